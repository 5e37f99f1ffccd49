// Noise that repeats without a seam, reproducible on every machine: the same seed gives the same numbers.
#pragma once

#include <cstdint>
#include <vector>

namespace scumble {

// A well-mixed 32-bit hash (Wang-Jenkins style finaliser of Ettinger's PCG, "rxs m xs").
uint32_t hash(uint32_t value);

// Gradient noise in about [-1, 1] at (x, y) in cells, repeating every so many cells along each axis.
float gradientNoise(float x, float y, uint32_t periodX, uint32_t periodY, uint32_t seed);

// Self-similar noise: octaves of gradient noise from `firstPeriod` cells an edge on, each twice as fine and
// `persistence` times as strong, over a square of size x size texels; scaled to mean 0 and standard
// deviation 1. `stretch`: how much longer than wide its features are, along v.
std::vector<float> selfSimilarNoise(uint32_t size, uint32_t firstPeriod, int octaves, float persistence,
                                    uint32_t seed, float stretch = 1.0f);

}  // namespace scumble
