// What surfaces take from each other of the light that comes from all around, at their vertices: where
// corners are closed, and in which colour what stands close by is seen from there (one bounce).
#pragma once

#include <functional>
#include <glm/gtc/type_precision.hpp>
#include <vector>

#include "base/shared.h"
#include "scene/scene_data.h"
#include "world/geometry.h"

namespace scumble::world {

// Of each item's vertices, or of none: rgb is the square root of the mean colour (linear) of what is seen
// within `reach` metres, by the cosine and by how near it is, and alpha how much of the half sphere that is;
// bytes. Things are as they stand at rest; what a skin bends has nothing around it but itself, in its bind
// pose. The ground and what features make are neither seen nor see anything.
std::vector<std::vector<glm::u8vec4>> indirectLight(
    const std::vector<GeometryItem>& items, const std::function<const scene::Material&(size_t)>& materialOf,
    const std::vector<Shared<scene::TextureImage>>& images, float reach);

}  // namespace scumble::world
