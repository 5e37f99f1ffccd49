#include "film/frame_rate.h"

#include <cmath>
#include <cstdlib>
#include <numeric>

namespace scumble::film {
namespace {

constexpr int kLargestDenominator = 1001;
constexpr double kExact = 1e-6;     // below what six decimals can say
constexpr double kDecimals = 5e-3;  // 23.98 is 24000/1001, rounded to two decimals

}  // namespace

FrameRate frameRateOf(double fps) {
  const int whole = int(std::lround(fps));
  if (std::abs(fps - whole) < kExact && whole > 0) return {whole, 1};
  // Television's rates lie n/1001 below whole ones, which two decimals tell apart from about 12 on.
  if (whole >= 12 && std::abs(fps - whole * 1000.0 / 1001) < kDecimals) return {whole * 1000, 1001};

  FrameRate best{0, 1};
  double leastError = INFINITY;
  for (int denominator = 1; denominator <= kLargestDenominator; ++denominator) {
    const int numerator = int(std::lround(fps * denominator));
    const double error = std::abs(fps - double(numerator) / denominator);
    // Among fractions that are as good as equal, the simplest one.
    if (numerator == 0 || error > leastError - kExact * 1e-3) continue;
    best = {numerator, denominator};
    leastError = error;
  }
  return best;
}

}  // namespace scumble::film
