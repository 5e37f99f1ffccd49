// Lines that are known to move, to come and to go.
#include "measure/line_steadiness.h"

#include <gtest/gtest.h>

#include "measure/test_fields.h"
#include "scumble/measure.h"

namespace scumble::measuring {
namespace {

using namespace test;

// An upright line, anti-aliased, from row 10 to `to`.
Field lineAt(double x, double width = 3, double to = 50) {
  return fieldFrom(64, 60, [&](double px, double py) {
    const double inRow = std::clamp(0.5 * width + 0.5 - std::abs(px - x), 0.0, 1.0);
    return inRow * std::clamp(std::min(py - 10, to - py) + 0.5, 0.0, 1.0);
  });
}
LineChange change(const Field& before, const Field& after) {
  return changeOf(before, greatestAround(before), after, greatestAround(after));
}

TEST(LineSteadiness, whatMovesDoesNotFlicker) {
  for (const double by : {0.0, 0.3, 1.0, 1.7, 2.0}) {
    const LineChange moved = change(lineAt(30.5), lineAt(30.5 + by));
    EXPECT_NEAR(moved.changes, 2 * by * 40, 1e-3 + 0.01 * by * 40) << by;
    EXPECT_EQ(moved.flickers, 0) << by;
  }
  // A line that grows by as much.
  EXPECT_EQ(change(lineAt(30.5), lineAt(30.5, 3, 52)).flickers, 0);
}

TEST(LineSteadiness, whatComesOrGoesAtOnceDoes) {
  Field none = lineAt(30.5);
  std::fill(none.values.begin(), none.values.end(), 0.0f);
  const LineChange gone = change(lineAt(30.5), none), come = change(none, lineAt(30.5));
  EXPECT_EQ(gone.flickers, 3 * 40);
  EXPECT_EQ(come.flickers, gone.flickers);
  EXPECT_NEAR(gone.changes, 3 * 40, 1e-3);
  // The last 10 rows of it, but for what two rows of movement explain.
  EXPECT_NEAR(change(lineAt(30.5), lineAt(30.5, 3, 40)).flickers, 3 * 8, 3);
  // Beside another one that stays.
  EXPECT_EQ(change(lineAt(30.5), lineAt(36.5)).flickers, 2 * 3 * 40);
}

TEST(LineSteadiness, whatFadesDoesNot) {
  Field faint = lineAt(30.5);
  for (float& value : faint.values) value *= 0.6f;
  EXPECT_EQ(change(lineAt(30.5), faint).flickers, 0);
  EXPECT_NEAR(change(lineAt(30.5), faint).changes, 0.4 * 3 * 40, 1e-3);
}

// Drawings on any paper, linear or in codes.
TEST(LineSteadiness, drawingsOfOthers) {
  const auto drawing = [](double x, float paper, bool isCoded) {
    const Field drawn = lineAt(x);
    Image image;
    image.width = uint32_t(drawn.width), image.height = uint32_t(drawn.height);
    image.channels = {"R", "G", "B"};
    if (isCoded) image.format = PixelFormat::srgb8;
    for (const float value : drawn.values)
      for (int c = 0; c < 3; ++c)
        if (isCoded)
          image.codes.push_back(value > 0.5f ? 0 : 250);
        else
          image.pixels.push_back(paper * (1 - value));
    return image;
  };
  for (const bool isCoded : {false, true}) {
    const Result<LineSteadiness> of = steadinessOf(
        "them", {drawing(20.5, 0.4f, isCoded), drawing(21.5, 0.4f, isCoded), drawing(41.5, 0.4f, isCoded)});
    ASSERT_TRUE(of) << of.error().message();
    EXPECT_EQ(of->method, "them");
    EXPECT_NEAR(of->drawn, 3 * 40, 1e-2);
    EXPECT_NEAR(of->flickers, 2 * 3 * 40 / (2 * kLineStep * of->drawn), 1e-3);
    EXPECT_NEAR(of->changes, (2 + 6) * 40 / (2 * kLineStep * of->drawn), 1e-2);
  }
  const Image one = drawing(20.5, 1, false);
  Image wide = one;
  wide.width *= 2, wide.pixels.resize(2 * wide.pixels.size(), 1);
  Image blank = one;
  std::fill(blank.pixels.begin(), blank.pixels.end(), 0.7f);
  for (const std::vector<Image>& bad : {std::vector<Image>{}, {one}, {one, wide}, {blank, blank}})
    EXPECT_EQ(steadinessOf("them", bad).error().kind, ErrorKind::usage);
  EXPECT_FALSE(steadinessOf("them", {one, one}, 0));
}

}  // namespace
}  // namespace scumble::measuring
