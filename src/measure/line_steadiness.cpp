#include "measure/line_steadiness.h"

namespace scumble::measuring {

Field greatestAround(const Field& drawn) {
  Field most = drawn;
  for (int y = 0; y < drawn.height; ++y)
    for (int x = 0; x < drawn.width; ++x) {
      float& greatest = most.values[size_t(y) * size_t(drawn.width) + size_t(x)];
      for (int dy = -kLineReach; dy <= kLineReach; ++dy)
        for (int dx = -kLineReach; dx <= kLineReach; ++dx) {
          const int atX = x + dx, atY = y + dy;
          // A disc that holds the pixels beside its ends.
          if (dx * dx + dy * dy > kLineReach * kLineReach + 1 || atX < 0 || atY < 0 || atX >= drawn.width ||
              atY >= drawn.height)
            continue;
          greatest = std::max(greatest, drawn.values[size_t(atY) * size_t(drawn.width) + size_t(atX)]);
        }
    }
  return most;
}

LineChange changeOf(const Field& before, const Field& mostBefore, const Field& after,
                    const Field& mostAfter) {
  LineChange change;
  for (size_t pixel = 0; pixel < before.values.size(); ++pixel) {
    const float was = before.values[pixel], is = after.values[pixel];
    change.changes += std::abs(is - was);
    change.flickers += std::max(is - mostBefore.values[pixel], was - mostAfter.values[pixel]) > kFlicker;
  }
  return change;
}

}  // namespace scumble::measuring
