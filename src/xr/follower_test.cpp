// Who looks over a wearer's shoulder.
#include "xr/follower.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace scumble::xr {
namespace {

Pose looking(float heading, float down, float roll, const glm::vec3& place = glm::vec3(0)) {
  return {aboutVertical(heading) * glm::angleAxis(-down, glm::vec3(1, 0, 0)) *
              glm::angleAxis(roll, glm::vec3(0, 0, 1)),
          place};
}

void expectTurn(const glm::quat& a, const glm::quat& b, float within = 1e-3f) {
  EXPECT_GT(std::abs(glm::dot(a, b)), 1 - within);
}

TEST(FollowersOfHeads, keepTheHorizonLevel) {
  for (const float heading : {0.0f, 1.0f, -2.5f})
    for (const float down : {-1.2f, 0.0f, 0.8f}) {
      expectTurn(upright(looking(heading, down, 0.6f).turn), looking(heading, down, 0).turn, 1e-5f);
      expectTurn(upright(looking(heading, down, 0).turn), looking(heading, down, 0).turn, 1e-5f);
    }
  const Pose up = looking(0.4f, -glm::half_pi<float>(), 0.3f);
  expectTurn(upright(up.turn), up.turn);
}

TEST(FollowersOfHeads, areThereAtOnceOrComeNearer) {
  const Pose here = looking(0.2f, 0.1f, 0, {1, 2, 3}), there = looking(1.2f, 0.1f, 0.4f, {2, 2, 3});
  Follower atOnce(0), steady(0.5f), coarse(0.5f);
  for (Follower* follower : {&atOnce, &steady, &coarse})
    expectTurn(follower->go(here, 0.01f).turn, here.turn);
  EXPECT_EQ(atOnce.go(there, 0.01f).place, there.place);
  expectTurn(atOnce.go(there, 0.01f).turn, looking(1.2f, 0.1f, 0).turn);
  // The rate of frames changes nothing.
  Pose fine;
  for (int i = 0; i < 90; ++i) fine = steady.go(there, 0.5f / 90);
  const Pose once = coarse.go(there, 0.5f);
  EXPECT_NEAR(fine.place.x, 2 - std::exp(-1.0f), 1e-3f);
  EXPECT_NEAR(once.place.x, fine.place.x, 1e-3f);
  expectTurn(once.turn, fine.turn);
  // A head that trembles is hardly seen to.
  Follower calm(0.5f);
  float least = 1, most = 0;
  for (int i = 0; i < 900; ++i) {
    const float x = calm.go(looking(0, 0, 0, {0.01f * float(i % 2), 0, 0}), 1.0f / 90).place.x;
    if (i > 800) least = std::min(least, x), most = std::max(most, x);
  }
  EXPECT_GT(least, 0.0045f);
  EXPECT_LT(most, 0.0055f);
}

}  // namespace
}  // namespace scumble::xr
