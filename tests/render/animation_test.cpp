// Clips as they are drawn: where things are at a time against triangles that the CPU poses in double
// precision, poses held on twos, motion, shadows and framing of what moves, and that frames do not remember.
#include <cmath>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <set>

#include "scene/scene_data.h"
#include "tests/support/animated_scene.h"
#include "tests/support/aov.h"
#include "tests/support/asset_files.h"
#include "tests/support/posed_scene.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"
#include "tests/support/test_device.h"

namespace scumble {
namespace {

using namespace test;

Frame drawn(Result<Frame> frame) {
  if (!frame) throw std::runtime_error(frame.error().message());
  return std::move(frame).value();
}

// The first clip, around and around.
Moments firstClipAt(const Scene& scene, double time) {
  const double length = double(scene.data().clips[0].duration);
  return {{0, time - length * std::floor(time / length)}};
}

// The share of the clip "Move" changes with time; nothing is held.
Look fadingLook(const std::string& keys) {
  const Result<Look> look = Look::fromJson(
      R"({"clips": {"Move": {"play": {"weight": {"keys": )" + keys + R"(}}}}, "animation": {"hold": 0},
          "ground": {"mode": "off"}, "light": {"shadowWarp": 0}})",
      "test.json");
  if (!look) throw std::runtime_error(look.error().message());
  return *look;
}

// Where the point that was hit is on the same triangle in another pose.
glm::dvec3 placeOn(const std::vector<WorldTriangle>& triangles, const Hit& hit) {
  glm::dvec3 place(0.0);
  for (int k = 0; k < 3; ++k) place += hit.barycentric[k] * triangles[hit.triangle].positions[k];
  return place;
}

Knobs unheld(Knobs more = {}) {
  more.insert(more.end(), {{"animation.hold", "0"}, {"light.shadowWarp", "0"}});
  return more;
}

// A bar with a skin, a ball that swells and a box that is carried, side by side; materials by their names.
AnimatedScene threeMovers(bool bar, bool ball, bool box) {
  AnimatedScene s;
  const auto named = [&](const char* name) {
    return s.material(TestScene::colored(name, {0.5f, 0.5f, 0.5f, 1}));
  };
  const int clip = s.clip("Move");
  if (bar) {
    std::vector<int> joints;
    std::vector<glm::mat4> binds;
    int parent = s.node({{"name", "Hip"}, {"translation", {-1.2, 0, 0}}});
    for (int k = 0; k < 4; ++k) {
      const float y = -1 + 2 * float(k) / 3;
      parent = s.node({{"translation", {0, k == 0 ? -1.0 : 2.0 / 3, 0}}}, parent);
      joints.push_back(parent);
      binds.push_back(glm::translate(glm::mat4(1.0f), {0, -y, 0}));
      s.channel(clip, parent, "rotation", "LINEAR", {0, 1, 2}, turns({0, 0, 1}, {-25, 25, -25}));
    }
    s.node(
        {{"name", "Bar"}, {"mesh", s.mesh(bendingBar(4), named("Cloth"))}, {"skin", s.skin(joints, binds)}});
  }
  if (ball) {
    AnimatedMesh mesh{sphereMesh({0, 0, 0}, 0.5f, 16), 0, {}, {}, {}, {}};
    mesh.targets = {swelling(mesh.shape, 0.5f, {0, 0.3f, 0})};
    const int node = s.node({{"name", "Ball"}, {"mesh", s.mesh(mesh, named("Skin"))}});
    s.channel(clip, node, "weights", "LINEAR", {0, 1, 2}, {0, 1, 0});
  }
  if (box) {
    const int cart = s.node({{"name", "Cart"}});
    s.node({{"name", "Box"},
            {"mesh",
             s.mesh({boxMesh({-0.3f, -0.3f, -0.3f}, {0.3f, 0.3f, 0.3f}), 0, {}, {}, {}, {}}, named("Wood"))}},
           cart);
    s.channel(clip, cart, "translation", "LINEAR", {0, 1, 2},
              {1.2f, -0.5f, 0, 1.3f, 0.6f, 0, 1.2f, -0.5f, 0});
  }
  return s;
}

class AnimationDrawn : public BothEyes {
 protected:
  static constexpr int kWidth = 96, kHeight = 72;

  static Frame drawAt(const Scene& scene, const Look& look, double time, const std::vector<View>& views,
                      const RenderOptions& options) {
    return drawn(renderer().render(scene, look, time, views, options));
  }

  // Every `step`th pixel against rays.
  static void compare(const Frame& frame, const std::vector<View>& views,
                      const std::vector<WorldTriangle>& triangles, const std::string& what, int step = 1,
                      double leastPart = 0.05) {
    for (size_t v = 0; v < views.size(); ++v) {
      const Image& ids = aov(frame, "id", v);
      const int width = int(ids.width), height = int(ids.height);
      size_t pixels = 0, hits = 0, misplaced = 0, misturned = 0;
      for (int y = step / 2; y < height; y += step)
        for (int x = step / 2; x < width; x += step) {
          ++pixels;
          const auto hit = castRay(pixelRay(views[v], x, y, width, height), triangles);
          const int id = int(texel(ids, x, y).x);
          hits += hit.has_value();
          if (id != (hit ? hit->id : 0)) {
            ++misplaced;
            continue;
          }
          if (!hit) continue;
          const glm::dvec3 position(texel(aov(frame, "position", v), x, y)),
              normal(texel(aov(frame, "normal", v), x, y));
          misplaced += !(glm::length(position - hit->position) < 2e-3 * hit->distance);
          misturned += !(glm::length(normal - hit->normal) < 5e-3);
        }
      EXPECT_GT(double(hits), leastPart * double(pixels)) << what;
      // Only where a ray grazes an edge.
      EXPECT_LE(misplaced, pixels / 150) << what << ", view " << v << ", " << hits << " hits of " << pixels;
      EXPECT_LE(misturned, pixels / 150) << what << ", view " << v << ", " << hits << " hits of " << pixels;
    }
  }

  // A made scene at several times, from the same place.
  static void check(const AnimatedScene& made, const Stand& stand,
                    const std::vector<double>& times = {0.13, 0.9, 1.55}) {
    const Scene scene = made.load();
    ASSERT_FALSE(scene.data().clips.empty());
    const auto views = viewsFrom(scene, stand, kWidth, kHeight, GetParam());
    std::vector<Frame> frames;
    for (const double time : times) {
      frames.push_back(drawAt(scene, quietLook(unheld()), time, views,
                              sized(kWidth, kHeight, {"position", "normal", "id"})));
      compare(frames.back(), views, posedTriangles(scene.data(), firstClipAt(scene, time)),
              "time " + std::to_string(time));
    }
    EXPECT_FALSE(sameBytes(aov(frames[0], "position"), aov(frames.back(), "position"))) << "it stands";
  }

  static TestMesh oddBox() { return boxMesh({-0.5f, -0.3f, -0.8f}, {0.7f, 0.9f, 0.4f}); }
  static AnimatedMesh rigid(TestMesh mesh) { return {std::move(mesh), 0, {}, {}, {}, {}}; }
  static int grey(AnimatedScene& s) { return s.material(TestScene::colored("Grey", {0.5f, 0.5f, 0.5f, 1})); }
};
INSTANTIATE_BOTH_EYES(AnimationDrawn);

TEST_P(AnimationDrawn, rigidNodes) {
  NEEDS_FINE_RASTER();
  AnimatedScene s;
  const int box = s.mesh(rigid(oddBox()), grey(s)), clip = s.clip("Move");
  // One for each interpolation; the second below the first, and mirrored.
  const int first = s.node({{"mesh", box}, {"translation", {-1, 0, 0}}});
  const int second =
      s.node({{"mesh", box}, {"translation", {0, 1.5, 0}}, {"scale", {-0.5, 0.5, 0.5}}}, first);
  const int third = s.node({{"mesh", box}});
  s.channel(clip, first, "rotation", "LINEAR", {0, 0.6f, 2}, turns({1, 2, 0.5f}, {0, 170, 300}));
  s.channel(clip, first, "scale", "LINEAR", {0.2f, 1.7f}, {1, 1, 1, 0.6f, 1.4f, 0.8f});
  s.channel(clip, second, "translation", "STEP", {0, 0.5f, 1.2f},
            {0, 1.5f, 0, 0.5f, 1.2f, 0, -0.4f, 1.3f, 0.2f});
  s.channel(clip, third, "translation", "CUBICSPLINE", {0, 0.7f, 2},
            {0, 0, 0, 1, 0, 0, 1, 2, 0, 0, 1, 0, 1.5f, 0.5f, 0.3f, 1, -1, 0, 2, 0, 0, 1, 0, 0, 0, 0, 0});
  std::vector<float> cubic;
  const std::vector<float> q = turns({0, 1, 1}, {0, 120, 250});
  for (size_t k = 0; k < 3; ++k) {
    cubic.insert(cubic.end(), {0.3f, -0.5f, 0.2f, 0});
    cubic.insert(cubic.end(), &q[4 * k], &q[4 * k] + 4);
    cubic.insert(cubic.end(), {0.1f, 0.4f, 0, -0.2f});
  }
  s.channel(clip, third, "rotation", "CUBICSPLINE", {0, 1, 2}, cubic);
  check(s, {{1, 1.5f, 5}});
}

TEST_P(AnimationDrawn, skins) {
  AnimatedScene s;
  const int material = grey(s), clip = s.clip("Bend");
  for (const int influences : {4, 8}) {
    std::vector<int> joints;
    std::vector<glm::mat4> binds;
    int parent = s.node({{"translation", {influences == 4 ? -0.8 : 0.8, 0, 0}}});
    float height = 0;
    for (int k = 0; k < influences; ++k) {
      const float y = -1 + 2 * float(k) / float(influences - 1);
      parent = s.node({{"translation", {0, y - height, 0}}}, parent);
      height = y;
      joints.push_back(parent);
      // A bind pose that is no mere translation.
      binds.push_back(glm::inverse(glm::scale(glm::translate(glm::mat4(1.0f), {0, y, 0}), {1.1f, 1, 0.9f})));
      const float bend = 100 / float(influences);
      s.channel(clip, parent, "rotation", "LINEAR", {0, 1, 2}, turns({0.3f, 0.2f, 1}, {-bend, bend, -bend}));
      if (k == 1) s.channel(clip, parent, "scale", "LINEAR", {0, 2}, {1, 1, 1, 1.3f, 1, 0.7f});
    }
    // The node's own place does not count.
    s.node({{"mesh", s.mesh(bendingBar(influences), material)},
            {"skin", s.skin(joints, binds)},
            {"translation", {50, 60, 70}}});
  }
  check(s, {{1, 1.5f, 4}});
}

// Joints beyond 255 and beyond 65535 / 64: indices of 16 bits, matrices by the hundred.
TEST_P(AnimationDrawn, manyJoints) {
  AnimatedScene s;
  const int material = grey(s), clip = s.clip("Bend");
  constexpr int kJoints = 700;
  std::vector<int> joints;
  std::vector<glm::mat4> binds;
  for (int k = 0; k < kJoints; ++k) {
    joints.push_back(s.node({{"translation", {0, 0, -0.01 * k}}}));
    binds.emplace_back(1.0f);
    const float y = -1 + 2 * float(k % 350) / 349;
    binds.back()[3] = {0, -y, 0.01f * float(k), 1};
  }
  for (const int k : {255, 256, 257, 258, 690, 691, 692, 693, 694, 695, 696, 697})
    s.channel(clip, joints[size_t(k)], "translation", "LINEAR", {0, 1, 2},
              {0, 0, 0, 0.004f * float(k % 100), -1 + 2 * float(k % 350) / 349, 0.3f, 0, 0, 0});
  const int skin = s.skin(joints, binds);
  s.node({{"mesh", s.mesh(bendingBar(4, 255), material)}, {"skin", skin}});
  s.node({{"mesh", s.mesh(bendingBar(8, 690), material)}, {"skin", skin}});
  check(s, {{1, 1.5f, 6}}, {0.4, 0.95});
}

TEST_P(AnimationDrawn, morphTargets) {
  NEEDS_FINE_RASTER();
  AnimatedScene s;
  const int material = grey(s), clip = s.clip("Swell");
  // Several targets, one of them sparse, one without positions, one without normals; weights of all kinds.
  AnimatedMesh ball = rigid(sphereMesh({0, 0, 0}, 0.7f, 16));
  ball.targets = {swelling(ball.shape, 0.4f, {0, 0.5f, 0.2f}), swelling(ball.shape, -0.2f, {0.4f, 0, 0})};
  ball.targets[0].sparse = true;
  for (size_t v = 0; v < ball.shape.positions.size(); v += 3)
    ball.targets[0].positions[v] = ball.targets[0].normals[v] = glm::vec3(0.0f);
  ball.targets.push_back({{}, ball.targets[1].normals, false});
  ball.targets.push_back({ball.targets[1].positions, {}, true});
  ball.defaultWeights = {0.5f, 0, 0, 0};
  const int mesh = s.mesh(ball, material);
  const int animated = s.node({{"mesh", mesh}, {"translation", {-1, 0, 0}}});
  // One that only its defaults move, and one with weights of its own; both below what turns.
  const int parent = s.node({{"translation", {1, 0, 0}}});
  s.node({{"mesh", mesh}, {"scale", {-0.7, 0.7, 0.5}}}, parent);
  s.node(
      {{"mesh", mesh}, {"translation", {0, 1.4, 0}}, {"scale", {0.5, 0.7, 0.7}}, {"weights", {0, 1, 1, 0.5}}},
      parent);
  s.channel(clip, animated, "weights", "LINEAR", {0, 1, 2}, {0, 0, 0, 0, 1, 0.5f, -1, 1, 0.2f, 2, 0.5f, -1});
  s.channel(clip, parent, "rotation", "LINEAR", {0, 2}, turns({0, 1, 0.3f}, {0, 150}));
  check(s, {{1, 1.5f, 5}});
}

TEST_P(AnimationDrawn, morphedInstances) {
  NEEDS_FINE_RASTER();
  AnimatedScene s;
  const int clip = s.clip("Swell");
  AnimatedMesh ball = rigid(sphereMesh({0, 0, 0}, 0.6f, 16));
  ball.targets = {swelling(ball.shape, 0.4f, {0, 0.5f, 0.2f})};
  const int node = s.node({{"mesh", s.mesh(ball, grey(s))}});
  s.instances(node, {{-1.2f, 0, 0}, {0.2f, 0.4f, -0.4f}, {1.4f, -0.2f, 0}},
              {{1, 1, 1}, {-0.7f, 0.8f, 1}, {0.6f, 1.2f, 0.8f}});
  s.channel(clip, node, "weights", "LINEAR", {0, 1, 2}, {0, 1, 0.3f});
  s.channel(clip, node, "rotation", "LINEAR", {0, 2}, turns({0, 0, 1}, {-20, 60}));
  check(s, {{1, 1.5f, 5}});
}

// All at once, from a camera that moves; two clips that share the pose; and at times before 0 and after the
// clip's end.
TEST_P(AnimationDrawn, theTroupe) {
  AnimatedScene made = troupe();
  const int other = made.clip("Lean");
  // glTF's node 1 is the carried box.
  made.channel(other, 1, "translation", "LINEAR", {0, 3}, {-1, 1.5f, 0.5f, -2, 0, 1});
  made.channel(other, 1, "rotation", "STEP", {0}, turns({1, 0, 0}, {40}));
  const Scene scene = made.load();
  const auto at = [&](double time, const Knobs& knobs) {
    const Look look = quietLook(unheld(knobs));
    const auto views = makeViews(scene, {}, float(kWidth) / kHeight, GetParam(), 0.2f, look, time);
    EXPECT_TRUE(views.ok());
    return std::pair(*views,
                     drawAt(scene, look, time, *views, sized(kWidth, kHeight, {"position", "normal", "id"})));
  };
  for (const double time : {-0.7, 0.45, 3.2}) {
    const auto [views, frame] = at(time, {});
    const Moments moments = firstClipAt(scene, time);
    compare(frame, views, posedTriangles(scene.data(), moments), "time " + std::to_string(time));
    // The camera is where its node is.
    size_t camera = 0;
    while (scene.data().nodes[camera].camera < 0) ++camera;
    const glm::dmat4 world = posedNodes(scene.data(), moments)[camera];
    glm::dvec3 eye(0.0);
    for (const View& view : views)
      eye += glm::dvec3(glm::inverse(glm::dmat4(view.worldToEye))[3]) / double(views.size());
    EXPECT_LT(glm::length(eye - glm::dvec3(world[3])), 1e-4);
  }
  const Knobs mix{{"clips.Play.play.weight", "0.5"},
                  {"clips.Lean.play.weight", "0.25"},
                  {"clips.Lean.play.speed", "-2"},
                  {"clips.Lean.play.start", "2.5"},
                  {"clips.Play.play.repeat", "ping-pong"}};
  const auto [views, frame] = at(2.3, mix);
  // 2.5 - 2 x 2.3 = -2.1, around to 0.9; 2.3 swings back to 1.7.
  compare(frame, views, posedTriangles(scene.data(), {{0, 1.7, 0.5}, {1, 0.9, 0.25}}), "two clips");
}

// A clip whose share goes to nothing leaves the rest pose, and comes back.
TEST_P(AnimationDrawn, fading) {
  const Scene scene = threeMovers(true, true, true).load();
  const Look look = fadingLook("[[0, 1], [1, 0]]");
  const auto views = viewsFrom(scene, {{0, 0, 6}}, kWidth, kHeight, GetParam());
  for (const double time : {0.25, 2.0, 2.0, 0.75, 3.0})
    compare(drawAt(scene, look, time, views, sized(kWidth, kHeight, {"position", "normal", "id"})), views,
            posedTriangles(scene.data(), {{0, std::min(time, 1.0), std::max(1 - time, 0.0)}}),
            "time " + std::to_string(time));
}

// The clips that play by default when files are combined: the first of each.
TEST_P(AnimationDrawn, combinedFiles) {
  AnimatedScene s;
  const int first = s.clip("First"), second = s.clip("Second");
  const int node = s.node({{"mesh", s.mesh(rigid(oddBox()), grey(s))}});
  s.channel(first, node, "translation", "LINEAR", {0, 1, 2}, {0, 0, 0, 1.5f, 0, 0, 0, 0, 0});
  s.channel(second, node, "translation", "LINEAR", {0, 1}, {0, 0, 0, 0, 9, 0});
  AnimatedScene t;
  const int swings = t.clip("Swing"), other = t.node({{"mesh", t.mesh(rigid(oddBox()), grey(t))}});
  t.channel(swings, other, "translation", "LINEAR", {0, 3}, {-2, 0, 0, -1, 1, 0});
  const Scene scene = Scene::combine({s.load(), t.load()});
  const auto views = viewsFrom(scene, {{1, 1.5f, 6}}, kWidth, kHeight, GetParam());
  const Frame frame =
      drawAt(scene, quietLook(unheld()), 0.7, views, sized(kWidth, kHeight, {"position", "normal", "id"}));
  compare(frame, views, posedTriangles(scene.data(), {{0, 0.7}, {2, 0.7}}), "both");
}

// Whether a file has animations at all, without loading its meshes and textures.
bool mayBeAnimated(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  return text.find("\"animations\"") != std::string::npos;
}

TEST_F(AnimationDrawn, everyAnimatedAsset) {
  NEEDS_FINE_RASTER();
  constexpr int kTinyWidth = 64, kTinyHeight = 48;
  size_t files = 0, number = 0;
  for (const auto& file : filesBelow(kAssets, {".gltf", ".glb"})) {
    if (!mayBeAnimated(file)) continue;
    const Result<Scene> scene = Scene::load(file.string());
    if (!scene || scene->data().clips.empty()) continue;
    ++files;
    const scene::SceneData& data = scene->data();
    const size_t clips = data.clips.size(), used = std::min<size_t>(clips, 4);
    for (size_t i = 0; i < used; ++i) {
      const size_t clip = used < 2 ? 0 : i * (clips - 1) / (used - 1);
      const std::string& name = data.clips[clip].name;
      // The first plays by itself; others where they are named.
      Look look = quietLook(unheld());
      Moments moments;
      for (size_t c = 0; c < clips; ++c)
        if (clip == 0 ? c == 0 : data.clips[c].name == name) moments.push_back({c, 0, 1});
      if (clip != 0) {
        ASSERT_TRUE(look.set("clips." + name + ".play.weight", "1").ok()) << file << ", clip " << name;
      }
      Viewpoint viewpoint;
      viewpoint.orbit = true, viewpoint.azimuth = 30, viewpoint.elevation = 15;
      const auto views = makeViews(*scene, viewpoint, float(kTinyWidth) / kTinyHeight,
                                   number++ % 5 == 2 ? Stereo::stereo : Stereo::mono, 0.063f, look);
      ASSERT_TRUE(views.ok()) << file << ": " << views.error().message();
      for (const double part : {0.283, 0.719}) {
        const double time = part * double(data.clips[clip].duration);
        for (ClipMoment& moment : moments) {
          const double length = double(data.clips[moment.clip].duration);
          moment.seconds = length > 0 ? std::fmod(time, length) : 0;
          moment.share = 1.0 / double(moments.size());
        }
        Frame frame;
        ASSERT_NO_THROW(frame = drawAt(*scene, look, time, *views,
                                       sized(kTinyWidth, kTinyHeight, {"position", "normal", "id"})))
            << file;
        compare(frame, *views, posedTriangles(data, moments),
                file.string() + ", clip '" + name + "' at " + std::to_string(time), 3, 0.01);
      }
    }
  }
  if (files == 0) GTEST_SKIP() << "no animated files below " << kAssets;
}

// ---- Poses that stand ----

const std::vector<std::string> kPlaces{"position", "normal", "id", "depth"};

bool samePlaces(const Frame& a, const Frame& b) {
  for (const std::string& name : kPlaces)
    for (size_t v = 0; v < a.layers[0].views.size(); ++v)
      if (!sameBytes(aov(a, name, v), aov(b, name, v))) return false;
  return true;
}

class OnTwos : public AnimationDrawn {
 protected:
  // For how many frames after frame 24 places stand as they were.
  static int standsFor(const Scene& scene, const Knobs& knobs) {
    constexpr int kWidth = 48, kHeight = 36;
    const Look look = quietLook(knobs);
    const auto views = viewsFrom(scene, {{0, 0, 6}}, kWidth, kHeight, GetParam());
    const Frame first = drawAt(scene, look, 1, views, sized(kWidth, kHeight, kPlaces));
    for (int frame = 1; frame < 8; ++frame)
      if (!samePlaces(drawAt(scene, look, (24 + frame) / 24.0, views, sized(kWidth, kHeight, kPlaces)),
                      first))
        return frame;
    return 8;
  }
};
INSTANTIATE_BOTH_EYES(OnTwos);

TEST_P(OnTwos, skinsAndMorphsAreHeld) {
  for (const bool bar : {true, false}) {
    const Scene scene = threeMovers(bar, !bar, false).load();
    const std::string material = bar ? "Cloth" : "Skin", node = bar ? "Hip" : "Ball";
    EXPECT_EQ(standsFor(scene, {}), 2);
    EXPECT_EQ(standsFor(scene, {{"animation.hold", "0"}}), 1);
    EXPECT_EQ(standsFor(scene, {{"animation.hold", "1"}}), 1);
    EXPECT_EQ(standsFor(scene, {{"animation.hold", "4"}}), 4);
    // Frame 24 is in the middle of a drawing of five: 20 to 24.
    EXPECT_EQ(standsFor(scene, {{"animation.hold", "5"}}), 1);
    EXPECT_EQ(standsFor(scene, {{"materials." + material + ".animation.hold", "3"}}), 3);
    EXPECT_EQ(standsFor(scene, {{"nodes." + node + ".animation.hold", "6"}}), 6);
    EXPECT_EQ(standsFor(scene, {{"nodes." + node + ".animation.hold", "4"},
                                {"materials." + material + ".animation.hold", "3"}}),
              4);
    EXPECT_EQ(standsFor(scene, {{"nodes.Nobody.animation.hold", "4"}}), 2);
  }
}

TEST_P(OnTwos, whatIsCarriedIsNotUnlessItIsNamed) {
  const Scene scene = threeMovers(false, false, true).load();
  EXPECT_EQ(standsFor(scene, {}), 1);
  EXPECT_EQ(standsFor(scene, {{"animation.hold", "4"}}), 1);
  EXPECT_EQ(standsFor(scene, {{"nodes.Cart.animation.hold", "4"}}), 4);
  // Its material's name holds the box's own node, which is not what moves.
  EXPECT_EQ(standsFor(scene, {{"nodes.Box.animation.hold", "4"}}), 1);
  EXPECT_EQ(standsFor(scene, {{"materials.Wood.animation.hold", "4"}}), 1);
  // Where the node that moves has the mesh, it does.
  AnimatedScene s;
  const int clip = s.clip("Move"),
            node = s.node(
                {{"name", "Box"},
                 {"mesh", s.mesh(rigid(oddBox()), s.material(TestScene::colored("Wood", {1, 1, 1, 1})))}});
  s.channel(clip, node, "translation", "LINEAR", {0, 1, 2}, {0, -0.5f, 0, 0, 0.5f, 0, 0, -0.5f, 0});
  const Scene one = s.load();
  EXPECT_EQ(standsFor(one, {}), 1);
  EXPECT_EQ(standsFor(one, {{"materials.Wood.animation.hold", "4"}}), 4);
  EXPECT_EQ(standsFor(one, {{"nodes.Box.animation.hold", "3"}, {"materials.Wood.animation.hold", "4"}}), 3);
}

// One scene with holds for each: every thing stands for its own time.
TEST_P(OnTwos, eachForItsOwnTime) {
  const Scene scene = threeMovers(true, true, true).load();
  const Look look = quietLook({{"animation.hold", "1"},
                               {"materials.Cloth.animation.hold", "3"},
                               {"nodes.Ball.animation.hold", "4"},
                               {"light.shadowWarp", "0"}});
  const auto views = viewsFrom(scene, {{0, 0, 6}}, kWidth, kHeight, GetParam());
  const auto node = [&](const std::string& name) {
    size_t n = 0;
    while (scene.data().nodes[n].name != name) ++n;
    return int(n) + 1;
  };
  for (int frame = 24; frame < 30; ++frame) {
    const double time = frame / 24.0;
    const auto every = [&](int hold) {
      const int held = frame - frame % hold;
      return posedTriangles(scene.data(), firstClipAt(scene, held / 24.0));
    };
    std::vector<WorldTriangle> triangles = every(1);
    const auto bar = every(3), ball = every(4);
    for (size_t i = 0; i < triangles.size(); ++i)
      if (triangles[i].id != node("Box")) triangles[i] = triangles[i].id == node("Bar") ? bar[i] : ball[i];
    const Frame got = drawAt(scene, look, time, views, sized(kWidth, kHeight, {"position", "normal", "id"}));
    compare(got, views, triangles, "frame " + std::to_string(frame));
  }
}

TEST_P(OnTwos, theCameraIsNot) {
  AnimatedScene s = threeMovers(true, true, false);
  s.json()["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
  const int eye = s.node({{"camera", 0}, {"translation", {0, 0, 6}}});
  s.channel(0, eye, "translation", "LINEAR", {0, 2}, {0, 0, 6, 1, 1, 6});
  const Scene scene = s.load();
  std::vector<glm::mat4> seen;
  for (int frame = 0; frame < 4; ++frame) {
    const auto views =
        makeViews(scene, {}, 1, GetParam(), 0.063f, quietLook({{"animation.hold", "4"}}), frame / 24.0);
    ASSERT_TRUE(views.ok());
    for (const glm::mat4& before : seen) EXPECT_NE(views->at(0).worldToEye, before);
    seen.push_back(views->at(0).worldToEye);
  }
}

// ---- Motion ----

TEST_P(AnimationDrawn, motion) {
  NEEDS_FINE_RASTER();
  const Scene scene = troupe().load();
  const scene::SceneData& data = scene.data();
  for (const int hold : {0, 2, 4})
    for (const int frame : {13, 14, 16}) {
      const double time = frame / 24.0, before = (frame - 1) / 24.0;
      const Look look = quietLook({{"animation.hold", std::to_string(hold)}, {"light.shadowWarp", "0"}});
      const auto viewsAt = [&](double t) {
        return makeViews(scene, {}, float(kWidth) / kHeight, GetParam(), 0.2f, look, t).value();
      };
      const auto views = viewsAt(time);
      RenderOptions options = sized(kWidth, kHeight, {"id", "motion", "position"});
      options.previousTime = before, options.previousViews = viewsAt(before);
      const Frame got = drawAt(scene, look, time, views, options);
      // What is carried moves at every frame; skins and targets do as they are held.
      const auto trianglesAt = [&](int at) {
        auto triangles = posedTriangles(data, firstClipAt(scene, at / 24.0));
        const auto held = posedTriangles(data, firstClipAt(scene, double(hold ? at / hold * hold : at) / 24));
        for (size_t i = 0; i < triangles.size(); ++i) {
          const scene::Node& node = data.nodes[size_t(triangles[i].id - 1)];
          if (node.skin >= 0 || !data.meshes[size_t(node.mesh)]->morphWeights.empty()) triangles[i] = held[i];
        }
        return triangles;
      };
      const auto now = trianglesAt(frame), then = trianglesAt(frame - 1);
      for (size_t v = 0; v < viewCount(); ++v) {
        std::set<int> ids;
        size_t hits = 0;
        Difference motion(0.03);
        double most = 0;
        for (int y = 0; y < kHeight; ++y)
          for (int x = 0; x < kWidth; ++x) {
            const auto hit = castRay(pixelRay(views[v], x, y, kWidth, kHeight), now);
            if (!hit || texel(aov(got, "id", v), x, y).x != hit->id) continue;
            ++hits;
            ids.insert(hit->id);
            const glm::dvec2 moved = glm::dvec2(x, y) + 0.5 -
                                     pixelOf(options.previousViews[v], placeOn(then, *hit), kWidth, kHeight);
            most = std::max(most, glm::length(moved));
            motion.add(texel(aov(got, "motion", v), x, y).x, moved.x);
            motion.add(texel(aov(got, "motion", v), x, y).y, moved.y);
          }
        EXPECT_GT(hits, 2000u);
        EXPECT_GE(ids.size(), 5u);
        EXPECT_GT(most, 1) << "nothing moves";
        EXPECT_LE(motion.beyond, hits / 100)
            << "frame " << frame << ", held for " << hold << ", view " << v << ": " << motion.text();
      }
    }
}

// A clip whose share changes with time: where things were follows the look of then.
TEST_P(AnimationDrawn, motionUnderALookThatChanges) {
  const Scene scene = threeMovers(true, true, true).load();
  const Look look = fadingLook("[[0, 0], [0.5, 1]]");
  const auto views = viewsFrom(scene, {{0, 0, 6}}, kWidth, kHeight, GetParam());
  const double time = 0.45, before = 0.2;
  RenderOptions options = sized(kWidth, kHeight, {"position", "normal", "id", "motion"});
  options.previousTime = before;
  const Frame frame = drawAt(scene, look, time, views, options);
  const auto now = posedTriangles(scene.data(), {{0, time, 2 * time}}),
             then = posedTriangles(scene.data(), {{0, before, 2 * before}});
  compare(frame, views, now, "now");
  for (size_t v = 0; v < viewCount(); ++v) {
    Difference motion(0.03);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const auto hit = castRay(pixelRay(views[v], x, y, kWidth, kHeight), now);
        if (!hit || texel(aov(frame, "id", v), x, y).x != hit->id) continue;
        const glm::dvec2 moved =
            glm::dvec2(x, y) + 0.5 - pixelOf(views[v], placeOn(then, *hit), kWidth, kHeight);
        motion.add(texel(aov(frame, "motion", v), x, y).x, moved.x);
        motion.add(texel(aov(frame, "motion", v), x, y).y, moved.y);
      }
    EXPECT_GT(motion.count, 1000u);
    EXPECT_LE(motion.beyondPart(), 0.01) << motion.text();
  }
}

// Without a time before, everything stands; and it does where a pose is held and the view stays.
TEST_P(AnimationDrawn, nothingMovesBetweenHeldPoses) {
  NEEDS_FINE_RASTER();
  const Scene scene = threeMovers(true, true, false).load();
  const auto views = viewsFrom(scene, {{0, 0, 6}}, kWidth, kHeight, GetParam());
  RenderOptions options = sized(kWidth, kHeight, {"motion"});
  const auto most = [&](int frame, std::optional<double> before) {
    options.previousTime = before;
    double largest = 0;
    const Frame frames = drawAt(scene, quietLook(), frame / 24.0, views, options);
    for (size_t v = 0; v < viewCount(); ++v)
      for (const float x : aov(frames, "motion", v).pixels) largest = std::max(largest, std::abs(double(x)));
    return largest;
  };
  EXPECT_LT(most(11, {}), 4e-3);
  EXPECT_LT(most(11, 10 / 24.0), 4e-3);
  EXPECT_GT(most(12, 11 / 24.0), 0.5);
  EXPECT_LT(most(13, 12 / 24.0), 4e-3);
  EXPECT_GT(most(13, 11 / 24.0), 0.5);
}

// ---- Frames do not remember ----

class Purity : public AnimationDrawn {
 protected:
  // A whole frame's arguments; the same number gives the same frame.
  struct Call {
    const Scene* scene;
    double time;
    RenderOptions options;
    std::vector<View> views, previous;
    Look look;
  };
  static Call call(const Scene& scene, double time, std::vector<std::string> aovs, uint32_t width = 64,
                   const Knobs& knobs = {}) {
    Call c{&scene, time, sized(width, 48, std::move(aovs)), {}, {}, quietLook(knobs)};
    const auto viewsAt = [&](double t) {
      return makeViews(scene, {}, float(width) / 48, GetParam(), 0.1f, c.look, t).value();
    };
    c.views = viewsAt(time);
    c.options.previousTime = time - 1 / 24.0, c.options.previousViews = viewsAt(time - 1 / 24.0);
    return c;
  }
  // All but the shadow map, which is large.
  static std::vector<std::string> allAovs() {
    std::vector<std::string> names = Renderer::aovNames();
    std::erase(names, "shadow-map");
    return names;
  }
  static Frame render(const Call& c) {
    return drawn(renderer().render(*c.scene, c.look, c.time, c.views, c.options));
  }
  static Status begin(const Call& c) {
    return renderer().begin(*c.scene, c.look, c.time, c.views, c.options);
  }
  static Frame finish() { return drawn(renderer().finish()); }
  void TearDown() override {
    while (renderer().finish()) ADD_FAILURE() << "a frame was left under way";
    AnimationDrawn::TearDown();
  }
};
INSTANTIATE_BOTH_EYES(Purity);

TEST_P(Purity, anyOrderAloneOrInSequence) {
  const Scene scene = troupe().load(), other = threeMovers(true, true, true).load();
  std::vector<Call> calls;
  for (const double time : {0.0, 1 / 24.0, 2 / 24.0, 3 / 24.0, 1.0, -0.6})
    calls.push_back(call(scene, time, allAovs()));
  std::vector<Frame> sequence;
  for (const Call& c : calls) sequence.push_back(render(c));
  EXPECT_FALSE(sameBytes(aov(sequence[0], "position"), aov(sequence[4], "position")));
  // Backwards, with jumps, and twice the same.
  for (const size_t i : {5u, 3u, 2u, 2u, 4u, 1u, 0u, 4u, 3u})
    expectSame(render(calls[i]), sequence[i], "in another order, frame " + std::to_string(i));
  // Alternating with another scene.
  const Call elsewhere = call(other, 0.4, allAovs());
  const Frame theirs = render(elsewhere);
  for (const size_t i : {1u, 4u}) {
    expectSame(render(calls[i]), sequence[i], "after another scene, frame " + std::to_string(i));
    expectSame(render(elsewhere), theirs, "the other scene");
  }
}

// Facts, and with them the positions of a frame ago, come and go; so do size and look.
TEST_P(Purity, afterOtherConfigurations) {
  const Scene scene = troupe().load();
  const Call facts = call(scene, 14 / 24.0, {"motion", "position", "shadow"}),
             plain = call(scene, 0.75, {"shadow"}), wide = call(scene, 0.9, {"motion", "shadow"}, 96),
             onFours = call(scene, 14 / 24.0, {"motion", "position", "shadow"}, 64,
                            {{"animation.hold", "4"}, {"nodes.Carried.animation.hold", "4"}}),
             slow = call(scene, 14 / 24.0, {"motion", "position", "shadow"}, 64,
                         {{"clips.Play.play.weight", "0.5"}}),
             still = call(scene, 14 / 24.0, {"motion", "position", "shadow"}, 64,
                          {{"clips.Play.play.weight", "0"}});
  const std::vector<const Call*> all{&facts, &plain, &wide, &onFours, &slow, &still};
  std::vector<Frame> first;
  for (const Call* c : all) first.push_back(render(*c));
  EXPECT_FALSE(sameBytes(aov(first[0], "position"), aov(first[3], "position")));
  EXPECT_FALSE(sameBytes(aov(first[0], "position"), aov(first[5], "position")));
  for (const size_t i : {1u, 0u, 2u, 1u, 2u, 0u, 3u, 0u, 5u, 4u, 5u, 0u, 3u})
    expectSame(render(*all[i]), first[i], "configuration " + std::to_string(i));
}

TEST_P(Purity, severalFramesUnderWay) {
  const Scene scene = troupe().load(), other = threeMovers(true, true, true).load();
  std::vector<Call> calls;
  for (int frame = 0; frame < 6; ++frame) calls.push_back(call(scene, frame / 24.0, allAovs()));
  // While frames are under way: another size, other AOVs, another scene, and back.
  calls.push_back(call(scene, 0.7, {"motion"}, 96));
  calls.push_back(call(scene, 0.8, {}, 96));
  calls.push_back(call(other, 0.3, {"position", "motion"}));
  calls.push_back(call(other, 0.4, {"position", "motion"}));
  calls.push_back(call(scene, 0.5, Renderer::aovNames()));
  std::vector<Frame> alone;
  for (const Call& c : calls) alone.push_back(render(c));
  std::vector<Frame> pipelined;
  for (size_t i = 0; i < calls.size(); ++i) {
    if (i >= size_t(Renderer::kMaxBegun)) pipelined.push_back(finish());
    const Status begun = begin(calls[i]);
    ASSERT_TRUE(begun.ok()) << begun.error().message();
  }
  while (pipelined.size() < calls.size()) pipelined.push_back(finish());
  for (size_t i = 0; i < calls.size(); ++i)
    expectSame(pipelined[i], alone[i], "begun, frame " + std::to_string(i));
}

TEST_P(Purity, callsInTheWrongOrderAreRefused) {
  const Scene scene = threeMovers(true, false, false).load();
  const Call one = call(scene, 0.2, {"position"}), two = call(scene, 0.7, {"position"});
  const Frame first = render(one), second = render(two);
  const auto expectUsage = [](const auto& result, const char* what) {
    ASSERT_FALSE(result.ok()) << what;
    EXPECT_EQ(result.error().kind, ErrorKind::usage) << what;
    EXPECT_FALSE(result.error().problem.empty() || result.error().advice.empty()) << what;
  };
  expectUsage(renderer().finish(), "finish without begin");
  ASSERT_TRUE(begin(one).ok());
  expectUsage(renderer().render(scene, Look(), 0, one.views, one.options),
              "render while a frame is under way");
  ASSERT_TRUE(begin(two).ok());
  for (int i = 2; i < Renderer::kMaxBegun; ++i) ASSERT_TRUE(begin(two).ok());
  expectUsage(begin(one), "one begin more");
  // Nothing of that hurts the frames under way, nor does a call with options that make no sense.
  expectSame(finish(), first, "the first");
  Call broken = one;
  broken.options.samples = 3;
  expectUsage(begin(broken), "three samples");
  broken = one, broken.options.previousTime = NAN;
  expectUsage(begin(broken), "no time before");
  for (int i = 1; i < Renderer::kMaxBegun; ++i) expectSame(finish(), second, "a later one");
  expectUsage(renderer().finish(), "finish once more");
  expectSame(render(one), first, "afterwards");
}

// ---- Bounds ----

// Something that a clip carries forty metres away: as a node, by a joint, by a morph target.
AnimatedScene farTraveller(int kind) {
  AnimatedScene s;
  const int material = s.material(TestScene::colored("Grey", {0.5f, 0.5f, 0.5f, 1})), clip = s.clip("Go");
  s.node({{"name", "Post"},
          {"mesh", s.mesh({boxMesh({-0.2f, 0, -0.2f}, {0.2f, 1, 0.2f}), 0, {}, {}, {}, {}}, material)}});
  AnimatedMesh box{boxMesh({-0.8f, 0.2f, -0.8f}, {0.8f, 2, 0.8f}), 0, {}, {}, {}, {}};
  const std::vector<float> times{0, 0.2f, 1.8f, 2}, places{0, 0, 0, 40, 0, 5, 40, 0, 5, 0, 0, 0};
  if (kind == 0) {
    const int node = s.node({{"mesh", s.mesh(box, material)}});
    s.channel(clip, node, "translation", "LINEAR", times, places);
  } else if (kind == 1) {
    box.influences = 4;
    for (size_t v = 0; v < box.shape.positions.size(); ++v) {
      box.joints.insert(box.joints.end(), {0, 0, 0, 0});
      box.weights.insert(box.weights.end(), {1, 0, 0, 0});
    }
    const int joint = s.node(Json::object());
    s.node({{"mesh", s.mesh(box, material)}, {"skin", s.skin({joint}, {glm::mat4(1.0f)})}});
    s.channel(clip, joint, "translation", "LINEAR", times, places);
  } else {
    box.targets.push_back({std::vector<glm::vec3>(box.shape.positions.size(), {40, 0, 5}), {}, false});
    const int node = s.node({{"mesh", s.mesh(box, material)}});
    s.channel(clip, node, "weights", "LINEAR", times, {0, 1, 1, 0});
  }
  const glm::quat q = glm::angleAxis(glm::radians(30.0f), glm::vec3(0, 1, 0)) *
                      glm::angleAxis(glm::radians(-50.0f), glm::vec3(1, 0, 0));
  s.json()["extensionsUsed"].push_back("KHR_lights_punctual");
  s.json()["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({{{"type", "directional"}}});
  s.node({{"rotation", {q.x, q.y, q.z, q.w}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  return s;
}

TEST_P(AnimationDrawn, shadowsGoWithWhatMoves) {
  for (int kind = 0; kind < 3; ++kind) {
    const Scene scene = farTraveller(kind).load();
    const auto views = viewsFrom(scene, {{37, 7, -6}, {39.5f, 0.5f, 4}}, kWidth, kHeight, GetParam());
    const Frame frame = drawAt(scene, quietLook({{"ground.mode", "on"}}), 1, views,
                               sized(kWidth, kHeight, {"position", "id", "shadow"}));
    const auto triangles = posedTriangles(scene.data(), firstClipAt(scene, 1));
    const glm::dvec3 toLight(posedNodes(scene.data(), {}).back()[2]);
    const int ground = int(scene.data().nodes.size()) + 1;
    for (size_t v = 0; v < viewCount(); ++v) {
      size_t dark = 0, lit = 0, wrong = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          if (int(texel(aov(frame, "id", v), x, y).x) != ground) continue;
          const glm::dvec3 position(texel(aov(frame, "position", v), x, y));
          const bool shadowed = castRay({position, glm::normalize(toLight)}, triangles, true).has_value();
          (shadowed ? dark : lit) += 1;
          wrong += (texel(aov(frame, "shadow", v), x, y).x < 0.5) != shadowed;
        }
      EXPECT_GT(dark, 100u) << kind;
      EXPECT_GT(lit, 1000u) << kind;
      EXPECT_LT(wrong, dark / 4) << "kind " << kind << ", of " << dark << " dark and " << lit << " lit";
    }
  }
}

// The map covers what things reach at any time, so that its texels stay where they are: what is carried away
// is as large in it as before.
TEST_F(AnimationDrawn, theShadowMapStandsStill) {
  const Scene scene = farTraveller(0).load();
  const auto views = viewsFrom(scene, {{37, 7, -6}, {39.5f, 0.5f, 4}}, 16, 12);
  size_t covered[2];
  for (const int time : {0, 1}) {
    const Frame frame =
        drawAt(scene, quietLook({{"light.shadowWarp", "0"}}), time, views, sized(16, 12, {"shadow-map"}));
    covered[time] = 0;
    for (const float depth : aov(frame, "shadow-map").pixels) covered[time] += depth < 1;
  }
  EXPECT_GT(covered[0], 100u);
  EXPECT_LE(covered[0], covered[1]) << "the box hides the post";
  EXPECT_GT(2 * covered[0], covered[1]);
}

// What the default view frames holds a character at every time of its clip.
void expectFramed(const Scene& scene, size_t clip, const Look& look, const std::string& what) {
  constexpr int kSize = 100;
  const auto views = makeViews(scene, {}, 1, Stereo::mono, 0.063f, look);
  ASSERT_TRUE(views.ok());
  double largest = 0;
  for (int i = 0; i < 17; ++i) {
    const double time = double(scene.data().clips[clip].duration) * (i + 0.31) / 17;
    for (const WorldTriangle& t : posedTriangles(scene.data(), {{clip, time}}))
      for (const glm::dvec3& position : t.positions) {
        const glm::dvec2 pixel = pixelOf(views->at(0), position, kSize, kSize);
        const double out = std::max(std::abs(pixel.x - 0.5 * kSize), std::abs(pixel.y - 0.5 * kSize));
        largest = std::max(largest, out);
      }
  }
  EXPECT_LT(largest, kSize / 2 - 1) << what << " leaves the picture";
  EXPECT_GT(largest, kSize / 4) << what << " is small in the picture";
}

TEST(AnimationFraming, farTravellers) {
  for (int kind = 0; kind < 3; ++kind)
    expectFramed(farTraveller(kind).load(), 0, Look(), "traveller " + std::to_string(kind));
}

TEST(AnimationFraming, characters) {
  size_t found = 0;
  for (const char* name :
       {"gltf/characters/m2m-fox-animations.glb", "gltf/characters/q-Bee.glb",
        "gltf/khronos/CesiumMan/glTF-Binary/CesiumMan.glb", "gltf/props/sketchbook-boxman.glb"}) {
    if (!std::filesystem::exists(kAssets / name)) continue;
    ++found;
    const Result<Scene> scene = Scene::load((kAssets / name).string());
    ASSERT_TRUE(scene.ok());
    const size_t clips = scene->data().clips.size();
    for (const size_t clip : std::set<size_t>{0, clips / 3, clips - 1}) {
      Look look;
      ASSERT_TRUE(look.set("clips." + scene->data().clips[clip].name + ".play.weight", "1").ok());
      expectFramed(*scene, clip, look, std::string(name) + ", clip " + scene->data().clips[clip].name);
    }
  }
  if (found == 0) GTEST_SKIP() << "no characters below " << kAssets;
}

}  // namespace
}  // namespace scumble
