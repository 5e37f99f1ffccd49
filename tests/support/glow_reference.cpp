#include "tests/support/glow_reference.h"

#include <algorithm>
#include <cmath>

namespace scumble::test {

namespace {

Texels spreadAlong(const Texels& source, glm::ivec2 axis, double reach) {
  const int farthest = int(std::ceil(reach));
  const auto weightOf = [&](int away) {
    const double part = 1 - std::pow(std::min(std::abs(away) / (reach + 0.5), 1.0), 2);
    return std::pow(part, 4);
  };
  double sum = 0;
  for (int i = -farthest; i <= farthest; ++i) sum += weightOf(i);
  Texels result(source.width, source.height);
  for (int y = 0; y < source.height; ++y)
    for (int x = 0; x < source.width; ++x)
      for (int i = -farthest; i <= farthest; ++i) {
        const glm::ivec2 at = glm::ivec2(x, y) + i * axis;
        if (at.x < 0 || at.y < 0 || at.x >= source.width || at.y >= source.height) continue;
        result.at(x, y) += weightOf(i) / sum * source.clamped(at.x, at.y);
      }
  return result;
}

}  // namespace

Texels glowReference(const Image& shadow, double reach) {
  Texels quarter(int(shadow.width) / 4, int(shadow.height) / 4);
  for (int y = 0; y < int(shadow.height); ++y)
    for (int x = 0; x < int(shadow.width); ++x) {
      const glm::dvec4 s = texel(shadow, x, y);
      quarter.at(x / 4, y / 4).x += s.y * s.w / 16;
    }
  const double texels = std::max(0.01 * reach * shadow.height / 4, 1.0);
  return spreadAlong(spreadAlong(quarter, {1, 0}, texels), {0, 1}, texels);
}

}  // namespace scumble::test
