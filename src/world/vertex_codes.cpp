#include "world/vertex_codes.h"

#include <algorithm>
#include <cmath>

namespace scumble::world {

uint32_t encodeNormal(glm::vec3 n) {
  n /= std::max(std::abs(n.x) + std::abs(n.y) + std::abs(n.z), 1e-20f);
  glm::vec2 oct(n.x, n.y);
  if (n.z < 0)
    oct = {(1 - std::abs(n.y)) * (n.x >= 0 ? 1.0f : -1.0f), (1 - std::abs(n.x)) * (n.y >= 0 ? 1.0f : -1.0f)};
  const auto snorm = [](float v) {
    return uint32_t(uint16_t(int16_t(std::lround(std::clamp(v, -1.0f, 1.0f) * 32767))));
  };
  return snorm(oct.x) | snorm(oct.y) << 16;
}

}  // namespace scumble::world
