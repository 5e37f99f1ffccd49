// Where a pixel's point of the surface stood in another picture, exactly, from what the renderer knows of it.
#pragma once

#include <glm/glm.hpp>

#include "measure/field.h"

namespace scumble::measuring {

// A view's pixels in the world, where something is.
struct Surface {
  Field position;  // x, y, z in metres
  Field depth;     // metres along the view axis
  // How much a pixel covers: metres for each metre of depth, or metres alone in a parallel projection.
  float pixel = 0;
  bool parallel = false;

  float footprint(float atDepth) const { return parallel ? pixel : pixel * atDepth; }
};

// Positions closer than this are the same point, in footprints of a pixel.
constexpr float kSamePoint = 2.2f;
// Depths that differ by more than this among the pixels that sampleAt uses, in footprints, are an edge
// between two surfaces; the steepest slope that does not count as one is some 80 degrees.
constexpr float kEdge = 26;

// For each pixel of `now` the place in `earlier`, by the motion AOV (pixels since then; x right, y down). Not
// valid where the point was hidden, beside an edge or out of the picture then.
Places placesByMotion(const Field& motion, const Surface& now, const Surface& earlier);

// For each pixel of `here` the place in another view of the same moment, by projecting its position there.
// Not valid where that view does not see the point, or sees it beside an edge. `worldToClip`: that view's (y
// down).
Places placesByProjection(const Surface& here, const Surface& there, const glm::mat4& worldToClip);

}  // namespace scumble::measuring
