// What lies on a surface has the surface's disparity; what lies elsewhere is found.
#include "measure/vergence.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scumble::measuring {
namespace {

constexpr int kWide = 160, kHigh = 96;

// Noise that is nowhere the same, of some five pixels.
float blotches(double x, double y) {
  return float(std::sin(0.9 * x + 1.7 * std::sin(0.31 * y)) + std::sin(0.83 * y + 1.3 * std::sin(0.37 * x)) +
               std::sin(0.41 * x * std::sin(0.013 * y + 1)));
}

// A field of a pattern that lies at a disparity, and a surface's own; pixels from the right eye to the left.
struct Eyes {
  Field left{kWide, kHigh, 1}, right{kWide, kHigh, 1};
  Places places{kWide, kHigh, 2};
  Eyes(double pattern, double surface, bool isFlat = false) {
    for (int y = 0; y < kHigh; ++y)
      for (int x = 0; x < kWide; ++x) {
        const size_t pixel = size_t(y) * kWide + size_t(x);
        left.valid[pixel] = right.valid[pixel] = places.valid[pixel] = 1;
        *left.at(pixel) = isFlat ? 1 : blotches(x - pattern, y);
        *right.at(pixel) = isFlat ? 1 : blotches(x, y);
        places.at(pixel)[0] = float(x + 0.5 + surface), places.at(pixel)[1] = float(y) + 0.5f;
      }
  }
  Vergence found() const { return vergenceOf(left, right, places); }
};

TEST(VergenceOfMarks, thoseOnTheSurfaceAgree) {
  for (const double disparity : {0.0, 7.0, 20.3, -12.0}) {
    const Vergence found = Eyes(disparity, disparity).found();
    EXPECT_GT(found.windows, 150u);
    EXPECT_EQ(found.conflicts, 0u) << disparity;
  }
}

TEST(VergenceOfMarks, thoseElsewhereDoNot) {
  // On the screen, as far as that; and on something nearer.
  for (const auto& [pattern, surface] : {std::pair(0.0, 15.0), {0.0, -22.0}, {15.0, 11.0}})
    EXPECT_GT(Eyes(pattern, surface).found().share(), 0.9) << pattern << ", " << surface;
  // A pixel is none.
  EXPECT_LT(Eyes(10, 11).found().share(), 0.02);
}

TEST(VergenceOfMarks, whereNothingIsNothingIsFound) {
  EXPECT_EQ(Eyes(0, 15, true).found().windows, 0u);
  Eyes hidden(0, 15);
  std::fill(hidden.places.valid.begin(), hidden.places.valid.end(), uint8_t(0));
  EXPECT_EQ(hidden.found().windows, 0u);
  EXPECT_EQ(hidden.found().share(), 0);
}

}  // namespace
}  // namespace scumble::measuring
