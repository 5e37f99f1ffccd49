// Where a pixel's point of the surface stood in another picture, exactly, from what the renderer knows of it.
#pragma once

#include <glm/glm.hpp>

#include "measure/field.h"

namespace scumble::measuring {

// A view's pixels in the world: position AOV and eye depth (the warp AOV's A or the depth AOV), where
// something is.
struct Surface {
  Field position;  // x, y, z in metres
  Field depth;     // metres along the view axis
};

// Two positions are the same point where they are at most this part of their distance from the eye apart:
// some two pixels of a view of 34 degrees and 540 lines.
constexpr float kSamePoint = 0.0025f;
// Where depths around a place, as far as sampleAt reaches, differ by more than this part, there is an edge
// between two surfaces: what lies on one must not be mixed with what lies on the other.
constexpr float kSameSurface = 0.03f;

// For each pixel of `now` the place in `earlier`, by the motion AOV (pixels since then; x right, y down). Not
// valid where the point was hidden, beside an edge or out of the picture then.
Places placesByMotion(const Field& motion, const Surface& now, const Surface& earlier);

// For each pixel of `here` the place in another view of the same moment, by projecting its position there.
// Not valid where that view does not see the point, or sees it beside an edge. `worldToClip`: that view's (y
// down).
Places placesByProjection(const Surface& here, const Surface& there, const glm::mat4& worldToClip);

}  // namespace scumble::measuring
