#include "base/srgb.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace scumble {
namespace {

int exactCode(float linear) {
  return int(std::floor(srgbFromLinear(linear) * 255 + 0.5));
}

TEST(Srgb, roundsExactlyAtEveryStepOfTheCode) {
  const SrgbEncoder& encode = SrgbEncoder::instance();
  for (int code = 0; code < 255; ++code) {
    float value = float(linearFromSrgb((code + 0.5) / 255));
    for (int i = 0; i < 4; ++i) value = std::nextafter(value, 0.0f);
    for (int i = 0; i < 9; ++i, value = std::nextafter(value, 2.0f)) {
      // Within 1e-9 of the step the reference itself is uncertain: either neighbour is right.
      const double distance = srgbFromLinear(value) * 255 + 0.5 - (code + 1);
      if (std::abs(distance) > 1e-9) {
        EXPECT_EQ(encode(value), exactCode(value)) << code << " " << value;
      }
    }
  }
}

TEST(Srgb, roundsExactlyEverywhere) {
  const SrgbEncoder& encode = SrgbEncoder::instance();
  for (uint32_t bits = 0; bits < std::bit_cast<uint32_t>(1.1f); bits += 4099) {
    const float value = std::bit_cast<float>(bits);
    ASSERT_EQ(encode(value), std::min(255, exactCode(value))) << value;
  }
}

TEST(Srgb, clampsAndTurnsNanIntoZero) {
  const SrgbEncoder& encode = SrgbEncoder::instance();
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(encode(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(encode(-std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(encode(-infinity), 0);
  EXPECT_EQ(encode(-1.0f), 0);
  EXPECT_EQ(encode(-0.0f), 0);
  EXPECT_EQ(encode(1.0f), 255);
  EXPECT_EQ(encode(std::nextafter(1.0f, 0.0f)), 255);
  EXPECT_EQ(encode(7.0f), 255);
  EXPECT_EQ(encode(infinity), 255);
}

TEST(Srgb, everyCodeSurvivesTheWayThroughLinear) {
  for (int code = 0; code < 256; ++code) EXPECT_EQ(SrgbEncoder::instance()(linearFromSrgb8()[code]), code);
}

}  // namespace
}  // namespace scumble
