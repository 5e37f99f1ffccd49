// The shape of the hull as functions, so that everything that is built on it touches it.
// s runs from the stern (0) to the stem (1), t from the keel (0) to the sheer (1).
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace demo {

// The sheer line: highest at the stem, lowest a little aft of amidships.
inline float sheerHeight(float s) {
  const float d = s - 0.36f;
  return 0.60f + (d > 0 ? 1.12f * d * d : 1.05f * d * d);
}

inline float keelHeight(float s) {
  return -0.36f + 0.16f * (1.0f - s) * (1.0f - s) + 0.10f * s * s * s * s;
}

// Half the beam at the sheer.
inline float halfBeam(float s) {
  constexpr float kWidest = 0.42f, kBeam = 1.0f, kTransom = 0.66f;
  if (s < kWidest) {
    const float d = 1.0f - s / kWidest;
    return kBeam - (kBeam - kTransom) * d * d;
  }
  const float d = (s - kWidest) / (1.0f - kWidest);
  return std::max(kBeam * (1.0f - std::pow(d, 2.3f)), 0.02f);
}

// A point of the starboard side.
inline glm::vec3 hullPoint(float s, float t) {
  const float stern = glm::mix(-2.42f, -2.62f, t);
  const float stem = glm::mix(1.65f, 2.75f, std::pow(t, 0.55f));
  const float y = glm::mix(keelHeight(s), sheerHeight(s), std::pow(t, 1.1f));
  // Round bilges amidships, a sharp V forward.
  const float bilge = glm::mix(0.52f, 1.05f, std::pow(s, 2.2f));
  return {glm::mix(stern, stem, s), y, halfBeam(s) * std::pow(t, bilge)};
}

// The station whose sheer is at x.
inline float stationAt(float x) {
  return std::clamp((x + 2.62f) / 5.37f, 0.0f, 1.0f);
}

// The deck lies a little under the sheer; z is measured from the middle.
inline float deckHeight(float x, float z) {
  const float s = stationAt(x);
  const float across = std::min(std::abs(z) / std::max(halfBeam(s), 0.05f), 1.0f);
  return sheerHeight(s) - 0.07f + 0.05f * (1.0f - across * across);
}

// The opening of the cockpit: half its width at x, 0 where there is none.
constexpr float kCockpitAft = -1.95f, kCockpitFore = 0.45f;
inline float cockpitHalfWidth(float x) {
  const float u = 2.0f * (x - kCockpitAft) / (kCockpitFore - kCockpitAft) - 1.0f;
  if (u <= -1.0f || u >= 1.0f) return 0.0f;
  return 0.60f * std::pow(1.0f - std::pow(std::abs(u), 3.5f), 0.5f);
}

constexpr float kSole = 0.16f;      // the cockpit's floor
constexpr float kBench = 0.46f;     // the seats along its sides
constexpr float kMastFoot = 1.10f;  // the mast's x

}  // namespace demo
