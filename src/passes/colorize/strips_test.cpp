// Strips: a pixel's column and row both list every colorizer whose box its ray meets.
#include "passes/colorize/strips.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <random>

namespace scumble::passes {
namespace {

class StripsTest : public ::testing::Test {
 protected:
  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  std::mt19937 random_{5};
};

// Boxes before, around and behind the eye, among them some whose corners lie on both sides of its plane.
TEST_F(StripsTest, noRayMeetsWhatItsStripsLeaveOut) {
  constexpr uint32_t kWidth = 900, kHeight = 500;
  const uint32_t strip = 1u << stripBits(kWidth, kHeight);
  const auto uniforms = std::make_unique<shared::ColorizeUniforms>();
  glm::dmat4 toClip(0.0);
  toClip[0][0] = 1.2, toClip[1][1] = -2.0, toClip[2][0] = 0.2, toClip[2][3] = -1, toClip[3][2] = 0.01;
  const glm::dmat4 fromClip = glm::inverse(toClip);
  size_t met = 0, left = 0;
  for (int round = 0; round < 40; ++round) {
    std::vector<PlacedColorizer> list(50);
    std::vector<glm::dmat4> toUnit;
    for (PlacedColorizer& one : list) {
      glm::dmat4 placed = glm::translate(glm::dmat4(1.0), {number(-4, 4), number(-3, 3), number(-8, 3)});
      placed = glm::rotate(placed, number(-3, 3), {0.5, 0.7, 0.1});
      placed = glm::scale(placed, {number(0.05, 2), number(0.05, 2), number(0.05, 2)});
      toUnit.push_back(glm::inverse(placed));
      one.bounded = true;
      for (int i = 0; i < 8; ++i)
        one.corners[i] = glm::dvec3(placed * glm::dvec4(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1, 1));
    }
    markStrips(list, toClip, kWidth, kHeight, 1, *uniforms);
    for (int k = 0; k < 2000; ++k) {
      const glm::dvec2 pixel(number(0, kWidth), number(0, kHeight));
      const glm::dvec2 ndc = pixel / glm::dvec2(kWidth, kHeight) * 2.0 - 1.0;
      const glm::dvec4 far = fromClip * glm::dvec4(ndc, 0.001, 1);
      const glm::dvec3 ray = glm::normalize(glm::dvec3(far) / far.w);
      const glm::uvec2 seen = uniforms->columns[shared::kMaxStrips + size_t(pixel.x) / strip] &
                              uniforms->rows[shared::kMaxStrips + size_t(pixel.y) / strip];
      const uint64_t mask = uint64_t(seen.y) << 32 | seen.x;
      for (size_t c = 0; c < list.size(); ++c) {
        // Slabs.
        const glm::dvec3 eye(toUnit[c][3]), along = glm::dmat3(toUnit[c]) * ray;
        const glm::dvec3 a = (-1.0 - eye) / along, b = (1.0 - eye) / along;
        const glm::dvec3 enter = glm::min(a, b), leave = glm::max(a, b);
        const bool meets = std::max({enter.x, enter.y, enter.z, 0.0}) < std::min({leave.x, leave.y, leave.z});
        const bool lists = mask >> c & 1;
        ASSERT_TRUE(!meets || lists);
        met += meets, left += !lists;
      }
    }
  }
  EXPECT_GT(met, 10000u);
  EXPECT_GT(left, 1000000u);
}

TEST_F(StripsTest, areWholeGroupsOfPixelsAndFitTheList) {
  for (const auto& [width, height] :
       {std::pair{1u, 1u}, {64u, 65u}, {2048u, 720u}, {2049u, 9u}, {7u, 16384u}}) {
    const uint32_t strip = 1u << stripBits(width, height);
    EXPECT_EQ(strip % 16, 0u);
    EXPECT_LE((std::max(width, height) + strip - 1) / strip, uint32_t(shared::kMaxStrips));
  }
}

}  // namespace
}  // namespace scumble::passes
