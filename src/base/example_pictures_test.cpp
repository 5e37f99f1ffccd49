#include "base/example_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace scumble {
namespace {

// The vectors that tear edges are as a brush's edge is: of pieces of it as long as a tear some are quiet and
// some bold; a ripple is the same everywhere.
TEST(ExamplePictures, tearsAreQuietHereAndBoldThere) {
  const Pixels pixels = builtInExample(0);
  constexpr uint32_t kPiece = 24;  // texels
  std::vector<double> lengths;
  for (uint32_t top = 0; top + kPiece <= pixels.height; top += kPiece)
    for (uint32_t left = 0; left + kPiece <= pixels.width; left += kPiece) {
      double squares = 0;
      for (uint32_t y = top; y < top + kPiece; ++y)
        for (uint32_t x = left; x < left + kPiece; ++x)
          for (size_t c = 0; c < 2; ++c)
            squares += std::pow(pixels.rgba[4 * (size_t(y) * pixels.width + x) + c] / 127.5 - 1, 2);
      lengths.push_back(std::sqrt(squares) / kPiece);
    }
  std::sort(lengths.begin(), lengths.end());
  const double quiet = lengths[lengths.size() / 10], usual = lengths[lengths.size() / 2],
               bold = lengths[lengths.size() * 9 / 10];
  EXPECT_LT(quiet, 0.6 * usual);
  EXPECT_GT(bold, 1.25 * usual);
  EXPECT_NEAR(usual, 0.7, 0.1);
}

}  // namespace
}  // namespace scumble
