// How finely to draw: what moves is drawn so coarsely that it moves, what rests is drawn in full.
#pragma once

#include <glm/glm.hpp>

namespace scumble::viewer {

class Sharpness {
 public:
  static constexpr double kMovingMilliseconds = 40;  // that a picture of what moves may take
  static constexpr double kRestSeconds = 0.1;        // without motion, after which it rests

  void moved(double now) { lastMotion_ = now; }
  bool isMoving(double now) const { return now - lastMotion_ < kRestSeconds; }
  // Of a picture in full: seconds until it is due.
  double untilRest(double now) const { return lastMotion_ + kRestSeconds - now; }

  // A picture was drawn, of so many pixels, in so long.
  void drew(const glm::uvec2& size, double milliseconds);
  // Of a first picture, which is to be there soon.
  static glm::uvec2 coarsest(const glm::uvec2& full) { return part(full, kCoarsest); }
  // Of a picture of what moves, where the window has room for `full`: this, a half or a quarter of each side.
  glm::uvec2 sizeWhileMoving(const glm::uvec2& full) const;

 private:
  static constexpr uint32_t kCoarsest = 4;
  static glm::uvec2 part(const glm::uvec2& full, uint32_t over) {
    return glm::max((full + (over - 1)) / over, glm::uvec2(1));
  }
  double lastMotion_ = -1e9;
  double fullPixels_ = 0;  // of the largest picture lately
  double perPixel_ = 0;    // milliseconds; 0: not known
};

}  // namespace scumble::viewer
