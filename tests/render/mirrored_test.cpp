// Mirrors above things and at them: whatever they show is as if it were modelled so.
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "tests/support/aov.h"
#include "tests/support/render_test.h"

namespace scumble {
namespace {

using namespace test;

constexpr uint32_t kMirrorWidth = 96, kMirrorHeight = 72;

enum class Subject { rigid, skinned, morphed, instanced, painted, strokes, fins, spot, placed };
constexpr Subject kSubjects[] = {Subject::rigid,     Subject::skinned, Subject::morphed,
                                 Subject::instanced, Subject::painted, Subject::strokes,
                                 Subject::fins,      Subject::spot,    Subject::placed};
constexpr const char* kSubjectNames[] = {"rigid",   "skinned", "morphed", "instanced", "painted",
                                         "strokes", "fins",    "spot",    "placed"};

glm::mat4 mirrorAlong(int axis) {
  glm::mat4 m(1.0f);
  m[axis][axis] = -1;
  return m;
}

Json numbersOf(const glm::mat4& m) {
  return std::vector<float>(&m[0][0], &m[0][0] + 16);
}

glm::vec3 across(const glm::mat4& mirror, const glm::vec3& point) {
  return glm::mat3(mirror) * point;
}

// What a mirror makes of it, as somebody who models that would write it. The first edge of a triangle stays
// its first: what a surface carries unevenly scaled follows that.
TestMesh across(const glm::mat4& mirror, TestMesh mesh) {
  for (glm::vec3& p : mesh.positions) p = across(mirror, p);
  for (glm::vec3& n : mesh.normals) n = across(mirror, n);
  if (glm::determinant(mirror) < 0)
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) std::swap(mesh.indices[i], mesh.indices[i + 1]);
  return mesh;
}

std::vector<TestStroke> across(const glm::mat4& mirror, std::vector<TestStroke> strokes) {
  for (TestStroke& stroke : strokes)
    for (glm::vec3& p : stroke.points) p = across(mirror, p);
  return strokes;
}

// A box with a ball on one of its corners: no mirror leaves it as it is.
TestMesh lopsided() {
  TestMesh mesh = boxMesh({-0.9f, -0.6f, -0.4f}, {0.5f, 0.3f, 0.7f});
  append(mesh, sphereMesh({0.6f, 0.5f, 0.2f}, 0.4f, 12), {});
  mesh.colors.clear();
  return mesh;
}

// The thing, and nothing else, with its shape across the mirror `shape`; `at`: a matrix of its own nodes.
TestScene only(Subject thing, const glm::mat4& shape, const glm::mat4& at) {
  TestScene s;
  const int grey = s.material(TestScene::colored("Grey", {0.6f, 0.5f, 0.4f, 1}));
  const TestMesh mesh = across(shape, lopsided());
  const std::vector<TestStroke> strokes =
      across(shape, {{{{-0.9f, 0.5f, 0.9f}, {0, 0.2f, 1}, {0.7f, 0.6f, 0.8f}}, 0.15f, {0.1f, 0.3f, 0.7f, 1}},
                     {{{0.9f, -0.6f, 0.5f}, {0.9f, 0.4f, 0.3f}}, 0.1f, {0.8f, 0.3f, 0.1f, 1}}});
  switch (thing) {
    case Subject::skinned: {
      TestMesh bent = mesh;
      for (const glm::vec3& p : bent.positions) {
        const float share = glm::clamp(0.5f + across(shape, p).y, 0.0f, 1.0f);
        bent.joints.emplace_back(0, 1, 0, 0), bent.weights.emplace_back(1 - share, share, 0, 0);
      }
      const glm::mat4 joint =
          glm::rotate(glm::translate(glm::mat4(1), {0.1f, 0.2f, 0}), 0.4f, glm::vec3(0.6f, 0, 0.8f));
      s.addSkinned(bent, grey, {at, at * shape * joint * shape}, {glm::mat4(1), glm::mat4(1)});
      break;
    }
    case Subject::instanced: {
      // The mirror is in the instances' own scales.
      const glm::mat4 whole = at * shape;
      const glm::mat3 turn(glm::mat3_cast(glm::angleAxis(0.5f, glm::vec3(0, 0.6f, 0.8f))));
      const glm::vec3 scale(at[0][0], at[1][1], at[2][2]);
      s.addInstances(mesh, grey, {across(whole, {-0.4f, 0, 0}), across(whole, {0.5f, 0.2f, -0.6f})},
                     {{1, 0, 0, 0}, glm::quat_cast(glm::mat3(whole) * turn * glm::mat3(whole))},
                     {0.6f * scale, 0.5f * scale});
      break;
    }
    case Subject::strokes:
      s.addStrokes(strokes, at);
      break;
    case Subject::fins: {
      Json material = TestScene::unlit("Paint", {0.8f, 0.2f, 0.1f, 0.8f});
      material["alphaMode"] = "BLEND", material["doubleSided"] = true;
      material["extras"]["scumble_paint"] = {{"fadeStart", 0.9}, {"fadeEnd", 0.5}};
      TestMesh sheets = gridMesh({-0.8f, -0.5f, 0.3f}, {1.3f, 0.2f, 0.2f}, {0, 1, 0});
      append(sheets, gridMesh({-0.2f, -0.3f, 0.8f}, {0.9f, 0, -0.6f}, {0.2f, 0.9f, 0}), {});
      sheets.colors.clear();
      s.add(across(shape, sheets), s.material(material), at);
      break;
    }
    case Subject::spot: {
      const glm::vec3 place = across(shape, {0.4f, 0.3f, 0.6f}), way = across(shape, {-0.4f, -0.7f, -0.3f});
      const glm::mat4 there = at * glm::inverse(glm::lookAt(place, place + way, {0, 0, 1}));
      Json& json = s.json();
      json["extensionsUsed"].push_back("KHR_lights_punctual");
      json["extensions"]["KHR_lights_punctual"]["lights"] = {
          {{"type", "spot"},
           {"intensity", 1.5},
           {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.6}}}}};
      json["nodes"].push_back(
          {{"matrix", numbersOf(there)}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
      json["scenes"][0]["nodes"].push_back(json["nodes"].size() - 1);
      break;
    }
    default:
      s.add(mesh, grey, at);
      if (thing == Subject::painted) s.paint(strokes);
  }
  if (thing == Subject::morphed) {
    Json& primitive = s.json()["meshes"].back()["primitives"][0];
    primitive["targets"] = {{{"POSITION", primitive["attributes"]["POSITION"]}}};
    s.json()["meshes"].back()["weights"] = {0.3};
  }
  return s;
}

// Over a floor, and lit from one side; from below, where a lamp is to be seen.
void addSurroundings(TestScene& s, float up = 1) {
  s.add(gridMesh({-4, -1.2f, 4}, {8, 0, 0}, {0, 0, -8}, 4),
        s.material(TestScene::colored("Floor", {0.5f, 0.5f, 0.5f, 1})));
  s.light({0.5f, up, 0.7f});
}

// All of it; of what is placed, the thing is a scene of its own.
Scene whole(Subject thing, TestScene s) {
  if (thing != Subject::placed) {
    addSurroundings(s, thing == Subject::spot ? -1.0f : 1.0f);
    return s.load();
  }
  TestScene floor;
  addSurroundings(floor);
  const Result<Scene> placed =
      Scene::place({{floor.load(), "floor"}, {s.load(), "thing", {0.3, 0, 0.2}, {0, 25, 0}, 0.8f}});
  EXPECT_TRUE(placed) << placed.error().message();
  return *placed;
}

Scene mirrored(Subject thing, const glm::mat4& shape, const glm::mat4& at, const glm::mat4& above) {
  TestScene s = only(thing, shape, at);
  s.putBelow({{"matrix", numbersOf(above)}});
  return whole(thing, std::move(s));
}

// Its scale goes from 1 in so many seconds through 0 to -1 along the axis.
Scene turning(Subject thing, const glm::mat4& shape, int axis) {
  TestScene s = only(thing, shape, glm::mat4(1));
  const size_t node = s.putBelow({});
  s.clip("turns", {0, 2}, {{1, 1, 1}, glm::vec3(1) - 2.0f * glm::vec3(glm::mat3(1)[axis])});
  Json& target = s.json()["animations"][0]["channels"][0]["target"];
  target["path"] = "scale", target["node"] = node;
  return whole(thing, std::move(s));
}

class Mirrored : public BothEyes {
 protected:
  static bool isThere(Subject thing) {
    return hasKnob("painting.opacity") ||
           (thing != Subject::painted && thing != Subject::strokes && thing != Subject::fins);
  }
  static std::vector<std::string> facts() {
    std::vector<std::string> aovs{"depth", "normal", "shadow"};
    if (hasKnob("ink.shown")) aovs.push_back("ink");
    if (hasKnob("painting.opacity")) aovs.push_back("painting");
    return aovs;
  }
  Frame drawn(const Scene& scene, double time = 0) const {
    const auto views =
        viewsFrom(scene, {{2, 1.5f, 4}, {0, 0, 0}, 40, 0, 0.1f}, kMirrorWidth, kMirrorHeight, GetParam());
    Look look = quietLook({{"warp.amount", "0"}, {"light.punctualUnit", "candela"}});
    for (const auto& [path, value] : thoseThere({{"ink.shown", "on"}, {"ink.weights", "edge"}}))
      EXPECT_TRUE(look.set(path, value));
    Result<Frame> frame =
        renderer().render(scene, look, time, views, sized(kMirrorWidth, kMirrorHeight, facts()));
    EXPECT_TRUE(frame) << frame.error().message();
    return std::move(frame).value();
  }
  // But for so many pixels of edges, which the last bit of a place decides.
  static void expectAlike(const Frame& a, const Frame& b, const std::string& what) {
    constexpr int kMostOthers = 4;
    const std::map<std::string, double> most{
        {"depth", 1e-4}, {"normal", 1e-3}, {"shadow", 0.02}, {"ink", 0.02}, {"painting", 0.02}};
    for (const std::string& name : facts())
      for (size_t v = 0; v < viewCount(); ++v) {
        int others = 0;
        for (int y = 0; y < int(kMirrorHeight); ++y)
          for (int x = 0; x < int(kMirrorWidth); ++x) {
            const glm::dvec4 p = texel(aov(a, name, v), x, y), q = texel(aov(b, name, v), x, y);
            others += p != q && !(glm::length(p - q) < most.at(name));
          }
        EXPECT_LE(others, kMostOthers) << what << ", " << name << ", view " << v;
      }
  }
  static bool isAlike(const Frame& a, const Frame& b) {
    for (const std::string& name : facts())
      if (!sameBytes(aov(a, name), aov(b, name))) return false;
    return true;
  }
};
INSTANTIATE_BOTH_EYES(Mirrored);

// Whatever a node mirrors is as if its shape were modelled so.
TEST_P(Mirrored, nodesMirrorShapes) {
  const glm::mat4 one(1.0f);
  for (const Subject thing : kSubjects) {
    if (!isThere(thing)) continue;
    const Frame plain = drawn(mirrored(thing, one, one, one));
    for (int axis = 0; axis < 3; ++axis) {
      const glm::mat4 mirror = mirrorAlong(axis);
      const std::string what = std::string(kSubjectNames[size_t(thing)]) + ", axis " + std::to_string(axis);
      const Frame modelled = drawn(mirrored(thing, mirror, one, one));
      EXPECT_FALSE(isAlike(modelled, plain)) << what;
      expectAlike(drawn(mirrored(thing, one, mirror, one)), modelled, what + ", at");
      expectAlike(drawn(mirrored(thing, one, one, mirror)), modelled, what + ", above");
      expectAlike(drawn(mirrored(thing, one, mirror, mirror)), plain, what + ", both");
    }
  }
}

// A scale that goes from 1 through 0 to -1.
TEST_P(Mirrored, thingsGoThroughAMirror) {
  for (const Subject thing : kSubjects) {
    if (!isThere(thing)) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const Scene there = turning(thing, glm::mat4(1), axis), back = turning(thing, mirrorAlong(axis), axis);
      const std::string what = std::string(kSubjectNames[size_t(thing)]) + ", axis " + std::to_string(axis);
      expectAlike(drawn(there, 1.9375), drawn(back, 0.0625), what + " at both ends");
      expectAlike(drawn(there, 1.5), drawn(back, 0.5), what + " halfway");
      drawn(there, 1.0);  // flat
    }
  }
}

// A scene that stands on a node stands upright there, whatever that has at rest, and is mirrored with it
// where that moves through a mirror.
TEST_P(Mirrored, placedScenesStandUprightAndGoThroughMirrors) {
  const auto standing = [](const glm::vec3& first, const glm::vec3& last, const glm::mat4& shape) {
    TestScene support;
    const int grey = support.material(TestScene::colored("Deck", {0.3f, 0.5f, 0.4f, 1}));
    support.add(boxMesh({-0.2f, -0.2f, -0.2f}, {0.2f, 0.2f, 0.2f}), grey);
    const size_t node = support.putBelow({{"name", "Deck"}, {"scale", {first.x, first.y, first.z}}});
    support.clip("turns", {0, 2}, {first, last});
    Json& target = support.json()["animations"][0]["channels"][0]["target"];
    target["path"] = "scale", target["node"] = node;
    addSurroundings(support);
    PlacedScene thing{only(Subject::rigid, shape, glm::mat4(1)).load(), "thing",
                      across(shape, {0.3f, 0.1f, 0.2f})};
    thing.on = "Deck";
    const Result<Scene> placed = Scene::place({{support.load(), "support"}, thing});
    EXPECT_TRUE(placed) << placed.error().message();
    return *placed;
  };
  const glm::mat4 one(1.0f), mirror = mirrorAlong(0);
  const Scene plain = standing({1, 1, 1}, {1, 1, 1}, one), at = standing({-1, 1, 1}, {-1, 1, 1}, one);
  expectAlike(drawn(at), drawn(plain), "at rest");
  const Scene there = standing({1, 1, 1}, {-1, 1, 1}, one), back = standing({1, 1, 1}, {-1, 1, 1}, mirror);
  expectAlike(drawn(there, 0), drawn(plain), "before the mirror");
  drawn(there, 1);  // flat
  expectAlike(drawn(there, 1.9375), drawn(back, 0.0625), "behind the mirror");
}

// Where the mirror puts it, without the mirror: glTF's cameras know no scale.
TEST_P(Mirrored, camerasShowNoMirrorsPicture) {
  TestScene s;
  const int grey = s.material(TestScene::colored("Grey", {0.6f, 0.5f, 0.4f, 1}));
  s.add(boxMesh({-1, -0.7f, -0.5f}, {1, 0.7f, 0.5f}), grey);
  s.add(sphereMesh({1.2f, 0.8f, 0}, 0.3f, 12), grey);
  const auto withCamera = [&](const glm::mat4& above, const glm::mat4& own) {
    TestScene copy = s;
    Json& json = copy.json();
    json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.01}}}}};
    json["nodes"].push_back({{"matrix", numbersOf(own)}, {"camera", 0}});
    json["nodes"].push_back({{"matrix", numbersOf(above)}, {"children", {json["nodes"].size() - 1}}});
    json["scenes"][0]["nodes"].push_back(json["nodes"].size() - 1);
    return copy.load();
  };
  for (int axis = 0; axis < 3; ++axis) {
    const glm::mat4 mirror = mirrorAlong(axis);
    const glm::mat4 own = glm::inverse(
        glm::lookAt(glm::vec3(mirror * glm::vec4(2, 1.5f, 4, 1)), glm::vec3(0), glm::vec3(mirror[1])));
    const Scene scene = withCamera(mirror, own);
    const std::vector<View> views = makeViews(scene, Viewpoint{}, 4.0f / 3, GetParam()).value();
    for (const View& view : views) EXPECT_GT(glm::determinant(glm::mat3(view.worldToEye)), 0.99f);
    const Scene plain =
        withCamera(glm::mat4(1), glm::inverse(glm::lookAt(glm::vec3(2, 1.5f, 4), glm::vec3(0), {0, 1, 0})));
    const std::vector<View> expected = makeViews(plain, Viewpoint{}, 4.0f / 3, GetParam()).value();
    for (size_t v = 0; v < views.size(); ++v)
      for (int i = 0; i < 16; ++i)
        EXPECT_NEAR(views[v].worldToEye[i / 4][i % 4], expected[v].worldToEye[i / 4][i % 4], 1e-5f)
            << "axis " << axis << ", view " << v;
  }
}

}  // namespace
}  // namespace scumble
