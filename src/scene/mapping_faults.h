// Whether patterns can follow a file's texture coordinates: atlases are cut where packing was easiest, halves
// are mirrored to save texels, and some parts get many more texels than others.
#pragma once

#include "scene/scene_data.h"

namespace scumble::scene {

// What is wrong with uv0 for a pattern that should run on over the surface.
struct MappingFaults {
  float unmapped = 0;  // part of the surface that lies on points and lines, as in atlases of plain colours
  float uneven = 0;    // part whose density is more than four times off the usual one of the rest
  // Length of the edges over which the surface goes on and the mapping breaks off or turns back, by the
  // square root of the surface's area: 1 is one side of a square that is as large. Edges at creases and where
  // the mapping closes on itself are none.
  float seams = 0;
  bool isMissing() const { return unmapped > 0.1f; }
  // One seam around a ball is 0.89.
  bool any() const { return isMissing() || uneven > 0.1f || seams > 1.0f; }
};

// `scale` brings the mesh to size one, so that areas neither overflow nor vanish.
MappingFaults mappingFaults(const Primitive& primitive, float scale);

}  // namespace scumble::scene
