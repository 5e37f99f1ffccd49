// What rides the ocean's waves, besides plain meshes: cameras, lights, skins; what a scene itself says of its
// ocean and of what floats; and how riding ends towards the horizon.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "features/ocean/ocean.h"
#include "scene/scene_data.h"
#include "scumble/view.h"
#include "tests/support/animated_scene.h"
#include "tests/support/aov.h"
#include "tests/support/render_test.h"
#include "tests/support/test_device.h"

namespace scumble {
namespace {

using namespace test;

constexpr int kAfloatWidth = 64, kAfloatHeight = 48;

const Knobs kStorm{{"ocean.mode", "on"}, {"ocean.wind", "16"}, {"ocean.tiles", "1"}, {"ocean.grid", "40"}};

Look stormy(const Knobs& more = {}) {
  Knobs knobs = kStorm;
  knobs.insert(knobs.end(), more.begin(), more.end());
  return quietLook(knobs);
}

int idOf(const Scene& scene, const std::string& name) {
  const std::vector<scene::Node>& nodes = scene.data().nodes;
  for (size_t n = 0; n < nodes.size(); ++n)
    if (nodes[n].name == name) return int(n) + 1;
  throw std::runtime_error("no node " + name);
}

// A boat, high above it a box on its mast; a camera hangs on the boat that looks at the box.
AnimatedScene boatWithCamera(const Json& boatExtras = Json::object()) {
  AnimatedScene s;
  const int box = s.mesh({boxMesh({-0.6f, -0.4f, -0.3f}, {0.6f, 0.4f, 0.3f}), 0, {}, {}, {}, {}},
                         s.material(TestScene::colored("Wood", {0.5f, 0.4f, 0.3f, 1})));
  Json boat{{"name", "Boat"}, {"mesh", box}, {"translation", {1.5, 0, -1}}};
  if (!boatExtras.empty()) boat["extras"] = boatExtras;
  const int node = s.node(boat);
  s.node({{"name", "Lamp"}, {"mesh", box}, {"translation", {0, 6, 0}}}, node);
  s.json()["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.9}, {"znear", 0.1}}}}};
  s.node({{"name", "Eye"}, {"camera", 0}, {"translation", {0.3, 6.2, 4}}}, node);
  return s;
}

class Afloat : public BothEyes {
 protected:
  static std::vector<View> camera(const Scene& scene, const Look& look, double time) {
    Result<std::vector<View>> views = makeViews(
        scene, Viewpoint{.camera = "0"}, float(kAfloatWidth) / kAfloatHeight, GetParam(), 0.2f, look, time);
    if (!views) throw std::runtime_error(views.error().message());
    return *views;
  }
  static Frame drawFrom(const Scene& scene, const Look& look, double time, const std::vector<View>& views,
                        const RenderOptions& options) {
    Result<Frame> frame = renderer().render(scene, look, time, views, options);
    if (!frame) throw std::runtime_error(frame.error().message());
    return std::move(frame).value();
  }
  // From aside, with positions and ids.
  static Frame aside(const Scene& scene, const Look& look, double time = 2.3) {
    return drawFrom(scene, look, time,
                    viewsFrom(scene, {{6, 9, 9}, {1, 2, 0}}, kAfloatWidth, kAfloatHeight, GetParam()),
                    sized(kAfloatWidth, kAfloatHeight, {"position", "id"}));
  }
  static void expectSame(const Frame& a, const Frame& b, const std::string& what) {
    for (size_t v = 0; v < viewCount(); ++v)
      for (const char* name : {"", "id", "position"})
        EXPECT_TRUE(sameBytes(aov(a, name, v), aov(b, name, v))) << what << ", '" << name << "'";
  }
  static void expectOther(const Frame& a, const Frame& b, const std::string& what) {
    EXPECT_FALSE(sameBytes(aov(a, "position"), aov(b, "position"))) << what;
  }
};
INSTANTIATE_BOTH_EYES(Afloat);

// ---- Cameras and lights ----

TEST_P(Afloat, aCameraOnABoatSeesTheBoatStandAndTheHorizonMove) {
  NEEDS_FINE_RASTER();
  const Scene scene = boatWithCamera().load();
  const int lamp = idOf(scene, "Lamp"), ocean = int(scene.data().nodes.size()) + 2;
  const Look rides = stormy({{"nodes.Boat.float.rides", "on"}, {"ocean.speed", "2"}}),
             stands = stormy({{"nodes.Lamp.float.rides", "on"}, {"ocean.speed", "2"}});
  const auto mask = [](const Frame& frame, int id, size_t v) {
    std::vector<bool> covered;
    for (const float x : aov(frame, "id", v).pixels) covered.push_back(int(x) == id);
    return covered;
  };
  const auto apart = [](const std::vector<bool>& a, const std::vector<bool>& b) {
    size_t count = 0;
    for (size_t i = 0; i < a.size(); ++i) count += a[i] != b[i];
    return count;
  };
  const auto drawn = [&](const Look& look, double time) {
    RenderOptions options = sized(kAfloatWidth, kAfloatHeight, {"id", "motion"});
    options.previousTime = time - 0.25;
    options.previousViews = camera(scene, look, *options.previousTime);
    return drawFrom(scene, look, time, camera(scene, look, time), options);
  };
  const Frame first = drawn(rides, 0.4), standsFirst = drawn(stands, 0.4);
  size_t horizon = 0, standing = 0;
  for (const double time : {3.1, 6.7, 11.9}) {
    const Frame later = drawn(rides, time), standsLater = drawn(stands, time);
    for (size_t v = 0; v < viewCount(); ++v) {
      const std::vector<bool> seen = mask(later, lamp, v);
      EXPECT_GT(std::count(seen.begin(), seen.end(), true), 100);
      EXPECT_LE(apart(seen, mask(first, lamp, v)), 3u) << time;
      horizon = std::max(horizon, apart(mask(later, ocean, v), mask(first, ocean, v)));
      standing = std::max(standing, apart(mask(standsLater, lamp, v), mask(standsFirst, lamp, v)));
      double boat = 0, water = 0;
      for (int y = 0; y < kAfloatHeight; ++y)
        for (int x = 0; x < kAfloatWidth; ++x) {
          const int id = int(texel(aov(later, "id", v), x, y).x);
          const double moved = glm::length(glm::dvec2(texel(aov(later, "motion", v), x, y)));
          if (id == lamp) boat = std::max(boat, moved);
          if (id == ocean) water = std::max(water, moved);
        }
      EXPECT_LT(boat, 0.02) << time;
      EXPECT_GT(water, 0.3) << time;
    }
  }
  EXPECT_GT(horizon, 40u);
  // Without its boat the camera stands, and sees what rides go up and down.
  EXPECT_GT(standing, 40u);
}

// A level one goes up and down with it, and the horizon stays straight and where it is.
TEST_P(Afloat, aLevelViewOnABoatKeepsTheHorizon) {
  const Scene scene = boatWithCamera().load();
  const int ocean = int(scene.data().nodes.size()) + 2;
  const Look rides = stormy({{"nodes.Boat.float.rides", "on"}, {"ocean.speed", "2"}});
  // By column, the highest row of the sea; how far apart they are over times.
  const auto swing = [&](bool isLevel) {
    std::vector<int> least(kAfloatWidth, kAfloatHeight), most(kAfloatWidth, 0);
    for (const double time : {0.4, 3.1, 6.7}) {
      std::vector<View> views = camera(scene, rides, time);
      for (View& view : views) {
        view.isLevel = isLevel;
        // Straight ahead, from high above the waves.
        view.worldToEye = glm::inverse(glm::translate(glm::mat4(1), {0, 60, 0}));
      }
      const Frame frame = drawFrom(scene, rides, time, views, sized(kAfloatWidth, kAfloatHeight, {"id"}));
      for (int x = 0; x < kAfloatWidth; ++x)
        for (int y = 0; y < kAfloatHeight; ++y)
          if (int(texel(aov(frame, "id"), x, y).x) == ocean) {
            least[size_t(x)] = std::min(least[size_t(x)], y), most[size_t(x)] = std::max(most[size_t(x)], y);
            break;
          }
    }
    int apart = 0;
    for (size_t x = 0; x < least.size(); ++x) apart = std::max(apart, most[x] - least[x]);
    return apart;
  };
  EXPECT_LE(swing(true), 1);
  EXPECT_GT(swing(false), 4);
}

TEST_F(Afloat, aViewNamesTheNodeThatItHangsOn) {
  const Scene scene = boatWithCamera().load();
  const auto nodeOf = [&](const Viewpoint& viewpoint) {
    const Result<std::vector<View>> views = makeViews(scene, viewpoint, 1, Stereo::stereo);
    EXPECT_TRUE(views.ok());
    EXPECT_EQ((*views)[0].node, (*views)[1].node);
    return (*views)[0].node;
  };
  EXPECT_EQ(nodeOf({.camera = "0"}), idOf(scene, "Eye") - 1);
  EXPECT_EQ(nodeOf({}), idOf(scene, "Eye") - 1);
  EXPECT_EQ(nodeOf({.orbit = true}), -1);
  EXPECT_EQ(nodeOf({.eye = glm::vec3(3)}), -1);
  // A view of another scene.
  View view;
  view.eyeToClip = perspectiveProjection(1, 1, 0.1f);
  view.node = 4;
  const Result<Frame> frame = renderer().render(scene, Look(), 0, {view}, sized(8, 8));
  ASSERT_FALSE(frame.ok());
  EXPECT_EQ(frame.error().kind, ErrorKind::usage);
}

// A lantern before a wall in the dark: the higher the waves lift it, the higher is what it lights.
TEST_P(Afloat, aLightRides) {
  AnimatedScene s;
  const int wall = s.mesh({gridMesh({-3, 2, 0}, {6, 0, 0}, {0, 8, 0}), 0, {}, {}, {}, {}},
                          s.material(TestScene::colored("Wall", {0.6f, 0.6f, 0.6f, 1})));
  s.node({{"name", "Wall"}, {"mesh", wall}});
  s.json()["extensionsUsed"] = {"KHR_lights_punctual"};
  s.json()["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 2}},
                                                             {{"type", "directional"}}};
  const Json light{{"KHR_lights_punctual", {{"light", 0}}}}, sun{{"KHR_lights_punctual", {{"light", 1}}}};
  s.node({{"name", "Raft"}});
  s.node({{"name", "Lantern"}, {"translation", {0, 6, 0.8}}, {"extensions", light}}, 1);
  // From behind the wall.
  s.node({{"name", "Sun"}, {"rotation", {0, 1, 0, 0}}, {"extensions", sun}});
  const Scene scene = s.load();
  const auto middleOfLight = [&](const char* rides, double time) {
    const Look look = stormy({{"nodes.Raft.float.rides", rides},
                              {"light.punctualUnit", "candela"},
                              {"light.terminatorSharpness", "64"},
                              {"shadowMap.cast", "off"},
                              {"warp.amount", "0"}});
    const Frame frame = drawFrom(
        scene, look, time, viewsFrom(scene, {{0, 6, 12}, {0, 6, 0}}, kAfloatWidth, kAfloatHeight, GetParam()),
        sized(kAfloatWidth, kAfloatHeight, {"position", "id", "shadow"}));
    double sum = 0, weight = 0;
    for (int y = 0; y < kAfloatHeight; ++y)
      for (int x = 0; x < kAfloatWidth; ++x) {
        if (int(texel(aov(frame, "id"), x, y).x) != 1) continue;
        const double lit = texel(aov(frame, "shadow"), x, y).x;
        sum += lit * texel(aov(frame, "position"), x, y).y, weight += lit;
      }
    EXPECT_GT(weight, 1);
    return sum / weight;
  };
  double low = 1e9, high = -1e9;
  for (const double time : {0.0, 3.0, 6.0, 9.0}) {
    const double middle = middleOfLight("on", time);
    low = std::min(low, middle), high = std::max(high, middle);
  }
  EXPECT_GT(high - low, 0.05);
  EXPECT_NEAR(middleOfLight("off", 0), middleOfLight("off", 3), 1e-6);
}

// ---- Skins ----

// A skin goes with its joints, as in glTF: the node that they hang on is the one to name.
TEST_P(Afloat, aSkinRidesWithItsJoints) {
  NEEDS_FINE_RASTER();
  const AnimatedMesh bar = bendingBar(4);
  const auto barOn = [&](bool isSkinned) {
    AnimatedScene s;
    const int material = s.material(TestScene::colored("Red", {0.7f, 0.1f, 0.1f, 1}));
    const int root = s.node({{"name", "Boat"}, {"translation", {0.5, 5, 0}}});
    if (!isSkinned) {
      s.node({{"name", "Bar"}, {"mesh", s.mesh({bar.shape, 0, {}, {}, {}, {}}, material)}}, root);
      return s.load();
    }
    std::vector<int> joints;
    std::vector<glm::mat4> binds;
    for (int k = 0; k < 4; ++k) {
      const float y = -1 + 2 * float(k) / 3;
      joints.push_back(s.node({{"translation", {0, y, 0}}}, root));
      binds.push_back(glm::translate(glm::mat4(1.0f), glm::vec3(0, -y, 0)));
    }
    s.node({{"name", "Bar"}, {"mesh", s.mesh(bar, material)}, {"skin", s.skin(joints, binds)}});
    return s.load();
  };
  const Scene plain = barOn(false), skinned = barOn(true);
  const auto seen = [&](const Scene& scene, const Knobs& knobs) {
    return drawFrom(scene, stormy(knobs), 2.3,
                    viewsFrom(scene, {{0.5f, 7, 9}, {0.5f, 5, 0}}, kAfloatWidth, kAfloatHeight, GetParam()),
                    sized(kAfloatWidth, kAfloatHeight, {"position", "id"}));
  };
  const Knobs boat{{"nodes.Boat.float.rides", "on"}};
  const Frame rides = seen(skinned, boat), expected = seen(plain, boat), still = seen(skinned, {});
  for (size_t v = 0; v < viewCount(); ++v) {
    Difference along(1e-3), from(0.02);
    for (int y = 0; y < kAfloatHeight; ++y)
      for (int x = 0; x < kAfloatWidth; ++x) {
        const auto isBar = [&](const Frame& frame, const Scene& scene) {
          return int(texel(aov(frame, "id", v), x, y).x) == idOf(scene, "Bar");
        };
        if (!isBar(rides, skinned)) continue;
        const glm::dvec4 at = texel(aov(rides, "position", v), x, y);
        if (isBar(expected, plain))
          along.add(glm::length(at - texel(aov(expected, "position", v), x, y)), 0.0);
        from.add(glm::length(at - texel(aov(still, "position", v), x, y)), 0.0);
      }
    EXPECT_GT(along.count, 40u);
    EXPECT_LE(along.beyond, 2u) << along.text();
    EXPECT_GT(from.beyond, 8u) << from.text();
  }
  expectSame(seen(skinned, {{"nodes.Bar.float.rides", "on"}}), still, "a skinned mesh's own node");
}

// ---- What the scene says ----

TEST_P(Afloat, extrasOfANodeMakeItFloat) {
  const Scene plain = boatWithCamera().load();
  const auto with = [&](const Json& floats) { return boatWithCamera({{"scumble_float", floats}}).load(); };
  const Frame still = aside(plain, stormy()),
              rides = aside(plain, stormy({{"nodes.Boat.float.rides", "on"}})),
              wide = aside(plain, stormy({{"nodes.Boat.float.rides", "on"},
                                          {"nodes.Boat.float.length", "4.6"},
                                          {"nodes.Boat.float.beam", "9"},
                                          {"nodes.Boat.float.bow", "z"}}));
  expectOther(still, rides, "riding");
  expectOther(rides, wide, "its size");
  expectSame(aside(with(true), stormy()), rides, "true");
  expectSame(aside(with(1), stormy()), rides, "1");
  expectSame(aside(with(Json::object()), stormy()), rides, "nothing more");
  expectSame(aside(with(false), stormy()), still, "false");
  const Json all{{"length", 4.6}, {"beam", 9}, {"bow", "z"}};
  const Scene tagged = with(all);
  expectSame(aside(tagged, stormy()), wide, "all");
  // The look wins, value by value.
  expectSame(aside(tagged, stormy({{"nodes.Boat.float.rides", "off"}})), still, "the look says no");
  expectSame(
      aside(with({{"length", 700}, {"beam", 9}, {"bow", "z"}}), stormy({{"nodes.B*.float.length", "4.6"}})),
      wide, "the look's length");
  expectSame(aside(with({{"length", 4.6}, {"bow", "z"}}), stormy({{"nodes.Boat.float.beam", "9"}})), wide,
             "the look's beam");
}

TEST_P(Afloat, extrasOfANodeMakeItTheOcean) {
  const auto harbour = [](const std::string& name, const Json& extras) {
    AnimatedScene s = boatWithCamera();
    Json water{{"name", name}, {"mesh", 0}, {"translation", {0.25, 0.5, -0.75}}};
    if (!extras.is_null()) water["extras"] = extras;
    s.node(water);
    return s.load();
  };
  const auto drawn = [&](const Scene& scene) { return aside(scene, stormy({{"ocean.mode", "auto"}})); };
  const Frame named = drawn(harbour("Ocean", nullptr)), plate = drawn(harbour("Plate", nullptr));
  expectOther(named, plate, "an ocean");
  expectSame(drawn(harbour("Plate", {{"scumble_ocean", true}})), named, "true");
  expectSame(drawn(harbour("Plate", {{"scumble_ocean", 1}})), named, "1");
  expectSame(drawn(harbour("Plate", {{"scumble_ocean", false}})), plate, "false");
  expectSame(drawn(harbour("Ocean", {{"scumble_ocean", false}})), plate, "false, in spite of its name");
}

// ---- Towards the horizon ----

TEST(AfloatFar, ridingEndsWithoutAStep) {
  gpu::DeviceOptions options;
  options.choice = testDevice();
  const std::unique_ptr<gpu::Device> device = std::move(gpu::Device::create(options)).value();
  ocean::OceanShape shape;
  shape.isThere = true;
  shape.origin = {3, 1, -2};
  const scene::SceneData none;
  ocean::OceanWaves waves(*device, none, shape);
  waves.pose(quietLook({{"ocean.wind", "20"}}).data().at(0), 2.5, [](double) { return glm::dvec2(4, 9); });
  ocean::FloatParams params;
  const auto riding = [&](float away) {
    return waves.riding(params, glm::translate(glm::mat4(1.0f), shape.origin + glm::vec3(away, 0, 0)));
  };
  const auto apart = [](const glm::mat4& a, const glm::mat4& b, const glm::vec3& at) {
    return glm::length(glm::vec3((a - b) * glm::vec4(at, 1)));
  };
  // From a centimetre to the next, where waves are whole, where they fade, and beyond: water is no steeper
  // than one to one.
  float most = 0, mostBefore = 0;
  for (float away = 60; away < 130; away += 0.01f) {
    const glm::vec3 at = shape.origin + glm::vec3(away, 0, 0);
    const float step = apart(riding(away + 0.01f), riding(away), at);
    (away < shape.fadeStart() - 1 ? mostBefore : most) =
        std::max(away < shape.fadeStart() - 1 ? mostBefore : most, step);
  }
  EXPECT_LT(most, 0.02f);
  EXPECT_LT(mostBefore, 0.02f);
  EXPECT_GT(most, 1e-5f);
  // At the zone's edges: as high as the water, and at rest.
  const float start = shape.fadeStart(), end = shape.falseHorizon;
  const glm::dvec2 place = waves.onField(shape.origin + glm::vec3(start, 0, 0));
  const float height =
      ocean::floatingAt(waves.field(), place.x, place.y, double(params.length), double(params.beam), 0)
          .height;
  const glm::vec3 at = shape.origin + glm::vec3(start, 0, 0);
  EXPECT_NEAR((riding(start) * glm::vec4(at, 1)).y - at.y, height, 1e-4f);
  EXPECT_GT(std::abs(height), 1e-3f);
  EXPECT_EQ(riding(end), glm::mat4(1.0f));
  EXPECT_EQ(riding(end + 1000), glm::mat4(1.0f));
}

}  // namespace
}  // namespace scumble
