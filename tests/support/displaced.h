// From where `final_color` takes a pixel (src/shading/displacement.glsl), by the vectors of the AOV `warp`,
// before what ripple is kept off.
#pragma once

#include <array>

#include "tests/support/aov.h"

namespace scumble::test {

// Four vectors: means over a square, 0.75 pixels at 1080 lines around the pixel's middle, in each quarter of
// the pixel. None where the pixel's own is none.
std::array<glm::dvec2, 4> partVectors(const Image& warp, int x, int y);

// The places that they move the pixel's middle to, which stay in the picture: the texels around them are
// interpolated.
std::array<glm::dvec2, 4> displacedPlaces(const Image& warp, int x, int y);

// Where samples lie in a pixel: Vulkan's standard locations of four.
inline constexpr std::array<glm::dvec2, 4> kSampleLocations{
    glm::dvec2(0.375, 0.125), {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}};

// Where the pixel has several samples: of each the place of the sample that it takes the colour of, which is
// in the same quarter of a pixel as where it is moved to.
std::array<glm::dvec2, 4> displacedSamples(const Image& warp, int x, int y);

}  // namespace scumble::test
