// Hulls keep the sea out as they are drawn (paper 000, section 6.2): boats of several forms in many poses,
// what lets the sea in, and who decides.
#include <glm/gtc/matrix_transform.hpp>
#include <iostream>

#include "features/ocean/hulls/hull_shapes.h"
#include "features/ocean/ocean.h"
#include "scene/scene_data.h"
#include "scumble/renderer.h"
#include "tests/support/animated_scene.h"
#include "tests/support/aov.h"
#include "tests/support/asset_files.h"
#include "tests/support/render_test.h"
#include "tests/support/sanitized.h"
#include "tests/support/test_device.h"

namespace scumble {
namespace {

using namespace test;

constexpr int kHullWidth = 160, kHullHeight = 120;
// A third of a pixel, metres: what is nearer to a side than that is in a pixel with it.
constexpr float kSliver = 0.04f;

TestMesh meshOf(const HullShape& shape) {
  TestMesh mesh;
  mesh.positions = shape.positions;
  mesh.indices = shape.indices;
  mesh.normals.assign(shape.positions.size(), {0, 1, 0});
  mesh.uvs.assign(shape.positions.size(), {0, 0});
  return mesh;
}

// How a boat lies: degrees, metres. `scale`: below 0 it is mirrored.
struct BoatPose {
  float heel = 0, pitch = 0, yaw = 0, heave = 0;
  glm::vec3 scale{1};
  glm::mat4 at(const glm::vec3& place) const {
    glm::mat4 m = glm::translate(glm::mat4(1), place + glm::vec3(0, heave, 0));
    m = glm::rotate(m, glm::radians(yaw), {0, 1, 0});
    m = glm::rotate(m, glm::radians(pitch), {0, 0, 1});
    m = glm::rotate(m, glm::radians(heel), {1, 0, 0});
    return glm::scale(m, scale);
  }
};

const std::vector<BoatPose> kBoatPoses{{},
                                       {5},
                                       {-8, 0, 30},
                                       {12, 3, 60},
                                       {-16, -3, 90},
                                       {20, 0, 123},
                                       {0, 5, 10},
                                       {0, -6, 200},
                                       {4, 4, 45, 0.1f},
                                       {-4, 2, 75, -0.1f},
                                       {0, 0, 15, -0.2f},
                                       {3, -2, 255, -0.22f},
                                       {0, 0, 0, 0, {-1, 1, 1}},
                                       {7, 2, 33, 0, {1, 1, -1}},
                                       {0, 0, 20, 0, {0.6f, 0.6f, 0.6f}},
                                       {6, 0, 80, 0, {1.3f, 1.3f, 1.3f}},
                                       {0, 3, 140, 0, {1.2f, 0.8f, 0.9f}},
                                       {-25, 0, 5, 0.05f},
                                       {28, 3, 310, 0.1f},
                                       {0, 8, 170, 0.05f}};

const glm::vec3 kBerths[] = {{-4, 0, -3.4f}, {4, 0, -3.4f}, {-4, 0, 3.4f}, {4, 0, 3.4f}};

Json matrixOf(const glm::mat4& m) {
  Json json = Json::array();
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) json.push_back(m[c][r]);
  return json;
}

// All shapes at their berths in one pose, named by their number.
AnimatedScene fleet(const std::vector<HullShape>& shapes, const BoatPose& pose,
                    const Json& extras = Json::object()) {
  AnimatedScene s;
  Json wood = TestScene::colored("Wood", {0.5f, 0.4f, 0.3f, 1});
  wood["doubleSided"] = true;
  const int material = s.material(wood);
  for (size_t i = 0; i < shapes.size(); ++i) {
    const int mesh = s.mesh({meshOf(shapes[i]), 0, {}, {}, {}, {}}, material);
    Json node{
        {"name", "Boat" + std::to_string(i)}, {"mesh", mesh}, {"matrix", matrixOf(pose.at(kBerths[i % 4]))}};
    if (!extras.empty()) node["extras"] = extras;
    s.node(node);
  }
  return s;
}

class Hulls : public BothEyes {
 protected:
  static Look look(const Knobs& more = {}) {
    Knobs knobs{{"ocean.mode", "on"}, {"ocean.wind", "4"}, {"ocean.tiles", "1"}, {"ocean.grid", "40"}};
    knobs.insert(knobs.end(), more.begin(), more.end());
    return quietLook(knobs);
  }
  static Frame drawSea(const Scene& scene, const Look& look, const Stand& stand = {{1, 15, 4}, {0, 0, 0}, 50},
                       double time = 1.5) {
    return drawSea(scene, look, viewsFrom(scene, stand, kHullWidth, kHullHeight, GetParam()), time);
  }
  static Frame drawSea(const Scene& scene, const Look& look, const std::vector<View>& views, double time) {
    Result<Frame> frame = renderer().render(scene, look, time, views,
                                            sized(kHullWidth, kHullHeight, {"position", "id", "shadow"}));
    if (!frame) throw std::runtime_error(frame.error().message());
    return std::move(frame).value();
  }
  // The same places by a parallel projection.
  static std::vector<View> parallelFrom(const Scene& scene, const Stand& stand) {
    std::vector<View> views = viewsFrom(scene, stand, kHullWidth, kHullHeight, GetParam());
    const float half = glm::distance(stand.eye, stand.target) * std::tan(glm::radians(0.5f * stand.fov));
    for (View& view : views)
      view.eyeToClip = orthographicProjection(half, float(kHullWidth) / kHullHeight, 0.1f, 100);
    return views;
  }
  static int oceanOf(const Scene& scene) { return int(scene.data().nodes.size()) + 2; }
  // Visits places of the sea that are seen: view, and where in the world.
  template <class Visit>
  static void forSea(const Scene& scene, const Frame& frame, Visit&& visit) {
    for (size_t v = 0; v < viewCount(); ++v)
      for (int y = 0; y < kHullHeight; ++y)
        for (int x = 0; x < kHullWidth; ++x)
          if (int(texel(aov(frame, "id", v), x, y).x) == oceanOf(scene))
            visit(v, x, y, glm::dvec3(texel(aov(frame, "position", v), x, y)));
  }
  // How many of them lie in boats that are where these matrices have them.
  static size_t inside(const Scene& scene, const Frame& frame, const std::vector<HullShape>& shapes,
                       const std::vector<glm::mat4>& matrices, float margin) {
    size_t count = 0;
    std::vector<glm::dmat4> toBoats;
    for (const glm::mat4& m : matrices) toBoats.push_back(glm::inverse(glm::dmat4(m)));
    forSea(scene, frame, [&](size_t, int, int, const glm::dvec3& place) {
      for (size_t i = 0; i < shapes.size(); ++i)
        count += shapes[i].isInside && shapes[i].isInside(toBoats[i] * glm::dvec4(place, 1), margin);
    });
    return count;
  }
  static void expectSameSea(const Frame& a, const Frame& b, const std::string& what) {
    for (size_t v = 0; v < viewCount(); ++v)
      for (const char* name : {"", "id", "position", "shadow"})
        EXPECT_TRUE(sameBytes(aov(a, name, v), aov(b, name, v))) << what << ", '" << name << "'";
  }
};
INSTANTIATE_BOTH_EYES(Hulls);

// No water in four boats in twenty poses; outside of them the sea is as it was, up to their sides.
TEST_P(Hulls, keepTheSeaOut) {
  NOT_WITH_SANITIZERS();
  NEEDS_FINE_RASTER();
  const std::vector<HullShape> shapes = vesselShapes();
  size_t before = 0, holes = 0;
  for (size_t p = 0; p < kBoatPoses.size(); ++p) {
    const BoatPose& pose = kBoatPoses[p];
    const Scene scene = fleet(shapes, pose).load();
    std::vector<glm::mat4> matrices;
    for (size_t i = 0; i < shapes.size(); ++i) matrices.push_back(pose.at(kBerths[i]));
    const Frame dry = drawSea(scene, look());
    const std::string what = "heel " + std::to_string(pose.heel) + ", pitch " + std::to_string(pose.pitch) +
                             ", yaw " + std::to_string(pose.yaw);
    EXPECT_EQ(inside(scene, dry, shapes, matrices, kSliver), 0u) << what;
    if (p % 3 != 0) continue;
    // Nothing is cut out of the sea but what is in a boat, in its sides, or above its rim.
    const Frame full = drawSea(scene, look({{"ocean.hulls", "off"}}));
    before += inside(scene, full, shapes, matrices, kSliver);
    size_t lost = 0;
    forSea(scene, full, [&](size_t v, int x, int y, const glm::dvec3& place) {
      bool isIn = false, isBelowRim = false;
      for (size_t i = 0; i < shapes.size(); ++i) {
        const glm::vec3 local = glm::inverse(glm::dmat4(matrices[i])) * glm::dvec4(place, 1);
        isBelowRim |= shapes[i].isInside(local + glm::vec3(0, 0.05f, 0), -0.12f);
        for (float above = 0; above < 0.8f; above += 0.05f)
          isIn |= shapes[i].isInside(local - glm::vec3(0, above, 0), -0.12f);
      }
      lost += !isIn && texel(aov(dry, "id", v), x, y) != texel(aov(full, "id", v), x, y);
      holes += isBelowRim && texel(aov(dry, "id", v), x, y).x == 0;
    });
    // But where it lies lower beside a rim that it would else reach over.
    EXPECT_LE(lost, 4 * viewCount()) << what;
  }
  std::cout << "sea in four boats: " << before
            << " pixels in seven poses without hulls, none with them; seen "
            << "through beside them: " << holes << "\n";
  EXPECT_GT(before, 3000u * viewCount()) << "without hulls";
  // But for single pixels at edges.
  EXPECT_LE(holes, before / 300) << "nothing is seen through the sea beside a hull";
}

// What lets the sea in, or is closed, changes nothing, to the byte.
TEST_P(Hulls, letTheSeaInWhereTheyHaveNoBottomOrNoOpening) {
  std::vector<HullShape> shapes = leakyShapes();
  const std::vector<HullShape> second(shapes.begin() + 4, shapes.end());
  shapes.resize(4);
  for (const std::vector<HullShape>& some : {shapes, second})
    for (const BoatPose& pose : {kBoatPoses[0], kBoatPoses[3]}) {
      const Scene scene = fleet(some, pose).load();
      expectSameSea(drawSea(scene, look()), drawSea(scene, look({{"ocean.hulls", "off"}})), some[0].name);
    }
}

// In a storm, riding; and with a wake, whose foam stays outside as well.
TEST_P(Hulls, keepTheSeaOutInAStorm) {
  NOT_WITH_SANITIZERS();
  NEEDS_FINE_RASTER();
  const std::vector<HullShape> shapes = vesselShapes();
  const Scene scene = fleet(shapes, {}, {{"scumble_float", {{"length", 4}, {"beam", 1.6}}}}).load();
  gpu::DeviceOptions options;
  options.choice = testDevice();
  const std::unique_ptr<gpu::Device> device = std::move(gpu::Device::create(options)).value();
  size_t before = 0;
  for (const char* speed : {"0", "3"}) {
    const Knobs storm{{"ocean.wind", "14"}, {"ocean.speed", speed}, {"ocean.heading", "180"}};
    Knobs off = storm;
    off.emplace_back("ocean.hulls", "off");
    const Look stormy = look(storm), full = look(off);
    for (const double time : {0.7, 7.3, 12.9}) {
      const scene::SceneData& data = scene.data();
      ocean::OceanWaves waves(*device, data, ocean::oceanShape(data, stormy.data().at(time)));
      waves.pose(stormy.data().at(time), time, ocean::travelledBy(stormy.data()));
      std::vector<glm::mat4> matrices;
      ocean::FloatParams params;
      params.length = 4, params.beam = 1.6f;
      for (size_t i = 0; i < shapes.size(); ++i) {
        const glm::mat4 still = BoatPose().at(kBerths[i]);
        matrices.push_back(waves.riding(params, still) * still);
      }
      before +=
          inside(scene, drawSea(scene, full, {{1, 15, 4}, {0, 0, 0}, 50}, time), shapes, matrices, kSliver);
      EXPECT_EQ(
          inside(scene, drawSea(scene, stormy, {{1, 15, 4}, {0, 0, 0}, 50}, time), shapes, matrices, kSliver),
          0u)
          << time << " at " << speed << " m/s";
    }
  }
  EXPECT_GT(before, 1000u);
}

// Waves may stand higher than a rim that is not above them, and are cut out of what is within it: nothing is
// seen between the rim and where they end, from nowhere around.
TEST_P(Hulls, nothingIsSeenBelowWavesBesideARim) {
  NOT_WITH_SANITIZERS();
  NEEDS_FINE_RASTER();
  const std::vector<HullShape> shapes = vesselShapes();
  size_t sea = 0, holes = 0;
  for (const char* speed : {"0", "3"}) {
    const Look storm = look({{"ocean.wind", "12"}, {"ocean.speed", speed}, {"ocean.heading", "90"}}),
               full = look({{"ocean.wind", "12"},
                            {"ocean.speed", speed},
                            {"ocean.heading", "90"},
                            {"ocean.hulls", "off"}});
    for (const BoatPose& pose : {BoatPose{}, BoatPose{10, 0, 40, -0.15f}, BoatPose{0, 5, 200, 0.1f}}) {
      const Scene scene = fleet(shapes, pose).load();
      for (const Stand& stand : {Stand{{1, 15, 4}, {0, 0, 0}, 50}, Stand{{-9, 6, 9}, {0, 0, 0}, 50}})
        for (const double time : {0.3, 1.1, 2.6}) {
          const Frame dry = drawSea(scene, storm, stand, time), wet = drawSea(scene, full, stand, time);
          forSea(scene, wet, [&](size_t v, int x, int y, const glm::dvec3&) {
            ++sea;
            holes += texel(aov(dry, "id", v), x, y).x == 0;
          });
        }
    }
  }
  EXPECT_GT(sea, 100000u);
  // But for single pixels at edges, a twentieth of what there was before the sea lay lower around a rim.
  EXPECT_LE(holes, sea / 10000);
}

// As by perspective, by a parallel projection.
TEST_P(Hulls, keepTheSeaOutOfParallelViews) {
  NOT_WITH_SANITIZERS();
  NEEDS_FINE_RASTER();
  const std::vector<HullShape> shapes = vesselShapes();
  const Look off = look({{"ocean.hulls", "off"}}), on = look();
  for (const BoatPose& pose : {kBoatPoses[0], kBoatPoses[3], kBoatPoses[7], kBoatPoses[12]}) {
    const Scene scene = fleet(shapes, pose).load();
    std::vector<glm::mat4> matrices;
    for (size_t i = 0; i < shapes.size(); ++i) matrices.push_back(pose.at(kBerths[i]));
    for (const Stand& stand : {Stand{{1, 15, 4}, {0, 0, 0}, 50}, Stand{{-9, 8, 9}, {0, 0, 0}, 50}}) {
      const std::vector<View> views = parallelFrom(scene, stand);
      // Pixels are as large everywhere as in the middle of the other view.
      const float sliver = 0.1f;
      EXPECT_GT(inside(scene, drawSea(scene, off, views, 1.5), shapes, matrices, sliver), 100u * viewCount());
      EXPECT_EQ(inside(scene, drawSea(scene, on, views, 1.5), shapes, matrices, sliver), 0u)
          << "heel " << pose.heel << ", pitch " << pose.pitch << ", yaw " << pose.yaw;
    }
  }
}

// Its rim below the water all around, a boat is sunk, and the sea closes over it.
TEST_P(Hulls, theSeaClosesOverWhatIsSunk) {
  const std::vector<HullShape> shapes{doryShape()};
  const Knobs calm{{"ocean.wind", "0"}};
  Knobs off = calm;
  off.emplace_back("ocean.hulls", "off");
  for (const float heave : {-0.8f, -3.0f}) {
    const Scene scene = fleet(shapes, {0, 0, 20, heave}).load();
    expectSameSea(drawSea(scene, look(calm)), drawSea(scene, look(off)), std::to_string(heave));
  }
  // Shortly before, waves that are above its rim amidships still end at it.
  const BoatPose pose{0, 0, 20, -0.4f};
  const Scene scene = fleet(shapes, pose).load();
  const Frame frame = drawSea(scene, look(calm), {{-4, 6, 0}, {-4, 0, -3.4f}});
  EXPECT_EQ(inside(scene, frame, shapes, {pose.at(kBerths[0])}, kSliver), 0u);
}

// A look and a scene say what a hull is: none, one of several parts, or an artist's inside, which is not
// drawn.
TEST_P(Hulls, areWhatLooksAndScenesSay) {
  const BoatPose pose{4, 2, 30};
  const std::vector<HullShape> dory{doryShape()};
  const Scene plain = fleet(dory, pose).load(), never = fleet(dory, pose, {{"scumble_hull", false}}).load();
  const Frame full = drawSea(plain, look({{"ocean.hulls", "off"}})), dry = drawSea(plain, look());
  EXPECT_FALSE(sameBytes(aov(full, "id"), aov(dry, "id")));
  expectSameSea(drawSea(never, look()), full, "the scene says no");
  expectSameSea(drawSea(plain, look({{"nodes.Boat0.float.hull", "off"}})), full, "the look says no");
  expectSameSea(drawSea(never, look({{"nodes.Boat0.float.hull", "whole"}})), dry,
                "the look says yes after all");

  // Planks and bottom are two meshes that hold water together alone.
  HullShape sides = doryShape(), bottom = doryShape();
  const auto keep = [](HullShape& shape, bool wantsBottom) {
    std::vector<uint32_t> kept;
    for (size_t i = 0; i < shape.indices.size(); i += 3) {
      float highest = -1;
      for (size_t k = 0; k < 3; ++k) highest = std::max(highest, shape.positions[shape.indices[i + k]].y);
      if ((highest < -0.2f) == wantsBottom)
        kept.insert(kept.end(), shape.indices.begin() + long(i), shape.indices.begin() + long(i) + 3);
    }
    shape.indices = kept;
  };
  keep(sides, false);
  keep(bottom, true);
  const auto parts = [&](const Json& extras) {
    AnimatedScene s;
    Json wood = TestScene::colored("Wood", {0.5f, 0.4f, 0.3f, 1});
    wood["doubleSided"] = true;
    const int material = s.material(wood);
    Json boat{{"name", "Boat"}, {"matrix", matrixOf(pose.at(kBerths[0]))}};
    if (!extras.empty()) boat["extras"] = extras;
    const int node = s.node(boat);
    for (const HullShape* shape : {&sides, &bottom})
      s.node({{"name", "Part"}, {"mesh", s.mesh({meshOf(*shape), 0, {}, {}, {}, {}}, material)}}, node);
    return s.load();
  };
  const Scene loose = parts(Json::object()), joined = parts({{"scumble_hull", true}});
  EXPECT_GT(inside(loose, drawSea(loose, look()), dory, {pose.at(kBerths[0])}, kSliver), 50u);
  EXPECT_EQ(inside(joined, drawSea(joined, look()), dory, {pose.at(kBerths[0])}, kSliver), 0u);

  // A tube lets the sea in, but for what hangs on it and says that it is its inside.
  AnimatedScene s = fleet({leakyShapes()[1]}, {});
  HullShape plug{"plug", {}, {}};
  plug.box({-0.6f, -0.5f, -0.6f}, {0.6f, 0.5f, 0.6f});
  const int plugMesh = s.mesh({meshOf(plug), 0, {}, {}, {}, {}}, 0);
  s.node({{"name", "Inside"}, {"mesh", plugMesh}, {"extras", {{"scumble_hull", "inside"}}}}, 0);
  const Scene tube = s.load();
  const Frame plugged = drawSea(tube, look());
  size_t within = 0, beside = 0;
  forSea(tube, plugged, [&](size_t, int, int, const glm::dvec3& place) {
    const glm::dvec3 local = place - glm::dvec3(kBerths[0]);
    const double away = std::max(std::abs(local.x), std::abs(local.z));
    within += away < 0.57;
    beside += away > 0.63 && glm::length(glm::dvec2(local.x, local.z)) < 0.95;
  });
  EXPECT_EQ(within, 0u);
  EXPECT_GT(beside, 10u) << "the tube around it is full of sea";
  size_t drawn = 0;
  for (int y = 0; y < kHullHeight; ++y)
    for (int x = 0; x < kHullWidth; ++x) drawn += int(texel(aov(plugged, "id"), x, y).x) == 2;
  EXPECT_EQ(drawn, 0u) << "the inside itself";
}

// A skin's hull goes with the joint that moves it; each instance of a mesh is a hull of its own.
TEST_P(Hulls, goWithJointsAndInstances) {
  const std::vector<HullShape> two{doryShape(), doryShape()};
  const BoatPose pose{6, 2, 40};
  TestMesh mesh = meshOf(two[0]);
  const std::vector<glm::vec3> places{kBerths[0], kBerths[3]};
  TestScene instanced;
  const int material = instanced.material(TestScene::colored("Wood", {0.5f, 0.4f, 0.3f, 1}));
  instanced.addInstances(mesh, material, places, {{1, 0, 0, 0}, {1, 0, 0, 0}},
                         {glm::vec3(1), glm::vec3(-1, 1, 1)});
  TestScene skinned;
  skinned.material(TestScene::colored("Wood", {0.5f, 0.4f, 0.3f, 1}));
  mesh.joints.assign(mesh.positions.size(), glm::u8vec4(0));
  mesh.weights.assign(mesh.positions.size(), glm::vec4(1, 0, 0, 0));
  skinned.addSkinned(mesh, material, {pose.at(kBerths[0])}, {glm::mat4(1)});
  const auto expectDry = [&](const Scene& scene, const std::vector<glm::mat4>& matrices, const char* what) {
    const std::vector<HullShape> shapes(two.begin(), two.begin() + long(matrices.size()));
    const Frame full = drawSea(scene, look({{"ocean.hulls", "off"}}));
    EXPECT_GT(inside(scene, full, shapes, matrices, kSliver), 100u) << what;
    EXPECT_EQ(inside(scene, drawSea(scene, look()), shapes, matrices, kSliver), 0u) << what;
  };
  expectDry(instanced.load(), {BoatPose().at(places[0]), BoatPose{0, 0, 0, 0, {-1, 1, 1}}.at(places[1])},
            "instances");
  expectDry(skinned.load(), {pose.at(kBerths[0])}, "a skin");
}

// Boats that were made elsewhere: seen from above, whatever of one can be seen without a sea hides no water.
TEST_P(Hulls, keepTheSeaOutOfRealBoats) {
  NEEDS_FINE_RASTER();
  const std::filesystem::path file = kAssets / "cases" / "18-open-boat" / "dory.glb";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  Result<Scene> loaded = Scene::load(file);
  ASSERT_TRUE(loaded) << loaded.error().message();
  const Knobs calm{{"ocean.wind", "0"}};
  Knobs off = calm, deep = calm;
  off.emplace_back("ocean.hulls", "off"), deep.emplace_back("ocean.level", "-50");
  const Stand above{{0.01f, 12, 0}, {0, 0, 0}, 30};
  const Frame bare = drawSea(*loaded, look(deep), above), dry = drawSea(*loaded, look(calm), above),
              full = drawSea(*loaded, look(off), above);
  size_t boat = 0, water = 0, before = 0;
  for (size_t v = 0; v < viewCount(); ++v)
    for (int y = 0; y < kHullHeight; ++y)
      for (int x = 0; x < kHullWidth; ++x) {
        if (int(texel(aov(bare, "id", v), x, y).x) != 1) continue;
        ++boat;
        water += int(texel(aov(dry, "id", v), x, y).x) != 1;
        before += int(texel(aov(full, "id", v), x, y).x) != 1;
      }
  EXPECT_GT(boat, 1000u);
  EXPECT_GT(3 * before, boat) << "a third of it was sea at least";
  EXPECT_EQ(water, 0u);
}

}  // namespace
}  // namespace scumble
