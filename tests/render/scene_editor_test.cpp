// Scenes from arrays are what files with the same numbers are; a scene that changes is drawn as one that has
// always been so; and only what changed is put on the device.
#include "scumble/scene_editor.h"

#include <algorithm>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "scene/scene_data.h"
#include "tests/support/animated_scene.h"
#include "tests/support/aov.h"
#include "tests/support/render_test.h"

namespace scumble {
namespace {

using namespace test;

MeshPart partOf(const TestMesh& mesh, MaterialId material) {
  return {.positions = mesh.positions,
          .indices = mesh.indices,
          .normals = mesh.normals,
          .uv0 = mesh.uvs,
          .material = material};
}

template <class T>
T must(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message());
  return std::move(result).value();
}

// Arrays of an editor's own, so that spans have something to point at.
struct Checker {
  std::vector<uint8_t> bytes;
  TextureDesc desc;
  explicit Checker(uint32_t size, glm::u8vec3 a = {240, 220, 40}, glm::u8vec3 b = {30, 60, 200}) {
    for (uint32_t i = 0; i < size * size; ++i) {
      const glm::u8vec3 c = (i / size + i % size) % 2 ? a : b;
      bytes.insert(bytes.end(), {c.r, c.g, c.b, 255});
    }
    desc = {"checker", size, size, bytes};
  }
};

// A few things: a floor, a box that hangs below another node, spheres, a pane.
struct Village {
  SceneEditor editor{"village"};
  TextureId checker;
  MaterialId floor, red, pane;
  MeshId ground, box, ball;
  NodeId floorNode, carrier, boxNode, balls, paneNode, lamp;

  Village() {
    checker = must(editor.addTexture(Checker(8).desc));
    MaterialDesc material;
    material.name = "Floor";
    material.baseColorTexture.texture = checker;
    floor = must(editor.addMaterial(material));
    red = must(editor.addMaterial({.name = "Red", .baseColor = {0.7f, 0.1f, 0.1f, 1}}));
    pane = must(editor.addMaterial({.name = "Pane",
                                    .baseColor = {0.2f, 0.5f, 0.8f, 0.5f},
                                    .alpha = MaterialDesc::Alpha::blend,
                                    .doubleSided = true}));
    ground = must(editor.addMesh({partOf(gridMesh({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}, 2), floor)}));
    box = must(editor.addMesh({partOf(boxMesh({-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f}), red)}));
    ball = must(editor.addMesh({partOf(sphereMesh({0, 0, 0}, 0.4f, 12), MaterialId::standard)}));
    const MeshId glass =
        must(editor.addMesh({partOf(gridMesh({-1, 0, 1.5f}, {2, 0, 0}, {0, 1.4f, 0}), pane)}));
    floorNode = must(editor.addNode({.name = "Floor", .mesh = ground}));
    carrier = must(editor.addNode({.name = "Carrier"}));
    boxNode = must(editor.addNode({.name = "Box", .parent = carrier, .mesh = box}));
    balls = must(editor.addNode(
        {.name = "Balls", .transform = glm::translate(glm::mat4(1.0f), {0, 0.5f, 0}), .mesh = ball}));
    paneNode = must(editor.addNode({.name = "Glass", .mesh = glass}));
    lamp = must(editor.addNode({.name = "Lamp", .transform = glm::translate(glm::mat4(1.0f), {1, 2, 1})}));
  }
};

// The default look, with its ground, and these knobs.
Look usualLook(const Knobs& knobs) {
  Look look;
  for (const auto& [path, value] : knobs) EXPECT_TRUE(look.set(path, value).ok()) << path;
  return look;
}

class Edited : public BothEyes {
 protected:
  static constexpr uint32_t kWidth = 72, kHeight = 56;

  static std::vector<View> views(const Scene& scene) {
    return viewsFrom(scene, {{3, 3, 6}, {0, 0.5f, 0}}, kWidth, kHeight, GetParam());
  }
  static Frame drawn(const Scene& scene, const Look& look = Look(), std::vector<std::string> aovs = {}) {
    return draw(scene, look, views(scene), sized(kWidth, kHeight, std::move(aovs)));
  }
  static std::vector<std::string> allAovs() { return Renderer::aovNames(); }
};
INSTANTIATE_BOTH_EYES(Edited);

// Whoever knows no file gives the same numbers by hand.
TEST_P(Edited, arraysAreWhatAFileSays) {
  TestScene file;
  SceneEditor editor("test");
  const TestMesh floor = gridMesh({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}, 3),
                 ball = sphereMesh({0.6f, 0.7f, 0}, 0.7f, 16);
  const TestMesh bare = boxMesh({-1.5f, 0, -0.5f}, {-0.5f, 1, 0.5f});
  Json glass = TestScene::colored("Glass", {0.3f, 0.6f, 0.8f, 0.6f});
  glass["alphaMode"] = "BLEND";
  const int materials[] = {file.material(TestScene::colored("Floor", {0.5f, 0.4f, 0.2f, 1})),
                           file.material(glass),
                           file.material(TestScene::unlit("Bare", {0.1f, 0.6f, 0.2f, 1}))};
  const glm::mat4 turned = glm::rotate(glm::translate(glm::mat4(1.0f), {0, 0.1f, 0}), 0.4f, {0, 1, 0});
  file.add(floor, materials[0]);
  file.add(ball, materials[1], turned);
  file.add(bare, materials[2], turned);
  file.light({1, 2, 1});
  file.json()["meshes"][2]["primitives"][0]["attributes"].erase("TEXCOORD_0");
  const Scene loaded = file.load();
  const scene::SceneData& read = loaded.data();
  const std::vector<glm::dmat4> world = scene::worldMatrices(read);

  const MaterialId own[] = {
      must(editor.addMaterial({.name = "Floor", .baseColor = {0.5f, 0.4f, 0.2f, 1}})),
      must(editor.addMaterial(
          {.name = "Glass", .baseColor = {0.3f, 0.6f, 0.8f, 0.6f}, .alpha = MaterialDesc::Alpha::blend})),
      must(editor.addMaterial({.name = "Bare", .baseColor = {0.1f, 0.6f, 0.2f, 1}, .unlit = true}))};
  must(editor.addNode({.mesh = must(editor.addMesh({partOf(floor, own[0])}))}));
  must(editor.addNode({.transform = world[1], .mesh = must(editor.addMesh({partOf(ball, own[1])}))}));
  MeshPart withoutUvs = partOf(bare, own[2]);
  withoutUvs.uv0 = {};
  must(editor.addNode({.transform = world[2], .mesh = must(editor.addMesh({withoutUvs}))}));
  const scene::Node& lit = read.nodes.back();
  ASSERT_GE(lit.light, 0);
  const NodeId lamp = must(editor.addNode({.transform = world.back()}));
  ASSERT_TRUE(editor
                  .setLight(lamp, LightDesc{.kind = LightDesc::Kind::directional,
                                            .intensity = read.lights[size_t(lit.light)].intensity})
                  .ok());
  expectSame(drawn(loaded, Look(), allAovs()), drawn(must(editor.scene()), Look(), allAovs()), "arrays");
}

// After any number of changes a frame is the one of a scene that was so from the start.
TEST_P(Edited, changesLeaveNothingBehind) {
  Village v;
  SceneEditor& editor = v.editor;
  std::mt19937 random(7 + unsigned(viewCount()));
  std::uniform_real_distribution<float> number(-1, 1);
  const auto place = [&] {
    return glm::rotate(glm::translate(glm::mat4(1.0f), {number(random), 0.2f, number(random)}),
                       3 * number(random), {0, 1, 0});
  };
  const Checker other(8, {200, 40, 40}, {20, 90, 60}), larger(16);
  std::vector<std::pair<std::string, std::function<Status()>>> changes = {
      {"transform", [&] { return editor.setTransform(v.carrier, place()); }},
      {"floor's transform",
       [&] {
         return editor.setTransform(v.floorNode, glm::scale(glm::mat4(1.0f), glm::vec3(2 + number(random))));
       }},
      {"hidden", [&] { return editor.setVisible(v.boxNode, false); }},
      {"hidden with its parent", [&] { return editor.setVisible(v.carrier, false); }},
      {"shown", [&] { return editor.setVisible(v.carrier, true); }},
      {"shown too", [&] { return editor.setVisible(v.boxNode, true); }},
      {"pane hidden", [&] { return editor.setVisible(v.paneNode, false); }},
      {"pane shown", [&] { return editor.setVisible(v.paneNode, true); }},
      {"texture", [&] { return editor.setTexture(v.checker, other.desc); }},
      {"larger texture", [&] { return editor.setTexture(v.checker, larger.desc); }},
      {"colour",
       [&] {
         return editor.setMaterial(v.red, {.name = "Red", .baseColor = {0.1f, 0.6f, 0.3f, 1}});
       }},
      {"textured",
       [&] {
         MaterialDesc material{.name = "Red"};
         material.baseColorTexture.texture = v.checker;
         material.emissiveTexture = {.texture = v.checker, .nearest = true};
         material.emissive = glm::vec3(0.2f);
         return editor.setMaterial(v.red, material);
       }},
      {"blended",
       [&] {
         return editor.setMaterial(
             v.red,
             {.name = "Red", .baseColor = {0.1f, 0.2f, 0.3f, 0.5f}, .alpha = MaterialDesc::Alpha::blend});
       }},
      {"opaque pane", [&] { return editor.setMaterial(v.pane, {.name = "Pane", .doubleSided = true}); }},
      {"instances",
       [&] {
         const glm::mat4 three[] = {place(), place(), place()};
         return editor.setInstances(v.balls, three);
       }},
      {"as many instances",
       [&] {
         const glm::mat4 three[] = {place(), place(), place()};
         return editor.setInstances(v.balls, three);
       }},
      {"one", [&] { return editor.setInstances(v.balls, {}); }},
      {"mesh of the same size",
       [&] {
         return editor.setMesh(v.box, {partOf(boxMesh({-0.7f, 0, -0.3f}, {0.2f, 1.4f, 0.3f}), v.red)});
       }},
      {"mesh of another size",
       [&] {
         return editor.setMesh(v.box, {partOf(sphereMesh({0, 0.5f, 0}, 0.5f, 8), v.floor)});
       }},
      {"another mesh on a node", [&] { return editor.setMesh(v.boxNode, v.ball); }},
      {"long triangles",
       [&] {
         return editor.setMesh(v.box, {partOf(boxMesh({-2, 0, -0.1f}, {2, 0.2f, 0.1f}), v.red)});
       }},
      {"its own mesh again", [&] { return editor.setMesh(v.boxNode, v.box); }},
      {"no mesh", [&] { return editor.setMesh(v.balls, MeshId::none); }},
      {"lamp",
       [&] {
         return editor.setLight(v.lamp, LightDesc{.color = {1, 0.5f, 0.2f}, .intensity = 8});
       }},
      {"moved lamp",
       [&] {
         return editor.setTransform(v.lamp, glm::translate(glm::mat4(1.0f), {-1, 1, 2}));
       }},
      {"no lamp", [&] { return editor.setLight(v.lamp, std::nullopt); }},
      {"more", [&] {
         const MaterialId gold =
             must(editor.addMaterial({.name = "Gold", .baseColor = {0.8f, 0.6f, 0.1f, 1}}));
         const MeshId mesh = must(editor.addMesh({partOf(sphereMesh({0, 0, 0}, 0.3f, 6), gold)}));
         const auto node =
             editor.addNode({.name = "More", .parent = v.boxNode, .transform = place(), .mesh = mesh});
         return node ? Status(Done{}) : Status(node.error());
       }}};
  const std::vector<Look> looks = {
      Look(), quietLook({{"nodes.Box.palette.saturation", "0.2"}, {"light.shadowWarp", "4"}}),
      quietLook(thoseThere(
          {{"ocean.mode", "on"}, {"ocean.level", "0.3"}, {"ocean.tiles", "1"}, {"ocean.grid", "16"}}))};
  for (int round = 0; round < 3; ++round) {
    for (auto& [what, change] : changes) {
      const Status done = change();
      ASSERT_TRUE(done.ok()) << what << ": " << done.error().message();
      const Scene now = must(editor.scene());
      const Look& look = looks[size_t(round)];
      const std::vector<std::string> seen = {"id", "motion", "shadow-map", "warp"};
      const Frame followed = drawn(now, look, seen);
      // Nobody has drawn this one.
      const Frame fresh = drawn(must(SceneEditor(now).scene()), look, seen);
      expectSame(followed, fresh, what + ", round " + std::to_string(round));
      if (HasFailure()) return;
    }
    std::shuffle(changes.begin(), changes.end(), random);
  }
}

// A mesh of the same size may have what no vertex of the scene had before, and lose it again.
TEST_P(Edited, whatVerticesHaveComesAndGoes) {
  Village v;
  ASSERT_TRUE(
      v.editor.setMaterial(v.red, {.name = "Red", .baseColorTexture = {.texture = v.checker, .uvSet = 1}})
          .ok());
  const TestMesh box = boxMesh({-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f});
  const size_t count = box.positions.size();
  std::vector<glm::vec2> uv1;
  for (const glm::vec2& uv : box.uvs) uv1.push_back(0.3f + 0.2f * uv);
  const std::vector<glm::vec2> onePoint(count, glm::vec2(0.5f));  // patterns need coordinates of their own
  const std::vector<glm::u8vec4> colors(count, {40, 200, 90, 255});
  const std::vector<float> warpScales(count, 4.0f);
  const MeshPart plain = partOf(box, v.red);
  std::vector<std::pair<const char*, MeshPart>> parts(6, {"plain", plain});
  parts[1].first = "second coordinates", parts[1].second.uv1 = uv1;
  parts[2].first = "colours", parts[2].second.colors = colors;
  parts[3].first = "factors", parts[3].second.warpScales = warpScales;
  parts[4].first = "pattern coordinates", parts[4].second.uv0 = onePoint;
  (void)drawn(must(v.editor.scene()));
  for (const auto& [what, part] : parts) {
    ASSERT_TRUE(v.editor.setMesh(v.box, {part}).ok());
    const Scene now = must(v.editor.scene());
    const std::vector<std::string> seen = {"warp"};
    const Frame followed = drawn(now, Look(), seen);
    expectSame(followed, drawn(must(SceneEditor(now).scene()), Look(), seen), what);
  }
}

// What is hidden is as if it were not there.
TEST_P(Edited, hiddenIsNotThere) {
  Village with, without;
  ASSERT_TRUE(with.editor.setVisible(with.carrier, false).ok());
  ASSERT_TRUE(without.editor.setMesh(without.boxNode, MeshId::none).ok());
  const Frame hidden = drawn(must(with.editor.scene())), gone = drawn(must(without.editor.scene()));
  expectSame(hidden, gone, "picture");
  EXPECT_EQ(hidden.stats.drawCalls, gone.stats.drawCalls);
  EXPECT_EQ(hidden.stats.triangles, gone.stats.triangles);
  ASSERT_TRUE(with.editor.setVisible(with.carrier, true).ok());
  EXPECT_FALSE(sameBytes(drawn(must(with.editor.scene())).layers[0].views[0], hidden.layers[0].views[0]));
  // Everything may be.
  for (const NodeId node : {with.floorNode, with.carrier, with.balls, with.paneNode})
    ASSERT_TRUE(with.editor.setVisible(node, false).ok());
  EXPECT_EQ(drawn(must(with.editor.scene())).stats.triangles,
            drawn(must(SceneEditor().scene())).stats.triangles);
}

// Each part goes to the device alone, and most changes put nothing there.
TEST_P(Edited, onlyWhatChangedIsWritten) {
  Village v;
  const auto written = [&] {
    // How long edges may be depends on all that casts shadows, where the shadow map is warped.
    const FrameStats stats = drawn(must(v.editor.scene()), usualLook({{"light.shadowWarp", "0"}})).stats;
    return std::vector<uint32_t>{stats.writtenPrimitives, stats.writtenTextures, stats.writtenMaterials,
                                 stats.pipelines};
  };
  using Counts = std::vector<uint32_t>;
  const Counts first = written();
  EXPECT_EQ(first[0], 7u);  // with the ground and two tones of strokes on it
  EXPECT_EQ(first[1], 1u);
  EXPECT_EQ(first[2], 7u);
  const Counts nothing{0, 0, 0, 0};
  EXPECT_EQ(written(), nothing);
  const glm::mat4 place = glm::translate(glm::mat4(1.0f), {0.3f, 0.1f, 0.2f});
  ASSERT_TRUE(v.editor.setTransform(v.carrier, place).ok());
  EXPECT_EQ(written(), nothing) << "a transform";
  ASSERT_TRUE(v.editor.setVisible(v.boxNode, false).ok());
  EXPECT_EQ(written(), nothing) << "hidden";
  ASSERT_TRUE(v.editor.setVisible(v.boxNode, true).ok());
  EXPECT_EQ(written(), nothing) << "shown";
  ASSERT_TRUE(v.editor.setMaterial(v.red, {.name = "Red", .baseColor = {0.1f, 0.2f, 0.7f, 1}}).ok());
  EXPECT_EQ(written(), nothing) << "a colour";
  ASSERT_TRUE(v.editor.setTexture(v.checker, Checker(8, {1, 2, 3}).desc).ok());
  const Counts texture = written();
  EXPECT_EQ(texture[0], 0u);
  EXPECT_EQ(texture[1], 1u);
  EXPECT_EQ(texture[3], 0u);
  ASSERT_TRUE(v.editor.setMesh(v.box, {partOf(boxMesh({-0.4f, 0, -0.4f}, {0.4f, 0.9f, 0.4f}), v.red)}).ok());
  EXPECT_EQ(written(), Counts({1, 0, 0, 0})) << "a mesh of the same size";
  // The ground lies under everything: it follows what the scene takes up.
  ASSERT_TRUE(v.editor.setTransform(v.floorNode, glm::translate(glm::mat4(1.0f), {0, -1, 0})).ok());
  EXPECT_EQ(written(), Counts({3, 0, 0, 0})) << "the lowest thing";
}

// A knob, or a track on it, writes what is made of it, and nothing else: of the scene mostly nothing.
TEST_P(Edited, looksWriteOnlyWhatIsMadeOfThem) {
  Village v;
  const Scene scene = must(v.editor.scene());
  struct Counts {
    uint32_t primitives, textures, materials, pipelines;
    bool operator==(const Counts&) const = default;
  };
  const Counts nothing{};
  const auto written = [&](const Look& look, double time = 0) {
    const Result<Frame> frame = renderer().render(scene, look, time, views(scene), sized(kWidth, kHeight));
    if (!frame) throw std::runtime_error(frame.error().message());
    const FrameStats& stats = frame->stats;
    return Counts{stats.writtenPrimitives, stats.writtenTextures, stats.writtenMaterials, stats.pipelines};
  };
  const auto tracked = [](const std::string& json) {
    const Result<Look> look = Look::fromJson(json, "tracked");
    if (!look) throw std::runtime_error(look.error().message());
    return *look;
  };
  (void)written(usualLook({{"light.shadowWarp", "0"}}));
  EXPECT_EQ(written(usualLook({{"light.shadowWarp", "0"}, {"palette.litTint", "#ff8030"}})), nothing)
      << "a colour";
  EXPECT_EQ(written(usualLook({{"light.shadowWarp", "0"}, {"materials.Red.palette.saturation", "0.3"}})),
            nothing);

  // Triangles that are too long for the warp are split: floor, box, the pane at most.
  const Look warped = tracked(R"({"light": {"shadowWarp": {"keys": [[0, 0], [1, 6]]}}})");
  uint32_t split = 0;
  for (const double time : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const Counts counts = written(warped, time);
    EXPECT_EQ(counts.textures, 0u);
    EXPECT_EQ(counts.materials, 0u);
    EXPECT_EQ(counts.pipelines, 0u);
    split += counts.primitives;
  }
  EXPECT_GT(split, 0u);
  EXPECT_EQ(written(warped, 1.0), nothing) << "the same as before";

  const Look sea = tracked(R"({"ocean": {"mode": "on", "level": {"keys": [[0, -0.5], [1, -0.2]]}}})");
  (void)written(sea, 0);
  for (const double time : {0.3, 0.6, 1.0}) EXPECT_EQ(written(sea, time), nothing) << "the sea's level";

  // A node's own knobs make a material of its own, once.
  (void)written(usualLook({}));
  const Counts own = written(usualLook({{"nodes.Balls.palette.saturation", "0.2"}}));
  EXPECT_EQ(own.primitives, 0u);
  EXPECT_EQ(own.textures, 0u);
  EXPECT_EQ(own.pipelines, 0u);
  EXPECT_EQ(written(usualLook({{"nodes.Balls.palette.saturation", "0.9"}})), nothing) << "another value";

  // Another step in the frame.
  (void)written(usualLook({}));
  const Counts limited = written(usualLook({{"limit.palette", "dusk"}}));
  EXPECT_EQ(limited, (Counts{0, 0, 0, limited.pipelines}));
  (void)written(usualLook({}));
  EXPECT_EQ(written(usualLook({{"limit.palette", "dusk"}})), nothing) << "switched on again";
}

// Frames of earlier scenes that are still under way are not touched.
TEST_P(Edited, framesUnderWayKeepTheirScene) {
  Village v;
  std::vector<Scene> scenes{must(v.editor.scene())};
  ASSERT_TRUE(v.editor.setTexture(v.checker, Checker(8, {1, 200, 3}).desc).ok());
  scenes.push_back(must(v.editor.scene()));
  ASSERT_TRUE(v.editor.setMesh(v.box, {partOf(boxMesh({-1, 0, -1}, {0.4f, 1.9f, 0.4f}), v.red)}).ok());
  ASSERT_TRUE(v.editor.setTransform(v.carrier, glm::translate(glm::mat4(1.0f), {1, 0, 0})).ok());
  scenes.push_back(must(v.editor.scene()));
  std::vector<Frame> expected;
  for (const Scene& scene : scenes) expected.push_back(drawn(must(SceneEditor(scene).scene())));
  const auto seen = views(scenes[0]);
  for (const Scene& scene : scenes)
    ASSERT_TRUE(renderer().begin(scene, Look(), 0, seen, sized(kWidth, kHeight)).ok());
  for (size_t i = 0; i < scenes.size(); ++i)
    expectSame(must(renderer().finish()), expected[i], std::to_string(i));
}

// Meshes with joints hang anywhere, and go with what is above all their joints.
TEST_P(Edited, carriersOfMeshes) {
  AnimatedScene s;
  const int grey = s.material(TestScene::colored("Grey", {0.5f, 0.5f, 0.5f, 1}));
  const int boat = s.node({{"name", "boat"}}), hips = s.node({{"name", "hips"}}, boat),
            left = s.node({{"name", "left"}}, hips), right = s.node({{"name", "right"}}, hips),
            leftToe = s.node({{"name", "left toe"}}, left), rightToe = s.node({{"name", "right toe"}}, right),
            alone = s.node({{"name", "alone"}});
  const auto bound = [&](const char* name, const std::vector<int>& joints) {
    s.node({{"name", name},
            {"mesh", s.mesh(bendingBar(4), grey)},
            {"skin", s.skin(joints, std::vector<glm::mat4>(joints.size(), glm::mat4(1.0f)))}});
  };
  bound("legs", {left, right, leftToe, rightToe});
  bound("chain", {hips, left, leftToe, right});
  bound("torn", {alone, left, right, leftToe});
  s.node({{"name", "plain"}, {"mesh", s.mesh({sphereMesh({0, 0, 0}, 0.5f, 8)}, grey)}}, boat);
  const SceneEditor editor(s.load());
  const auto carrier = [&](const char* name) {
    return editor.nameOf(editor.carrierOf(editor.findNode(name)));
  };
  EXPECT_EQ(carrier("legs"), "hips");
  EXPECT_EQ(carrier("chain"), "hips");
  EXPECT_EQ(carrier("torn"), "alone");
  EXPECT_EQ(carrier("plain"), "plain");
  EXPECT_EQ(carrier("boat"), "boat");
  EXPECT_EQ(editor.carrierOf(NodeId(99)), NodeId::none);
}

// Motion from one scene to the next is that of a camera which goes the other way.
TEST_P(Edited, motionFromAnEarlierScene) {
  SceneEditor editor;
  const MeshId ball =
      must(editor.addMesh({partOf(sphereMesh({0, 0.7f, 0}, 0.7f, 16), MaterialId::standard)}));
  const NodeId root = must(editor.addNode({})), moved = must(editor.addNode({.parent = root, .mesh = ball}));
  const Scene before = must(editor.scene());
  const glm::vec3 way(0.25f, 0.1f, -0.2f);
  ASSERT_TRUE(editor.setTransform(root, glm::translate(glm::mat4(1.0f), way)).ok());
  const Scene after = must(editor.scene());
  EXPECT_EQ(editor.meshOf(moved), ball);
  EXPECT_EQ(editor.nodeCount(), 2u);
  EXPECT_EQ(editor.parentOf(moved), root);
  EXPECT_EQ(editor.parentOf(root), NodeId::none);
  EXPECT_EQ(editor.transformOf(root), glm::translate(glm::dmat4(1.0), glm::dvec3(way)));
  EXPECT_EQ(editor.transformOf(moved), glm::dmat4(1.0));
  const auto seen = views(after);
  RenderOptions options = sized(kWidth, kHeight, {"motion", "id"});
  options.previousScene = before;
  const Frame byScene = draw(after, quietLook(), seen, options);
  options.previousScene = Scene();
  // Where the camera would have stood for the ball to have seemed as it did.
  options.previousViews = seen;
  for (View& view : options.previousViews)
    view.worldToEye = view.worldToEye * glm::translate(glm::mat4(1.0f), -way);
  const Frame byCamera = draw(after, quietLook(), seen, options);
  for (size_t v = 0; v < seen.size(); ++v) {
    size_t shown = 0;
    for (int y = 0; y < int(kHeight); ++y)
      for (int x = 0; x < int(kWidth); ++x) {
        if (texel(aov(byScene, "id", v), x, y).x == 0) continue;
        ++shown;
        for (int c = 0; c < 2; ++c)
          ASSERT_NEAR(texel(aov(byScene, "motion", v), x, y)[c], texel(aov(byCamera, "motion", v), x, y)[c],
                      2e-3)
              << x << ", " << y;
        ASSERT_GT(glm::length(glm::dvec2(texel(aov(byScene, "motion", v), x, y))), 0.1);
      }
    EXPECT_GT(shown, 100u);
  }
  // Of other scenes nothing is known.
  options.previousViews.clear();
  options.previousScene = must(SceneEditor(before).scene());
  EXPECT_EQ(renderer().render(after, Look(), 0, seen, options).error().kind, ErrorKind::usage);
  must(editor.addNode({}));
  options.previousScene = before;
  EXPECT_EQ(renderer().render(must(editor.scene()), Look(), 0, seen, options).error().kind, ErrorKind::usage);
}

}  // namespace
}  // namespace scumble
