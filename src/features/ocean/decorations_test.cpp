// Where wakes, ripples and splashes lie on the water: a pure function of look, clips, travel and time.
#include "features/ocean/decorations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "scumble/look.h"

namespace scumble::ocean {
namespace {

using Knobs = std::vector<std::pair<std::string, std::string>>;

look::LookData lookOf(const Knobs& knobs) {
  Look look;
  for (const auto& [path, value] : knobs) EXPECT_TRUE(look.set("decorations.D.water." + path, value).ok());
  return look.data().at(0);
}

// A node that goes from one place to another in a clip of four seconds, below a parent that is turned.
scene::SceneData goes(const glm::vec3& from, const glm::vec3& to) {
  scene::SceneData scene;
  scene.nodes.resize(2);
  scene.nodes[0].name = "World";
  scene.nodes[0].local.rotation = glm::angleAxis(glm::radians(90.0f), glm::vec3(0, 1, 0));  // x to -z
  scene.nodes[1].name = "Boat";
  scene.nodes[1].parent = 0;
  scene::Clip clip;
  clip.duration = 4;
  scene::Channel channel;
  channel.node = 1;
  channel.property = scene::AnimatedProperty::translation;
  channel.times = {0, 4};
  channel.values = {from.x, from.y, from.z, to.x, to.y, to.z};
  channel.componentsPerKey = 3;
  clip.channels.push_back(channel);
  scene.clips.push_back(clip);
  return scene;
}

std::vector<Decoration> decorationsOf(const scene::SceneData& scene, const look::LookData& look) {
  return ocean::decorationsOf(scene, look, floatingNodes(scene, look, -1));
}

const Travelled kStays = [](double) { return glm::dvec2(0.0); };
const std::vector<scene::PlayedClip> kPlays{{}};

TEST(Decorations, oneNodeIsWhereItsSceneHasIt) {
  const scene::SceneData scene = goes({0, 1, 0}, {8, 0, 2});
  for (const double time : {-1.0, 0.0, 1.3, 3.9, 4.1, 9.5})
    for (const size_t node : {0u, 1u})
      EXPECT_EQ(scene::worldAt(scene, kPlays, node, time), scene::poseAt(scene, kPlays, time).world[node]);
  EXPECT_EQ(scene::worldAt(scene, {}, 1, 2), scene::poseAt(scene, {}, 2).world[1]);
}

TEST(Decorations, wakesGoBackAlongTheWay) {
  // Two metres a second along the parent's x, which is -z.
  const scene::SceneData scene = goes({0, 0, 0}, {8, 0, 0});
  const look::LookData look = lookOf({{"node", "Boat"}, {"length", "4"}, {"lasts", "3"}});
  const auto placed = placeDecorations(decorationsOf(scene, look), scene, kPlays, 3.5, {1, 0, 2}, kStays);
  ASSERT_EQ(placed.size(), 1u);
  const shared::WaterDecoration& wake = placed[0];
  ASSERT_EQ(wake.count, shared::kDecorationPoints);
  EXPECT_NEAR(wake.points[0].x, -1, 1e-4);  // from the middle of the water
  EXPECT_NEAR(wake.points[0].y, -7 - 2 - 2, 1e-3) << "the bow is half a hull ahead";
  EXPECT_NEAR(wake.points[1].y, -7 - 2, 1e-3);
  const glm::vec4 last = wake.points[wake.count - 1];
  EXPECT_NEAR(last.y, -7 - 2 + 2 * 3, 1e-3);
  EXPECT_NEAR(last.z, 2 + 6, 1e-3) << "metres behind the bow";
  for (int i = 0; i < wake.count; ++i) {
    EXPECT_NEAR(wake.points[i].w, 1, 1e-3);
    if (i > 0) {
      EXPECT_GT(wake.points[i].z, wake.points[i - 1].z);
    }
    EXPECT_LE(glm::length(glm::vec2(wake.points[i]) - wake.center), wake.reach);
  }
}

TEST(Decorations, wakesAreCarriedByTheWater) {
  const scene::SceneData scene = goes({0, 0, 0}, {8, 0, 0});
  const Travelled travels = [](double t) { return glm::dvec2(3 * t, 4 * t); };
  const look::LookData look = lookOf({{"at", "1,9,2"}, {"lasts", "2"}});
  const auto wake = placeDecorations(decorationsOf(scene, look), scene, kPlays, 5, glm::vec3(0), travels)[0];
  // What is at a place of the scene leaves a straight wake against the way of the scene, five metres a
  // second.
  const glm::vec4 last = wake.points[wake.count - 1];
  EXPECT_NEAR(last.x, 1 - 3 * 2, 1e-3);
  EXPECT_NEAR(last.y, 2 - 4 * 2, 1e-3);
  // What stands still over the water has none.
  const auto still = placeDecorations(decorationsOf(scene, look), scene, kPlays, 5, glm::vec3(0), kStays)[0];
  EXPECT_EQ(still.count, 0);
}

TEST(Decorations, wakesGoStraightOnWhereClipsJump) {
  const scene::SceneData scene = goes({0, 0, 0}, {8, 0, 0});
  const look::LookData look = lookOf({{"node", "Boat"}, {"length", "4"}, {"lasts", "6"}});
  // Just after the clip has begun anew, at that moment, and before anything has begun.
  for (const double time : {4.25, 4.0, 0.0, 0.3}) {
    const auto wake =
        placeDecorations(decorationsOf(scene, look), scene, kPlays, time, glm::vec3(0), kStays)[0];
    ASSERT_GT(wake.count, 2);
    const double here = -2 * std::fmod(time, 4.0);
    for (int i = 1; i < wake.count; ++i)
      EXPECT_NEAR(wake.points[i].y, here + 2 * 6.0 * (i - 1) / (wake.count - 2), 0.05) << time << " s, " << i;
  }
}

// However short the clip is, beside what lasts.
TEST(Decorations, wakesGoStraightOnWhereClipsJumpOften) {
  const scene::SceneData scene = goes({0, 0, 0}, {8, 0, 0});
  for (const char* lasts : {"10", "40", "120"}) {
    const look::LookData look = lookOf({{"node", "Boat"}, {"length", "4"}, {"lasts", lasts}});
    const auto wake = placeDecorations(decorationsOf(scene, look), scene, kPlays, 7, glm::vec3(0), kStays)[0];
    ASSERT_GT(wake.count, 2);
    for (int i = 1; i < wake.count; ++i)
      EXPECT_NEAR(wake.points[i].y, -6 + 2 * std::stod(lasts) * (i - 1) / (wake.count - 2), 0.05) << lasts;
  }
}

TEST(Decorations, turningBackKeepsWhatWasMade) {
  scene::SceneData scene = goes({0, 0, 0}, {8, 0, 0});
  std::vector<scene::PlayedClip> back{{}};
  back[0].repeat = scene::Repeat::pingPong;
  const look::LookData look = lookOf({{"node", "Boat"}, {"length", "4"}, {"lasts", "3"}});
  const auto wake = placeDecorations(decorationsOf(scene, look), scene, back, 5, glm::vec3(0), kStays)[0];
  float farthest = 0;
  for (int i = 1; i < wake.count; ++i) farthest = std::min(farthest, wake.points[i].y);
  EXPECT_NEAR(wake.points[1].y, -6, 0.01);
  EXPECT_NEAR(farthest, -8, 0.2) << "where it turned, a second ago";
  EXPECT_NEAR(wake.points[wake.count - 1].y, -4, 0.05) << "two seconds before that";
}

TEST(Decorations, stoppingLeavesWhatWasMade) {
  scene::SceneData scene = goes({0, 0, 0}, {8, 0, 0});
  std::vector<scene::PlayedClip> once{{}};
  once[0].repeat = scene::Repeat::once;
  const look::LookData look = lookOf({{"node", "Boat"}, {"length", "4"}, {"lasts", "3"}});
  const auto wake = placeDecorations(decorationsOf(scene, look), scene, once, 5.5, glm::vec3(0), kStays)[0];
  ASSERT_GT(wake.count, 2);
  EXPECT_EQ(wake.points[1].w, 0);
  EXPECT_NEAR(wake.points[wake.count - 1].w, 1, 1e-3);
  EXPECT_EQ(placeDecorations(decorationsOf(scene, look), scene, once, 20, glm::vec3(0), kStays)[0].count, 0);
}

TEST(Decorations, ringsBeginWhenTheyAreTold) {
  const scene::SceneData scene = goes({0, 0, 0}, {8, 0, 0});
  const Knobs knobs{
      {"kind", "ripples"}, {"node", "Boat"}, {"start", "0.5"}, {"every", "1"}, {"lasts", "2.25"}};
  const auto at = [&](double time) {
    return placeDecorations(decorationsOf(scene, lookOf(knobs)), scene, kPlays, time, glm::vec3(0),
                            kStays)[0];
  };
  EXPECT_EQ(at(0.49).count, 0);
  EXPECT_EQ(at(0.5).count, 1);
  const auto later = at(3.6);  // those of 3.5, 2.5 and 1.5 s
  ASSERT_EQ(later.count, 3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(later.points[i].z, 0.1 + i, 1e-4);
    EXPECT_NEAR(later.points[i].y, -2 * (3.5 - i), 1e-3) << "where the boat was then";
    EXPECT_LE(glm::length(glm::vec2(later.points[i]) - later.center) + later.radius, later.reach);
  }
  EXPECT_NE(later.points[0].w, later.points[1].w);
  EXPECT_EQ(at(3.6).points[1], later.points[1]);
  // Each keeps its own number while others come.
  EXPECT_EQ(at(4.4).points[1].w, at(4.6).points[2].w);
}

TEST(Decorations, moreThanThereIsRoomForAreTheNewest) {
  const look::LookData look = lookOf({{"kind", "splash"}, {"every", "0.001"}, {"lasts", "100"}});
  const auto one = placeDecorations(decorationsOf({}, look), {}, {}, 50, glm::vec3(0), kStays)[0];
  ASSERT_EQ(one.count, shared::kDecorationPoints);
  EXPECT_NEAR(one.points[one.count - 1].z, 0.025, 1e-3);
}

TEST(Decorations, whatRidesHasAWake) {
  scene::SceneData scene = goes({0, 0, 0}, {8, 0, 0});
  const auto decorations = [&](const Knobs& knobs) {
    Look look;
    for (const auto& [path, value] : knobs) EXPECT_TRUE(look.set(path, value).ok());
    return decorationsOf(scene, look.data().at(0));
  };
  EXPECT_TRUE(decorations({}).empty());
  const auto rides = decorations({{"nodes.Boat.float.rides", "on"}, {"nodes.Boat.float.length", "7"}});
  ASSERT_EQ(rides.size(), 1u);
  EXPECT_EQ(rides[0].node, 1u);
  EXPECT_EQ(rides[0].params.length, 7);
  EXPECT_TRUE(decorations({{"nodes.Boat.float.rides", "on"}, {"nodes.Boat.float.wake", "off"}}).empty());
  // The scene says it: then with every look, unless that declares one of its own.
  scene.nodes[1].extras["scumble_float"] =
      std::make_shared<const nlohmann::json>(nlohmann::json{{"beam", 3}});
  ASSERT_EQ(decorations({}).size(), 1u);
  EXPECT_EQ(decorations({})[0].params.beam, 3);
  EXPECT_TRUE(decorations({{"nodes.Boat.float.rides", "off"}}).empty());
  const auto own = decorations({{"decorations.W.water.node", "Boat"}, {"decorations.W.water.beam", "2"}});
  ASSERT_EQ(own.size(), 1u);
  EXPECT_EQ(own[0].params.beam, 2);
  EXPECT_EQ(
      decorations({{"decorations.W.water.node", "Boat"}, {"decorations.W.water.kind", "ripples"}}).size(),
      2u);
}

TEST(Decorations, meshesFaceUp) {
  for (const int kind : {shared::kWake, shared::kRipples, shared::kSplash}) {
    const scene::Primitive mesh = makeDecorationMesh(kind);
    for (size_t t = 0; t < mesh.indices.size(); t += 3) {
      const glm::vec3 &a = mesh.positions[mesh.indices[t]], &b = mesh.positions[mesh.indices[t + 1]],
                      &c = mesh.positions[mesh.indices[t + 2]];
      // x and y become directions along the water's x and z, or turned together.
      EXPECT_LT((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x), 0);
    }
  }
}

}  // namespace
}  // namespace scumble::ocean
