// How much ink changes from picture to picture, and how much of that lines that move do not explain.
#pragma once

#include <vector>

#include "measure/field.h"

namespace scumble::measuring {

// Sums over two pictures of ink, pixels.
struct InkChange {
  double changes = 0, flickers = 0;
};

// How far lines may have moved, pixels, and what part of the full ink is a flicker.
constexpr int kInkReach = 2;
constexpr float kFlicker = 0.5f;

// The most ink that is within kInkReach of each pixel.
Field greatestAround(const Field& ink);

// From one picture to the next.
InkChange changeOf(const Field& before, const Field& mostBefore, const Field& after, const Field& mostAfter);

}  // namespace scumble::measuring
