#include "study/borders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace scumble::study {

namespace {

struct Piece {
  double raggedness = 0, width = 0;  // pixels
};

// What is left of the numbers without the parabola that is nearest to them, and that parabola's slope.
struct Rest {
  double rms = 0, slope = 0;
};
Rest withoutParabola(const std::array<double, kPiece>& values) {
  // Legendre's first three polynomials, made orthogonal on these points.
  Rest rest;
  double mean = 0, linear = 0, linear2 = 0, square = 0, square2 = 0, middle = 0;
  const auto at = [](int i) { return (2 * i + 1.0) / kPiece - 1; };
  for (int i = 0; i < kPiece; ++i) mean += values[size_t(i)] / kPiece, middle += at(i) * at(i) / kPiece;
  for (int i = 0; i < kPiece; ++i) {
    const double t = at(i), q = t * t - middle;
    linear += t * values[size_t(i)], linear2 += t * t;
    square += q * values[size_t(i)], square2 += q * q;
  }
  linear /= linear2, square /= square2;
  double sum = 0;
  for (int i = 0; i < kPiece; ++i) {
    const double t = at(i), left = values[size_t(i)] - mean - linear * t - square * (t * t - middle);
    sum += left * left;
  }
  rest.rms = std::sqrt(sum / kPiece);
  rest.slope = linear * 2 / kPiece;
  return rest;
}

std::optional<Piece> followed(const Plane& areas, int left, int top) {
  constexpr double kLeastStep = 0.06;  // OKLab lightness
  std::vector<float> values;
  values.reserve(kPiece * kPiece);
  for (int y = 0; y < kPiece; ++y)
    for (int x = 0; x < kPiece; ++x) values.push_back(areas.at(left + x, top + y));
  const double low = quantile(values, 0.1), high = quantile(values, 0.9), step = high - low;
  if (step < kLeastStep) return std::nullopt;
  const double level = 0.5 * (low + high);
  std::array<double, kPiece> crossing;
  std::vector<float> widths;
  const bool begins = areas.at(left, top) > level;
  for (int y = 0; y < kPiece; ++y) {
    int crossings = 0;
    double steepest = 0;
    if ((areas.at(left, top + y) > level) != begins) return std::nullopt;
    for (int x = 0; x + 1 < kPiece; ++x) {
      const double one = areas.at(left + x, top + y), next = areas.at(left + x + 1, top + y);
      steepest = std::max(steepest, std::abs(next - one));
      if ((one > level) == (next > level)) continue;
      ++crossings;
      crossing[size_t(y)] = x + (level - one) / (next - one);
    }
    if (crossings != 1) return std::nullopt;
    if (y > 0 && std::abs(crossing[size_t(y)] - crossing[size_t(y) - 1]) > 6) return std::nullopt;
    widths.push_back(float(step / steepest));
  }
  const Rest rest = withoutParabola(crossing);
  if (std::abs(rest.slope) > 1.05) return std::nullopt;
  const double across = 1 / std::sqrt(1 + rest.slope * rest.slope);
  return Piece{rest.rms * across, quantile(widths, 0.5) * across};
}

}  // namespace

StudiedBorders bordersOf(const Plane& areas, double pixelsAt1080) {
  constexpr int kStride = 8;
  std::vector<float> raggedness, widths;
  for (const Plane& plane : {areas, transposed(areas)})
    for (int top = 0; top + kPiece <= plane.height; top += kStride)
      for (int left = 0; left + kPiece <= plane.width; left += kStride)
        if (const std::optional<Piece> piece = followed(plane, left, top)) {
          raggedness.push_back(float(piece->raggedness));
          widths.push_back(float(piece->width));
        }
  StudiedBorders borders;
  borders.counted = double(raggedness.size()) * kStride / kPiece;
  borders.raggedness = quantile(raggedness, 0.5) * pixelsAt1080;
  borders.width = quantile(widths, 0.5) * pixelsAt1080;
  return borders;
}

}  // namespace scumble::study
