// How far a scene travels, against integrals worked out by hand and by sums of small steps.
#include "features/ocean/ocean_travel.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "features/ocean/ocean.h"
#include "scumble/look.h"

namespace scumble::ocean {
namespace {

Look lookOfOcean(const std::string& ocean) {
  Result<Look> look = Look::fromJson(R"({"ocean": )" + ocean + "}", "test.json");
  if (!look) throw std::runtime_error(look.error().message());
  return *look;
}

void expectAt(const Look& look, double time, const glm::dvec2& expected, double tolerance = 1e-6) {
  const glm::dvec2 at = travelledBy(look.data())(time);
  EXPECT_NEAR(at.x, expected.x, tolerance) << "at " << time;
  EXPECT_NEAR(at.y, expected.y, tolerance) << "at " << time;
}

// Sums of so many small steps.
glm::dvec2 summed(const Look& look, double time, int steps) {
  glm::dvec2 sum(0.0);
  for (int i = 0; i < steps; ++i) {
    const OceanParams now = look.data().at((i + 0.5) / steps * time).get<OceanParams>();
    const double angle = glm::radians(double(now.heading));
    sum += double(now.speed) * glm::dvec2(std::cos(angle), std::sin(angle)) * (time / steps);
  }
  return sum;
}

TEST(OceanTravel, isSpeedTimesTimeWhereNothingChanges) {
  const Look look = lookOfOcean(R"({"speed": 3, "heading": 90})");
  for (const double time : {0.0, 1.0, 12.5, -7.0, 999999.0}) expectAt(look, time, {0, 3 * time}, 1e-7);
  expectAt(Look(), 100, {0, 0}, 0);
}

TEST(OceanTravel, isTheAreaUnderTheSpeed) {
  const Look look = lookOfOcean(R"({"speed": {"keys": [[0, 0], [10, 3]]}})");
  expectAt(look, 5, {3.75, 0});
  expectAt(look, 10, {15, 0});
  // Three metres a second from there, and none before.
  expectAt(look, 11, {18, 0});
  expectAt(look, 100010, {300015, 0}, 1e-6);
  expectAt(look, -20, {0, 0});
  // A track that begins later, or before 0.
  expectAt(lookOfOcean(R"({"speed": {"keys": [[2, 1], [4, 3]]}})"), 5, {2 + 4 + 3, 0});
  expectAt(lookOfOcean(R"({"speed": {"keys": [[-4, 2], [-2, 0]]}})"), 5, {0, 0});
  expectAt(lookOfOcean(R"({"speed": {"keys": [[-4, 2], [-2, 0]]}})"), -6, {-2 - 4, 0});
  // A jump.
  expectAt(lookOfOcean(R"({"speed": {"keys": [[0, 1], [2, 5]], "interpolation": "step"}})"), 3, {7, 0}, 1e-5);
  // What is set by hand wins.
  Look byHand = look;
  ASSERT_TRUE(byHand.set("ocean.speed", "2").ok());
  expectAt(byHand, 10, {20, 0});
}

TEST(OceanTravel, aFullCircleReturns) {
  const Look look = lookOfOcean(R"({"speed": 4, "heading": {"keys": [[0, -180], [20, 180]]}})");
  expectAt(look, 20, {0, 0});
  const double radius = 4 * 20 / (2 * 3.14159265358979);
  expectAt(look, 10, {0, -2 * radius});
  expectAt(look, 25, {-20, 0});
  const Look forever =
      lookOfOcean(R"({"speed": 4, "heading": {"keys": [[0, -180], [20, 180]], "repeat": true}})");
  for (const double time : {20.0, 40.0, -20.0, 200000.0}) expectAt(forever, time, {0, 0}, 1e-3);
  expectAt(forever, 200010, {0, -2 * radius}, 1e-3);
  expectAt(forever, -10, {0, -2 * radius});
}

// At least a millimetre a minute.
TEST(OceanTravel, isTheSumOfSmallSteps) {
  for (const char* text :
       {R"({"speed": {"keys": [[0, 0], [3, 90], [9, 100], [11, -20], [60, 5]], "interpolation": "cubic"},
            "heading": {"keys": [[1, 0], [2, 170], [20, -180], [50, 30]], "interpolation": "cubic"}})",
        R"({"speed": {"keys": [[0, 2], [3, 9], [4, 2]], "repeat": true},
            "heading": {"keys": [[0, 10], [2.5, 80], [6, 10]], "interpolation": "cubic", "repeat": true}})",
        R"({"speed": {"keys": [[0, 2], [0.7, 9], [1.1, 2]], "repeat": true},
            "heading": {"keys": [[5, 10], [25, 120]]}})"})
    for (const double time : {60.0, 13.7, -31.0}) {
      const Look look = lookOfOcean(text);
      const glm::dvec2 expected = summed(look, time, 200000);
      expectAt(look, time, expected, 1e-3);
    }
}

TEST(OceanTravel, isContinuousAndAsFastAsTheSpeed) {
  const Look look = lookOfOcean(R"({"speed": {"keys": [[1, 0], [2, 7], [4, 1]], "repeat": true},
                                 "heading": {"keys": [[0, 0], [5, 90], [7, -10]], "repeat": true}})");
  for (double time = -9; time < 40; time += 0.01) {
    const glm::dvec2 step = travelledBy(look.data())(time + 0.01) - travelledBy(look.data())(time);
    const double speed = double(look.data().at(time + 0.005).get<OceanParams>().speed);
    ASSERT_NEAR(glm::length(step), 0.01 * speed, 1.5e-3) << time;
  }
}

TEST(OceanTravel, costIsBounded) {
  // Periods of a hundredth of a second that have no common multiple, for eleven days; a key every ten
  // thousandth of a second.
  std::string keys;
  for (int i = 0; i < 1000; ++i)
    keys += (i ? ", [" : "[") + std::to_string(i * 1e-4) + ", " + std::to_string(i % 7) + "]";
  for (const std::string& text :
       {std::string(R"({"speed": {"keys": [[0, 2], [0.01, 90], [0.0314159, 2]], "repeat": true},
                        "heading": {"keys": [[0, 10], [0.0271828, 80]], "repeat": true}})"),
        R"({"speed": {"keys": [)" + keys +
            R"(], "repeat": true}, "heading": {"keys": [[0, 0], [1e6, 180]]}})"}) {
    const Look look = lookOfOcean(text);
    const auto start = std::chrono::steady_clock::now();
    const glm::dvec2 at = travelledBy(look.data())(999999.0);
    EXPECT_TRUE(std::isfinite(at.x) && std::isfinite(at.y));
    EXPECT_EQ(at, travelledBy(look.data())(999999.0));
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 2.0);
  }
}

}  // namespace
}  // namespace scumble::ocean
