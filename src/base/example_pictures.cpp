#include "base/example_pictures.h"

#include <algorithm>
#include <cmath>

#include "base/nested_marks.h"
#include "base/stroke_maps.h"
#include "base/tileable_noise.h"

namespace scumble {

namespace {

// A quarter of a unit is one deviation: then noise seldom leaves [0, 1].
uint8_t noiseByte(float v) {
  return uint8_t(std::lround(std::clamp(0.5f + v / 4.0f, 0.0f, 1.0f) * 255));
}

// Longer than wide, with flat tops and sharp sides; so many of them stand side by side.
std::vector<uint8_t> knifeMarks(uint32_t count) {
  const std::vector<float> noise = selfSimilarNoise(kBuiltInSize, count, 3, 0.6f, 5, 4.0f);
  std::vector<uint8_t> marks(noise.size());
  std::transform(noise.begin(), noise.end(), marks.begin(),
                 [](float v) { return uint8_t(std::lround((0.5f + 0.5f * std::tanh(1.05f * v)) * 255)); });
  return marks;
}

// A brush's edge and not a ripple: both fields are quiet along some stretches and bold along others, and once
// in a while the brush misses, all the way to one side.
void vary(std::vector<float>& x, std::vector<float>& y) {
  const std::vector<float> stretches = selfSimilarNoise(kBuiltInSize, 6, 2, 0.5f, 47);
  const std::vector<float> misses = selfSimilarNoise(kBuiltInSize, 11, 1, 1.0f, 61);
  float squares = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    const float part = std::clamp(0.5f + 0.45f * stretches[i], 0.0f, 1.0f);
    const float amount = 0.25f + 1.35f * part * part * (3 - 2 * part);
    const float miss = std::clamp(1.5f * (std::abs(misses[i]) - 1.9f), 0.0f, 1.2f);
    x[i] = amount * x[i] + std::copysign(miss, misses[i]);
    y[i] = amount * y[i] + miss;
    squares += x[i] * x[i] + y[i] * y[i];
  }
  const float deviation = 0.87f * std::sqrt(0.5f * squares / float(x.size()));  // they are as long as before
  for (std::vector<float>* const field : {&x, &y})
    for (float& value : *field) value /= deviation;
}

Pixels grey(const std::vector<uint8_t>& values) {
  Pixels pixels{kBuiltInSize, kBuiltInSize, std::vector<uint8_t>(values.size() * 4, 255)};
  for (size_t i = 0; i < values.size(); ++i)
    for (size_t c = 0; c < 3; ++c) pixels.rgba[4 * i + c] = values[i];
  return pixels;
}

}  // namespace

Pixels builtInExample(int index) {
  if (index == 3) return seaStrokes();
  if (index == 4) return foamStrokes();
  if (index == 5) return nestedMarks();
  if (index == 1) {
    // Lying, as `orient` wants them.
    const std::vector<uint8_t> standing = knifeMarks(32);
    std::vector<uint8_t> lying(standing.size());
    for (uint32_t y = 0; y < kBuiltInSize; ++y)
      for (uint32_t x = 0; x < kBuiltInSize; ++x)
        lying[y * kBuiltInSize + x] = standing[x * kBuiltInSize + y];
    return grey(lying);
  }
  if (index == 2) {
    const std::vector<float> grain = selfSimilarNoise(kBuiltInSize, 24, 4, 0.7f, 31);
    std::vector<uint8_t> bytes(grain.size());
    std::transform(grain.begin(), grain.end(), bytes.begin(), noiseByte);
    return grey(bytes);
  }
  std::vector<float> x = selfSimilarNoise(kBuiltInSize, 14, 3, 0.62f, 11);
  std::vector<float> y = selfSimilarNoise(kBuiltInSize, 14, 3, 0.62f, 23);
  vary(x, y);
  Pixels pixels = grey(knifeMarks(16));
  for (size_t i = 0; i < x.size(); ++i)
    pixels.rgba[4 * i] = noiseByte(x[i]), pixels.rgba[4 * i + 1] = noiseByte(y[i]);
  return pixels;
}

}  // namespace scumble
