#include "base/tileable_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace scumble {

namespace {

// Unit vectors all around, since a cosine and a sine for each corner of each texel would take most of the
// time.
const std::array<std::pair<float, float>, 256>& directions() {
  static const std::array<std::pair<float, float>, 256> table = [] {
    std::array<std::pair<float, float>, 256> t;
    for (size_t i = 0; i < t.size(); ++i) {
      const float angle = float(i) * (6.28318531f / 256.0f);
      t[i] = {std::cos(angle), std::sin(angle)};
    }
    return t;
  }();
  return table;
}

}  // namespace

uint32_t hash(uint32_t value) {
  const uint32_t state = value * 747796405u + 2891336453u;
  const uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}

float gradientNoise(float x, float y, uint32_t periodX, uint32_t periodY, uint32_t seed) {
  const float floorX = std::floor(x), floorY = std::floor(y);
  const float fx = x - floorX, fy = y - floorY;
  const auto corner = [&](int dx, int dy) {
    const auto wrap = [](float cell, int offset, uint32_t period) {
      return uint32_t((int64_t(cell) + offset) % int64_t(period) + int64_t(period)) % period;
    };
    const uint32_t h = hash(wrap(floorX, dx, periodX) + hash(wrap(floorY, dy, periodY) + hash(seed)));
    const auto& [gx, gy] = directions()[h & 0xFF];
    return gx * (fx - float(dx)) + gy * (fy - float(dy));
  };
  const auto fade = [](float t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  const auto mix = [](float a, float b, float t) { return a + (b - a) * t; };
  const float u = fade(fx), v = fade(fy);
  return 1.41421356f * mix(mix(corner(0, 0), corner(1, 0), u), mix(corner(0, 1), corner(1, 1), u), v);
}

std::vector<float> selfSimilarNoise(uint32_t size, uint32_t firstPeriod, int octaves, float persistence,
                                    uint32_t seed, float stretch) {
  std::vector<float> field(size_t(size) * size, 0.0f);
  float amplitude = 1.0f;
  uint32_t period = firstPeriod;
  for (int octave = 0; octave < octaves; ++octave, period *= 2, amplitude *= persistence) {
    const uint32_t periodV = std::max(1u, uint32_t(std::lround(float(period) / stretch)));
    for (uint32_t y = 0; y < size; ++y)
      for (uint32_t x = 0; x < size; ++x) {
        const float u = (float(x) + 0.5f) / float(size), v = (float(y) + 0.5f) / float(size);
        field[size_t(y) * size + x] +=
            amplitude * gradientNoise(u * float(period), v * float(periodV), period, periodV,
                                      seed + uint32_t(octave) * 977u);
      }
  }
  double sum = 0, squares = 0;
  for (const float f : field) sum += f, squares += double(f) * f;
  const double mean = sum / double(field.size());
  const double deviation = std::sqrt(std::max(1e-12, squares / double(field.size()) - mean * mean));
  for (float& f : field) f = float((f - mean) / deviation);
  return field;
}

}  // namespace scumble
