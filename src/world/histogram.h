// What blending needs to know of an example texture: its statistics, and its Gaussian twin (Heitz and Neyret
// 2018, "High-performance by-example noise using a histogram-preserving blending operator").
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "base/pixels.h"

namespace scumble::world {

// Of each channel's bytes / 255.
struct Statistics {
  glm::vec4 mean{0.0f}, deviation{0.0f};
  // Largest distance between the channel's cumulative histogram and that of a Gaussian of the same mean and
  // deviation, 0 to 1 (Kolmogorov-Smirnov); 0 where the channel does not vary.
  glm::vec4 distanceToGaussian{0.0f};
};
Statistics measure(const Pixels& pixels);

// From a distance below this, blending that restores the variance alone is good enough: a uniform histogram
// lies at 0.06, two values of equal weight at 0.34.
constexpr float kGaussianEnough = 0.1f;

// Every channel's values by rank, so that their histogram is Gaussian with mean 0.5 and deviation 1 / 6;
// equal values stay equal. `inverse`: the way back, from 256 Gaussian values to the channel's own.
struct GaussianTwin {
  Pixels pixels;
  std::array<glm::u8vec4, 256> inverse{};
};
GaussianTwin gaussianTwin(const Pixels& pixels);

}  // namespace scumble::world
