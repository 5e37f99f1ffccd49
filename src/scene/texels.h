// What a texture shows at a place of a surface, on the CPU.
#pragma once

#include "scene/scene_data.h"

namespace scumble::scene {

// The coordinates that a texture lies on.
const std::vector<glm::vec2>& coordinatesOf(const Primitive& primitive, const TextureUse& use);

// The texel there, as the file has it, 0 to 1: sRGB, which is close to a square root, and alpha.
glm::dvec4 texelAt(const TextureImage& image, const TextureUse& use, const glm::vec2& uv);

}  // namespace scumble::scene
