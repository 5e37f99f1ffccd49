#include "world/histogram.h"

#include <algorithm>
#include <cmath>

namespace scumble::world {

namespace {

constexpr double kDeviation = 1.0 / 6.0;

double cumulative(double x) {
  return 0.5 * std::erfc(-x / std::sqrt(2.0));
}

// The inverse of `cumulative` by bisection: a few hundred calls, and no table of coefficients to get wrong.
double quantile(double p) {
  double low = -8, high = 8;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (cumulative(middle) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

using Counts = std::array<uint64_t, 256>;

Counts countsOf(const Pixels& pixels, int channel) {
  Counts counts{};
  for (size_t i = size_t(channel); i < pixels.rgba.size(); i += 4) ++counts[pixels.rgba[i]];
  return counts;
}

uint8_t toByte(double v) {
  return uint8_t(std::lround(std::clamp(v, 0.0, 1.0) * 255));
}

}  // namespace

Statistics measure(const Pixels& pixels) {
  Statistics result;
  const size_t count = pixels.rgba.size() / 4;
  const double total = double(count);
  if (total == 0) return result;
  for (int c = 0; c < 4; ++c) {
    const Counts counts = countsOf(pixels, c);
    double sum = 0, squares = 0;
    for (int v = 0; v < 256; ++v) sum += v * double(counts[v]), squares += v * v * double(counts[v]);
    const double mean = sum / total, deviation = std::sqrt(std::max(squares / total - mean * mean, 0.0));
    result.mean[c] = float(mean / 255);
    result.deviation[c] = float(deviation / 255);
    if (deviation < 0.5) continue;
    double below = 0, distance = 0;
    for (int v = 0; v < 256; ++v) {
      below += double(counts[v]);
      distance = std::max(distance, std::abs(below / total - cumulative((v + 0.5 - mean) / deviation)));
    }
    result.distanceToGaussian[c] = float(distance);
  }
  return result;
}

GaussianTwin gaussianTwin(const Pixels& pixels) {
  GaussianTwin twin{pixels, {}};
  const size_t count = pixels.rgba.size() / 4;
  const double total = double(count);
  for (int c = 0; c < 4; ++c) {
    const Counts counts = countsOf(pixels, c);
    std::array<uint8_t, 256> byValue{};
    double below = 0;
    for (int v = 0; v < 256; ++v) {
      if (counts[v] == 0) continue;
      byValue[v] = toByte(0.5 + kDeviation * quantile((below + 0.5 * double(counts[v])) / total));
      below += double(counts[v]);
    }
    for (size_t i = size_t(c); i < twin.pixels.rgba.size(); i += 4)
      twin.pixels.rgba[i] = byValue[twin.pixels.rgba[i]];
    // The value at each Gaussian value's rank.
    int value = 0;
    double upTo = double(counts[0]);
    for (int g = 0; g < 256; ++g) {
      const double rank = cumulative((g / 255.0 - 0.5) / kDeviation) * total;
      while (value < 255 && upTo < rank) upTo += double(counts[++value]);
      twin.inverse[size_t(g)][c] = uint8_t(value);
    }
  }
  return twin;
}

}  // namespace scumble::world
