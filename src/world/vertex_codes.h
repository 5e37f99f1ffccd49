// Numbers of vertices as the device has them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace scumble::world {

// A unit vector in 2 x snorm16, by the octahedral map (shading/frame.glsl decodes it).
uint32_t encodeNormal(glm::vec3 n);

}  // namespace scumble::world
