#include "sharpness.h"

#include <algorithm>

namespace scumble::viewer {

// Small pictures say little about large ones: part of their time is the same whatever their size. So a
// picture counts where it is not much smaller than the one before that counted.
void Sharpness::drew(const glm::uvec2& size, double milliseconds) {
  const double pixels = double(size.x) * double(size.y);
  if (pixels < 0.5 * fullPixels_) {
    fullPixels_ *= 0.9;  // the window may be smaller now
    return;
  }
  fullPixels_ = pixels;
  perPixel_ = milliseconds / std::max(pixels, 1.0);
}

glm::uvec2 Sharpness::sizeWhileMoving(const glm::uvec2& full) const {
  const double whole = perPixel_ * double(full.x) * double(full.y);
  uint32_t over = 1;
  while (over < kCoarsest && whole > kMovingMilliseconds * over * over) over *= 2;
  return part(full, over);
}

}  // namespace scumble::viewer
