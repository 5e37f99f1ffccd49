// What an editor refuses, and what scenes share.
#include "scumble/scene_editor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "scene/extras.h"
#include "scene/scene_data.h"
#include "tests/support/loaded_test_gltf.h"
#include "tests/support/test_gltf.h"

namespace scumble {
namespace {

const std::vector<glm::vec3> kTriangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

std::string refusal(const Status& status) {
  if (status) return "";
  EXPECT_EQ(status.error().kind, ErrorKind::usage);
  EXPECT_FALSE(status.error().advice.empty());
  return status.error().problem;
}

template <class T>
std::string refusal(const Result<T>& result) {
  return result ? "" : refusal(Status(result.error()));
}

// A cloth that a program bends from frame to frame: its pattern stays where it was, and so do its vertices.
TEST(SceneEditor, patternsStayOnWhatIsBent) {
  SceneEditor editor("cloth");
  constexpr uint32_t kSide = 16;
  std::vector<uint32_t> indices;
  for (uint32_t i = 0; i + kSide + 1 < kSide * kSide; ++i)
    if (i % kSide != kSide - 1)
      indices.insert(indices.end(), {i, i + 1, i + kSide + 1, i, i + kSide + 1, i + kSide});
  const auto cloth = [&](float time) {
    std::vector<glm::vec3> positions;
    for (uint32_t i = 0; i < kSide * kSide; ++i) {
      const glm::vec2 at = glm::vec2(i % kSide, i / kSide) / float(kSide - 1);
      positions.push_back({at.x, at.y, 0.4f * std::sin(9 * at.x + time) * std::cos(7 * at.y - time)});
    }
    return positions;
  };
  const std::vector<glm::vec3> normals(kSide * kSide, {0, 0, 1});
  const auto primitive = [&] { return editor.scene()->data().meshes[0]->primitives[0]; };
  const std::vector<glm::vec3> first = cloth(0);
  const MeshId mesh = *editor.addMesh({{.positions = first, .indices = indices, .normals = normals}});
  ASSERT_TRUE(editor.addNode({.name = "cloth", .mesh = mesh}).ok());
  const scene::Primitive before = primitive();
  for (const float time : {0.1f, 0.7f, 2.0f}) {
    const std::vector<glm::vec3> bent = cloth(time);
    ASSERT_TRUE(editor.setMesh(mesh, {{.positions = bent, .indices = indices, .normals = normals}}).ok());
    const scene::Primitive now = primitive();
    EXPECT_EQ(now.uv0, before.uv0);
    EXPECT_EQ(now.indices, before.indices);
    EXPECT_NE(now.positions, before.positions);
  }
  // Other triangles have a mapping of their own.
  std::swap(indices[0], indices[1]), std::swap(indices[1], indices[2]);
  ASSERT_TRUE(editor.setMesh(mesh, {{.positions = first, .indices = indices, .normals = normals}}).ok());
  EXPECT_NE(primitive().indices, before.indices);
}

TEST(SceneEditor, isASceneOfItsParts) {
  SceneEditor editor("parts");
  const MeshId mesh = *editor.addMesh({{.positions = kTriangle}});
  const NodeId up = *editor.addNode({.name = "up", .transform = glm::translate(glm::mat4(1.0f), {0, 5, 0})});
  const NodeId node = *editor.addNode({.name = "leaf", .parent = up, .mesh = mesh});
  EXPECT_EQ(editor.findNode("leaf"), node);
  EXPECT_EQ(editor.findNode("up/leaf"), node);
  EXPECT_EQ(editor.findNode("down"), NodeId::none);
  const SceneSummary s = editor.scene()->summary();
  EXPECT_EQ(s.triangles, 1u);
  EXPECT_EQ(s.vertices, 3u);
  EXPECT_EQ(s.nodeNames, (std::vector<std::string>{"up", "leaf"}));
  EXPECT_EQ(s.min[1], 5);
  EXPECT_EQ(s.max[1], 6);
  ASSERT_TRUE(editor.setVisible(up, false).ok());
  EXPECT_TRUE(editor.scene()->data().bounds.empty);
  const glm::mat4 instances[] = {glm::mat4(1.0f), glm::translate(glm::mat4(1.0f), {0, 0, 7})};
  ASSERT_TRUE(editor.setVisible(up, true).ok());
  ASSERT_TRUE(editor.setInstances(node, instances).ok());
  EXPECT_EQ(editor.scene()->summary().max[2], 7);
}

// Scenes that were given stay as they are, and share what did not change.
TEST(SceneEditor, scenesStay) {
  SceneEditor editor;
  const uint8_t pixel[4] = {1, 2, 3, 255}, other[4] = {9, 9, 9, 255};
  const TextureId texture = *editor.addTexture({"t", 1, 1, pixel});
  const MeshId mesh = *editor.addMesh({{.positions = kTriangle}});
  const NodeId node = *editor.addNode({.mesh = mesh});
  const Scene first = *editor.scene();
  EXPECT_EQ(&editor.scene()->data(), &first.data()) << "nothing has changed";
  ASSERT_TRUE(editor.setTransform(node, glm::translate(glm::mat4(1.0f), {3, 0, 0})).ok());
  ASSERT_TRUE(editor.setTexture(texture, {"t", 1, 1, other}).ok());
  const Scene second = *editor.scene();
  EXPECT_EQ(first.summary().min[0], 0);
  EXPECT_EQ(second.summary().min[0], 3);
  EXPECT_EQ(&*first.data().meshes[0], &*second.data().meshes[0]);
  EXPECT_EQ(first.data().images[0]->rgba[0], 1);
  EXPECT_EQ(second.data().images[0]->rgba[0], 9);
  EXPECT_EQ(first.data().family, second.data().family);
  EXPECT_NE(SceneEditor(first).scene()->data().family, first.data().family);
}

TEST(SceneEditor, refusesArraysThatDoNotFit) {
  SceneEditor editor;
  const auto mesh = [&](const MeshPart& part) { return refusal(editor.addMesh({part})); };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<uint32_t> outside = {0, 1, 3}, two = {0, 1};
  const std::vector<glm::vec3> broken = {{0, 0, 0}, {1, nan, 0}, {0, 1, 0}},
                               far = {{0, 0, 0}, {2e15f, 0, 0}, {0, 1, 0}};
  const std::vector<glm::vec2> uvs = {{0, 0}, {1, 0}};
  const std::vector<float> scales = {1, 2, 65};
  EXPECT_EQ(refusal(editor.addMesh({})), "mesh: it has no parts");
  EXPECT_EQ(mesh({}), "part 0 of the mesh: it has no positions");
  EXPECT_EQ(mesh({.positions = kTriangle, .indices = outside}),
            "part 0 of the mesh: indices[2] is no vertex");
  EXPECT_EQ(mesh({.positions = kTriangle, .indices = two}),
            "part 0 of the mesh: 2 corners make no triangles");
  EXPECT_EQ(mesh({.positions = broken}), "part 0 of the mesh: positions[1] is not finite");
  EXPECT_EQ(mesh({.positions = far}), "part 0 of the mesh: positions[1] is out of range");
  EXPECT_EQ(mesh({.positions = kTriangle, .normals = broken}),
            "part 0 of the mesh: normals[1] is not finite");
  EXPECT_EQ(mesh({.positions = kTriangle, .uv0 = uvs}), "part 0 of the mesh: there are 2 uv0 for 3 vertices");
  EXPECT_EQ(mesh({.positions = kTriangle, .warpScales = scales}),
            "part 0 of the mesh: a warp scale is out of range");
  EXPECT_EQ(mesh({.positions = kTriangle, .material = MaterialId(1)}),
            "part 0 of the mesh: there is no material 1");
  EXPECT_EQ(editor.scene()->summary().meshes, 0u) << "nothing was added";

  const std::vector<uint8_t> bytes(16);
  EXPECT_EQ(refusal(editor.addTexture({"", 0, 4, bytes})), "texture: a size of 0x4 is out of range");
  EXPECT_EQ(refusal(editor.addTexture({"", 16385, 1, bytes})), "texture: a size of 16385x1 is out of range");
  EXPECT_EQ(refusal(editor.addTexture({"", 2, 1, bytes})), "texture: there are 16 bytes for 2x1 pixels");
  EXPECT_EQ(refusal(editor.addTexture({"", 2, 2, bytes})), "");
}

TEST(SceneEditor, refusesNumbersThatMakeNoSense) {
  SceneEditor editor;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(refusal(editor.addMaterial({.baseColor = {1, 2, 0, 1}})),
            "material: its base colour is out of range");
  EXPECT_EQ(refusal(editor.addMaterial({.emissive = {0, nan, 0}})),
            "material: what it emits is out of range");
  EXPECT_EQ(refusal(editor.addMaterial({.shadowedColor = glm::vec3(-1)})),
            "material: its colour in shadow is out of range");
  MaterialDesc textured;
  textured.baseColorTexture.texture = TextureId(0);
  EXPECT_EQ(refusal(editor.addMaterial(textured)), "material: there is no texture 0");
  EXPECT_EQ(refusal(editor.setMaterial(MaterialId(1), {})), "there is no material 1");
  EXPECT_EQ(refusal(editor.material(MaterialId(-1))), "there is no material -1");
  EXPECT_EQ(editor.findMaterial("Gold"), std::nullopt);

  const NodeId node = *editor.addNode({});
  glm::mat4 perspective(1.0f), broken(1.0f);
  perspective[2][3] = 1, broken[3][0] = nan;
  for (const glm::mat4& m : {perspective, broken}) {
    EXPECT_EQ(refusal(editor.setTransform(node, m)), "the transform is not affine, or not finite");
    EXPECT_EQ(refusal(editor.addNode({.transform = m})), "the node's transform is not affine, or not finite");
    EXPECT_EQ(refusal(editor.setInstances(node, {&m, 1})),
              "an instance's transform is not affine, or not finite");
  }
  EXPECT_EQ(refusal(editor.addNode({.parent = NodeId(5)})), "there is no node 5");
  EXPECT_EQ(refusal(editor.addNode({.mesh = MeshId(0)})), "there is no mesh 0");
  EXPECT_EQ(refusal(editor.setTransform(NodeId(1), glm::mat4(1.0f))), "there is no node 1");
  EXPECT_EQ(refusal(editor.setVisible(NodeId::none, true)), "there is no node -1");
  EXPECT_EQ(refusal(editor.setMesh(node, MeshId(0))), "there is no mesh 0");
  EXPECT_EQ(refusal(editor.setMesh(MeshId(0), {})), "there is no mesh 0");
  EXPECT_EQ(refusal(editor.setTexture(TextureId(0), {})), "there is no texture 0");
  EXPECT_EQ(editor.meshOf(NodeId(9)), MeshId::none);
  EXPECT_EQ(editor.nameOf(NodeId(9)), "");
  EXPECT_EQ(editor.parentOf(NodeId(9)), NodeId::none);
  EXPECT_EQ(editor.transformOf(NodeId::none), glm::dmat4(1.0));
  LightDesc light;
  light.innerCone = 1;
  EXPECT_EQ(refusal(editor.setLight(node, light)), "light: its cones are out of range");
  light = {.intensity = -1};
  EXPECT_EQ(refusal(editor.setLight(node, light)), "light: its colour, intensity or range is out of range");

  // Each is in range, and together they are not.
  const MeshId mesh = *editor.addMesh({{.positions = kTriangle}});
  NodeId parent = node;
  for (int i = 0; i < 4; ++i)
    parent = *editor.addNode(
        {.parent = parent, .transform = glm::scale(glm::mat4(1.0f), glm::vec3(1e13f)), .mesh = mesh});
  EXPECT_NE(refusal(editor.scene()), "");
}

TEST(SceneEditor, whatHasNoAreaTakesUpNoSpace) {
  SceneEditor editor;
  const std::vector<glm::vec3> line = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const MeshId mesh = *editor.addMesh({{.positions = kTriangle}}),
               thin = *editor.addMesh({{.positions = line}});
  ASSERT_TRUE(editor.addNode({.mesh = mesh}).ok());
  ASSERT_TRUE(editor.addNode({.transform = glm::translate(glm::mat4(1.0f), {100, 0, 0}), .mesh = thin}).ok());
  const Scene scene = *editor.scene();
  EXPECT_EQ(scene.summary().max[0], 1);
  EXPECT_TRUE(scene.warnings().empty());
}

// A lamp that blinks is one lamp.
TEST(SceneEditor, lightsAreUsedAgain) {
  SceneEditor editor;
  const NodeId node = *editor.addNode({}), other = *editor.addNode({});
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(editor.setLight(node, LightDesc{.intensity = 2}).ok());
    ASSERT_TRUE(editor.setLight(node, std::nullopt).ok());
  }
  ASSERT_TRUE(editor.setLight(other, LightDesc{}).ok());
  ASSERT_TRUE(editor.setLight(node, LightDesc{.intensity = 3}).ok());
  const Scene scene = *editor.scene();
  ASSERT_EQ(scene.data().lights.size(), 2u);
  EXPECT_EQ(scene.data().lights[size_t(scene.data().nodes[0].light)].intensity, 3);
  EXPECT_EQ(scene.data().lights[size_t(scene.data().nodes[1].light)].intensity, 1);
}

TEST(SceneEditor, namesAndExtrasChange) {
  SceneEditor editor;
  const NodeId node = *editor.addNode({.name = "Old"});
  ASSERT_TRUE(editor.setName(node, "New").ok());
  EXPECT_EQ(editor.findNode("Old"), NodeId::none);
  EXPECT_EQ(editor.findNode("New"), node);
  EXPECT_EQ(editor.scene()->data().nodes[0].name, "New");
  EXPECT_EQ(refusal(editor.setName(NodeId(1), "")), "there is no node 1");
  for (const char* wrong : {"[]", "{", "5", "null", "{}{}"})
    EXPECT_EQ(refusal(editor.setExtras(node, wrong)), "extras are no JSON object") << wrong;
  EXPECT_EQ(refusal(editor.setExtras(NodeId(1), "")), "there is no node 1");
  ASSERT_TRUE(editor.setExtras(node, R"({"somebody": 1})").ok());
  EXPECT_TRUE(editor.scene()->data().nodes[0].extras.empty()) << "what no feature knows does not count";
  for (const scene::ExtraRule& rule : scene::extraRules()) {
    const std::string key = rule.key;
    ASSERT_TRUE(editor.setExtras(node, "{\"" + key + "\": true}").ok());
    EXPECT_EQ(editor.scene()->data().nodes[0].extras.count(key), 1u) << key;
    ASSERT_TRUE(editor.setExtras(node, "").ok());
    EXPECT_TRUE(editor.scene()->data().nodes[0].extras.empty()) << key;
    const Scene before = *editor.scene();
    ASSERT_TRUE(editor.setExtras(node, "{\"" + key + "\": \"whatever\"}").ok());
    EXPECT_EQ(editor.scene()->warnings().size(),
              before.warnings().size() + (rule.problemsOf("whatever").empty() ? 0 : 1))
        << key;
  }
}

TEST(SceneEditor, outlinesAreTheMaterialsOwn) {
  SceneEditor editor;
  const MaterialId plain = *editor.addMaterial({});
  EXPECT_EQ(editor.material(plain)->outline, std::nullopt);
  OutlineDesc outline{OutlineDesc::Unit::pictureHeights, 0.01f, {0.1f, 0.2f, 0.3f}, 0.5f};
  const MaterialId lined = *editor.addMaterial({.outline = outline});
  const OutlineDesc got = *editor.material(lined)->outline;
  EXPECT_EQ(got.unit, outline.unit);
  EXPECT_EQ(got.width, outline.width);
  EXPECT_EQ(got.color, outline.color);
  EXPECT_EQ(got.lightingMix, outline.lightingMix);
  outline.width = -1;
  EXPECT_EQ(refusal(editor.setMaterial(lined, {.outline = outline})),
            "material: the width of its outline is out of range");
  outline = {.color = {0, 2, 0}};
  EXPECT_EQ(refusal(editor.setMaterial(lined, {.outline = outline})),
            "material: its outline's colour is out of range");
  outline = {.lightingMix = 2};
  EXPECT_EQ(refusal(editor.setMaterial(lined, {.outline = outline})),
            "material: its outline's lightingMix is out of range");
  EXPECT_EQ(editor.material(lined)->outline->width, 0.01f);
}

// What files have and arrays have not stays as it is.
TEST(SceneEditor, sparesWhatClipsAndJointsMove) {
  scene::TestGltf g = scene::quad();
  g.json["nodes"][0]["name"] = "Walker";
  g.json["animations"] = scene::TestGltf::Json::array(
      {{{"name", "walk"},
        {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
        {"samplers",
         {{{"input", g.addFloats({0, 1}, 1)}, {"output", g.addFloats({0, 0, 0, 1, 0, 0}, 3)}}}}}});
  SceneEditor editor(scene::loaded(g));
  const NodeId walker = editor.findNode("Walker");
  ASSERT_NE(walker, NodeId::none);
  EXPECT_EQ(refusal(editor.setTransform(walker, glm::mat4(1.0f))), "the clip \"walk\" moves node 0");
  EXPECT_EQ(refusal(editor.setVisible(walker, false)), "");
  EXPECT_EQ(editor.scene()->summary().clips.size(), 1u);
}

}  // namespace
}  // namespace scumble
