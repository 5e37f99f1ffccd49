#include "measure/vergence.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "measure/statistics.h"

namespace scumble::measuring {

namespace {

constexpr int kHalfWindow = 6, kWindowStep = 6;  // of a window from its middle; between middles, pixels
constexpr int kBeyond = 8, kFarthest = 64;
constexpr double kFewest = 0.8;     // of a window's pixels must count
constexpr double kSomething = 0.5;  // of the whole field's deviation: there is something to see
// A window fits a disparity where it correlates so much, and another one better where it does by so much
// more.
constexpr double kFits = 0.8, kBetter = 0.1;
constexpr int kSame = 1;  // pixels: fine patterns are seen to that

std::optional<float> at(const Field& field, float x, float y) {
  const float fx = x - 0.5f, fy = y - 0.5f;
  const int i = int(std::floor(fx)), j = int(std::floor(fy));
  if (i < 0 || j < 0 || i + 1 >= field.width || j + 1 >= field.height) return std::nullopt;
  const float tx = fx - float(i), ty = fy - float(j);
  const size_t first = size_t(j) * size_t(field.width) + size_t(i), below = first + size_t(field.width);
  if (!field.valid[first] || !field.valid[first + 1] || !field.valid[below] || !field.valid[below + 1])
    return std::nullopt;
  const float top = (1 - tx) * *field.at(first) + tx * *field.at(first + 1);
  const float bottom = (1 - tx) * *field.at(below) + tx * *field.at(below + 1);
  return (1 - ty) * top + ty * bottom;
}

class Window {
 public:
  Window(const Field& left, const Field& right, const Places& places, int x, int y)
      : left_(left), right_(right), places_(places), x_(x), y_(y) {}

  // Of both eyes' pictures, where the left one's is moved aside by so much beyond the surface's disparity;
  // nothing where too little can be compared. `deviation`: the right one's.
  std::optional<double> correlation(int aside, double& deviation) const {
    double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
    size_t count = 0;
    for (int j = -kHalfWindow; j <= kHalfWindow; ++j)
      for (int i = -kHalfWindow; i <= kHalfWindow; ++i) {
        const size_t pixel = size_t(y_ + j) * size_t(right_.width) + size_t(x_ + i);
        if (!places_.valid[pixel] || !right_.valid[pixel]) continue;
        const auto other = at(left_, places_.at(pixel)[0] + float(aside), places_.at(pixel)[1]);
        if (!other) continue;
        const double own = *right_.at(pixel), his = *other;
        a += own, b += his, aa += own * own, bb += his * his, ab += own * his, ++count;
      }
    constexpr int kSide = 2 * kHalfWindow + 1;
    if (double(count) < kFewest * kSide * kSide) return std::nullopt;
    const double n = double(count);
    const double va = std::max(aa / n - a * a / n / n, 0.0), vb = std::max(bb / n - b * b / n / n, 0.0);
    deviation = std::sqrt(va);
    return va > 0 && vb > 0 ? (ab / n - a * b / n / n) / std::sqrt(va * vb) : 0;
  }

  // How far on the screen the left eye sees it from where the right one does, pixels.
  float disparity() const {
    const size_t pixel = size_t(y_) * size_t(right_.width) + size_t(x_);
    return places_.valid[pixel] ? std::abs(places_.at(pixel)[0] - (float(x_) + 0.5f)) : 0;
  }

 private:
  const Field &left_, &right_;
  const Places& places_;
  int x_, y_;
};

}  // namespace

Vergence vergenceOf(const Field& left, const Field& right, const Places& places) {
  Vergence vergence;
  const double something = kSomething * spread({&right, 1});
  if (!(something > 0)) return vergence;
  for (int y = kHalfWindow; y + kHalfWindow < right.height; y += kWindowStep)
    for (int x = kHalfWindow; x + kHalfWindow < right.width; x += kWindowStep) {
      const Window window(left, right, places, x, y);
      double deviation = 0, ignored = 0;
      const auto own = window.correlation(0, deviation);
      if (!own || deviation < something) continue;
      const int farthest = std::min(int(window.disparity()) + kBeyond, kFarthest);
      double best = -1;
      for (int aside = -farthest; aside <= farthest; ++aside)
        if (std::abs(aside) > kSame)
          if (const auto other = window.correlation(aside, ignored)) best = std::max(best, *other);
      ++vergence.windows;
      vergence.conflicts += best > kFits && best > *own + kBetter;
    }
  return vergence;
}

}  // namespace scumble::measuring
