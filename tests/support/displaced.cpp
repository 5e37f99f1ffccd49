#include "tests/support/displaced.h"

#include <algorithm>

namespace scumble::test {

std::array<glm::dvec2, 4> partVectors(const Image& warp, int x, int y) {
  std::array<glm::dvec2, 4> vectors{};
  const glm::dvec4 own = texel(warp, x, y);
  if (own.w == 0 || glm::dvec2(own) == glm::dvec2(0.0)) return vectors;
  const double reach = std::max(0.75 * double(warp.height) / 1080, 0.25);
  const auto at = [&](const glm::dvec2& place) {
    const glm::dvec2 corner = glm::floor(place - 0.5), f = place - 0.5 - corner;
    const int i = int(corner.x), j = int(corner.y);
    return glm::dvec2(glm::mix(glm::mix(texel(warp, i, j), texel(warp, i + 1, j), f.x),
                               glm::mix(texel(warp, i, j + 1), texel(warp, i + 1, j + 1), f.x), f.y));
  };
  const glm::dvec2 middle = glm::dvec2(x, y) + 0.5;
  const glm::dvec2 a = at(middle + reach * glm::dvec2(-1, -1)), b = at(middle + reach * glm::dvec2(1, -1)),
                   c = at(middle + reach * glm::dvec2(-1, 1)), d = at(middle + reach * glm::dvec2(1, 1));
  for (int i = 0; i < 4; ++i) {
    // A quarter of a pixel from its middle, of the way from one corner of the square to the other.
    const glm::dvec2 share = 0.5 + 0.25 * glm::dvec2((i & 1) - 0.5, (i >> 1) - 0.5) / reach;
    vectors[size_t(i)] = glm::mix(glm::mix(a, b, share.x), glm::mix(c, d, share.x), share.y);
  }
  return vectors;
}

std::array<glm::dvec2, 4> displacedPlaces(const Image& warp, int x, int y) {
  std::array<glm::dvec2, 4> places = partVectors(warp, x, y);
  for (glm::dvec2& place : places)
    place = glm::clamp(glm::dvec2(x, y) + 0.5 + place, glm::dvec2(0.5),
                       glm::dvec2(warp.width, warp.height) - 0.5);
  return places;
}

}  // namespace scumble::test
