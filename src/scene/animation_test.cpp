// Clips on the CPU: keys against a double-precision reference, times that loop and swing, mixing, and poses
// that numbers cannot hold.
#include "scene/animation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "scene/posed_bounds.h"
#include "scene/prepare_mesh.h"
#include "tests/support/posed_scene.h"

namespace scumble::scene {
namespace {

using test::posedNodes;

constexpr ChannelInterpolation kInterpolations[] = {ChannelInterpolation::linear, ChannelInterpolation::step,
                                                    ChannelInterpolation::cubicSpline};
constexpr AnimatedProperty kProperties[] = {AnimatedProperty::translation, AnimatedProperty::rotation,
                                            AnimatedProperty::scale, AnimatedProperty::weights};

int componentsOf(AnimatedProperty property) {
  return property == AnimatedProperty::rotation ? 4 : property == AnimatedProperty::weights ? 5 : 3;
}

// Keys at uneven times; of a cubic one, tangents as large as values are.
Channel randomChannel(AnimatedProperty property, ChannelInterpolation interpolation, uint32_t seed,
                      int keys = 6) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> number(-1, 1), step(0.01f, 0.9f);
  Channel channel{0, property, interpolation, {}, {}, componentsOf(property)};
  const int parts = interpolation == ChannelInterpolation::cubicSpline ? 3 : 1;
  for (int k = 0; k < keys; ++k) {
    channel.times.push_back(k == 0 ? 0.25f : channel.times.back() + step(random));
    for (int part = 0; part < parts; ++part) {
      glm::vec4 turn(number(random), number(random), number(random), number(random));
      if (parts == 1 || part == 1) turn = glm::normalize(turn);
      for (int i = 0; i < channel.componentsPerKey; ++i)
        channel.values.push_back(property == AnimatedProperty::rotation ? turn[i] : 3 * number(random));
    }
  }
  return channel;
}

std::vector<double> sampled(const Channel& channel, double time) {
  std::vector<double> values(size_t(channel.componentsPerKey));
  sampleChannel(channel, time, values.data());
  return values;
}

void expectNear(const std::vector<double>& got, const std::vector<double>& expected, double tolerance,
                const std::string& what) {
  ASSERT_EQ(got.size(), expected.size());
  for (size_t i = 0; i < got.size(); ++i) EXPECT_NEAR(got[i], expected[i], tolerance) << what;
}

void expectNear(const glm::dmat4& got, const glm::dmat4& expected, double tolerance,
                const std::string& what) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      EXPECT_NEAR(got[c][r], expected[c][r], tolerance) << what << ", column " << c << ", row " << r;
}

TEST(Animation, keysAgainstTheSpecification) {
  for (const AnimatedProperty property : kProperties)
    for (const ChannelInterpolation interpolation : kInterpolations)
      for (uint32_t seed = 0; seed < 8; ++seed) {
        const Channel channel = randomChannel(property, interpolation, seed);
        std::vector<double> times{-100, 0, 1e9};
        for (size_t k = 0; k < channel.times.size(); ++k) {
          const double time = channel.times[k];
          times.push_back(time);
          if (k == 0) continue;
          const double before = channel.times[k - 1];
          for (const double part : {1e-4, 0.1, 0.5, 0.77, 0.9999})
            times.push_back(before + part * (time - before));
        }
        for (const double time : times)
          expectNear(sampled(channel, time), test::channelAt(channel, time), 4e-5,
                     "property " + std::to_string(int(property)) + ", interpolation " +
                         std::to_string(int(interpolation)) + ", time " + std::to_string(time));
      }
}

TEST(Animation, keysStandAtTheirOwnTimesAndOutside) {
  for (const AnimatedProperty property : kProperties)
    for (const ChannelInterpolation interpolation : kInterpolations) {
      const Channel channel = randomChannel(property, interpolation, 3);
      const size_t n = size_t(channel.componentsPerKey),
                   stride = interpolation == ChannelInterpolation::cubicSpline ? 3 * n : n,
                   first = interpolation == ChannelInterpolation::cubicSpline ? n : 0;
      const auto key = [&](size_t k) {
        const float* values = &channel.values[k * stride + first];
        return std::vector<double>(values, values + n);
      };
      for (size_t k = 0; k < channel.times.size(); ++k)
        EXPECT_EQ(sampled(channel, double(channel.times[k])), key(k));
      EXPECT_EQ(sampled(channel, -1e6), key(0));
      EXPECT_EQ(sampled(channel, 1e6), key(channel.times.size() - 1));
      // A step stands until the very time of the next key.
      if (interpolation != ChannelInterpolation::step) continue;
      const double next = channel.times[2];
      EXPECT_EQ(sampled(channel, std::nextafter(next, 0)), key(1));
    }
}

TEST(Animation, aSingleKeyStandsForever) {
  for (const AnimatedProperty property : kProperties)
    for (const ChannelInterpolation interpolation : kInterpolations) {
      const Channel channel = randomChannel(property, interpolation, 1, 1);
      for (const double time : {-3.0, 0.0, 0.25, 7.0})
        expectNear(sampled(channel, time), test::channelAt(channel, time), 0, "one key");
    }
}

// All but steps are continuous, and rotations have unit length everywhere.
TEST(Animation, curvesAreContinuous) {
  for (const AnimatedProperty property : kProperties)
    for (const ChannelInterpolation interpolation :
         {ChannelInterpolation::linear, ChannelInterpolation::cubicSpline}) {
      const Channel channel = randomChannel(property, interpolation, 7);
      const double from = 0, to = double(channel.times.back()) + 0.2;
      constexpr int kSteps = 20000;
      std::vector<double> before = sampled(channel, from);
      for (int i = 1; i <= kSteps; ++i) {
        const std::vector<double> now = sampled(channel, from + (to - from) * i / kSteps);
        double dot = 0, length = 0, change = 0;
        for (size_t k = 0; k < now.size(); ++k)
          dot += now[k] * before[k], length += now[k] * now[k], change += std::abs(now[k] - before[k]);
        if (property == AnimatedProperty::rotation) {
          EXPECT_NEAR(length, 1, 1e-5f);
          // The other sign is the same turn.
          EXPECT_GT(std::abs(dot), 0.99f);
        } else {
          EXPECT_LT(change, 0.3f) << i;
        }
        before = now;
      }
    }
}

TEST(Animation, linearRotationsTakeTheShorterArcEvenly) {
  // From 10 to 60 degrees about z, the second with its sign turned: as slow at every time.
  const auto about = [](float degrees, float sign) {
    const float half = glm::radians(degrees) / 2;
    return std::vector<float>{0, 0, sign * std::sin(half), sign * std::cos(half)};
  };
  for (const float sign : {1.0f, -1.0f}) {
    Channel channel{0, AnimatedProperty::rotation, ChannelInterpolation::linear, {0, 1}, about(10, 1), 4};
    for (const float x : about(60, sign)) channel.values.push_back(x);
    for (const float t : {0.1f, 0.25f, 0.5f, 0.8f}) {
      const std::vector<double> q = sampled(channel, double(t));
      const glm::dvec3 x = glm::dquat(q[3], q[0], q[1], q[2]) * glm::dvec3(1, 0, 0);
      EXPECT_NEAR(glm::degrees(std::atan2(x.y, x.x)), 10 + 50 * t, 1e-3f);
    }
  }
  // Equal keys and nearly equal ones divide by no zero.
  for (const float degrees : {10.0f, 10.0001f}) {
    Channel channel{0, AnimatedProperty::rotation, ChannelInterpolation::linear, {0, 1}, about(10, 1), 4};
    for (const float x : about(degrees, 1)) channel.values.push_back(x);
    EXPECT_NEAR(sampled(channel, 0.5)[2], about(10, 1)[2], 1e-5f);
  }
}

TEST(Animation, cubicRotationsThatVanishKeepAKey) {
  // Opposite values: half way they cancel out.
  Channel channel{0, AnimatedProperty::rotation, ChannelInterpolation::cubicSpline, {0, 1}, {}, 4};
  for (const float w : {1.0f, -1.0f})
    channel.values.insert(channel.values.end(), {0, 0, 0, 0, 0, 0, 0, w, 0, 0, 0, 0});
  EXPECT_EQ(sampled(channel, 0.5), (std::vector<double>{0, 0, 0, 1}));
}

TEST(Animation, clipTimes) {
  const auto at = [](Repeat repeat, double time, double speed = 1, double start = 0, double duration = 2) {
    return clipTime({0, 1, speed, start, repeat}, duration, time);
  };
  struct Case {
    double time, loop, once, pingPong;
  };
  for (const Case& c : {Case{0, 0, 0, 0},
                        {0.5, 0.5, 0.5, 0.5},
                        {1.75, 1.75, 1.75, 1.75},
                        {2.5, 0.5, 2, 1.5},
                        {3.75, 1.75, 2, 0.25},
                        {4.5, 0.5, 2, 0.5},
                        {-0.5, 1.5, 0, 0.5},
                        {-2.5, 1.5, 0, 1.5},
                        {-4.25, 1.75, 0, 0.25}}) {
    EXPECT_DOUBLE_EQ(at(Repeat::loop, c.time), c.loop) << c.time;
    EXPECT_DOUBLE_EQ(at(Repeat::once, c.time), c.once) << c.time;
    EXPECT_DOUBLE_EQ(at(Repeat::pingPong, c.time), c.pingPong) << c.time;
    // Speed and start are a line in time.
    for (const Repeat repeat : {Repeat::loop, Repeat::once, Repeat::pingPong}) {
      EXPECT_DOUBLE_EQ(at(repeat, c.time / 4, 4), at(repeat, c.time)) << c.time;
      EXPECT_DOUBLE_EQ(at(repeat, -c.time / 2, -2), at(repeat, c.time)) << c.time;
      EXPECT_DOUBLE_EQ(at(repeat, c.time - 8, 1, 8), at(repeat, c.time)) << c.time;
      EXPECT_DOUBLE_EQ(at(repeat, c.time, 0, 1.25), 1.25) << "a clip that stands";
    }
  }
  EXPECT_EQ(at(Repeat::once, 2), 2);
  EXPECT_EQ(at(Repeat::pingPong, 2), 2);
  for (const Repeat repeat : {Repeat::loop, Repeat::once, Repeat::pingPong}) {
    for (const double time : {-5.0, 0.0, 3.0})
      EXPECT_EQ(at(repeat, time, 1, 0, 0), 0) << "a clip of no length";
    // Never outside the clip, however far.
    for (double time = -1e6; time < 1e6; time += 12345.678) {
      const double inside = at(repeat, time, -3.3, 0.7, 0.013);
      EXPECT_GE(inside, 0);
      EXPECT_LE(inside, 0.013 * (1 + 1e-6));
    }
  }
}

// Some nodes, a parent first, and a mesh with two targets on one of them.
SceneData family() {
  SceneData scene;
  Primitive triangle;
  triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.normals.assign(3, {0, 0, 1});
  triangle.indices = {0, 1, 2};
  triangle.morphTargets.resize(2);
  scene.materials.resize(1);
  triangle.extent = extentOf(triangle);
  scene.meshes.push_back(Mesh{"", {triangle}, {0.25f, 0.5f}});
  for (int n = 0; n < 4; ++n) {
    Node node;
    node.parent = n - 1;
    node.local.translation = {0.5f, float(n), -1};
    node.local.rotation = glm::normalize(glm::quat(1, 0.2f * float(n), 0.3f, -0.4f));
    node.local.scale = {1, 1.5f, 0.75f};
    scene.nodes.push_back(node);
  }
  scene.nodes[2].mesh = 0;
  scene.nodes[3].parent = 0;
  scene.bounds.add(glm::vec3(0.0f)), scene.bounds.add(glm::vec3(1.0f));
  return scene;
}

Clip& addClip(SceneData& scene) {
  scene.clips.emplace_back();
  scene.clips.back().name = "clip";
  return scene.clips.back();
}
void addChannel(SceneData& scene, size_t clip, int node, Channel channel) {
  channel.node = node;
  scene.clips[clip].duration = std::max(scene.clips[clip].duration, channel.times.back());
  scene.clips[clip].channels.push_back(std::move(channel));
}
Channel constant(AnimatedProperty property, std::vector<float> value) {
  const int components = int(value.size());
  return {0, property, ChannelInterpolation::linear, {0}, std::move(value), components};
}

TEST(Animation, aPoseWithoutClipsIsTheRestPose) {
  SceneData scene = family();
  scene.nodes[1].localMatrix = glm::mat4(1, 0.5f, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1);
  const Pose pose = poseAt(scene, {}, 5);
  const std::vector<glm::dmat4> world = worldMatrices(scene);
  for (size_t n = 0; n < world.size(); ++n) expectNear(pose.world[n], glm::dmat4(world[n]), 0, "rest");
  EXPECT_EQ(pose.morphWeights[2], (std::vector<float>{0.25f, 0.5f}));
  EXPECT_TRUE(pose.morphWeights[0].empty());
  scene.nodes[2].morphWeights = {1, 0};
  EXPECT_EQ(poseAt(scene, {}, 5).morphWeights[2], (std::vector<float>{1, 0})) << "a node's own";
}

TEST(Animation, parentsCarryTheirChildren) {
  SceneData scene = family();
  addClip(scene);
  for (const AnimatedProperty property : {kProperties[0], kProperties[1], kProperties[2]})
    for (int node = 0; node < 3; ++node)
      addChannel(scene, 0, node,
                 randomChannel(property, kInterpolations[(node + int(property)) % 3], uint32_t(node)));
  for (const double time : {0.0, 0.3, 0.9, 1.7}) {
    const PlayedClip played{0};
    const Pose pose = poseAt(scene, {&played, 1}, time);
    const double inClip = clipTime(played, double(scene.clips[0].duration), time);
    const std::vector<glm::dmat4> expected = posedNodes(scene, {{0, inClip}});
    for (size_t n = 0; n < scene.nodes.size(); ++n)
      expectNear(pose.world[n], expected[n], 2e-3,
                 "time " + std::to_string(time) + ", node " + std::to_string(n));
  }
}

TEST(Animation, clipsMixByTheirWeights) {
  SceneData scene = family();
  addClip(scene), addClip(scene);
  for (size_t clip = 0; clip < 2; ++clip) {
    for (const AnimatedProperty property : {AnimatedProperty::translation, AnimatedProperty::scale})
      addChannel(scene, clip, 1, randomChannel(property, ChannelInterpolation::linear, uint32_t(clip)));
    Channel weights =
        constant(AnimatedProperty::weights, clip ? std::vector<float>{2, 0} : std::vector<float>{-1, 1});
    addChannel(scene, clip, 2, weights);
  }
  // Rotations near the rest pose, some with their signs turned.
  for (size_t clip = 0; clip < 2; ++clip) {
    const glm::quat q = glm::normalize(glm::quat(scene.nodes[1].local.rotation) +
                                       glm::quat(0, clip ? 0.4f : -0.2f, 0.3f, 0)) *
                        (clip ? -1.0f : 1.0f);
    addChannel(scene, clip, 1, constant(AnimatedProperty::rotation, {q.x, q.y, q.z, q.w}));
  }
  const auto pose = [&](float a, float b) {
    const PlayedClip played[] = {{0, a}, {1, b}};
    return poseAt(scene, played, 0.6);
  };
  const auto expectMix = [&](float a, float b, double shareA, double shareB) {
    const std::string what = std::to_string(a) + " and " + std::to_string(b);
    const Pose got = pose(a, b);
    const auto seconds = [&](size_t clip) { return clipTime({}, double(scene.clips[clip].duration), 0.6); };
    const auto expected = posedNodes(scene, {{0, seconds(0), shareA}, {1, seconds(1), shareB}});
    for (size_t n = 0; n < scene.nodes.size(); ++n) expectNear(got.world[n], expected[n], 1e-3, what);
    const double rest = 1 - shareA - shareB;
    EXPECT_NEAR(got.morphWeights[2][0], -shareA + 2 * shareB + 0.25 * rest, 1e-5) << what;
    EXPECT_NEAR(got.morphWeights[2][1], shareA + 0.5 * rest, 1e-5) << what;
  };
  expectMix(1, 0, 1, 0);
  expectMix(0, 1, 0, 1);
  expectMix(0.3f, 0.2f, 0.3, 0.2);      // the rest pose fills up
  expectMix(0.25f, 0.75f, 0.25, 0.75);  // whole
  expectMix(1, 1, 0.5, 0.5);            // too much: an average
  expectMix(3, 1, 0.75, 0.25);
  expectMix(0, 0, 0, 0);
  // In which order clips come does not count.
  const PlayedClip turned[] = {{1, 0.2f}, {0, 0.3f}};
  const Pose a = pose(0.3f, 0.2f), b = poseAt(scene, turned, 0.6);
  for (size_t n = 0; n < scene.nodes.size(); ++n)
    expectNear(a.world[n], glm::dmat4(b.world[n]), 1e-5, "order");
}

// A clip that plays at ten percent and one that plays fully meet on nodes of their own only.
TEST(Animation, clipsOnOtherNodesDoNotInterfere) {
  SceneData scene = family();
  addClip(scene), addClip(scene);
  addChannel(scene, 0, 1, constant(AnimatedProperty::translation, {10, 0, 0}));
  addChannel(scene, 1, 3, constant(AnimatedProperty::translation, {0, 20, 0}));
  addChannel(scene, 1, 1, constant(AnimatedProperty::scale, {2, 2, 2}));
  const PlayedClip played[] = {{0, 1.0f}, {1, 1.0f}};
  const Pose pose = poseAt(scene, played, 0);
  const std::vector<glm::dmat4> expected = posedNodes(scene, {{0, 0}, {1, 0}});
  for (size_t n = 0; n < scene.nodes.size(); ++n) expectNear(pose.world[n], expected[n], 1e-4, "whole");
}

TEST(Animation, oppositeRotationsNeverVanish) {
  SceneData scene = family();
  scene.nodes[0].local.rotation = glm::quat(1, 0, 0, 0);
  addClip(scene), addClip(scene);
  // Half turns about x and -x: the same turn, as opposite quaternions.
  addChannel(scene, 0, 0, constant(AnimatedProperty::rotation, {1, 0, 0, 0}));
  addChannel(scene, 1, 0, constant(AnimatedProperty::rotation, {-1, 0, 0, 0}));
  const PlayedClip both[] = {{0, 0.5f}, {1, 0.5f}};
  const Pose same = poseAt(scene, both, 0), one = poseAt(scene, {both, 1}, 0);
  EXPECT_NEAR(std::abs(same.world[0][1][2]), 0, 1e-5f);
  EXPECT_NEAR(same.world[0][1][1], -1.5f, 1e-5f) << "turned by a half";
  // Whatever is mixed, lengths stay.
  for (const Pose* pose : {&same, &one})
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(glm::length(glm::vec3(pose->world[0][axis])), scene.nodes[0].local.scale[axis], 1e-5f);
  // Quarters that cancel out.
  const float h = std::sqrt(0.5f);
  scene.clips[0].channels[0].values = {h, 0, 0, h}, scene.clips[1].channels[0].values = {-h, 0, 0, h};
  const Pose middle = poseAt(scene, both, 0);
  EXPECT_NEAR(middle.world[0][1][1], 1.5f, 1e-5f) << "half way between is the rest";
}

TEST(Animation, nodesHaveTimesOfTheirOwn) {
  SceneData scene = family();
  addClip(scene);
  for (int node = 0; node < 4; ++node)
    addChannel(scene, 0, node,
               randomChannel(AnimatedProperty::translation, ChannelInterpolation::linear, uint32_t(node)));
  addChannel(scene, 0, 2,
             {0, AnimatedProperty::weights, ChannelInterpolation::linear, {0, 2}, {0, 0, 2, 4}, 2});
  scene.clips[0].duration = 3;
  const PlayedClip played{0};
  const NodeTimes times{{0.3, 0.3, 1.1, 0.7}, {0.1, 0.1, 0.5, 0.1}};
  const Pose mixed = poseAt(scene, {&played, 1}, times);
  EXPECT_NEAR(mixed.morphWeights[2][1], 1, 1e-6f) << "weights go by their own times";
  const auto local = [&](const std::vector<glm::dmat4>& world, size_t n) {
    return glm::inverse(world[size_t(scene.nodes[n].parent)]) * world[n];
  };
  for (const size_t n : {1u, 2u, 3u}) {
    const Pose alone = poseAt(scene, {&played, 1}, times.transforms[n]);
    expectNear(local(mixed.world, n), glm::dmat4(local(alone.world, n)), 1e-4, "node " + std::to_string(n));
  }
}

TEST(Animation, sheared) {
  SceneData scene = family();
  scene.nodes[1].localMatrix = glm::mat4(1, 0.5f, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1);
  addClip(scene);
  addChannel(scene, 0, 0, constant(AnimatedProperty::translation, {1, 2, 3}));
  const PlayedClip played{0};
  const Pose pose = poseAt(scene, {&played, 1}, 0);
  expectNear(pose.world[2], posedNodes(scene, {{0, 0}})[2], 1e-4, "below a matrix that shears");
}

bool isZero(const glm::mat4& m) {
  return m == glm::mat4(0.0f);
}

TEST(Animation, scalesOfNothingAndOfTooMuch) {
  SceneData scene = family();
  addClip(scene);
  addChannel(scene, 0, 1, constant(AnimatedProperty::scale, {0, 0, 0}));
  const PlayedClip played{0};
  Pose pose = poseAt(scene, {&played, 1}, 0);
  EXPECT_EQ(glm::vec3(pose.world[1][0]), glm::vec3(0.0f));
  EXPECT_EQ(glm::vec3(pose.world[2][1]), glm::vec3(0.0f)) << "a child of nothing";
  EXPECT_FALSE(isZero(pose.world[1])) << "the place stays";
  // Too large at a child: it and what is below are gone; others stay.
  scene.clips[0].channels[0].values = {1e10f, 1e10f, 1e10f};
  addChannel(scene, 0, 2, constant(AnimatedProperty::scale, {1e9f, 1, 1}));
  pose = poseAt(scene, {&played, 1}, 0);
  EXPECT_TRUE(isZero(pose.world[2]));
  EXPECT_FALSE(isZero(pose.world[1]));
  expectNear(pose.world[3], glm::dmat4(worldMatrices(scene)[3]), 0, "elsewhere");
  addChannel(scene, 0, 0, constant(AnimatedProperty::translation, {1e15f, -1e15f, 1e15f}));
  pose = poseAt(scene, {&played, 1}, 0);
  for (const glm::dmat4& world : pose.world)
    for (int i = 0; i < 16; ++i) EXPECT_TRUE(std::isfinite(world[i / 4][i % 4]));
}

bool isFinite(const Bounds& b) {
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(b.min[i]) || !std::isfinite(b.max[i])) return false;
  return true;
}

// Instances, joints and targets multiply once more.
TEST(Animation, boundsStayFinite) {
  SceneData scene = family();
  addClip(scene);
  addChannel(scene, 0, 2, constant(AnimatedProperty::scale, {1e14f, 1e14f, 1e14f}));
  scene.nodes[2].instances = {glm::scale(glm::mat4(1.0f), glm::vec3(1e14f))};
  Mesh& mesh = scene.meshes[0].own();
  Primitive& p = mesh.primitives[0];
  for (glm::vec3& position : p.positions) position *= 1e14f;
  p.extent = extentOf(p);
  const int clips[] = {0};
  EXPECT_TRUE(isFinite(playedBounds(scene, clips))) << "morphed instances";
  p.morphTargets.clear(), mesh.morphWeights.clear();
  p.extent = extentOf(p);
  EXPECT_TRUE(isFinite(playedBounds(scene, clips))) << "instances";
  const PlayedClip played{0};
  const Pose pose = poseAt(scene, {&played, 1}, 0);
  EXPECT_TRUE(isFinite(
      posedBounds(p.extent, instanceToWorld(scene.nodes[2], pose.world[2], 0), {}, pose.morphWeights[2])));
}

// Boxes hold every vertex of what they are around, at every time, and are not far too large.
TEST(Animation, boundsHoldWhatMoves) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> number(-1, 1);
  SceneData scene = family();
  Primitive& p = scene.meshes[0].own().primitives[0];
  p.positions.clear();
  p.indices.clear();
  for (uint32_t v = 0; v < 60; ++v) {
    p.positions.push_back({number(random), number(random), number(random)});
    p.indices.push_back(v);
  }
  p.normals.assign(60, {0, 0, 1});
  for (MorphTarget& target : p.morphTargets)
    for (int v = 0; v < 60; ++v) target.positions.push_back({number(random), 0, number(random)});
  scene.skins.push_back({"", {0, 1, 3}, std::vector<glm::mat4>(3, glm::mat4(0.7f))});
  addClip(scene);
  for (int node = 0; node < 4; ++node)
    for (const AnimatedProperty property : {kProperties[0], kProperties[1], kProperties[2]})
      addChannel(scene, 0, node, randomChannel(property, ChannelInterpolation::linear, uint32_t(node)));
  Channel weights = randomChannel(AnimatedProperty::weights, ChannelInterpolation::linear, 4);
  weights.componentsPerKey = 2, weights.values.resize(12);
  addChannel(scene, 0, 2, weights);
  for (const bool skinned : {false, true}) {
    if (skinned) {
      p.influences = 4;
      for (int i = 0; i < 240; ++i) p.joints.push_back(uint16_t((i / 4 + i % 4) % 3));
      p.weights.assign(240, 0.25f);
    }
    scene.nodes[2].skin = skinned ? 0 : -1;
    p.extent = extentOf(p);
    const int clips[] = {0};
    const Bounds whole = playedBounds(scene, clips);
    const glm::vec3 slack = 0.1f * (whole.max - whole.min);
    for (double time = 0; time < double(scene.clips[0].duration); time += 0.11) {
      const PlayedClip played{0};
      const Pose pose = poseAt(scene, {&played, 1}, time);
      std::vector<glm::mat4> joints;
      if (skinned) joints = jointMatrices(scene.skins[0], pose.world);
      const Bounds box = posedBounds(p.extent, pose.world[2], joints, pose.morphWeights[2]);
      for (const test::WorldTriangle& t : test::posedTriangles(scene, {{0, time}}))
        for (const glm::dvec3& vertex : t.positions)
          for (int axis = 0; axis < 3; ++axis) {
            EXPECT_GE(vertex[axis], double(box.min[axis]) - 1e-3);
            EXPECT_LE(vertex[axis], double(box.max[axis]) + 1e-3);
            EXPECT_GE(vertex[axis], double(whole.min[axis] - slack[axis])) << "time " << time;
            EXPECT_LE(vertex[axis], double(whole.max[axis] + slack[axis])) << "time " << time;
          }
      EXPECT_LT(box.radius(), 3 * whole.radius());
    }
  }
}

}  // namespace
}  // namespace scumble::scene
