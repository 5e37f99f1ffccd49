// A surface for paintings that have none: it lies on the outside of what strokes cover.
#pragma once

#include "scene/painting.h"

namespace scumble::bake {

// `cells`: how many lie along the painting's longest side; strokes that are closer than two of them have no
// gap between. A single sheet of paint gets two sides. Without triangles where there are no strokes.
scene::Primitive hullOf(const scene::Painting& painting, uint32_t cells);

}  // namespace scumble::bake
