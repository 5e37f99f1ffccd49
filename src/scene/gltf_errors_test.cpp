// What makes a file unusable, what is only a warning, and that every message says where.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scene/gltf_uri.h"
#include "scene/import_failure.h"
#include "scene/scene_data.h"
#include "scene/test_gltf.h"
#include "scumble/scene.h"

namespace scumble::scene {
namespace {

using Json = TestGltf::Json;

Result<Scene> load(const std::string& text, const SceneOptions& options = {}) {
  return Scene::loadFromMemory(text.data(), text.size(), "test.gltf", "", options);
}

// The error's JSON path, after checks that hold for every error; "loaded" when there is none.
std::string failingPath(const std::string& text) {
  const Result<Scene> scene = load(text);
  if (scene) return "loaded";
  EXPECT_EQ(scene.error().kind, ErrorKind::unusableFile);
  EXPECT_EQ(scene.error().file, "test.gltf");
  EXPECT_FALSE(scene.error().problem.empty());
  EXPECT_EQ(scene.error().message().find('\n'), std::string::npos);
  return scene.error().jsonPath;
}

TestGltf quad() {
  TestGltf g;
  g.addQuad();
  return g;
}

TEST(GltfErrors, jsonMistakesHaveALine) {
  const Result<Scene> scene = load("{\n  \"asset\": {\n    \"version\": \"2.0\",\n  }\n}");
  ASSERT_FALSE(scene.ok());
  EXPECT_EQ(scene.error().line, 4);
  EXPECT_EQ(scene.error().message().substr(0, 12), "test.gltf:4:");
  std::string deep = "{\"a\":";
  deep.append(100000, '[');
  EXPECT_FALSE(load(deep).ok());
  EXPECT_FALSE(load("").ok());
  EXPECT_FALSE(load("solid cube").ok());
  EXPECT_FALSE(load("{\"asset\":{\"version\":\"2.0\"},\"x\":1e999}").ok());
}

TEST(GltfErrors, indicesOutOfRange) {
  TestGltf g = quad();
  g.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 99;
  EXPECT_EQ(failingPath(g.glb()), "meshes[0].primitives[0].attributes.POSITION");
  g = quad();
  g.json["meshes"][0]["primitives"][0]["material"] = 0;
  EXPECT_EQ(failingPath(g.glb()), "meshes[0].primitives[0].material");
  g = quad();
  g.json["meshes"][0]["primitives"][0]["indices"] = g.addIndices({0, 1, 4});
  EXPECT_EQ(failingPath(g.glb()), "meshes[0].primitives[0].indices");
  g = quad();
  g.json["nodes"][0]["mesh"] = -1;
  EXPECT_EQ(failingPath(g.glb()), "nodes[0].mesh");
  g = quad();
  g.json["scene"] = 5;
  EXPECT_EQ(failingPath(g.glb()), "scene");
}

TEST(GltfErrors, bytesOutOfRange) {
  TestGltf g = quad();
  g.json["accessors"][0]["count"] = 1000;
  EXPECT_EQ(failingPath(g.glb()), "accessors[0]");
  g.json["accessors"][0]["count"] = 4000000000u;
  EXPECT_EQ(failingPath(g.glb()), "accessors[0]");
  g.json["accessors"][0].erase("bufferView");
  EXPECT_EQ(failingPath(g.glb()), "accessors[0]");
  g = quad();
  g.json["bufferViews"][0]["byteOffset"] = 1 << 20;
  EXPECT_EQ(failingPath(g.glb()), "bufferViews[0]");
  g = quad();
  g.json["bufferViews"][0]["byteOffset"] = 18446744073709551615ull;
  EXPECT_EQ(failingPath(g.glb()), "bufferViews[0].byteOffset");
  g = quad();
  Json whole = Json::parse(g.gltf());
  whole["buffers"][0]["byteLength"] = 1 << 20;
  EXPECT_EQ(failingPath(whole.dump()), "buffers[0]");
  whole["buffers"][0]["uri"] = "data:application/octet-stream;base64,A!";
  EXPECT_EQ(failingPath(whole.dump()), "buffers[0].uri");
}

TEST(GltfErrors, sparseOutOfRange) {
  TestGltf g = quad();
  const int indices = g.addView<uint8_t>({200}), values = g.addView<float>({5, 0, 0});
  g.json["accessors"][0]["sparse"] = {{"count", 1},
                                      {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                      {"values", {{"bufferView", values}}}};
  EXPECT_EQ(failingPath(g.glb()), "accessors[0].sparse.indices");
  g.json["accessors"][0]["sparse"]["count"] = 3;
  EXPECT_EQ(failingPath(g.glb()), "accessors[0].sparse.indices");
}

TEST(GltfErrors, manyUsesOfTheSameBytesAreBounded) {
  TestGltf g;
  const int position = g.addFloats(std::vector<float>(3 * 100000, 0.5f), 3);
  g.addMesh({{"POSITION", position}});
  const Json primitive = g.json["meshes"][0]["primitives"][0];
  for (int i = 0; i < 2000; ++i) g.json["meshes"][0]["primitives"].push_back(primitive);
  const Result<Scene> scene = load(g.glb());
  ASSERT_FALSE(scene.ok());
}

TEST(GltfErrors, nodeTrees) {
  TestGltf g = quad();
  g.json["nodes"][0]["children"] = {0};
  EXPECT_EQ(failingPath(g.glb()), "nodes[0].children[0]");
  g.json["nodes"] = {{{"children", {1}}}, {{"children", {0}}}, {{"mesh", 0}}};
  EXPECT_EQ(failingPath(g.glb()), "nodes[0]");
  g.json["nodes"] = {{{"children", {2}}}, {{"children", {2}}}, {{"mesh", 0}}};
  EXPECT_EQ(failingPath(g.glb()), "nodes[1].children[0]");
  g.json["nodes"] = {{{"mesh", 0}, {"scale", {1e30, 1, 1}}, {"children", {1}}}, {{"scale", {1e30, 1, 1}}}};
  EXPECT_EQ(failingPath(g.glb()), "nodes");
}

TEST(GltfErrors, deepTreesAreFine) {
  TestGltf g = quad();
  g.json["nodes"] = Json::array();
  constexpr int kDepth = 50000;
  for (int i = 0; i < kDepth; ++i) g.json["nodes"].push_back({{"children", {i + 1}}});
  g.json["nodes"].push_back({{"mesh", 0}});
  const Result<Scene> scene = load(g.glb());
  ASSERT_TRUE(scene.ok()) << scene.error().message();
  EXPECT_EQ(scene->summary().nodes, kDepth + 1u);
}

TEST(GltfErrors, versionsAndExtensions) {
  TestGltf g = quad();
  g.json["asset"]["version"] = "1.0";
  EXPECT_EQ(failingPath(g.glb()), "asset.version");
  g.json["asset"]["version"] = "2.0";
  g.json["asset"]["minVersion"] = "2.1";
  EXPECT_EQ(failingPath(g.glb()), "asset.minVersion");
  g = quad();
  g.json["extensionsUsed"] = {"ACME_paint", "KHR_texture_transform"};
  const Result<Scene> used = load(g.glb());
  ASSERT_TRUE(used.ok());
  EXPECT_EQ(used->warnings().size(), 1u);
  EXPECT_EQ(used->summary().extensionsNotSupported, std::vector<std::string>{"ACME_paint"});
  g.json["extensionsRequired"] = {"KHR_texture_basisu", "ACME_paint"};
  EXPECT_EQ(failingPath(g.glb()), "extensionsRequired[1]");
}

TEST(GltfErrors, uris) {
  Json whole = Json::parse(quad().gltf());
  for (const char* uri : {"http://example.org/a.bin", "HTTPS://x", "file:///etc/passwd", "../a.bin",
                          "/etc/passwd", "a/../../b.bin", "%2e%2e/a.bin", "%2Fetc/passwd", "a%00b"}) {
    whole["buffers"][0]["uri"] = uri;
    EXPECT_EQ(failingPath(whole.dump()), "buffers[0].uri") << uri;
  }
  whole = Json::parse(quad().gltf());
  whole["images"] = {{{"uri", "http://example.org/unused.png"}}};
  EXPECT_EQ(failingPath(whole.dump()), "images[0].uri");
  EXPECT_EQ(resolveFileUri("a%20b/./c.bin", "folder", false, ""), "folder/a b/c.bin");
  EXPECT_EQ(resolveFileUri("x/../c.bin", "folder", false, ""), "folder/c.bin");
  EXPECT_EQ(resolveFileUri("../c.bin", "folder", true, ""), "folder/../c.bin");
  EXPECT_EQ(resolveFileUri("100%.bin", "folder", false, ""), "folder/100%.bin");
  EXPECT_THROW(resolveFileUri("", "folder", false, ""), ImportFailure);
}

TEST(GltfErrors, filesBesideTheScene) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "scumble scene test";
  std::filesystem::create_directories(folder / "sub");
  const TestGltf g = quad();
  Json whole = Json::parse(g.gltf());
  whole["buffers"][0]["uri"] = "sub/my%20data.bin";
  std::ofstream(folder / "sub" / "my data.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(g.bytes.data()), static_cast<std::streamsize>(g.bytes.size()));
  std::ofstream(folder / "scene.gltf") << whole.dump();
  const Result<Scene> good = Scene::load((folder / "scene.gltf").string());
  EXPECT_TRUE(good.ok()) << good.error().message();

  whole["buffers"][0]["uri"] = "../outside.bin";
  std::filesystem::copy_file(folder / "sub" / "my data.bin", folder / "outside.bin",
                             std::filesystem::copy_options::overwrite_existing);
  std::ofstream(folder / "sub" / "scene.gltf") << whole.dump();
  EXPECT_FALSE(Scene::load((folder / "sub" / "scene.gltf").string()).ok());
  SceneOptions outside;
  outside.allowOutside = true;
  EXPECT_TRUE(Scene::load((folder / "sub" / "scene.gltf").string(), outside).ok());
  EXPECT_FALSE(Scene::load((folder / "sub").string()).ok());
  EXPECT_FALSE(Scene::load("/dev/null").ok());
  EXPECT_FALSE(Scene::load("/no/such/file.glb").ok());
  std::filesystem::remove_all(folder);
}

TEST(GltfErrors, glbContainers) {
  const std::string good = quad().glb();
  EXPECT_EQ(failingPath(good), "loaded");
  for (size_t size = 0; size < good.size(); size += 7)
    EXPECT_NE(failingPath(good.substr(0, size)), "loaded") << size;
  std::string bad = good;
  bad[4] = 1;
  EXPECT_NE(failingPath(bad), "loaded");
  bad = good;
  bad[15] = 0x7f;
  EXPECT_NE(failingPath(bad), "loaded");
  bad = good;
  bad[16] = 'X';
  EXPECT_NE(failingPath(bad), "loaded");
  const Result<Scene> longer = load(good + "tail");
  ASSERT_TRUE(longer.ok());
  EXPECT_EQ(longer->warnings().size(), 1u);
}

TEST(GltfErrors, nothingToDraw) {
  EXPECT_NE(failingPath("{\"asset\":{\"version\":\"2.0\"}}"), "loaded");
  TestGltf g = quad();
  g.json["meshes"][0]["primitives"][0]["mode"] = 1;
  EXPECT_NE(failingPath(g.glb()), "loaded");
}

TEST(GltfErrors, whatIsOptionalIsOnlyAWarning) {
  TestGltf g = quad();
  g.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", "wide"}, {"znear", 0.1}}}}};
  g.json["nodes"][0]["camera"] = 0;
  g.json["nodes"][0]["skin"] = 3;
  g.json["animations"] = {{{"channels", {{{"sampler", 7}, {"target", {{"node", 0}, {"path", "rotation"}}}}}},
                           {"samplers", Json::array()}}};
  g.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 4}}}}}}};
  g.json["meshes"][0]["primitives"][0]["material"] = 0;
  const Result<Scene> scene = load(g.glb());
  ASSERT_TRUE(scene.ok()) << scene.error().message();
  EXPECT_EQ(scene->warnings().size(), 4u);
  EXPECT_EQ(scene->data().nodes[0].camera, -1);
  const TextureUse& texture = scene->data().materials[1].baseColorTexture;
  ASSERT_EQ(texture.image, 0);
  EXPECT_TRUE(scene->data().images[0].standIn);
}

}  // namespace
}  // namespace scumble::scene
