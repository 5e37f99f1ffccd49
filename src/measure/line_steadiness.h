// How much of what is drawn changes from picture to picture, and how much of that lines that move do not
// explain.
#pragma once

#include <vector>

#include "measure/field.h"

namespace scumble::measuring {

// Sums over two pictures, pixels.
struct LineChange {
  double changes = 0, flickers = 0;
};

// How far lines may have moved, pixels, and what part of a pixel is a flicker.
constexpr int kLineReach = 2;
constexpr float kFlicker = 0.5f;

// The most that is drawn on within kLineReach of each pixel.
Field greatestAround(const Field& drawn);

// From one picture to the next.
LineChange changeOf(const Field& before, const Field& mostBefore, const Field& after, const Field& mostAfter);

}  // namespace scumble::measuring
