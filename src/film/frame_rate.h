// Frames a second as the fraction that a film's clock counts in.
#pragma once

namespace scumble::film {

struct FrameRate {
  int numerator = 24, denominator = 1;
};

// The fraction that is meant by `fps` (> 0): whole numbers as they are, television's n * 1000/1001 by their
// usual decimals (23.976, 23.98, 29.97, 59.94), and else the nearest fraction with a denominator of at most
// 1001.
FrameRate frameRateOf(double fps);

}  // namespace scumble::film
