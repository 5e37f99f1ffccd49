// Which way strokes go over a mesh: a smooth field of directions on its vertices.
#pragma once

#include <span>
#include <vector>

#include "scene/scene_data.h"

namespace scumble::paint {

// By primitive, then by vertex: unit vectors along the surface, in mesh space.
using DirectionField = std::vector<std::vector<glm::vec3>>;

// Along the least curvature where the surface bends more one way than the other, and smoothly on from there;
// on the side of `towards`.
DirectionField alongCurvature(std::span<const scene::Primitive* const> primitives, const glm::vec3& towards);
// `towards`, laid onto the surface; where it stands on it, as around there.
DirectionField alongDirection(std::span<const scene::Primitive* const> primitives, const glm::vec3& towards);

}  // namespace scumble::paint
