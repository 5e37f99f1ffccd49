#include "panorama/tiling.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace scumble::panorama {

namespace {

constexpr float kPole = 0.5f * glm::pi<float>();
// Where eyes begin to draw together, and where they are one. Bands are narrower there.
const float kEasingFrom = glm::radians(40.0f), kEasingTo = glm::radians(85.0f);
// Between the middles of bands, at most; and between those of parts of one place, along either way.
const float kBand = glm::radians(13.5f), kEasedBand = glm::radians(6.3f), kMonoBand = glm::radians(18.0f);
const float kWidest = glm::radians(9.0f);
constexpr float kMarginLines = 48;  // around what is used of a frame, of 1080: filters look there

// Middles of bands from 0 to a pole.
std::vector<float> latitudesOf(bool isStereo) {
  std::vector<float> latitudes{0};
  const auto add = [&](float to, float most) {
    const float from = latitudes.back();
    const int steps = int(std::ceil((to - from) / most - 1e-3f));
    for (int i = 1; i <= steps; ++i) latitudes.push_back(from + (to - from) * float(i) / float(steps));
  };
  if (isStereo) add(kEasingFrom, kBand), add(kPole, kEasedBand);
  if (!isStereo) add(kPole, kMonoBand);
  return latitudes;
}

// Parts around a latitude. From one to the next the eyes step along the way they look, which moves what is
// seen up or down by the sine of the latitude: as much as at 45 degrees, so that no band has larger steps.
int partsOf(const Band& band, bool isStereo, float strip, float ipd) {
  const float most =
      (isStereo ? kWidest : kMonoBand) / std::cos(std::min(std::abs(band.latitude), kPole - 0.02f));
  const float farthest =
      std::min(std::abs(band.latitude) + kShareEnds * std::max(band.below, band.above), kPole);
  const float step = std::sin(farthest) * band.eyes / (0.5f * std::max(ipd, 1e-6f));
  const float spacing =
      isStereo ? std::min(strip * std::sin(0.5f * kPole) / std::max(step, 1e-6f), most) : most;
  return std::max(int(std::ceil(kTurn / spacing)), 8);
}

// Of the plane before the middle of a band's part, how far to the side and up what it must show reaches.
glm::vec2 tangentsOf(const Band& band) {
  glm::vec2 most(0.0f);
  const glm::mat3 toEye = glm::transpose(turnOf(0, band.latitude));
  const float lowest = std::max(band.latitude - kShareEnds * band.below, -kPole);
  const float highest = std::min(band.latitude + kShareEnds * band.above, kPole);
  const float side = band.parts == 1 ? 0.5f * kTurn : kShareEnds * band.spacing();
  constexpr int kSteps = 16;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const float longitude = side * (2.0f * float(i) / kSteps - 1);
      const float latitude = glm::mix(lowest, highest, float(j) / kSteps);
      const glm::vec3 d = toEye * (turnOf(longitude, latitude) * glm::vec3(0, 0, -1));
      most = glm::max(most, glm::abs(glm::vec2(d) / d.z));
    }
  return most;
}

}  // namespace

float Band::spacing() const {
  return kTurn / float(parts);
}
float Band::longitudeOf(int part) const {
  return (float(part) + 0.5f) * spacing() - 0.5f * kTurn;
}

float easing(float latitude) {
  const float t = std::clamp((std::abs(latitude) - kEasingFrom) / (kEasingTo - kEasingFrom), 0.0f, 1.0f);
  return 1 - t * t * (3 - 2 * t);
}

Tiling tilingOf(const Panorama& panorama, uint32_t height) {
  const bool isStereo = eyesOf(panorama.kind) > 1 && panorama.ipd > 0;
  Tiling tiling;
  tiling.pixelsOfRadian = float(height) / glm::pi<float>();
  std::vector<float> latitudes = latitudesOf(isStereo);
  for (const float latitude : std::vector<float>(latitudes.begin() + 1, latitudes.end()))
    latitudes.push_back(-latitude);
  std::sort(latitudes.begin(), latitudes.end());
  for (size_t i = 0; i < latitudes.size(); ++i) {
    Band band;
    band.latitude = latitudes[i];
    if (i > 0) band.below = latitudes[i] - latitudes[i - 1];
    if (i + 1 < latitudes.size()) band.above = latitudes[i + 1] - latitudes[i];
    if (isStereo) band.eyes = 0.5f * panorama.ipd * easing(band.latitude);
    const bool isPole = i == 0 || i + 1 == latitudes.size();
    band.parts = isPole ? 1 : partsOf(band, isStereo, glm::radians(panorama.strip), panorama.ipd);
    tiling.bands.push_back(band);
  }
  // Images are made anew where frames have another size: broad bands have one, and narrow ones.
  const float margin = glm::radians(panorama.knobHeight) * kMarginLines / 1080;
  const auto isNarrow = [](const Band& band) { return std::abs(band.latitude) > kEasingFrom + 0.01f; };
  for (Band& band : tiling.bands) {
    glm::vec2 tangents(0.0f);
    for (const Band& other : tiling.bands)
      if (isNarrow(other) == isNarrow(band)) tangents = glm::max(tangents, tangentsOf(other));
    // Whole pixels on both sides of the middle.
    band.size = 2u * glm::uvec2(glm::ceil((tangents + margin) * tiling.pixelsOfRadian + 1.0f));
  }
  return tiling;
}

float shareAt(float offset, float spacing) {
  // All of it up to a quarter of the way, half of it half way.
  const float t = std::clamp(1.5f - 2 * std::abs(offset) / spacing, 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

glm::mat3 turnOf(float longitude, float latitude) {
  const float s = std::sin(longitude), c = std::cos(longitude);
  const float up = std::sin(latitude), out = std::cos(latitude);
  const glm::vec3 ahead(s * out, up, -c * out), right(c, 0, s);
  return {right, glm::cross(right, ahead), -ahead};
}

glm::vec3 placeOf(float longitude, float aside) {
  return aside * glm::vec3(std::cos(longitude), 0, std::sin(longitude));
}

}  // namespace scumble::panorama
