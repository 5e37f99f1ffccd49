// What cannot be seen is not there: neither in the picture nor in framing, ground, shadows, lines, drawings
// and mattes.
#include "scene/seen.h"

#include "tests/support/aov.h"
#include "tests/support/render_test.h"

namespace scumble {
namespace {

using namespace test;

enum class Thing { rigid, skinned, morphed, instanced, strokes };
constexpr Thing kThings[] = {Thing::rigid, Thing::skinned, Thing::morphed, Thing::instanced, Thing::strokes};
constexpr const char* kThingNames[] = {"rigid", "skinned", "morphed", "instanced", "strokes"};

enum class Way { hidden, hiddenAbove, scale, flat, material, vertices, texture, mask, cutoff };
constexpr Way kWays[] = {Way::hidden,   Way::hiddenAbove, Way::scale, Way::flat,  Way::material,
                         Way::vertices, Way::texture,     Way::mask,  Way::cutoff};
constexpr const char* kWayNames[] = {"hidden",   "hiddenAbove", "scale", "flat",  "material",
                                     "vertices", "texture",     "mask",  "cutoff"};
bool isOfNode(Way way) {
  return way <= Way::flat;
}

Image clearImage() {
  Image image;
  image.width = image.height = 4, image.channels = {"R", "G", "B", "A"};
  image.pixels.assign(64, 0.5f);
  for (size_t i = 3; i < 64; i += 4) image.pixels[i] = 0;
  return image;
}

Json materialOf(TestScene& s, Way way) {
  Json m = TestScene::colored("Gone", {0.9f, 0.2f, 0.1f, 1});
  Json& pbr = m["pbrMetallicRoughness"];
  if (way == Way::material) m["alphaMode"] = "BLEND", pbr["baseColorFactor"][3] = 0;
  if (way == Way::vertices) m["alphaMode"] = "BLEND";
  if (way == Way::texture)
    m["alphaMode"] = "BLEND", pbr["baseColorTexture"] = {{"index", s.texture(clearImage())}};
  if (way == Way::mask) m["alphaMode"] = "MASK", pbr["baseColorFactor"][3] = 0.4;
  if (way == Way::cutoff) m["alphaMode"] = "MASK", m["alphaCutoff"] = 1.5;
  return m;
}

void declare(TestScene& s, const char* extension) {
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) s.json()[list].push_back(extension);
}

void hide(TestScene& s, size_t node, Way way) {
  Json& nodes = s.json()["nodes"];
  const auto vanish = [&](size_t n) {
    nodes[n].erase("matrix");
    nodes[n]["scale"] = way == Way::scale ? Json{0, 0, 0} : Json{0, 1, 0};
  };
  if (way == Way::scale || way == Way::flat) {
    if (nodes[node].contains("skin")) vanish(node + 1);  // its joint
    return vanish(node);
  }
  declare(s, "KHR_node_visibility");
  const Json invisible = {{"KHR_node_visibility", {{"visible", false}}}};
  if (way == Way::hidden) {
    nodes[node]["extensions"].update(invisible);
    return;
  }
  nodes.push_back({{"children", {node}}, {"extensions", invisible}});
  for (Json& root : s.json()["scenes"][0]["nodes"])
    if (root == node) root = nodes.size() - 1;
}

TestScene cubeAlone() {
  TestScene s;
  s.add(boxMesh({-1, 0, -1}, {1, 2, 1}), s.material(TestScene::colored("Grey", {0.4f, 0.5f, 0.6f, 1})));
  return s;
}

// The cube, and beside it a thing that is not seen.
TestScene cubeAnd(Thing thing, Way way) {
  TestScene s = cubeAlone();
  const int m = s.material(materialOf(s, way));
  TestMesh ball = sphereMesh({5, 1, 0.5f}, 1, 12);
  if (way == Way::vertices) ball.colors.assign(ball.positions.size(), glm::vec4(1, 1, 1, 0));
  if (thing == Thing::skinned) {
    ball.joints.assign(ball.positions.size(), glm::u8vec4(0));
    ball.weights.assign(ball.positions.size(), glm::vec4(1, 0, 0, 0));
    s.addSkinned(ball, m, {glm::mat4(1)}, {glm::mat4(1)});
  } else if (thing == Thing::instanced) {
    s.addInstances(ball, m, {{0, 0, 0}, {0, 0, -3}}, {{1, 0, 0, 0}, {1, 0, 0, 0}}, {{1, 1, 1}, {1, 1, 1}});
  } else if (thing == Thing::strokes) {
    s.addStrokes({{{{4, 1, 0}, {6, 1.5f, 0}}, 0.3f, {0.9f, 0.2f, 0.1f, 1}}});
  } else {
    s.add(ball, m);
  }
  if (thing == Thing::morphed) {
    Json& primitive = s.json()["meshes"].back()["primitives"][0];
    primitive["targets"] = {{{"POSITION", primitive["attributes"]["POSITION"]}}};
    s.json()["meshes"].back()["weights"] = {0.5};
  }
  if (isOfNode(way)) hide(s, 1, way);
  return s;
}

// Numbers of objects are by node, whatever is seen of them.
Frame withoutNumbers(Frame frame) {
  std::erase_if(frame.layers, [](const Frame::Layer& layer) { return layer.name == "cryptomatte"; });
  return frame;
}

class Seen : public BothEyes {};
INSTANTIATE_BOTH_EYES(Seen);

TEST_P(Seen, whatIsNotIsAsIfItWereNotThere) {
  const Scene alone = cubeAlone().load();
  std::vector<Look> looks{Look()};
  for (const char* name : {"ink", "watercolour"})
    if (Result<Look> look = Look::load(name)) looks.push_back(std::move(look).value());
  if (hasKnob("ink.shown")) {
    for (const char* kind : {"objects", "cutouts", "intersections"})
      ASSERT_TRUE(looks[1].set("ink." + std::string(kind) + ".shown", "on"));
  }
  std::vector<Frame> expected;
  RenderOptions options = sized(96, 54, {"depth", "cryptomatte"});
  std::vector<View> views;
  for (const Look& look : looks) {
    options.drawing = &look == &looks[1];
    views = makeViews(alone, Viewpoint{}, 96.0f / 54, GetParam()).value();
    expected.push_back(withoutNumbers(draw(alone, look, views, options)));
  }
  size_t l = 0;
  for (const Thing thing : kThings)
    for (const Way way : kWays) {
      if (thing == Thing::strokes && !isOfNode(way)) continue;  // their colours are no material's
      if (thing == Thing::instanced && way == Way::flat) continue;
      const std::string what = std::string(kThingNames[size_t(thing)]) + ", " + kWayNames[size_t(way)];
      const Scene scene = cubeAnd(thing, way).load();
      EXPECT_EQ(scene.data().bounds.min, alone.data().bounds.min) << what;
      EXPECT_EQ(scene.data().bounds.max, alone.data().bounds.max) << what;
      const std::vector<View> framed = makeViews(scene, Viewpoint{}, 96.0f / 54, GetParam()).value();
      for (size_t v = 0; v < views.size(); ++v) EXPECT_EQ(framed[v].worldToEye, views[v].worldToEye) << what;
      l = (l + 1) % looks.size();
      options.drawing = l == 1;
      const Frame frame = withoutNumbers(draw(scene, looks[l], framed, options));
      expectSame(frame, expected[l], what);
      for (const std::string& name : frame.objects)
        EXPECT_NE(name, "node 2") << what << ": a matte of what is not seen";
      ASSERT_EQ(frame.drawings.size(), expected[l].drawings.size());
      for (size_t v = 0; v < frame.drawings.size(); ++v)
        EXPECT_EQ(svgOf(frame.drawings[v]), svgOf(expected[l].drawings[v])) << what;
    }
}

// By a clip, from one second to the next: gone, there, gone; and in the motion of the frame in which it
// appears.
TEST_P(Seen, clipsShowAndHide) {
  TestScene s = cubeAlone();
  s.add(sphereMesh({2.5f, 1, 0}, 0.9f, 12), s.material(TestScene::colored("Red", {0.9f, 0.2f, 0.1f, 1})));
  TestScene without = cubeAlone();
  declare(s, "KHR_node_visibility");
  declare(s, "KHR_animation_pointer");
  const std::vector<uint8_t> visible{0, 1, 0, 0};
  scene::TestGltf extra;  // its buffer is appended below
  const auto asData = [](const void* bytes, size_t size) {
    const auto* first = static_cast<const uint8_t*>(bytes);
    return "data:application/octet-stream;base64," + scene::TestGltf::base64({first, first + size});
  };
  Json& json = s.json();
  const std::vector<float> times{0, 1, 2, 3};
  const Json::array_t buffers{{{"byteLength", 16}, {"uri", asData(times.data(), 16)}},
                              {{"byteLength", 4}, {"uri", asData(visible.data(), 4)}}};
  std::string text = s.text();
  Json whole = Json::parse(text);
  const size_t firstBuffer = whole["buffers"].size(), firstView = whole["bufferViews"].size(),
               firstAccessor = whole["accessors"].size();
  for (const Json& buffer : buffers) whole["buffers"].push_back(buffer);
  for (size_t i = 0; i < 2; ++i)
    whole["bufferViews"].push_back({{"buffer", firstBuffer + i}, {"byteLength", i == 0 ? 16 : 4}});
  whole["accessors"].push_back(
      {{"bufferView", firstView}, {"componentType", 5126}, {"type", "SCALAR"}, {"count", 4}});
  whole["accessors"].push_back(
      {{"bufferView", firstView + 1}, {"componentType", 5121}, {"type", "SCALAR"}, {"count", 4}});
  whole["animations"] = {
      {{"samplers", {{{"input", firstAccessor}, {"output", firstAccessor + 1}, {"interpolation", "STEP"}}}},
       {"channels",
        {{{"sampler", 0},
          {"target",
           {{"path", "pointer"},
            {"extensions",
             {{"KHR_animation_pointer",
               {{"pointer", "/nodes/1/extensions/KHR_node_visibility/visible"}}}}}}}}}}}};
  json = whole;
  text = whole.dump();
  const Result<Scene> scene = Scene::loadFromMemory(text.data(), text.size(), "clip.gltf", "");
  ASSERT_TRUE(scene) << scene.error().message();
  ASSERT_TRUE(scene->warnings().empty()) << scene->warnings()[0];
  const Scene alone = without.load();
  Look look = quietLook();
  if (hasKnob("ink.shown")) {
    ASSERT_TRUE(look.set("ink.shown", "on"));
  }
  const auto views = viewsFrom(*scene, {{3, 3, 9}, {1, 1, 0}, 40, 0, 0.1f}, 96, 54, GetParam());
  RenderOptions options = sized(96, 54, {"depth", "motion"});
  const auto at = [&](const Scene& of, double time) {
    options.previousTime = time - 0.25;
    Result<Frame> frame = renderer().render(of, look, time, views, options);
    EXPECT_TRUE(frame) << frame.error().message();
    return std::move(frame).value();
  };
  for (const double time : {0.5, 2.5})
    expectSame(at(*scene, time), at(alone, time), "at " + std::to_string(time));
  // It stands still, whether or not it was there a frame ago.
  const Frame there = at(*scene, 1.0);
  size_t shown = 0;
  const Frame empty = at(alone, 1.0);
  for (int y = 0; y < 54; ++y)
    for (int x = 0; x < 96; ++x) {
      shown += texel(aov(there, "depth"), x, y).x != texel(aov(empty, "depth"), x, y).x;
      EXPECT_LT(glm::length(glm::dvec2(texel(aov(there, "motion"), x, y))), 0.01) << x << ", " << y;
    }
  EXPECT_GT(shown, 100u);
}

// Of a primitive that is cut away in part, the rest alone is framed.
TEST(SeenParts, whatIsCutAwayTakesNoSpace) {
  for (const bool isSkinned : {false, true}) {
    TestScene s;
    TestMesh wall = gridMesh({0, 0, 0}, {4, 0, 0}, {0, 1, 0}, 4);
    wall.colors.assign(wall.positions.size(), glm::vec4(1));
    for (size_t v = 0; v < wall.positions.size(); ++v)
      if (wall.positions[v].x > 1.5f) wall.colors[v].a = 0;
    Json m = TestScene::colored("Wall", {1, 1, 1, 1});
    m["alphaMode"] = "MASK";
    const int material = s.material(m);
    if (isSkinned) {
      wall.joints.assign(wall.positions.size(), glm::u8vec4(0));
      wall.weights.assign(wall.positions.size(), glm::vec4(1, 0, 0, 0));
      s.addSkinned(wall, material, {glm::mat4(1)}, {glm::mat4(1)});
    } else {
      s.add(wall, material);
    }
    const Scene scene = s.load();
    EXPECT_EQ(scene.data().bounds.min, glm::vec3(0));
    EXPECT_EQ(scene.data().bounds.max, glm::vec3(2, 1, 0)) << "the cells that have any corner left";
    ASSERT_EQ(scene.data().seen.size(), 1u);
    EXPECT_TRUE(scene.data().seen[0][0].isSeen);
    EXPECT_EQ(scene.data().seen[0][0].extent->box.max.x, 2);
  }
}

TEST(SeenParts, matricesThatLeaveAnArea) {
  const auto scaled = [](float x, float y, float z) {
    glm::mat4 m(1.0f);
    m[0][0] = x, m[1][1] = y, m[2][2] = z;
    return m;
  };
  for (const glm::mat4& m : {scaled(1, 1, 1), scaled(-1, 2, 3), scaled(1, 1, 0), scaled(0, 1e-6f, 1e-6f),
                             scaled(1e-9f, 1e-9f, 1e-9f), scaled(1e9f, 1e9f, 1)})
    EXPECT_TRUE(scene::keepsArea(m));
  for (const glm::mat4& m : {scaled(0, 0, 0), scaled(1, 0, 0), scaled(0, 0, -2)})
    EXPECT_FALSE(scene::keepsArea(m));
}

}  // namespace
}  // namespace scumble
