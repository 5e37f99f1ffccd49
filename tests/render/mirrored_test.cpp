// Mirrors above things and at them: whatever bodies they make, those are closed, and are seen from outside.
#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/aov.h"
#include "tests/support/render_test.h"

namespace scumble {
namespace {

using namespace test;

constexpr uint32_t kMirrorWidth = 96, kMirrorHeight = 72;

enum class Body { rigid, skinned, morphed, instanced };
constexpr Body kBodies[] = {Body::rigid, Body::skinned, Body::morphed, Body::instanced};
constexpr const char* kBodyNames[] = {"rigid", "skinned", "morphed", "instanced"};

glm::mat4 mirrorAlong(int axis) {
  glm::mat4 m(1.0f);
  m[axis][axis] = -1;
  return m;
}

Json numbersOf(const glm::mat4& m) {
  return std::vector<float>(&m[0][0], &m[0][0] + 16);
}

// A box around the origin, which no mirror changes; `at`: the body's own matrix; `above`: that of a root.
TestScene boxUnder(Body body, const glm::mat4& at, const glm::mat4& above) {
  TestScene s;
  const int m = s.material(TestScene::colored("Grey", {0.6f, 0.5f, 0.4f, 1}));
  TestMesh box = boxMesh({-1, -0.7f, -0.5f}, {1, 0.7f, 0.5f});
  if (body == Body::skinned) {
    box.joints.assign(box.positions.size(), glm::u8vec4(0));
    box.weights.assign(box.positions.size(), glm::vec4(1, 0, 0, 0));
    s.addSkinned(box, m, {at}, {glm::mat4(1)});
  } else if (body == Body::instanced) {
    s.addInstances(box, m, {{0, 0, 0}}, {{1, 0, 0, 0}}, {{at[0][0], at[1][1], at[2][2]}});
  } else {
    s.add(box, m, at);
  }
  if (body == Body::morphed) {
    Json& primitive = s.json()["meshes"].back()["primitives"][0];
    primitive["targets"] = {{{"POSITION", primitive["attributes"]["POSITION"]}}};
  }
  Json& nodes = s.json()["nodes"];
  Json children = s.json()["scenes"][0]["nodes"];
  nodes.push_back({{"matrix", numbersOf(above)}, {"children", children}});
  s.json()["scenes"][0]["nodes"] = {nodes.size() - 1};
  return s;
}

class Mirrored : public BothEyes {
 protected:
  Frame drawn(const Scene& scene, double time = 0) const {
    const auto views =
        viewsFrom(scene, {{2, 1.5f, 4}, {0, 0, 0}, 40, 0, 0.1f}, kMirrorWidth, kMirrorHeight, GetParam());
    Look look = quietLook({{"warp.amount", "0"}});
    for (const auto& [path, value] : thoseThere({{"ink.shown", "on"}, {"ink.weights", "edge"}}))
      EXPECT_TRUE(look.set(path, value));
    std::vector<std::string> aovs{"depth", "normal"};
    if (hasKnob("ink.shown")) aovs.push_back("ink");
    Result<Frame> frame =
        renderer().render(scene, look, time, views, sized(kMirrorWidth, kMirrorHeight, aovs));
    EXPECT_TRUE(frame) << frame.error().message();
    return std::move(frame).value();
  }
  // But for what triangles that are split along the other diagonal round otherwise.
  void expectAlike(const Frame& a, const Frame& b, const std::string& what) const {
    for (const auto& [name, most] : {std::pair("depth", 1e-4), {"normal", 1e-3}, {"ink", 0.02}}) {
      if (std::string(name) == "ink" && !hasKnob("ink.shown")) continue;
      for (size_t v = 0; v < viewCount(); ++v) {
        int others = 0;
        for (int y = 0; y < int(kMirrorHeight); ++y)
          for (int x = 0; x < int(kMirrorWidth); ++x) {
            const glm::dvec4 p = texel(aov(a, name, v), x, y), q = texel(aov(b, name, v), x, y);
            others += p != q && !(glm::length(p - q) < most);
          }
        EXPECT_LE(others, 4) << what << ", " << name << ", view " << v;
      }
    }
  }
};
INSTANTIATE_BOTH_EYES(Mirrored);

TEST_P(Mirrored, bodiesAreSeenFromOutside) {
  const glm::mat4 one(1.0f);
  for (const Body body : kBodies) {
    const Frame expected = drawn(boxUnder(body, one, one).load());
    for (int axis = 0; axis < 3; ++axis)
      for (const int where : {0, 1, 2}) {  // above, at, both: which is no mirror
        const glm::mat4 mirror = mirrorAlong(axis);
        expectAlike(drawn(boxUnder(body, where == 0 ? one : mirror, where == 1 ? one : mirror).load()),
                    expected,
                    std::string(kBodyNames[size_t(body)]) + ", axis " + std::to_string(axis) + ", where " +
                        std::to_string(where));
      }
  }
}

// A scale that goes from 1 through 0 to -1.
TEST_P(Mirrored, bodiesGoThroughAMirror) {
  for (const Body body : {Body::rigid, Body::skinned, Body::morphed}) {
    TestScene s = boxUnder(body, glm::mat4(1), glm::mat4(1));
    Json& root = s.json()["nodes"].back();
    root.erase("matrix");
    const size_t node = s.json()["nodes"].size() - 1;
    s.clip("turns", {0, 2}, {{1, 1, 1}, {-1, 1, 1}});
    Json& target = s.json()["animations"][0]["channels"][0]["target"];
    target["path"] = "scale", target["node"] = node;
    const Scene scene = s.load();
    const std::string name = kBodyNames[size_t(body)];
    expectAlike(drawn(scene, 1.9999), drawn(scene, 0.0001), name + " at both ends");
    expectAlike(drawn(scene, 1.5), drawn(scene, 0.5), name + " halfway");
    drawn(scene, 1.0);  // flat
  }
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
