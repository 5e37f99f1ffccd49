#include "measure/line_steadiness.h"

namespace scumble::measuring {

Field greatestAround(const Field& ink) {
  Field most = ink;
  for (int y = 0; y < ink.height; ++y)
    for (int x = 0; x < ink.width; ++x) {
      float& greatest = most.values[size_t(y) * size_t(ink.width) + size_t(x)];
      for (int dy = -kInkReach; dy <= kInkReach; ++dy)
        for (int dx = -kInkReach; dx <= kInkReach; ++dx) {
          const int atX = x + dx, atY = y + dy;
          // A disc that holds the pixels beside its ends.
          if (dx * dx + dy * dy > kInkReach * kInkReach + 1 || atX < 0 || atY < 0 || atX >= ink.width ||
              atY >= ink.height)
            continue;
          greatest = std::max(greatest, ink.values[size_t(atY) * size_t(ink.width) + size_t(atX)]);
        }
    }
  return most;
}

InkChange changeOf(const Field& before, const Field& mostBefore, const Field& after, const Field& mostAfter) {
  InkChange change;
  for (size_t pixel = 0; pixel < before.values.size(); ++pixel) {
    const float was = before.values[pixel], is = after.values[pixel];
    change.changes += std::abs(is - was);
    change.flickers += std::max(is - mostBefore.values[pixel], was - mostAfter.values[pixel]) > kFlicker;
  }
  return change;
}

}  // namespace scumble::measuring
