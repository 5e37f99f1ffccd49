// Tracks against values computed by hand.
#include "look/track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/oklab.h"

namespace scumble::look {
namespace {

const ParamRow kNumber{"number", ParamKind::number, 0, -10, 10, "", "", 0};
const ParamRow kInteger{"integer", ParamKind::integer, 0, 0, 24, "", "", 0};
const ParamRow kColor{"color", ParamKind::color, 0, 0, 0xFFFFFF, "", "", 0};
const ParamRow kChoice{"choice", ParamKind::choice, 0, 0, 2, "a|b|c", "", 0};

Track numbers(const std::vector<std::pair<double, double>>& keys, Interpolation interpolation,
              bool repeat = false) {
  Track track{{}, interpolation, repeat};
  for (const auto& [time, number] : keys) track.keys.push_back({time, {number, {}}});
  return track;
}

double at(const Track& track, double time) {
  return track.at(kNumber, time).number;
}

TEST(LookTrack, stepStandsUntilTheNextKey) {
  const Track track = numbers({{1, 5}, {2, -3}, {4, 7}}, Interpolation::step);
  const struct {
    double time, value;
  } cases[] = {{-100, 5}, {0, 5}, {1, 5}, {1.999, 5}, {2, -3}, {3.999, -3}, {4, 7}, {1000, 7}};
  for (const auto& c : cases) EXPECT_EQ(at(track, c.time), c.value) << c.time;
}

TEST(LookTrack, linearGoesStraight) {
  const Track track = numbers({{1, 5}, {2, -3}, {4, 7}}, Interpolation::linear);
  const struct {
    double time, value;
  } cases[] = {{0, 5}, {1, 5}, {1.25, 3}, {1.5, 1}, {2, -3}, {2.5, -0.5}, {3, 2}, {4, 7}, {5, 7}};
  for (const auto& c : cases) EXPECT_DOUBLE_EQ(at(track, c.time), c.value) << c.time;
}

// Keys (0, 0), (1, 2), (3, 1), (4, 4). Tangents: 2 (one-sided), (1 - 0) / 3, (4 - 2) / 3, 3 (one-sided).
TEST(LookTrack, cubicFollowsItsTangents) {
  const Track track = numbers({{0, 0}, {1, 2}, {3, 1}, {4, 4}}, Interpolation::cubic);
  // The middle of an interval: the mean of its ends + length / 8 times the difference of its tangents.
  EXPECT_NEAR(at(track, 0.5), 1 + 1.0 / 8 * (2 - 1.0 / 3), 1e-12);
  EXPECT_NEAR(at(track, 2), 1.5 + 2.0 / 8 * (1.0 / 3 - 2.0 / 3), 1e-12);
  EXPECT_NEAR(at(track, 3.5), 2.5 + 1.0 / 8 * (2.0 / 3 - 3), 1e-12);
  // A quarter: Hermite's polynomials are 27/32, 9/64, 5/32 and -3/64.
  EXPECT_NEAR(at(track, 1.5), 27 / 32.0 * 2 + 9 / 64.0 * 2 / 3 + 5 / 32.0 * 1 - 3 / 64.0 * 2 * 2 / 3, 1e-12);
  for (const auto& [time, value] : {std::pair{-1.0, 0.0}, {0, 0}, {1, 2}, {3, 1}, {4, 4}, {9, 4}})
    EXPECT_EQ(at(track, time), value) << time;
  // Two keys are a straight line.
  EXPECT_NEAR(at(numbers({{1, 2}, {3, 6}}, Interpolation::cubic), 1.5), 3, 1e-12);
}

// Two keys: smoothstep. In between: Catmull-Rom where that does not swing over, rest where values turn or
// stay.
TEST(LookTrack, easeStartsAndEndsAtRestAndFlowsThrough) {
  const Track two = numbers({{1, 0}, {3, 8}}, Interpolation::ease);
  EXPECT_NEAR(at(two, 1.5), 8 * (3 / 16.0 - 2 / 64.0), 1e-12);
  EXPECT_NEAR(at(two, 2), 4, 1e-12);
  const double h = 1e-6;
  const Track track = numbers({{0, 0}, {1, 1}, {2, 3}, {4, 3}, {5, -2}, {6, 2}}, Interpolation::ease);
  const double slopes[] = {0, 1.5, 0, 0, 0, 0};  // the second is (3 - 0) / 2
  for (size_t i = 0; i < track.keys.size(); ++i) {
    const double time = track.keys[i].time;
    EXPECT_EQ(at(track, time), track.keys[i].value.number);
    EXPECT_NEAR((at(track, time) - at(track, time - h)) / h, slopes[i], 1e-4) << i;
    EXPECT_NEAR((at(track, time + h) - at(track, time)) / h, slopes[i], 1e-4) << i;
  }
  for (int i = 0; i < 50; ++i) EXPECT_NEAR(at(track, 2 + i / 25.0), 3, 1e-12);  // where they stay, they do
}

TEST(LookTrack, easeNeverGoesBeyondItsKeys) {
  const Track track =
      numbers({{0, -9}, {1e-6, -8.99}, {1, -8.9}, {1.1, 9}, {50, 9.1}, {51, -3}}, Interpolation::ease);
  for (size_t i = 0; i + 1 < track.keys.size(); ++i) {
    const Key &from = track.keys[i], &to = track.keys[i + 1];
    double before = from.value.number;
    for (int k = 1; k <= 200; ++k) {
      const double value = at(track, from.time + (to.time - from.time) * k / 200);
      ASSERT_GE((value - before) * (to.value.number - from.value.number), -1e-12) << i << " " << k;
      before = value;
    }
  }
}

// A turn that closes has no end to rest at; as `cubic` has it.
TEST(LookTrack, easeFlowsOverTheSeamOfALoop) {
  const Track loop = numbers({{0, 0}, {1, 1}, {3, -1}, {4, 0}}, Interpolation::ease, true);
  const double h = 1e-4;  // times nearer to the seam are on it
  EXPECT_NEAR((at(loop, 4 + h) - at(loop, 4 - h)) / (2 * h), 1, 1e-3);
}

TEST(LookTrack, cubicIsContinuousAndSoIsItsSlope) {
  const Track track = numbers({{-1, 0}, {0, 3}, {0.25, -2}, {2, 1}, {2.5, 1}, {6, -4}}, Interpolation::cubic);
  const double h = 1e-6;
  for (size_t i = 1; i + 1 < track.keys.size(); ++i) {
    const Key &before = track.keys[i - 1], &key = track.keys[i], &after = track.keys[i + 1];
    const double slope = (after.value.number - before.value.number) / (after.time - before.time);
    EXPECT_NEAR((at(track, key.time) - at(track, key.time - h)) / h, slope, 1e-3) << i;
    EXPECT_NEAR((at(track, key.time + h) - at(track, key.time)) / h, slope, 1e-3) << i;
  }
}

// Keys that nearly touch, and keys that are far: nothing but numbers in the range.
TEST(LookTrack, cubicStaysInTheRange) {
  const Track track = numbers({{0, -10}, {1e-300, 10}, {1, 10}, {1.0001, -10}, {1e9, -9}, {1e9 + 1, 10}},
                              Interpolation::cubic);
  for (const double base : {0.0, 1e-301, 0.5, 1.0, 1.00005, 2.0, 1e8, 1e9, 1e9 + 0.5})
    for (int i = 0; i < 50; ++i) {
      const double value = at(track, base * (1 + i * 1e-3));
      ASSERT_TRUE(value >= -10 && value <= 10) << base << " " << value;
    }
  const Track over = numbers({{0, 10}, {1, 10}, {2, -10}}, Interpolation::cubic);
  EXPECT_EQ(at(over, 0.7), 10) << "the curve overshoots the knob's range";
}

TEST(LookTrack, repeatedTracksLoop) {
  for (const Interpolation interpolation :
       {Interpolation::step, Interpolation::linear, Interpolation::cubic}) {
    const Track once = numbers({{1, 5}, {1.5, -2}, {2, 3}, {3, 5}}, interpolation),
                track = numbers({{1, 5}, {1.5, -2}, {2, 3}, {3, 5}}, interpolation, true);
    for (int i = 0; i < 48; ++i) {
      const double time = 1 + i / 24.0;
      if (interpolation != Interpolation::cubic) {
        EXPECT_NEAR(at(track, time), at(once, time), 1e-12);
      }
      for (const int periods : {-500, -1, 1, 2, 1000})
        EXPECT_NEAR(at(track, time + 2 * periods), at(track, time), 1e-9) << time << " " << periods;
    }
    EXPECT_EQ(at(track, 3), 5);
    EXPECT_EQ(at(track, 0), at(track, 2));
  }
  // Where the end is not the beginning, the beginning wins.
  EXPECT_EQ(at(numbers({{0, 1}, {2, 4}}, Interpolation::linear, true), 4), 1);
  EXPECT_EQ(at(numbers({{0, 1}, {2, 4}}, Interpolation::linear, true), -0.5), 3.25);
}

TEST(LookTrack, aClosedCubicIsSmoothAcrossItsSeam) {
  const Track track = numbers({{0, 1}, {1, 4}, {1.5, 2}, {3, 1}}, Interpolation::cubic, true);
  const double h = 1e-4, slope = (4.0 - 2.0) / (1 + 1.5);
  EXPECT_NEAR((at(track, 3 + h) - at(track, 3)) / h, slope, 1e-2);
  EXPECT_NEAR((at(track, 3) - at(track, 3 - h)) / h, slope, 1e-2);
}

// Frame numbers over frame rates round; a jump must not come a frame late for that.
TEST(LookTrack, jumpsComeWithTheirFrame) {
  const Track track = numbers({{0, 0}, {0.1, 1}, {0.2, 2}, {0.3, 0}}, Interpolation::step, true);
  for (int frame = 0; frame < 3000; ++frame) ASSERT_EQ(at(track, frame / 10.0), frame % 3) << frame;
}

TEST(LookTrack, oneKeyAndStrangeTimes) {
  for (const bool repeat : {false, true}) {
    const Track single = numbers({{2, 7}}, Interpolation::cubic, repeat);
    for (const double time : {-5.0, 0.0, 2.0, 3.0}) EXPECT_EQ(at(single, time), 7);
    const Track track = numbers({{0, 1}, {1, 2}}, Interpolation::linear, repeat);
    for (const double time :
         {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), std::nan("")}) {
      const double value = at(track, time);
      EXPECT_TRUE(value == 1 || value == 2) << time;
    }
  }
}

TEST(LookTrack, integersAreRoundedToTheNearest) {
  Track track = numbers({{0, 2}, {1, 6}}, Interpolation::linear);
  const struct {
    double time, value;
  } cases[] = {{0, 2}, {0.12, 2}, {0.13, 3}, {0.37, 3}, {0.38, 4}, {0.88, 6}, {1, 6}};
  for (const auto& c : cases) EXPECT_EQ(track.at(kInteger, c.time).number, c.value) << c.time;
  track.interpolation = Interpolation::step;
  EXPECT_EQ(track.at(kInteger, 0.99).number, 2);
}

TEST(LookTrack, choicesStep) {
  const Track track = numbers({{0, 2}, {1, 1}}, Interpolation::step);
  EXPECT_EQ(track.at(kChoice, 0.5).number, 2);
  EXPECT_EQ(track.at(kChoice, 1).number, 1);
}

TEST(LookTrack, coloursAreMixedInOklab) {
  const glm::vec3 blue = linearFromSrgb(0x2040C0), yellow = linearFromSrgb(0xF0D020);
  const Track track{{{0, {0, blue}}, {2, {0, yellow}}}, Interpolation::linear, false};
  EXPECT_EQ(track.at(kColor, 0).linear, blue) << "keys are kept to the bit";
  EXPECT_EQ(track.at(kColor, 2).linear, yellow);
  const glm::dvec3 middle = oklabFromLinear(track.at(kColor, 1).linear),
                   expected = 0.5 * (oklabFromLinear(blue) + oklabFromLinear(yellow));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(middle[c], expected[c], 1e-6);
  // Between black and white, OKLab's middle is half the lightness: an eighth of the light.
  const Track grey{{{0, {0, glm::vec3(0)}}, {2, {0, glm::vec3(1)}}}, Interpolation::linear, false};
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(grey.at(kColor, 1).linear[c], 0.125, 1e-5);
}

TEST(LookTrack, coloursStayColours) {
  for (const Interpolation interpolation : {Interpolation::linear, Interpolation::cubic}) {
    Track track{{}, interpolation, true};
    for (const uint32_t code : {0x0000FFu, 0x00FF00u, 0xFF0000u, 0x000000u, 0xFFFFFFu, 0xFF00FFu, 0x0000FFu})
      track.keys.push_back({double(track.keys.size()), {0, linearFromSrgb(code)}});
    for (int i = 0; i < 600; ++i) {
      const glm::vec3 color = track.at(kColor, i / 100.0).linear;
      for (int c = 0; c < 3; ++c) ASSERT_TRUE(color[c] >= 0 && color[c] <= 1) << i;
    }
  }
}

}  // namespace
}  // namespace scumble::look
