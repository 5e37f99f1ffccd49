// Scenes far from (0, 0, 0), as georeferenced ones are, look as they do near it.
#include <algorithm>
#include <cmath>

#include "scumble/placement.h"
#include "scumble/scene_editor.h"
#include "tests/support/aov.h"
#include "tests/support/render_test.h"

namespace scumble {
namespace {

using namespace test;

constexpr uint32_t kFarWidth = 96, kFarHeight = 64;
constexpr float kFarAspect = float(kFarWidth) / float(kFarHeight);
// The distances that are asked for, and a place on Earth in ECEF coordinates, to whole metres.
const glm::dvec3 kFarPlaces[] = {{1e4, 0, -1e4}, {1e6, 0, -1e6}, {-6.4e6, 0, 6.4e6}, {4e6, 1e6, -4.8e6}};

// Things of all kinds, a lamp and a camera. Places are multiples of a half, which single precision tells
// apart as far out as the Earth's surface lies from its middle: clips and instances have no other numbers.
TestScene farScene() {
  TestScene s;
  const int grey = s.material(TestScene::colored("Grey", {0.6f, 0.5f, 0.4f, 1}));
  const int red = s.material(TestScene::colored("Red", {0.8f, 0.2f, 0.1f, 1}));
  Json glass = TestScene::colored("Glass", {0.2f, 0.5f, 0.8f, 0.5f});
  glass["alphaMode"] = "BLEND";
  const auto at = [](const glm::vec3& place) { return glm::translate(glm::mat4(1.0f), place); };
  s.add(boxMesh({-0.6f, 0, -0.4f}, {0.6f, 1.3f, 0.4f}), grey,
        glm::rotate(at({-1.5f, 0, 0}), 0.4f, {0, 1, 0}));
  s.paint({{{{-0.7f, 1.4f, 0.5f}, {0, 1.6f, 0.6f}, {0.7f, 1.2f, 0.5f}}, 0.12f, {0.1f, 0.3f, 0.7f, 1}}});
  TestMesh bent = sphereMesh({0, 0, 0}, 0.5f, 16);
  for (const glm::vec3& p : bent.positions) {
    const float up = std::clamp(p.y + 0.5f, 0.0f, 1.0f);
    bent.joints.emplace_back(0, 1, 0, 0), bent.weights.emplace_back(1 - up, up, 0, 0);
  }
  s.addSkinned(bent, red, {at({0, 0.5f, 1}), glm::rotate(at({0.5f, 1, 1}), 0.5f, {0, 0, 1})},
               {glm::mat4(1), glm::mat4(1)});
  s.add(sphereMesh({0, 0, 0}, 0.5f, 16), grey, glm::scale(at({1.5f, 0.5f, 0}), {1, -1, 1}));
  Json& morphed = s.json()["meshes"].back();
  morphed["primitives"][0]["targets"] = {{{"POSITION", morphed["primitives"][0]["attributes"]["POSITION"]}}};
  morphed["weights"] = {0.2};
  s.addInstances(boxMesh({-0.15f, 0, -0.15f}, {0.15f, 0.4f, 0.15f}), red,
                 {{-0.5f, 0, 1.5f}, {0.5f, 0, 2}, {2, 0, 1.5f}}, std::vector<glm::quat>(3, {1, 0, 0, 0}),
                 std::vector<glm::vec3>(3, glm::vec3(1)));
  s.addStrokes({{{{1, 0.2f, 1.5f}, {1.5f, 0.6f, 1.6f}, {2, 0.3f, 1.4f}}, 0.1f, {0.2f, 0.6f, 0.2f, 1}}});
  s.add(gridMesh({-0.5f, 0.2f, 0}, {1, 0, 0}, {0, 1, 0}), s.material(glass), at({0, 0, 2.5f}));
  s.add(sphereMesh({0, 0, 0}, 0.3f, 12), red);
  s.clip("rolls", {0, 1, 2}, {{-2, 0.5f, 1}, {-0.5f, 0.5f, 2}, {-2, 0.5f, 1}});
  Json& json = s.json();
  const auto lamp = [&](const char* type, const Json& node) {
    json["extensions"]["KHR_lights_punctual"]["lights"].push_back(
        {{"type", type}, {"intensity", 3.0}, {"color", {1, 1, 1}}});
    Json whole = node;
    whole["extensions"]["KHR_lights_punctual"]["light"] =
        json["extensions"]["KHR_lights_punctual"]["lights"].size() - 1;
    json["scenes"][0]["nodes"].push_back(json["nodes"].size());
    json["nodes"].push_back(whole);
  };
  json["extensionsUsed"].push_back("KHR_lights_punctual");
  lamp("spot", {{"translation", {0.5, 3.0, 1.5}}, {"rotation", {-0.7071068, 0, 0, 0.7071068}}});
  lamp("point", {{"translation", {-1.0, 2.0, 2.0}}});
  json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.05}}}}};
  json["scenes"][0]["nodes"].push_back(json["nodes"].size());
  json["nodes"].push_back({{"camera", 0}, {"translation", {0.5, 1.5, 7.0}}});
  return s;
}

enum class How { atNodes, above, mirroredAbove, acrossAndBack, placed, edited };
constexpr How kHows[] = {How::atNodes,       How::above,  How::mirroredAbove,
                         How::acrossAndBack, How::placed, How::edited};
constexpr const char* kHowNames[] = {"at its nodes",    "above",  "above a mirror",
                                     "across and back", "placed", "edited"};

void moveNode(Json& node, const glm::dvec3& way) {
  if (node.contains("matrix")) {
    for (int i = 0; i < 3; ++i) node["matrix"][12 + i] = node["matrix"][12 + i].get<double>() + way[i];
    return;
  }
  const Json rest = node.value("translation", Json{0, 0, 0});
  node["translation"] = {rest[0].get<double>() + way.x, rest[1].get<double>() + way.y,
                         rest[2].get<double>() + way.z};
}

Json translated(const glm::dvec3& way) {
  return {{"translation", {way.x, way.y, way.z}}};
}

// The scene moved by `way`, whichever way it is brought there; with `way` 0 what that is to look like.
Scene movedScene(How how, const glm::dvec3& way) {
  TestScene s = farScene();
  switch (how) {
    case How::atNodes: {
      for (const Json& root : s.json()["scenes"][0]["nodes"])
        moveNode(s.json()["nodes"][root.get<size_t>()], way);
      // What a clip moves stands where the clip has it.
      Json& animation = s.json()["animations"][0];
      const size_t node = animation["channels"][0]["target"]["node"];
      s.json()["nodes"][node].erase("translation");
      Json held = s.json()["nodes"][node];
      s.json()["nodes"][node] = translated(way);
      s.json()["nodes"][node]["children"] = {s.json()["nodes"].size()};
      animation["channels"][0]["target"]["node"] = s.json()["nodes"].size();
      s.json()["nodes"].push_back(held);
      return s.load();
    }
    case How::above:
      s.putBelow(translated(way));
      return s.load();
    case How::mirroredAbove:
      s.putBelow({{"scale", {-1, 1, 1}}});
      s.putBelow(translated(way));
      return s.load();
    case How::acrossAndBack:
      // It ends where it began.
      s.putBelow(translated(-way));
      s.putBelow(translated(way));
      return s.load();
    case How::placed: {
      const Result<Scene> placed = Scene::place({{s.load(), "there", way}});
      EXPECT_TRUE(placed) << placed.error().message();
      return *placed;
    }
    case How::edited: {
      s.putBelow(translated({}));
      SceneEditor editor(s.load());
      const NodeId root = NodeId(int(editor.nodeCount()) - 1);
      // Nodes are sorted, parents first.
      const NodeId first = editor.parentOf(root) == NodeId::none ? root : NodeId(0);
      EXPECT_TRUE(editor.setTransform(first, glm::translate(glm::dmat4(1.0), way)));
      return *editor.scene();
    }
  }
  return {};
}

Viewpoint byHand(const glm::dvec3& way) {
  Viewpoint from;
  from.eye = glm::dvec3(2.5, 2, 5) + way, from.target = glm::dvec3(0, 0.5, 0.5) + way;
  return from;
}

class FarAway : public BothEyes {
 protected:
  static std::vector<View> seen(const Scene& scene, const Viewpoint& from, const Look& look,
                                double time = 0.4) {
    Result<std::vector<View>> views = makeViews(scene, from, kFarAspect, GetParam(), 0.1f, look, time);
    EXPECT_TRUE(views) << views.error().message();
    return std::move(views).value();
  }
  static Frame drawn(const Scene& scene, const Look& look, const glm::dvec3& way,
                     const std::vector<std::string>& aovs = {"depth", "normal", "motion", "id"}) {
    RenderOptions options = sized(kFarWidth, kFarHeight, aovs);
    options.previousViews = seen(scene, byHand(way + glm::dvec3(0.25, 0, 0)), look);
    options.previousTime = 0.3;
    Result<Frame> frame = renderer().render(scene, look, 0.4, seen(scene, byHand(way), look), options);
    EXPECT_TRUE(frame) << frame.error().message();
    return std::move(frame).value();
  }
};
INSTANTIATE_BOTH_EYES(FarAway);

std::string placeText(const glm::dvec3& way) {
  return std::to_string(way.x) + ", " + std::to_string(way.y) + ", " + std::to_string(way.z);
}

TEST_P(FarAway, scenesLookAsTheyDoHere) {
  const Look look;
  for (const How how : kHows) {
    const Frame expected = drawn(movedScene(how, {}), look, {});
    for (const glm::dvec3& place : kFarPlaces) {
      const glm::dvec3 way = how == How::acrossAndBack ? glm::dvec3(0.0) : place;
      expectSame(drawn(movedScene(how, place), look, way), expected,
                 std::string(kHowNames[size_t(how)]) + " at " + placeText(place));
    }
  }
}

// With what lies in the world, and not on things: ground, fog, sea, shadows, lines, pigment.
TEST_P(FarAway, looksLookAsTheyDoHere) {
  const auto triple = [](const glm::dvec3& at) {
    return std::to_string(int64_t(at.x)) + "," + std::to_string(int64_t(at.y)) + "," +
           std::to_string(int64_t(at.z));
  };
  const auto lookFor = [&](const std::string& name, const glm::dvec3& way) {
    const auto styled = [](const std::string& of) {
      Result<Look> look = Look::load(of);
      return look ? *look : Look();
    };
    Look look = styled(name == "ink" || name == "watercolour" || name == "storm" ? name : "age-of-sail");
    Knobs knobs;
    if (name == "fog")
      knobs = {{"colorizers.mist.volume.shape", "half-space"},
               {"colorizers.mist.volume.center", triple(way)},
               {"colorizers.mist.grade.tint", "#8090C0"},
               {"colorizers.ball.volume.shape", "sphere"},
               {"colorizers.ball.volume.center", triple(way + glm::dvec3(1, 1, 1))},
               {"colorizers.ball.grade.tint", "#C06040"},
               {"colorizers.box.volume.shape", "box"},
               {"colorizers.box.volume.center", triple(way + glm::dvec3(-2, 0, 0))},
               {"colorizers.box.grade.gain", "1.6"}};
    if (name == "sea" && hasKnob("ocean.mode"))
      knobs = {{"ocean.mode", "on"},
               {"ocean.level", std::to_string(0.25 + way.y)},
               {"decorations.D.water.kind", "ripples"},
               {"decorations.D.water.at", triple(way + glm::dvec3(1, 0, 2))}};
    for (const auto& [path, value] : knobs) {
      const Status set = look.set(path, value);
      EXPECT_TRUE(set) << path << ": " << set.error().message();
    }
    return look;
  };
  for (const std::string name : {"fog", "sea", "ink", "watercolour", "storm"}) {
    const Frame expected = drawn(movedScene(How::above, {}), lookFor(name, {}), {});
    for (const glm::dvec3& place : kFarPlaces) {
      if (name == "sea" && place.y != 0) continue;  // no knob has its level so high
      expectSame(drawn(movedScene(How::above, place), lookFor(name, place), place), expected,
                 name + " at " + placeText(place));
    }
  }
}

// Whoever says where the camera stands, it stands there, as exactly as here.
TEST_P(FarAway, camerasStandWhereTheyAreSaidTo) {
  Viewpoint named, orbit, turning, framing, held;
  named.camera = "0", orbit.orbit = true, orbit.azimuth = 20, orbit.elevation = 30;
  turning.turntable = 3, framing.distance = 4, framing.frame = "*";
  Look look;
  for (const glm::dvec3& place : kFarPlaces) {
    const Scene near = movedScene(How::above, {}), far = movedScene(How::above, place);
    EXPECT_EQ(far.origin() - near.origin(), place);
    std::vector<std::pair<Viewpoint, Viewpoint>> cases{{byHand({}), byHand(place)}};
    for (const Viewpoint& from : {named, orbit, turning, Viewpoint{}}) cases.emplace_back(from, from);
    for (size_t i = 0; i < cases.size(); ++i) {
      const std::vector<View> here = seen(near, cases[i].first, look),
                              there = seen(far, cases[i].second, look);
      for (size_t v = 0; v < here.size(); ++v) {
        EXPECT_EQ(here[v].worldToEye, there[v].worldToEye) << i;
        EXPECT_EQ(there[v].origin - here[v].origin, place) << i;
        // The same in one matrix of double precision, from which a view is made again.
        View again = there[v];
        setWorldToEye(again, worldToEyeOf(there[v]));
        const glm::dmat4 other = worldToEyeOf(again), whole = worldToEyeOf(there[v]);
        for (int c = 0; c < 4; ++c) EXPECT_LT(glm::length(other[c] - whole[c]), 3e-3 * (c == 3) + 1e-12);
        const glm::dvec3 eye(glm::inverse(whole)[3]), same(glm::inverse(other)[3]);
        EXPECT_LT(glm::distance(eye, same), 1e-5);
        EXPECT_LT(glm::distance(eye - place, glm::dvec3(glm::inverse(worldToEyeOf(here[v]))[3])), 1e-5);
      }
    }
    Look eye = look;
    ASSERT_TRUE(eye.set("camera.mode", std::string("eye")));
    ASSERT_TRUE(eye.set("camera.eye", glm::vec3(place + glm::dvec3(1, 2, 6))));
    Look hereLook = look;
    ASSERT_TRUE(hereLook.set("camera.mode", std::string("eye")));
    ASSERT_TRUE(hereLook.set("camera.eye", glm::vec3(1, 2, 6)));
    EXPECT_EQ(seen(far, {}, eye)[0].worldToEye, seen(near, {}, hereLook)[0].worldToEye);
    const SceneSummary a = near.summary(), b = far.summary();
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(b.min[i] - a.min[i], place[i], 1e-6);
    const auto here = nodesToWorld(near, look, 0.4), there = nodesToWorld(far, look, 0.4);
    for (size_t n = 0; n < here.size(); ++n)
      EXPECT_LT(glm::distance(glm::dvec3(there[n][3] - here[n][3]), place), 1e-8) << n;
    EXPECT_EQ(glm::dvec3((*nodeToWorld(far, ""))[3]), glm::dvec3(0.0));
  }
}

// Where the caller counts from somewhere else, all the same.
TEST_P(FarAway, viewsMayCountFromElsewhere) {
  const Look look;
  const glm::dvec3 place = kFarPlaces[1];
  const Scene scene = movedScene(How::above, place);
  const std::vector<View> views = seen(scene, byHand(place), look);
  std::vector<View> others = views;
  for (View& view : others) {
    view.worldToEye = glm::dmat4(view.worldToEye) * glm::translate(glm::dmat4(1.0), glm::dvec3(16, -8, 4));
    view.origin += glm::dvec3(16, -8, 4);
  }
  const Frame a = draw(scene, look, views, sized(kFarWidth, kFarHeight, {"depth"}));
  const Frame b = draw(scene, look, others, sized(kFarWidth, kFarHeight, {"depth"}));
  for (size_t v = 0; v < viewCount(); ++v)
    EXPECT_LT(largestDifference(aov(a, "depth", v), aov(b, "depth", v)), INFINITY);
  double sum = 0;
  for (size_t v = 0; v < viewCount(); ++v) {
    Difference alike(2e-3);
    for (int y = 0; y < int(kFarHeight); ++y)
      for (int x = 0; x < int(kFarWidth); ++x) {
        const double p = texel(aov(a, "depth", v), x, y).x, q = texel(aov(b, "depth", v), x, y).x;
        if (std::isfinite(p) && std::isfinite(q)) alike.add(p, q);
      }
    EXPECT_LT(alike.beyondPart(), 0.005) << alike.text();
    sum += double(alike.count);
  }
  EXPECT_GT(sum, 1000);
  others[0].origin.x = NAN;
  EXPECT_EQ(renderer().render(scene, look, 0, others, sized(8, 8)).error().kind, ErrorKind::usage);
}

// In the world, as far as single precision tells; sharp where they count from nearby.
TEST_P(FarAway, positionsAreOfTheWorld) {
  const Look look;
  for (const glm::dvec3& place : kFarPlaces) {
    const Frame near = drawn(movedScene(How::above, {}), look, {}, {"position"});
    const Scene scene = movedScene(How::above, place);
    const Frame far = drawn(scene, look, place, {"position"});
    RenderOptions options = sized(kFarWidth, kFarHeight, {"position"});
    options.positionsFrom = scene.origin();
    const Result<Frame> fromNearby =
        renderer().render(scene, look, 0.4, seen(scene, byHand(place), look), options);
    ASSERT_TRUE(fromNearby) << fromNearby.error().message();
    const Frame& sharp = *fromNearby;
    for (size_t v = 0; v < viewCount(); ++v) {
      Difference coarse(0.26), fine(1e-6);
      for (int y = 0; y < int(kFarHeight); ++y)
        for (int x = 0; x < int(kFarWidth); ++x) {
          const glm::dvec4 p = texel(aov(near, "position", v), x, y),
                           q = texel(aov(far, "position", v), x, y),
                           r = texel(aov(sharp, "position", v), x, y);
          if (p == glm::dvec4(0.0)) continue;
          for (int i = 0; i < 3; ++i) coarse.add(q[i], p[i] + place[i]), fine.add(r[i], p[i]);
        }
      EXPECT_EQ(coarse.beyond, 0u) << coarse.text();
      EXPECT_EQ(fine.beyond, 0u) << fine.text();
    }
  }
}

// A list of instances may hold the far places itself, below a node that lays it on its back, as files of
// programs whose z is up do; and joints' bind poses may take back what their vertices have.
TEST_P(FarAway, instancesHoldFarPlaces) {
  const Look look;
  const auto made = [](const glm::dvec3& way) {
    TestScene s;
    const int grey = s.material(TestScene::colored("Grey", {0.6f, 0.5f, 0.4f, 1}));
    // Up is z in the list.
    const glm::vec3 there(glm::dvec3(way.x, -way.z, way.y));
    s.addInstances(boxMesh({-0.5f, -0.4f, 0}, {0.5f, 0.4f, 1.5f}), grey,
                   {there, there + glm::vec3(-1.5f, 1, 0), there + glm::vec3(1.5f, -0.5f, 0)},
                   std::vector<glm::quat>(3, {1, 0, 0, 0}), std::vector<glm::vec3>(3, glm::vec3(1)));
    s.putBelow({{"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}}});
    return s.load();
  };
  // A turn has sixteen digits, of which seven are left here: enough but for the last bit of a motion.
  const std::vector<std::string> aovs{"depth", "normal", "id"};
  const Frame expected = drawn(made({}), look, {}, aovs);
  for (const glm::dvec3& place : kFarPlaces)
    expectSame(drawn(made(place), look, place, aovs), expected, placeText(place));
}

}  // namespace
}  // namespace scumble
