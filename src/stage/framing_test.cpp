#include "stage/framing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <tuple>

#include "scene/posed_bounds.h"
#include "scumble/view.h"
#include "stage/seen_views.h"
#include "tests/support/loaded_test_gltf.h"
#include "tests/support/test_scene.h"

namespace scumble {
namespace {

using scene::Bounds;
using scene::TestGltf;
using Json = TestGltf::Json;

// The surface of this box; one that is flat leaves out what has no area.
TestGltf boxScene(const glm::vec3& low, const glm::vec3& high) {
  TestGltf g;
  std::vector<float> corners;
  for (int i = 0; i < 8; ++i)
    corners.insert(corners.end(), {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  g.addMesh({{"POSITION", g.addFloats(corners, 3)}},
            g.addIndices({0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                          2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6}));
  return g;
}

// A box with three cameras: by name, without a name of its own, and one that is named like a number.
Scene withCameras() {
  TestGltf g = boxScene({-1, 0, -1}, {1, 2, 1});
  g.json["cameras"] = {
      {{"name", "Hero"}, {"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.25}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 4}, {"ymag", 3}, {"znear", 0.5}, {"zfar", 50}}}},
      {{"name", "0"}, {"type", "perspective"}, {"perspective", {{"yfov", 1.2}, {"znear", 0.1}}}}};
  g.json["nodes"].push_back({{"camera", 0}, {"translation", {0, 1, 8}}, {"scale", {3, 3, 3}}});
  g.json["nodes"].push_back(
      {{"camera", 1}, {"translation", {5, 1, 0}}, {"rotation", {0, 0.70710678, 0, 0.70710678}}});
  g.json["nodes"].push_back({{"camera", 2}, {"translation", {0, 9, 0}}});
  for (const int node : {1, 2, 3}) g.json["scenes"][0]["nodes"].push_back(node);
  return loaded(g);
}

std::vector<View> mustSee(const Scene& scene, const Viewpoint& viewpoint, float aspect = 16.0f / 9,
                          Stereo stereo = Stereo::mono, float ipd = 0.063f) {
  const Result<std::vector<View>> views = makeViews(scene, viewpoint, aspect, stereo, ipd);
  EXPECT_TRUE(views.ok()) << views.error().message();
  return views.ok() ? views.value() : std::vector<View>(2);
}

glm::vec3 ndcOf(const View& view, const glm::vec3& point) {
  const glm::vec4 clip = view.eyeToClip * view.worldToEye * glm::vec4(point, 1);
  return glm::vec3(clip) / clip.w;
}

// How much of the frame a box takes: the largest |ndc| of its corners. Also whether all of it lies before the
// eye.
struct Extent {
  float x = 0, y = 0;
  bool inFront = true;
};
Extent extentOf(const View& view, const Bounds& bounds) {
  Extent extent;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 ndc = ndcOf(view, bounds.corner(corner));
    extent.x = std::max(extent.x, std::abs(ndc.x));
    extent.y = std::max(extent.y, std::abs(ndc.y));
    extent.inFront &= ndc.z > 0 && ndc.z < 1;
  }
  return extent;
}

// -- Framing

// Everything is seen with air around it, and is not lost in the middle of the frame: two thirds of its height
// or width, whatever the proportions; through wide lenses less, where one would stand in it.
TEST(Framing, holdsEverythingWithAirAround) {
  const glm::vec3 sizes[] = {{1, 1, 1},         {100, 1, 1}, {1, 100, 1},
                             {1, 1, 100},       {50, 0, 50}, {0.001f, 0.002f, 0.001f},
                             {3e4f, 2e4f, 1e4f}};
  for (const glm::vec3& size : sizes) {
    const glm::vec3 low = glm::vec3(7, -3, 2) * std::max({size.x, size.y, size.z});
    const Scene scene = loaded(boxScene(low, low + size));
    for (const float aspect : {0.1f, 9.0f / 16, 1.0f, 16.0f / 9, 8.0f})
      for (const float fov : {10.0f, 34.0f, 100.0f})
        for (const bool orbit : {false, true}) {
          Viewpoint viewpoint;
          viewpoint.verticalFov = fov;
          viewpoint.orbit = orbit;
          viewpoint.azimuth = -110, viewpoint.elevation = 35;
          const View view = mustSee(scene, viewpoint, aspect)[0];
          const Extent extent = extentOf(view, scene.data().bounds);
          EXPECT_TRUE(extent.inFront) << size.x << " " << size.y << " " << size.z << " aspect " << aspect;
          EXPECT_LT(std::max(extent.x, extent.y), 0.67f)
              << size.x << " " << size.y << " " << size.z << " aspect " << aspect << " fov " << fov;
          EXPECT_GT(std::max(extent.x, extent.y), fov < 50 && aspect < 4 ? 0.66f : 0.15f)
              << size.x << " " << size.y << " " << size.z << " aspect " << aspect << " fov " << fov;
        }
  }
}

// Not its box, but what is seen: round, slim and flat things, in pieces, many, bent ones. All of it lies in
// the middle.
TEST(Framing, whatIsSeenTakesTwoThirdsAndLiesInTheMiddle) {
  const glm::mat4 one(1.0f);
  const auto scaled = [&](const glm::vec3& by) { return glm::scale(one, by); };
  std::vector<std::pair<const char*, test::TestScene>> scenes(6);
  for (auto& [what, scene] : scenes) scene.material(test::TestScene::colored("Grey", {0.5f, 0.5f, 0.5f, 1}));
  const test::TestMesh ball = test::sphereMesh({0, 0, 0}, 1, 24);
  scenes[0].first = "round", scenes[0].second.add(ball, 0);
  scenes[1].first = "slim", scenes[1].second.add(ball, 0, scaled({0.1f, 3, 0.1f}));
  scenes[2].first = "flat", scenes[2].second.add(ball, 0, scaled({4, 0.1f, 4}));
  scenes[3].first = "pieces", scenes[3].second.add(ball, 0);
  scenes[3].second.add(ball, 0, glm::translate(one, {6, 1, 0}) * scaled(glm::vec3(0.2f)));
  scenes[4].first = "instances";
  scenes[4].second.addInstances(ball, 0, {{0, 0, 0}, {3, 0, 0}, {0, 5, 2}}, {3, glm::quat(1, 0, 0, 0)},
                                {3, glm::vec3(1)});
  test::TestMesh bent = ball;
  bent.joints.assign(ball.positions.size(), {0, 0, 0, 0});
  bent.weights.assign(ball.positions.size(), {1, 0, 0, 0});
  scenes[5].first = "bent",
  scenes[5].second.addSkinned(bent, 0, {glm::translate(one, {3, 4, 5}) * scaled({1, 2, 1})}, {one});
  for (const auto& [what, test] : scenes) {
    const Scene scene = test.load();
    for (const float aspect : {0.6f, 16.0f / 9}) {
      const View view = mustSee(scene, {}, aspect)[0];
      glm::vec2 low(1e9f), high(-1e9f);
      for (const test::WorldTriangle& triangle : test.triangles())
        for (const glm::dvec3& p : triangle.positions) {
          const glm::vec2 ndc(ndcOf(view, p));
          low = glm::min(low, ndc), high = glm::max(high, ndc);
        }
      const glm::vec2 size = 0.5f * (high - low), middle = 0.5f * (high + low);
      // Boxes of joints are larger than what they hold.
      EXPECT_NEAR(std::max(size.x, size.y), 0.667f, scenes[5].first == what ? 0.12f : 0.04f)
          << what << " aspect " << aspect;
      EXPECT_LT(glm::length(middle), scenes[5].first == what ? 0.08f : 0.03f) << what << " aspect " << aspect;
    }
  }
}

// A house with a door on a wide hill, and a camera that looks elsewhere.
Scene hillWithHouse() {
  TestGltf g = boxScene({-500, -20, -500}, {500, 0, 500});
  g.json["nodes"][0]["name"] = "Hill";
  g.json["nodes"].push_back(
      {{"name", "House"}, {"mesh", 0}, {"translation", {40, 5, 3}}, {"scale", {0.006, 0.2, 0.006}}});
  g.json["nodes"].push_back(
      {{"name", "Door"}, {"mesh", 0}, {"translation", {500, 0, 0}}, {"scale", {0.02, 0.5, 0.2}}});
  g.json["nodes"].push_back({{"name", "Lamp"}, {"camera", 0}, {"translation", {0, 9, 0}}});
  g.json["nodes"][1]["children"] = {2};
  g.json["scenes"][0]["nodes"] = {0, 1, 3};
  g.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.25}}}}};
  return loaded(g);
}

// The box that a node of it is in the world.
Bounds boxOf(const Scene& scene, const std::string& name) {
  const scene::SceneData& data = scene.data();
  const size_t node = size_t(std::find_if(data.nodes.begin(), data.nodes.end(),
                                          [&](const scene::Node& n) { return n.name == name; }) -
                             data.nodes.begin());
  const glm::mat4 world = scene::worldMatrices(data)[node];
  Bounds box;
  box.add(glm::vec3(world * glm::vec4(-500, -20, -500, 1)));
  box.add(glm::vec3(world * glm::vec4(500, 0, 500, 1)));
  return box;
}

TEST(Framing, framesTheNodesThatAreNamed) {
  const Scene scene = hillWithHouse();
  Bounds house = boxOf(scene, "House");
  house.add(boxOf(scene, "Door"));
  const std::tuple<const char*, Bounds> cases[] = {{"Door", boxOf(scene, "Door")},
                                                   {"House", house},  // with what hangs below it
                                                   {"Do*", boxOf(scene, "Door")},
                                                   {"House/Door", boxOf(scene, "Door")},
                                                   {"H*", scene.data().bounds}};
  for (const auto& [name, box] : cases) {
    Viewpoint viewpoint;
    viewpoint.frame = name;
    const Extent extent = extentOf(mustSee(scene, viewpoint)[0], box);
    EXPECT_NEAR(std::max(extent.x, extent.y), 0.667f, 0.01f) << name;
    EXPECT_TRUE(extent.inFront);
    EXPECT_FALSE(viewsMove(scene, viewpoint, Look()));
    // What goes around it, or looks at it from a place, does so too.
    viewpoint.orbit = true, viewpoint.azimuth = 90, viewpoint.distance = 3;
    expectClose(eyeOf(mustSee(scene, viewpoint)[0]), box.center() + glm::vec3(3 * box.radius(), 0, 0),
                2e-3f * box.radius());
    viewpoint = {};
    viewpoint.frame = name;
    viewpoint.eye = glm::vec3(0, 700, 0);
    expectClose(axisOf(mustSee(scene, viewpoint)[0]),
                glm::normalize(box.center() - glm::vec3(*viewpoint.eye)), 1e-3f);
  }
}

// What subjects stand on counts up to eight times their size; more of it does not take them away. It is
// named.
TEST(Framing, farLargerGroundsAreLeftOut) {
  // A ball of radius 1 and, by case, low boxes: edges of the larger ones, and how many are left out.
  struct Case {
    const char* what;
    std::vector<std::pair<float, float>> slabs;  // edge, height
    size_t leftOut;
  };
  const float ball = std::sqrt(12.0f), edge = 8 * ball / std::sqrt(2.0f);
  const Case cases[] = {{"small enough", {{0.98f * edge, 0.01f}}, 0},
                        {"too large", {{1.02f * edge, 0.01f}}, 1},
                        {"a kilometre", {{1000, 0.1f}}, 1},
                        {"a plate on the way", {{15, 0.1f}, {100, 0.1f}}, 0},
                        {"a plate, and far more", {{2, 0.1f}, {1000, 0.1f}, {2000, 1}}, 2},
                        {"hills", {{1000, 150}}, 0}};
  for (const Case& c : cases) {
    test::TestScene made;
    const int grey = made.material(test::TestScene::colored("Grey", {0.5f, 0.5f, 0.5f, 1}));
    made.add(test::sphereMesh({0, 0, 0}, 1, 24), grey);
    for (const auto& [size, height] : c.slabs)
      made.add(test::boxMesh({-0.5f * size, -1 - height, -0.5f * size}, {0.5f * size, -1, 0.5f * size}),
               grey);
    const Scene scene = made.load();
    const std::vector<std::string> named = scene.summary().surroundings;
    EXPECT_EQ(named.size(), c.leftOut) << c.what;
    // What is left fills the frame, whoever looks at it; named, all of it does.
    for (const bool orbit : {false, true}) {
      Viewpoint viewpoint;
      viewpoint.orbit = orbit, viewpoint.elevation = 20;
      const Extent seen = extentOf(mustSee(scene, viewpoint)[0], {{-1, -1, -1}, {1, 1, 1}, false});
      if (c.leftOut > 0)
        EXPECT_GT(std::max(seen.x, seen.y), 0.5f) << c.what;
      else
        EXPECT_LT(std::max(seen.x, seen.y), 0.4f) << c.what;
    }
  }
}

TEST(Framing, lowThingsAloneAreFramed) {
  EXPECT_TRUE(loaded(boxScene({-500, -1, -500}, {500, 0, 500})).summary().surroundings.empty());
}

TEST(Framing, nodesThatCannotBeSeenAreUsageErrors) {
  const Scene scene = hillWithHouse();
  for (const auto& [name, problem] :
       {std::pair("Dor", "no node 'Dor'"), std::pair("Lamp", "nothing is to be seen")}) {
    Viewpoint viewpoint;
    viewpoint.frame = name;
    const auto views = makeViews(scene, viewpoint, 1);
    ASSERT_FALSE(views.ok()) << name;
    EXPECT_EQ(views.error().kind, ErrorKind::usage);
    EXPECT_NE(views.error().message().find(problem), std::string::npos) << views.error().message();
  }
}

// However few they are, they reach nearly as far as all.
TEST(Framing, outermostPointsAreOfThePoints) {
  std::mt19937 random(5);
  std::normal_distribution<float> far;
  for (const glm::vec3& stretch : {glm::vec3(1), glm::vec3(100, 1, 0.01f), glm::vec3(1, 1, 0)}) {
    std::vector<glm::vec3> points;
    for (int i = 0; i < 3000; ++i)
      points.push_back(stretch * glm::vec3(far(random), far(random), far(random)));
    const std::vector<glm::vec3> few = scene::outermostOf(points, 200);
    EXPECT_LE(few.size(), 200u);
    for (const glm::vec3& p : few) EXPECT_NE(std::find(points.begin(), points.end(), p), points.end());
    const auto reach = [](const std::vector<glm::vec3>& of, const glm::vec3& direction) {
      float most = -1e9f;
      for (const glm::vec3& p : of) most = std::max(most, glm::dot(p, direction));
      return most;
    };
    for (int i = 0; i < 100; ++i) {
      const glm::vec3 direction(far(random), far(random), far(random));
      EXPECT_GE(reach(few, direction), 0.93f * reach(points, direction));
    }
  }
  EXPECT_TRUE(scene::outermostOf({}, 200).empty());
}

TEST(Framing, aPointHasADistanceToo) {
  const glm::vec3 point(1, 1, 1);
  EXPECT_GT(stage::framingDistance({&point, 1}, point, {0, 0, 1}, 0.6f, 1.5f), 0);
  EXPECT_GT(stage::framingOf({&point, 1}, {0, 0, 1}, 0.6f, 1.5f).distance, 0);
}

TEST(Framing, theDefaultIsAThreeQuarterViewFromAbove) {
  const Scene scene = loaded(boxScene({-1, -1, -1}, {1, 1, 1}));
  const glm::vec3 eye = eyeOf(mustSee(scene, {})[0]);
  EXPECT_GT(eye.z, std::abs(eye.x));  // more from the front than from the side
  EXPECT_GT(std::abs(eye.x), 0.3f * eye.z);
  EXPECT_GT(eye.y, 0);
}

// -- Orbit

TEST(Viewpoint, orbitsGoAroundTheCentre) {
  const glm::vec3 center(4, 5, 6);
  const Scene scene = loaded(boxScene(center - glm::vec3(1, 2, 3), center + glm::vec3(1, 2, 3)));
  const struct {
    float azimuth, elevation;
    glm::vec3 direction;
  } cases[] = {{0, 0, {0, 0, 1}},    {90, 0, {1, 0, 0}},
               {-90, 0, {-1, 0, 0}}, {180, 0, {0, 0, -1}},
               {0, 90, {0, 1, 0}},   {50, -90, {0, -1, 0}},
               {450, 0, {1, 0, 0}},  {0, 45, {0, 0.70710678f, 0.70710678f}}};
  for (const auto& c : cases) {
    Viewpoint viewpoint;
    viewpoint.orbit = true;
    viewpoint.azimuth = c.azimuth, viewpoint.elevation = c.elevation, viewpoint.distance = 3.0f;
    const View view = mustSee(scene, viewpoint)[0];
    const float radius = scene.data().bounds.radius();
    expectClose(eyeOf(view), center + 3 * radius * c.direction, 1e-3f);
    expectClose(axisOf(view), -c.direction, 1e-3f);
    // Upright where that means something.
    if (std::abs(c.elevation) < 90) {
      EXPECT_GT((view.worldToEye * glm::vec4(0, 1, 0, 0)).y, 0.5f);
    }
  }
}

TEST(Viewpoint, orbitsWithoutADistanceFrameEverything) {
  const Scene scene = loaded(boxScene({0, 0, 0}, {9, 1, 2}));
  Viewpoint viewpoint;
  viewpoint.orbit = true;
  for (viewpoint.azimuth = -180; viewpoint.azimuth <= 180; viewpoint.azimuth += 30) {
    const Extent extent = extentOf(mustSee(scene, viewpoint)[0], scene.data().bounds);
    EXPECT_LT(std::max(extent.x, extent.y), 0.88f);
  }
}

// -- Eye and target

TEST(Viewpoint, eyeAndTargetByHand) {
  const Scene scene = withCameras();  // they win over the scene's cameras
  Viewpoint viewpoint;
  viewpoint.eye = glm::vec3(1, 2, 3);
  viewpoint.target = glm::vec3(-4, 2.5f, -6);
  viewpoint.verticalFov = 50.0f;
  View view = mustSee(scene, viewpoint, 1.5f)[0];
  expectClose(eyeOf(view), *viewpoint.eye);
  expectClose(axisOf(view), glm::normalize(*viewpoint.target - *viewpoint.eye));
  EXPECT_NEAR(fovOf(view), 50.0f, 1e-3f);
  EXPECT_NEAR(view.eyeToClip[0][0] * 1.5f, -view.eyeToClip[1][1], 1e-5f);
  // Straight down: some upright must be chosen, and the picture must not be empty.
  viewpoint.eye = glm::vec3(0, 5, 0), viewpoint.target = glm::vec3(0, 1, 0);
  view = mustSee(scene, viewpoint)[0];
  expectClose(axisOf(view), {0, -1, 0});
  EXPECT_NEAR(glm::determinant(glm::mat3(view.worldToEye)), 1, 1e-4f);
}

TEST(Viewpoint, eyeAloneLooksAtTheSceneAndTargetAloneIsLookedAt) {
  const Scene scene = loaded(boxScene({-1, -1, -1}, {1, 1, 1}));
  Viewpoint viewpoint;
  viewpoint.eye = glm::vec3(0, 0, 9);
  expectClose(axisOf(mustSee(scene, viewpoint)[0]), {0, 0, -1});
  viewpoint.eye.reset();
  viewpoint.target = glm::vec3(1, 0, 0);
  const View view = mustSee(scene, viewpoint)[0];
  EXPECT_NEAR(ndcOf(view, {1, 0, 0}).x, 0, 1e-4f);
  EXPECT_NEAR(ndcOf(view, {1, 0, 0}).y, 0, 1e-4f);
}

// The camera turns clockwise, so what it sees turns the other way.
TEST(Viewpoint, rollTurnsTheCameraClockwise) {
  const Scene scene = loaded(boxScene({-1, -1, -1}, {1, 1, 1}));
  Viewpoint viewpoint;
  viewpoint.eye = glm::vec3(0, 0, 9), viewpoint.roll = 90;
  const View view = mustSee(scene, viewpoint, 1)[0];
  const glm::vec3 right = ndcOf(view, {1, 0, 0});
  EXPECT_NEAR(right.x, 0, 1e-4f);
  EXPECT_LT(right.y, -0.1f);  // y down: it is at the top now
}

// -- The scene's cameras

TEST(Viewpoint, theFirstCameraIsTheDefault) {
  const View view = mustSee(withCameras(), {}, 2)[0];
  expectClose(eyeOf(view), {0, 1, 8});
  expectClose(axisOf(view), {0, 0, -1});
  EXPECT_NEAR(fovOf(view), glm::degrees(0.7f), 1e-3f);
  // Scale in its node means nothing.
  EXPECT_NEAR(glm::determinant(glm::mat3(view.worldToEye)), 1, 1e-4f);
  EXPECT_NEAR(ndcOf(view, {0, 1, 8 - 0.25f}).z, 1, 1e-4f);  // its near plane
}

TEST(Viewpoint, camerasByNameAndByNumber) {
  const Scene scene = withCameras();
  const struct {
    const char* name;
    glm::vec3 eye;
  } cases[] = {{"Hero", {0, 1, 8}},
               {"1", {5, 1, 0}},
               {"2", {0, 9, 0}},
               {"0", {0, 9, 0}}};  // a name wins over a number
  for (const auto& c : cases) {
    Viewpoint viewpoint;
    viewpoint.camera = c.name;
    expectClose(eyeOf(mustSee(scene, viewpoint)[0]), c.eye);
  }
}

TEST(Viewpoint, orthographicCameras) {
  Viewpoint viewpoint;
  viewpoint.camera = "1";
  const View view = mustSee(withCameras(), viewpoint, 2)[0];
  expectClose(axisOf(view), {-1, 0, 0});
  EXPECT_NEAR(ndcOf(view, {0, 4, 0}).y, -1, 1e-4f);  // three metres above the axis
  EXPECT_NEAR(ndcOf(view, {0, 1, -6}).x, 1, 1e-4f);  // the picture's aspect counts, not the camera's
  EXPECT_NEAR(ndcOf(view, {4.5f, 1, 0}).z, 1, 1e-4f);
  EXPECT_NEAR(ndcOf(view, {-45, 1, 0}).z, 0, 1e-4f);
}

TEST(Viewpoint, aFieldOfViewByHandWins) {
  Viewpoint viewpoint;
  viewpoint.verticalFov = 20.0f;
  EXPECT_NEAR(fovOf(mustSee(withCameras(), viewpoint)[0]), 20.0f, 1e-3f);
}

TEST(Viewpoint, unknownCamerasAreUsageErrorsThatNameTheKnownOnes) {
  const Scene scene = withCameras(), without = loaded(boxScene({0, 0, 0}, {1, 1, 1}));
  for (const char* name : {"hero", "3", "-1", "99999999999999999999", "Hero ", "1.0"}) {
    Viewpoint viewpoint;
    viewpoint.camera = name;
    const auto views = makeViews(scene, viewpoint, 1);
    ASSERT_FALSE(views.ok()) << name;
    EXPECT_EQ(views.error().kind, ErrorKind::usage);
    EXPECT_NE(views.error().message().find("Hero"), std::string::npos) << views.error().message();
    EXPECT_FALSE(makeViews(without, viewpoint, 1).ok());
  }
}

TEST(Viewpoint, viewsThatSeeNothingAreUsageErrors) {
  const Scene scene = loaded(boxScene({0, 0, 0}, {1, 1, 1}));
  const auto expectUsage = [&](const Viewpoint& viewpoint, float aspect) {
    const auto views = makeViews(scene, viewpoint, aspect);
    ASSERT_FALSE(views.ok());
    EXPECT_EQ(views.error().kind, ErrorKind::usage);
    EXPECT_FALSE(views.error().advice.empty());
  };
  Viewpoint onTarget;
  onTarget.eye = onTarget.target = glm::vec3(1, 2, 3);
  expectUsage(onTarget, 1);
  for (const float fov : {0.0f, -20.0f, 180.0f, 1e9f, std::nanf("")}) {
    Viewpoint viewpoint;
    viewpoint.verticalFov = fov;
    expectUsage(viewpoint, 1);
  }
  for (const float distance : {0.0f, -1.0f, std::nanf("")}) {
    Viewpoint viewpoint;
    viewpoint.orbit = true, viewpoint.distance = distance;
    expectUsage(viewpoint, 1);
  }
  for (const float aspect : {0.0f, -1.0f, std::nanf("")}) expectUsage({}, aspect);
}

TEST(Viewpoint, numbersOutOfRangeAreUsageErrors) {
  const Scene scene = loaded(boxScene({0, 0, 0}, {1, 1, 1}));
  const auto problem = [&](const Viewpoint& viewpoint, float ipd = 0.063f) -> std::string {
    const auto views = makeViews(scene, viewpoint, 1, Stereo::stereo, ipd);
    if (views) return "";
    EXPECT_EQ(views.error().kind, ErrorKind::usage);
    EXPECT_FALSE(views.error().advice.empty());
    return views.error().problem;
  };
  const auto orbit = [](float azimuth, float elevation, std::optional<float> distance = {}) {
    Viewpoint viewpoint;
    viewpoint.orbit = true;
    viewpoint.azimuth = azimuth, viewpoint.elevation = elevation, viewpoint.distance = distance;
    return viewpoint;
  };
  for (const float degrees : {-90.0f, 0.0f, 90.0f}) EXPECT_EQ(problem(orbit(-400, degrees)), "");
  for (const float degrees : {-91.0f, 1000.0f, std::nanf("")})
    EXPECT_EQ(problem(orbit(0, degrees)), "the orbit's elevation is out of range");
  EXPECT_EQ(problem(orbit(1e30f, 0)), "the orbit's azimuth is out of range");
  EXPECT_EQ(problem(orbit(0, 0, 1e30f)), "the orbit's distance is out of range");
  Viewpoint rolled, far;
  rolled.roll = 720;
  EXPECT_EQ(problem(rolled), "");
  rolled.roll = 1e30f;
  EXPECT_EQ(problem(rolled), "the roll is out of range");
  far.eye = glm::vec3(0, 0, 1e16f);
  EXPECT_EQ(problem(far), "the eye or its target is out of range");
  for (const float ipd : {0.0f, 10.0f}) EXPECT_EQ(problem({}, ipd), "");
  for (const float ipd : {-1.0f, 1e30f, std::nanf("")})
    EXPECT_EQ(problem({}, ipd), "the distance between the eyes (ipd) is out of range");
}

// -- Stereo

TEST(Stereo, eyesAreSideBySideAndParallel) {
  const Scene scene = withCameras();
  for (const char* camera : {"Hero", "1"})
    for (const float ipd : {0.063f, 0.5f, 0.0f}) {
      Viewpoint viewpoint;
      viewpoint.camera = camera;
      viewpoint.roll = 20;
      const View middle = mustSee(scene, viewpoint, 1.6f)[0];
      const std::vector<View> eyes = mustSee(scene, viewpoint, 1.6f, Stereo::stereo, ipd);
      ASSERT_EQ(eyes.size(), 2u);
      EXPECT_NEAR(glm::length(eyeOf(eyes[0]) - eyeOf(eyes[1])), ipd, 1e-5f);
      expectClose(0.5f * (eyeOf(eyes[0]) + eyeOf(eyes[1])), eyeOf(middle));
      // Left first, along the rolled camera's own axis.
      expectClose(glm::vec3(middle.worldToEye * glm::vec4(eyeOf(eyes[0]), 1)), {-0.5f * ipd, 0, 0});
      for (const View& eye : eyes) {
        expectClose(axisOf(eye), axisOf(middle));
        EXPECT_EQ(eye.eyeToClip, middle.eyeToClip);
      }
    }
}

// -- The default direction, from which the light is measured

TEST(Framing, theDefaultDirectionIsTheFirstCameras) {
  expectClose(stage::defaultEyeDirection(withCameras().data()), {0, 0, 1});
  const Scene without = loaded(boxScene({0, 0, 0}, {1, 1, 1}));
  EXPECT_NEAR(glm::length(stage::defaultEyeDirection(without.data())), 1, 1e-5f);
  // A camera that looks straight down says nothing about a side.
  TestGltf g = boxScene({0, 0, 0}, {1, 1, 1});
  g.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.25}}}}};
  g.json["nodes"].push_back({{"camera", 0}, {"rotation", {-0.70710678, 0, 0, 0.70710678}}});
  g.json["scenes"][0]["nodes"].push_back(1);
  expectClose(stage::defaultEyeDirection(loaded(g).data()), stage::defaultEyeDirection(without.data()));
}

}  // namespace
}  // namespace scumble
