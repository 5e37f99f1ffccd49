#include "xr/resolution.h"

#include <cmath>
#include <iterator>

namespace scumble::xr {

namespace {

// Parts of a period: the runtime's compositor needs some of it, and a step up must not be a step too far.
constexpr double kLate = 0.85, kRoom = 0.75;
// Being late is seen at once; more pixels can wait, since each step makes images anew.
constexpr int kLateFrames = 3, kEarlyFrames = 90;

}  // namespace

void Resolution::took(double device, double period) {
  if (!(device > 0) || !(period > 0)) return;
  const bool isLast = fixed_ || step_ + 1 == std::size(kSteps);
  const double pixels = step_ == 0 ? 1 : std::pow(kSteps[step_ - 1] / kSteps[step_], 2);
  late_ = device > kLate * period ? late_ + 1 : 0;
  early_ = step_ > 0 && device * pixels < kRoom * period ? early_ + 1 : 0;
  isTooMuch_ = isTooMuch_ || (late_ >= kLateFrames && isLast);
  if (late_ >= kLateFrames && !isLast) ++step_;
  if (early_ >= kEarlyFrames) --step_;
  if (late_ >= kLateFrames || early_ >= kEarlyFrames) late_ = early_ = 0;
}

glm::uvec2 Resolution::of(const glm::uvec2& size) const {
  return glm::max(glm::uvec2(glm::round(scale() * glm::vec2(size))), 1u);
}

}  // namespace scumble::xr
