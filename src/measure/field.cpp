#include "measure/field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace scumble::measuring {

namespace {

constexpr int kLobes = 3;
using Taps = std::array<float, 2 * kLobes>;

// Weights of the pixels first ... first + 5, whose centres lie around `place`; they add up to 1.
Taps lanczos(float place, int* first) {
  const double at = double(place) - 0.5, floored = std::floor(at), fraction = at - floored;
  *first = int(floored) - (kLobes - 1);
  Taps taps{};
  double sum = 0;
  for (int i = 0; i < 2 * kLobes; ++i) {
    const double x = std::numbers::pi * (i - (kLobes - 1) - fraction);
    const double weight = std::abs(x) < 1e-6 ? 1 : kLobes * std::sin(x) * std::sin(x / kLobes) / (x * x);
    taps[size_t(i)] = std::abs(weight) < 1e-6 ? 0 : float(weight);
    sum += weight;
  }
  for (float& tap : taps) tap = float(tap / sum);
  return taps;
}

}  // namespace

Field::Field(int w, int h, int channelCount)
    : width(w),
      height(h),
      channels(channelCount),
      values(size_t(w) * size_t(h) * size_t(channelCount)),
      valid(size_t(w) * size_t(h)) {}

size_t Field::validCount() const {
  return size_t(std::count(valid.begin(), valid.end(), uint8_t(1)));
}

Field fieldOf(const Image& image, uint32_t first, uint32_t count, const Image& mask, uint32_t maskChannel,
              float scale) {
  Field field(int(image.width), int(image.height), int(count));
  const size_t stride = image.channels.size(), maskStride = mask.channels.size();
  for (size_t pixel = 0; pixel < field.pixelCount(); ++pixel) {
    bool counts = mask.pixels[pixel * maskStride + maskChannel] > 0;
    for (uint32_t c = 0; c < count; ++c) {
      const float value = image.pixels[pixel * stride + first + c] * scale;
      counts = counts && std::isfinite(value);
      field.at(pixel)[c] = std::isfinite(value) ? value : 0;
    }
    field.valid[pixel] = counts;
  }
  return field;
}

Field sampleAt(const Field& field, const Places& places) {
  Field sampled(places.width, places.height, field.channels);
  for (size_t pixel = 0; pixel < places.pixelCount(); ++pixel) {
    if (!places.valid[pixel]) continue;
    int left = 0, top = 0;
    const Taps across = lanczos(places.at(pixel)[0], &left), down = lanczos(places.at(pixel)[1], &top);
    bool counts = true;
    float* out = sampled.at(pixel);
    for (int j = 0; j < 2 * kLobes && counts; ++j) {
      if (down[size_t(j)] == 0) continue;
      for (int i = 0; i < 2 * kLobes && counts; ++i) {
        const float weight = across[size_t(i)] * down[size_t(j)];
        if (weight == 0) continue;
        const int x = left + i, y = top + j;
        counts = x >= 0 && y >= 0 && x < field.width && y < field.height;
        if (!counts) break;
        const size_t tap = size_t(y) * size_t(field.width) + size_t(x);
        counts = field.valid[tap];
        for (int c = 0; c < field.channels; ++c) out[c] += weight * field.at(tap)[c];
      }
    }
    sampled.valid[pixel] = counts;
  }
  return sampled;
}

}  // namespace scumble::measuring
