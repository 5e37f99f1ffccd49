// A surface laid flat, for patterns that are to run on over it: coordinates that know no file's packing.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/scene_data.h"

namespace scumble::scene {

struct Unfolding {
  // By vertex: which of the primitive's it is. The primitive's own come first; at seams there are more.
  std::vector<uint32_t> source;
  std::vector<uint32_t> indices;  // of these, as many as the primitive's
  std::vector<glm::vec2> uvs;     // of these; one unit is 1 / `scale` metres, so long as nothing is stretched
};

// Pieces grow from their largest triangle outward, each triangle laid beside one that lies already, across
// its edge; over creases later, so that pieces meet there. A piece ends where triangles would be stretched or
// squeezed to more than four times, which a ball is at 140 degrees from where it began, and may lie over
// itself: a pattern repeats anyway. Then all are relaxed towards their own shape, within these bounds.
// Nothing is mirrored. What is up in mesh space is up where a piece begins.
//
// Triangles meet at edges whose ends share places, to 1 / 65536 of the primitive, whatever vertices they
// have. Where more than two do, those go on that are turned least against each other. Triangles of which two
// corners share a place lie wherever those beside them do. Depends on nothing but the primitive and `scale`.
Unfolding unfold(const Primitive& primitive, float scale);

}  // namespace scumble::scene
