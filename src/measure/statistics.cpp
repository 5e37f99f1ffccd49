#include "measure/statistics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scumble::measuring {

std::vector<double> meanOf(std::span<const Field> fields) {
  std::vector<double> mean(fields.empty() ? 0 : size_t(fields[0].channels));
  size_t count = 0;
  for (const Field& field : fields) {
    for (size_t pixel = 0; pixel < field.pixelCount(); ++pixel) {
      if (!field.valid[pixel]) continue;
      ++count;
      for (size_t c = 0; c < mean.size(); ++c) mean[c] += field.at(pixel)[c];
    }
  }
  for (double& m : mean) m /= double(std::max<size_t>(count, 1));
  return mean;
}

namespace {

constexpr size_t kFewestPairs = 24;  // of pixels, below which a correlation is chance

// Correlation of pixels (stepX, stepY) apart; nothing known (-2) where there are too few of them.
double correlation(std::span<const Field> fields, const std::vector<double>& mean, int stepX, int stepY) {
  double product = 0, squares = 0;
  size_t pairs = 0;
  for (const Field& field : fields) {
    const size_t step = size_t(stepY) * size_t(field.width) + size_t(stepX);
    for (int y = 0; y + stepY < field.height; ++y) {
      for (int x = 0; x + stepX < field.width; ++x) {
        const size_t pixel = size_t(y) * size_t(field.width) + size_t(x);
        if (!field.isPair(pixel, pixel + step)) continue;
        ++pairs;
        for (size_t c = 0; c < mean.size(); ++c) {
          const double a = field.at(pixel)[c] - mean[c], b = field.at(pixel + step)[c] - mean[c];
          product += a * b;
          squares += 0.5 * (a * a + b * b);
        }
      }
    }
  }
  return pairs < kFewestPairs || squares <= 0 ? -2 : product / squares;
}

// Lag at which the correlation along a direction falls to a half, pixels; 0 where it never does. Between two
// lags the angle acos(r) is interpolated, which is exact for a cosine, also below one pixel.
double halfLag(std::span<const Field> fields, const std::vector<double>& mean, bool alongX) {
  constexpr double kHalf = std::numbers::pi / 3;  // acos(1/2)
  const int longest = alongX ? fields[0].width : fields[0].height;
  double before = 0, beforeLag = 0;
  for (int lag = 1; lag < longest; lag += std::max(1, lag / 4)) {
    const double r = correlation(fields, mean, alongX ? lag : 0, alongX ? 0 : lag);
    if (r < -1) return 0;
    const double angle = std::acos(std::clamp(r, -1.0, 1.0));
    if (angle >= kHalf) return beforeLag + (kHalf - before) / (angle - before) * (lag - beforeLag);
    before = angle, beforeLag = lag;
  }
  return 0;
}

}  // namespace

double spread(std::span<const Field> fields) {
  const std::vector<double> mean = meanOf(fields);
  double squares = 0;
  size_t count = 0;
  for (const Field& field : fields) {
    for (size_t pixel = 0; pixel < field.pixelCount(); ++pixel) {
      if (!field.valid[pixel]) continue;
      ++count;
      for (size_t c = 0; c < mean.size(); ++c) squares += std::pow(field.at(pixel)[c] - mean[c], 2);
    }
  }
  return std::sqrt(squares / double(std::max<size_t>(count, 1)));
}

FieldDifference difference(const Field& a, const Field& b) {
  Field both[2] = {a, b};
  FieldDifference result;
  double squares = 0;
  for (size_t pixel = 0; pixel < a.pixelCount(); ++pixel) {
    const bool counts = a.valid[pixel] && b.valid[pixel];
    both[0].valid[pixel] = both[1].valid[pixel] = counts;
    if (!counts) continue;
    ++result.pixels;
    for (int c = 0; c < a.channels; ++c) squares += std::pow(double(a.at(pixel)[c]) - b.at(pixel)[c], 2);
  }
  if (result.pixels == 0) return result;
  result.rms = std::sqrt(squares / double(result.pixels));
  if (const double own = spread(both); own > 0) result.relative = result.rms / (std::numbers::sqrt2 * own);
  return result;
}

double dominantFrequency(std::span<const Field> fields) {
  if (fields.empty()) return 0;
  const std::vector<double> mean = meanOf(fields);
  const double x = halfLag(fields, mean, true), y = halfLag(fields, mean, false);
  const double lag = x > 0 && y > 0 ? 0.5 * (x + y) : std::max(x, y);
  return lag > 0 ? 1 / (6 * lag) : 0;
}

}  // namespace scumble::measuring
