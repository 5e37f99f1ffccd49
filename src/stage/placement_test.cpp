// Where things are in the world, against what cameras see and the light lights.
#include "scumble/placement.h"

#include <gtest/gtest.h>

#include "scumble/view.h"
#include "tests/support/pond_gltf.h"

namespace scumble {
namespace {

void expectAt(const glm::vec3& actual, const glm::vec3& expected, float within = 1e-5f) {
  EXPECT_LT(glm::distance(actual, expected), within)
      << actual.x << ", " << actual.y << ", " << actual.z << " for " << expected.x << ", " << expected.y
      << ", " << expected.z;
}

TEST(Placement, ofNodesGoesWithTheirClips) {
  const Scene scene = loaded(pond());
  const auto at = [&](const char* node, double time) {
    const Result<glm::dmat4> world = nodeToWorld(scene, node, Look(), time);
    EXPECT_TRUE(world.ok()) << world.error().message();
    return world ? glm::vec3(*world * glm::dvec4(1, 0, 0, 1)) : glm::vec3(NAN);
  };
  expectAt(at("", 0.5), {1, 0, 0});
  expectAt(at("Bird", 0), {0, 3, -1});
  expectAt(at("Bird", 0.25), {1, 3, -1});
  EXPECT_EQ(nodeToWorld(scene, "Brid").error().kind, ErrorKind::usage);
  EXPECT_EQ(nodeToWorld(Scene(), "").error().kind, ErrorKind::usage);
}

// What is set where a place of the world lies is what the camera looks at.
TEST(Placement, ofTheCamerasShiftIsWhatItLooksAt) {
  const Scene scene = loaded(pond());
  const glm::vec3 place(2, 1, 7), eye(10, 4, 3);
  for (const char* target : {"", "Bird", "Nobody"})
    for (const double time : {0.0, 0.5}) {
      Look look;
      ASSERT_TRUE(look.set("camera.target", std::string(target)).ok());
      ASSERT_TRUE(look.set("camera.mode", std::string("eye")).ok());
      ASSERT_TRUE(look.set("camera.eye", eye).ok());
      const Result<glm::dmat4> world = cameraShiftToWorld(scene, look, time);
      ASSERT_TRUE(world.ok());
      ASSERT_TRUE(look.set("camera.shift", glm::vec3(glm::inverse(*world) * glm::dvec4(place, 1))).ok());
      const auto views = makeViews(scene, {}, 1.5f, Stereo::mono, 0.063f, look, time);
      ASSERT_TRUE(views.ok());
      const glm::vec3 seen = views->front().worldToEye * glm::vec4(place, 1);
      expectAt(seen, {0, 0, -glm::distance(place, eye)}, 1e-4f);
    }
  EXPECT_EQ(cameraShiftToWorld(Scene(), Look()).error().kind, ErrorKind::usage);
}

TEST(Placement, ofTheKeyLightAndBack) {
  const Scene scene = loaded(pond());
  for (const float azimuth : {-170.0f, -50.0f, 0.0f, 90.0f, 179.0f})
    for (const float elevation : {1.0f, 30.0f, 85.0f}) {
      Look look;
      ASSERT_TRUE(look.set("light.source", std::string("look")).ok());
      ASSERT_TRUE(look.set("light.azimuth", azimuth).ok());
      ASSERT_TRUE(look.set("light.elevation", elevation).ok());
      const Result<glm::vec3> towards = towardsKeyLight(scene, look);
      ASSERT_TRUE(towards.ok());
      EXPECT_NEAR(glm::length(*towards), 1, 1e-5f);
      const Result<glm::vec2> angles = keyLightAngles(scene, 3.0f * *towards);
      ASSERT_TRUE(angles.ok());
      EXPECT_NEAR(angles->x, azimuth, 1e-3f);
      EXPECT_NEAR(angles->y, elevation, 1e-3f);
    }
  EXPECT_EQ(keyLightAngles(scene, {0.5f, -2, 0.1f})->y, 1) << "the lowest";
  for (const glm::vec3 none : {glm::vec3(0), glm::vec3(NAN), glm::vec3(INFINITY, 0, 0)})
    EXPECT_EQ(keyLightAngles(scene, none).error().kind, ErrorKind::usage);
  EXPECT_EQ(towardsKeyLight(Scene(), Look()).error().kind, ErrorKind::usage);
}

}  // namespace
}  // namespace scumble
