// A small seeded random number generator (PCG32). The standard library's distributions differ between
// implementations; these do not, so a scene is the same on every machine.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace meshkit {

class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed * 6364136223846793005ull + 1442695040888963407ull) { next(); }

  uint32_t next() {
    const uint64_t old = state_;
    state_ = old * 6364136223846793005ull + 1442695040888963407ull;
    const uint32_t shifted = uint32_t(((old >> 18u) ^ old) >> 27u);
    const uint32_t turn = uint32_t(old >> 59u);
    return (shifted >> turn) | (shifted << ((32u - turn) & 31u));
  }

  // In [0, 1).
  float unit() { return float(next() >> 8) * (1.0f / 16777216.0f); }
  float between(float low, float high) { return low + (high - low) * unit(); }
  int below(int count) { return int(next() % uint32_t(count)); }

  // Uniform on the unit sphere.
  glm::vec3 direction() {
    const float z = between(-1.0f, 1.0f), angle = between(0.0f, 6.2831853f);
    const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
    return {r * std::cos(angle), z, r * std::sin(angle)};
  }

 private:
  uint64_t state_;
};

}  // namespace meshkit
