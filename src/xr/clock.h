// When it is in a scene, by when its frames are seen: arithmetic alone.
#pragma once

#include <algorithm>

#include "scumble/renderer.h"
#include "xr/openxr.h"

namespace scumble::xr {

class Clock {
 public:
  // Beyond this a gap is none of the scene's: nobody was there.
  static constexpr XrDuration kLongestStep = 1'000'000'000;  // nanoseconds

  explicit Clock(double start) : start_(start) {}

  // To a frame, each in its turn, whether it is drawn or not. `stands`: nothing of the scene moves on.
  void go(XrTime display, bool stands) {
    const XrDuration step = isGoing_ ? std::clamp<XrDuration>(display - last_, 0, kLongestStep) : 0;
    isGoing_ = true, last_ = display;
    step_ = double(step) * 1e-9;
    if (!stands) gone_ += step;
  }
  // Seconds, in the scene: it ends where renderers do.
  double time() const { return std::min(start_ + double(gone_) * 1e-9, Renderer::kMaxTime * (1 - 1e-9)); }
  double sinceLast() const { return step_; }  // seconds, of whoever watches

 private:
  double start_, step_ = 0;
  XrTime last_ = 0;
  XrDuration gone_ = 0;
  bool isGoing_ = false;
};

}  // namespace scumble::xr
