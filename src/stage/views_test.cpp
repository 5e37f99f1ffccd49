// Cameras that move: turntables, and those that looks bring.
#include <gtest/gtest.h>

#include <cmath>

#include "scumble/view.h"
#include "stage/framing.h"
#include "stage/seen_views.h"
#include "tests/support/pond_gltf.h"

namespace scumble {
namespace {

using scene::TestGltf;
using Json = TestGltf::Json;

TestGltf pondWithCamera() {
  TestGltf g = pond();
  g.json["cameras"] = {
      {{"name", "Top"}, {"type", "perspective"}, {"perspective", {{"yfov", 0.9}, {"znear", 0.1}}}}};
  g.json["nodes"].push_back({{"camera", 0}, {"translation", {0, 20, 0}}});
  g.json["scenes"][0]["nodes"].push_back(int(g.json["nodes"].size()) - 1);
  return g;
}

const glm::vec3 kCenter(1, 1, -2);

Look lookOf(const std::string& text) {
  Result<Look> look = Look::fromJson(text, "test.json");
  EXPECT_TRUE(look.ok()) << look.error().message();
  return look.ok() ? look.value() : Look();
}

std::vector<View> seen(const Scene& scene, const Viewpoint& viewpoint, const Look& look, double time = 0,
                       Stereo stereo = Stereo::mono) {
  const auto views = makeViews(scene, viewpoint, 16.0f / 9, stereo, 0.2f, look, time);
  EXPECT_TRUE(views.ok()) << views.error().message();
  return views.ok() ? views.value() : std::vector<View>(2);
}

float difference(const View& a, const View& b) {
  float most = 0;
  for (int i = 0; i < 16; ++i)
    most = std::max({most, std::abs(a.worldToEye[i / 4][i % 4] - b.worldToEye[i / 4][i % 4]),
                     std::abs(a.eyeToClip[i / 4][i % 4] - b.eyeToClip[i / 4][i % 4])});
  return most;
}

class BothEyesOf : public testing::TestWithParam<Stereo> {};
INSTANTIATE_TEST_SUITE_P(, BothEyesOf, testing::Values(Stereo::mono, Stereo::stereo));

// -- Turntable

TEST_P(BothEyesOf, aTurntableGoesOnceAroundAndCloses) {
  const Scene scene = loaded(pondWithCamera());  // it wins over the scene's camera
  Viewpoint viewpoint;
  viewpoint.turntable = 8;
  const auto first = seen(scene, viewpoint, {}, 0, GetParam()),
             again = seen(scene, viewpoint, {}, 8, GetParam());
  for (size_t i = 0; i < first.size(); ++i) EXPECT_EQ(difference(first[i], again[i]), 0);
  // The step over the seam is a step like any other.
  const auto angle = [&](double from, double to) {
    return glm::degrees(std::acos(std::min(1.0f, glm::dot(axisOf(seen(scene, viewpoint, {}, from)[0]),
                                                          axisOf(seen(scene, viewpoint, {}, to)[0])))));
  };
  EXPECT_NEAR(angle(191 / 24.0, 8), angle(0, 1 / 24.0), 1e-2);
  // A quarter of the turn is 90 degrees, towards +x; the axis goes through the centre.
  viewpoint.orbit = true, viewpoint.distance = 3;
  const float radius = scene.data().bounds.radius();
  const auto quarter = seen(scene, viewpoint, {}, 2, GetParam());
  glm::vec3 middle(0);
  for (const View& view : quarter) middle += eyeOf(view) / float(quarter.size());
  expectClose(middle, kCenter + glm::vec3(3 * radius, 0, 0));
}

TEST(Turntable, keepsItsDistanceAndSeesEverything) {
  const Scene scene = loaded(pond());
  Viewpoint viewpoint;
  viewpoint.turntable = 5;
  const float distance = glm::length(eyeOf(seen(scene, viewpoint, {})[0]) - kCenter);
  float fullest = 0;
  for (int i = 0; i < 50; ++i) {
    const View view = seen(scene, viewpoint, {}, i / 10.0)[0];
    EXPECT_NEAR(glm::length(eyeOf(view) - kCenter), distance, 1e-3f * distance);
    for (int c = 0; c < 8; ++c) {
      const glm::vec4 clip =
          view.eyeToClip * view.worldToEye * glm::vec4(c & 1 ? 5 : -3, c & 2 ? 2 : 0, c & 4 ? -1 : -3, 1);
      fullest = std::max({fullest, std::abs(clip.x / clip.w), std::abs(clip.y / clip.w)});
    }
  }
  EXPECT_LT(fullest, 0.88f);
  EXPECT_GT(fullest, 0.6f);
}

// The look says what it goes around, how high and how far; its own way around would not close.
TEST(Turntable, goesAroundWhatTheLookLooksAt) {
  const Scene scene = loaded(pond());
  const Look look = lookOf(R"({"camera": {"target": "Bird", "elevation": 0, "distance": 2,
                               "azimuth": {"keys": [[0, 90], [1, 100]]}}})");
  Viewpoint viewpoint;
  viewpoint.turntable = 4;
  const float radius = glm::length(glm::vec3(4, 1, 1));
  expectClose(eyeOf(seen(scene, viewpoint, look)[0]), glm::vec3(0, 3, 0) + glm::vec3(2 * radius, 0, 0),
              0.01f);
  expectClose(eyeOf(seen(scene, viewpoint, look, 0.5)[0]) - glm::vec3(2, 3, 0),
              2 * radius * stage::orbitDirection(135, 0), 0.01f);
}

TEST(Turntable, timesThatAreNoneAreUsageErrors) {
  const Scene scene = loaded(pond());
  for (const double seconds : {0.0, -1.0, std::nan(""), double(INFINITY)}) {
    Viewpoint viewpoint;
    viewpoint.turntable = seconds;
    const auto views = makeViews(scene, viewpoint, 1);
    ASSERT_FALSE(views.ok()) << seconds;
    EXPECT_EQ(views.error().kind, ErrorKind::usage);
  }
}

// -- A look's camera

TEST_P(BothEyesOf, aLooksOrbitFollowsItsTracks) {
  const Scene scene = loaded(pondWithCamera());
  const Look look = lookOf(R"({"camera": {"azimuth": {"keys": [[0, 0], [2, 90]]}, "elevation": 0,
                               "distance": {"keys": [[0, 4], [2, 2]]}, "roll": {"keys": [[0, 0], [2, 20]]},
                               "fov": {"keys": [[0, 20], [2, 40]]}}})");
  const float radius = scene.data().bounds.radius();
  for (const double time : {0.0, 0.5, 1.0, 2.0}) {
    const auto views = seen(scene, {}, look, time, GetParam());
    glm::vec3 middle(0);
    for (const View& view : views) middle += eyeOf(view) / float(views.size());
    expectClose(middle, kCenter + float(4 - time) * radius * stage::orbitDirection(float(45 * time), 0),
                0.01f);
    EXPECT_NEAR(fovOf(views[0]), 20 + 10 * time, 1e-3);
    const glm::vec3 up = glm::mat3(views[0].worldToEye) * glm::vec3(0, 1, 0);
    EXPECT_NEAR(glm::degrees(std::atan2(-up.x, up.y)), 10 * time, 1e-2);
  }
}

TEST(LookCamera, looksAtANodeWhereverThatGoes) {
  const Scene scene = loaded(pond());
  const Look orbit = lookOf(R"({"camera": {"target": "Bird", "distance": 1}})");
  const Look still = lookOf(R"({"camera": {"target": "Bird", "shift": [0, 1, 2], "eye": [0, 5, 20]}})");
  for (const double time : {0.0, 0.25, 0.75}) {
    const glm::vec3 bird(float(4 * time), 3, 0);
    const View around = seen(scene, {}, orbit, time)[0];
    expectClose(axisOf(around), glm::normalize(bird - eyeOf(around)));
    EXPECT_NEAR(glm::length(bird - eyeOf(around)), glm::length(glm::vec3(4, 1, 1)), 0.3);
    // The shift is in the bird's space, whose z is the world's x.
    const View tripod = seen(scene, {}, still, time)[0];
    expectClose(eyeOf(tripod), {0, 5, 20});
    expectClose(axisOf(tripod), glm::normalize(bird + glm::vec3(2, 1, 0) - glm::vec3(0, 5, 20)));
  }
}

// Over the top, and past the back, without a jump.
TEST(LookCamera, nothingJumpsOnTheWayOverThePole) {
  const Scene scene = loaded(pond());
  const Look look = lookOf(R"({"camera": {"elevation": {"keys": [[0, 80], [1, 90]]}, "distance": 3,
                               "azimuth": {"keys": [[0, 130], [2, 250]]}}})");
  View before = seen(scene, {}, look, 0)[0];
  for (int i = 1; i <= 400; ++i) {
    const View view = seen(scene, {}, look, i / 200.0)[0];
    EXPECT_LT(difference(view, before), 0.12f) << i;
    before = view;
  }
}

TEST(LookCamera, whoWins) {
  const Scene scene = loaded(pondWithCamera()), without = loaded(pond());
  const Look look = lookOf(R"({"camera": {"eye": [0, 0, 30]}})");
  const glm::vec3 top(0, 20, 0), looks(0, 0, 30);
  expectClose(eyeOf(seen(scene, {}, look)[0]), looks);
  expectClose(eyeOf(seen(scene, {}, {})[0]), top);
  Viewpoint byName, orbit, byHand;
  byName.camera = "Top";
  expectClose(eyeOf(seen(scene, byName, look)[0]), top);
  orbit.orbit = true, orbit.distance = 2;
  expectClose(eyeOf(seen(scene, orbit, look)[0]),
              kCenter + 2 * scene.data().bounds.radius() * glm::vec3(0, 0, 1));
  byHand.eye = glm::vec3(9, 9, 9);
  expectClose(eyeOf(seen(scene, byHand, look)[0]), {9, 9, 9});
  // The look's mode says which of its knobs count.
  expectClose(eyeOf(seen(scene, {}, lookOf(R"({"camera": {"eye": [0, 0, 30], "mode": "scene"}})"))[0]), top);
  const float radius = scene.data().bounds.radius();
  const Look both = lookOf(R"({"camera": {"eye": [0, 0, 30], "mode": "orbit", "distance": 2, "azimuth": 0,
                               "elevation": 0}})");
  expectClose(eyeOf(seen(scene, {}, both)[0]), kCenter + glm::vec3(0, 0, 2 * radius));
  // Roll and field of view hold for every camera, and the caller's win.
  const Look lens = lookOf(R"({"camera": {"fov": 20, "roll": 90}})");
  expectClose(eyeOf(seen(scene, {}, lens)[0]), top);
  EXPECT_NEAR(fovOf(seen(scene, {}, lens)[0]), 20, 1e-3);
  // Clockwise: what is up lies to the left.
  expectClose(glm::mat3(seen(scene, {}, lens)[0].worldToEye) * glm::vec3(0, 1, 0), {-1, 0, 0});
  EXPECT_NEAR(fovOf(seen(scene, {}, {})[0]), glm::degrees(0.9f), 1e-3);
  EXPECT_NEAR(fovOf(seen(without, {}, {})[0]), 34, 1e-3);
  byName.verticalFov = 50.0f, byName.roll = 0.0f;
  EXPECT_NEAR(fovOf(seen(scene, byName, lens)[0]), 50, 1e-3);
  expectClose(glm::mat3(seen(scene, byName, lens)[0].worldToEye) * glm::vec3(1, 0, 0), {1, 0, 0});
}

// A node that is not there leaves the scene's centre.
TEST(LookCamera, anUnknownNodeIsLeftOut) {
  const Scene scene = loaded(pond());
  const View view = seen(scene, {}, lookOf(R"({"camera": {"target": "Brid"}})"))[0];
  expectClose(axisOf(view), glm::normalize(kCenter - eyeOf(view)));
}

TEST(LookCamera, saysWhetherItMoves) {
  const Scene scene = loaded(pond()), withCamera = loaded(pondWithCamera());
  Viewpoint orbit, turn;
  orbit.orbit = true, turn.turntable = 3;
  const Look still, moving = lookOf(R"({"camera": {"azimuth": {"keys": [[0, 0], [2, 90]]}}})"),
                    zooming = lookOf(R"({"camera": {"fov": {"keys": [[0, 20], [2, 30]]}}})");
  EXPECT_FALSE(viewsMove(scene, {}, still));
  EXPECT_TRUE(viewsMove(withCamera, {}, still));
  EXPECT_TRUE(viewsMove(scene, turn, still));
  EXPECT_TRUE(viewsMove(scene, {}, moving));
  EXPECT_FALSE(viewsMove(scene, orbit, moving));
  EXPECT_TRUE(viewsMove(scene, orbit, zooming));
  orbit.verticalFov = 30.0f;
  EXPECT_FALSE(viewsMove(scene, orbit, zooming));
}

}  // namespace
}  // namespace scumble
