// Colours in a hand.
#include "xr/tint.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scumble::xr {
namespace {

Pose rolled(float degrees, float height = 0) {
  // Pointing somewhere, rolled clockwise as seen along -z.
  const glm::quat somewhere = glm::normalize(glm::quat(0.8f, 0.1f, -0.5f, 0.2f));
  return {somewhere * glm::angleAxis(glm::radians(-degrees), glm::vec3(0, 0, 1)), {0.3f, 1 + height, -0.2f}};
}

double valueOf(const Look& look, const std::string& path) {
  return std::get<double>(*look.get(path));
}

TEST(TintsInHands, rollsAreAboutWhereAHandPoints) {
  for (const float degrees : {-170.0f, -40.0f, 0.0f, 25.0f, 179.0f})
    EXPECT_NEAR(glm::degrees(rollBetween(rolled(0), rolled(degrees))), degrees, 0.01f);
  // A quaternion and its opposite are one turn.
  Pose other = rolled(30);
  other.turn = -other.turn;
  EXPECT_NEAR(glm::degrees(rollBetween(rolled(0), other)), 30, 0.01f);
}

TEST(TintsInHands, huesTurnWithTheWristAndLightnessRisesWithTheHand) {
  Look look = *Look::fromJson(
      R"({"lit": {"hue": 10}, "materials": {"Sail": {"shadowed": {"brightness": 0.5}}}})", "");
  Result<Tint> tint = Tint::take(look, "Sail", 0, rolled(0));
  ASSERT_TRUE(tint.ok());
  ASSERT_TRUE(tint->follow(look, rolled(0)).ok());
  EXPECT_EQ(tint->told(), "");
  ASSERT_TRUE(tint->follow(look, rolled(35, kLightnessHeight)).ok());
  EXPECT_NEAR(valueOf(look, "materials.Sail.lit.hue"), 45, 0.01);
  EXPECT_NEAR(valueOf(look, "materials.Sail.shadowed.hue"), 35, 0.01);
  EXPECT_NEAR(valueOf(look, "materials.Sail.lit.brightness"), 2, 1e-3);
  EXPECT_NEAR(valueOf(look, "materials.Sail.shadowed.brightness"), 1, 1e-3);
  EXPECT_EQ(valueOf(look, "materials.Deck.lit.hue"), 10) << "of another material";
  EXPECT_NE(tint->told().find("--set 'materials.Sail.lit.hue=45'"), std::string::npos) << tint->told();
  EXPECT_NE(tint->told().find("shadowed.brightness=1'"), std::string::npos) << tint->told();
  // Beyond a full turn hues go around, and lightness ends somewhere.
  for (float degrees = 35; degrees < 400; degrees += 40)
    ASSERT_TRUE(tint->follow(look, rolled(degrees)).ok());
  ASSERT_TRUE(tint->follow(look, rolled(400, 3)).ok());
  EXPECT_NEAR(valueOf(look, "materials.Sail.lit.hue"), 50, 0.05);
  EXPECT_EQ(valueOf(look, "materials.Sail.lit.brightness"), 3);
  ASSERT_TRUE(tint->follow(look, rolled(170)).ok());
  EXPECT_NEAR(std::abs(valueOf(look, "materials.Sail.lit.hue")), 180, 0.05);
  for (const char* const name : {"", "a=b", "a*", "a[b]", "a\nb"})
    EXPECT_FALSE(Tint::take(look, name, 0, rolled(0)).ok()) << name;
  Result<Tint> quoted = Tint::take(look, "Bob's", 0, rolled(0));
  ASSERT_TRUE(quoted.ok() && quoted->follow(look, rolled(10)).ok());
  EXPECT_NE(quoted->told().find(R"(--set 'materials.Bob'\''s.lit.hue=20')"), std::string::npos)
      << quoted->told();
}

}  // namespace
}  // namespace scumble::xr
