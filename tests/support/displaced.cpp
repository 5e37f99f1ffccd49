#include "tests/support/displaced.h"

#include <algorithm>

namespace scumble::test {

namespace {

// At places from the pixel's middle.
std::array<glm::dvec2, 4> vectorsAt(const Image& warp, int x, int y,
                                    const std::array<glm::dvec2, 4>& offsets) {
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
  for (size_t i = 0; i < 4; ++i) {
    // Of the way from one corner of the square to the other.
    const glm::dvec2 share = 0.5 + 0.5 * offsets[i] / reach;
    vectors[i] = glm::mix(glm::mix(a, b, share.x), glm::mix(c, d, share.x), share.y);
  }
  return vectors;
}

}  // namespace

std::array<glm::dvec2, 4> partVectors(const Image& warp, int x, int y) {
  return vectorsAt(warp, x, y, {glm::dvec2(-0.25, -0.25), {0.25, -0.25}, {-0.25, 0.25}, {0.25, 0.25}});
}

std::array<glm::dvec2, 4> displacedSamples(const Image& warp, int x, int y) {
  std::array<glm::dvec2, 4> offsets, places;
  for (size_t i = 0; i < 4; ++i) offsets[i] = kSampleLocations[i] - 0.5;
  const std::array<glm::dvec2, 4> vectors = vectorsAt(warp, x, y, offsets);
  for (size_t i = 0; i < 4; ++i) {
    const glm::dvec2 moved = glm::clamp(glm::dvec2(x, y) + kSampleLocations[i] + vectors[i], glm::dvec2(0.0),
                                        glm::dvec2(warp.width, warp.height) - 0.01);
    const glm::dvec2 corner = glm::floor(moved), part = moved - corner;
    places[i] = corner + kSampleLocations[size_t(part.x >= 0.5) + 2 * size_t(part.y >= 0.5)];
  }
  return places;
}

std::array<glm::dvec2, 4> displacedPlaces(const Image& warp, int x, int y) {
  std::array<glm::dvec2, 4> places = partVectors(warp, x, y);
  for (glm::dvec2& place : places)
    place = glm::clamp(glm::dvec2(x, y) + 0.5 + place, glm::dvec2(0.5),
                       glm::dvec2(warp.width, warp.height) - 0.5);
  return places;
}

}  // namespace scumble::test
