// Vertices that are on a device are not needed on the CPU as well, if nothing changes there. What stays of a
// primitive: its material, counts, extent, colours and factors.
#pragma once

#include "scene/scene_data.h"

namespace scumble::scene {

// Those of a skinned or morphed primitive stay: they tell where it is in each frame. Frees others, and gives
// the heap's free pages back to the system from time to time (glibc). Nobody else may read the primitive
// meanwhile, nor its vertices ever after: all scenes that share it have lost them.
void dropVertices(const Primitive& primitive);

// Whether some have been dropped, so that no device can be given them any more.
bool hasDroppedVertices(const SceneData& scene);

}  // namespace scumble::scene
