// What makes a file unusable, what is only a warning, and that every message says where.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

#include "base/test_folder.h"
#include "gltf/uri.h"
#include "scene/animation.h"
#include "scene/import_failure.h"
#include "scene/scene_data.h"
#include "scumble/scene.h"
#include "tests/support/loaded_test_gltf.h"

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
  whole["images"] = {{{"uri", "file:///unused.png"}}};
  EXPECT_EQ(failingPath(whole.dump()), "images[0].uri");
  EXPECT_EQ(gltf::resolveFileUri("a%20b/./c.bin", "folder", false, ""), "folder/a b/c.bin");
  EXPECT_EQ(gltf::resolveFileUri("x/../c.bin", "folder", false, ""), "folder/c.bin");
  EXPECT_EQ(gltf::resolveFileUri("../c.bin", "folder", true, ""), "folder/../c.bin");
  EXPECT_EQ(gltf::resolveFileUri("100%.bin", "folder", false, ""), "folder/100%.bin");
  EXPECT_THROW(gltf::resolveFileUri("", "folder", false, ""), ImportFailure);
  EXPECT_THROW(gltf::resolveFileUri("?v=2", "folder", false, ""), ImportFailure);
  EXPECT_THROW(gltf::resolveFileUri("..\\a.bin", "folder", false, ""), ImportFailure);
  EXPECT_THROW(gltf::resolveFileUri("a\\..\\..\\b.bin?x", "folder", false, ""), ImportFailure);
}

// As exporters and servers write them; but a file of just that name is meant before all.
TEST(GltfErrors, urisOfOtherWriters) {
  const TestFolder made;
  const std::string folder = made.path();
  for (const char* uri : {"textures\\back.png", "textures/back.png?v=2", "textures/back.png#part",
                          "textures%5Cback.png", ".\\textures\\back.png?a=b?c", "textures//back.png"})
    EXPECT_EQ(gltf::resolveFileUri(uri, folder, false, ""), folder + "/textures/back.png") << uri;
  for (const char* name : {"q.png?v=2", "tex#1.png", "back\\slash.png"}) {
    std::ofstream(made.file(name)) << "x";
    EXPECT_EQ(gltf::resolveFileUri(name, folder, false, ""), folder + "/" + name);
  }
  const std::vector<uint8_t> bytes{1, 2, 3, 250};
  for (const char* uri :
       {"data:application/octet-stream;base64,AQID+g==", "DATA:application/octet-stream;BASE64,AQID+g==",
        "data:;base64,AQ\r\nID\n+g==\n", "data:;base64,AQID%2Bg%3D%3D", "data:;base64,AQID-g",
        "data:;base64 ,AQID+g", "data:,%01%02%03%FA", "data:a/b;charset=x;base64,AQID+g=="}) {
    EXPECT_TRUE(gltf::isDataUri(uri)) << uri;
    EXPECT_EQ(gltf::decodeDataUri(uri, ""), bytes) << uri;
  }
  for (const char* uri : {"data:;base64", "data:;base64,A*ID", "data:;base64,AQ==ID"})
    EXPECT_THROW(gltf::decodeDataUri(uri, ""), ImportFailure) << uri;
}

// Pictures may lie on the network, where nobody asks for them: a stand-in, and a word for all of them.
TEST(GltfErrors, imagesOnTheNetwork) {
  TestGltf g = quad();
  g.json["images"] = {{{"uri", "https://vr.example/a.png"}}, {{"uri", "HTTP://vr.example/b.png"}}};
  g.json["textures"] = {{{"source", 0}}, {{"source", 1}}};
  g.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                          {"emissiveTexture", {{"index", 1}}}}};
  g.json["meshes"][0]["primitives"][0]["material"] = 0;
  const Result<Scene> scene = load(g.glb());
  ASSERT_TRUE(scene.ok()) << scene.error().message();
  ASSERT_EQ(scene->data().images.size(), 2u);
  for (const scene::TextureImage& image : scene->data().images) EXPECT_TRUE(image.standIn);
  ASSERT_EQ(scene->warnings().size(), 1u);
  EXPECT_NE(scene->warnings()[0].find("network"), std::string::npos);
}

TEST(GltfErrors, filesBesideTheScene) {
  const TestFolder made;
  const std::filesystem::path folder = made.path();
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
  EXPECT_TRUE(scene->data().images[0]->standIn);
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                kInfinity = std::numeric_limits<float>::infinity();

// A quad with two morph targets and a clip of one channel.
TestGltf clipOf(const char* path, int components, const std::vector<float>& times,
                const std::vector<float>& values, const char* interpolation = "LINEAR") {
  TestGltf g = quad();
  const int target = g.addFloats(std::vector<float>(12, 0.5f), 3);
  g.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", target}}, {{"POSITION", target}}};
  const int input = g.addFloats(times, 1), output = g.addFloats(values, components);
  g.json["animations"] = {
      {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}},
       {"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}}}};
  return g;
}

// Loads with so many warnings; every pose is a matrix of finite numbers.
SceneData warned(const TestGltf& g, size_t warnings, const char* what) {
  const Result<Scene> scene = load(g.glb());
  EXPECT_TRUE(scene.ok()) << what << ": " << scene.error().message();
  if (!scene) return {};
  EXPECT_EQ(scene->warnings().size(), warnings) << what;
  for (const std::string& line : scene->warnings()) {
    if (scene->warnings().size() != warnings) ADD_FAILURE() << what << ": " << line;
    EXPECT_EQ(line.find('\n'), std::string::npos);
  }
  for (int clip = 0; clip < int(scene->data().clips.size()); ++clip)
    for (const double time : {-1.0, 0.0, 0.4, 1.0, 7.3}) {
      const PlayedClip played{clip};
      const Pose pose = poseAt(scene->data(), {&played, 1}, time);
      for (const glm::dmat4& world : pose.world)
        for (int i = 0; i < 16; ++i) EXPECT_TRUE(std::isfinite(world[i / 4][i % 4])) << what;
      for (const std::vector<float>& weights : pose.morphWeights)
        for (const float weight : weights) EXPECT_TRUE(std::isfinite(weight)) << what;
    }
  return scene->data();
}

TEST(GltfErrors, timesOfClips) {
  const auto keys = [](const std::vector<float>& times, const std::vector<float>& xs, size_t warnings,
                       const char* what) {
    std::vector<float> values;
    for (const float x : xs) values.insert(values.end(), {x, 0, 0});
    const SceneData scene = warned(clipOf("translation", 3, times, values), warnings, what);
    std::vector<float> kept;
    if (scene.clips.size() == 1)
      for (size_t k = 0; k < scene.clips[0].channels[0].times.size(); ++k) {
        kept.push_back(scene.clips[0].channels[0].times[k]);
        kept.push_back(scene.clips[0].channels[0].values[3 * k]);
      }
    return kept;
  };
  using List = std::vector<float>;
  EXPECT_EQ(keys({0, 1, 2}, {5, 6, 7}, 0, "good"), (List{0, 5, 1, 6, 2, 7}));
  EXPECT_EQ(keys({2, 0, 1}, {7, 5, 6}, 1, "unsorted"), (List{0, 5, 1, 6, 2, 7}));
  EXPECT_EQ(keys({0, 1, 1, 2}, {5, 6, 9, 7}, 1, "doubled"), (List{0, 5, 1, 6, 2, 7}));
  EXPECT_EQ(keys({0, kNan, 2}, {5, 6, 7}, 1, "a time that is no number"), (List{0, 5, 2, 7}));
  EXPECT_EQ(keys({0, 1, kInfinity}, {5, 6, 7}, 1, "an infinite time"), (List{0, 5, 1, 6}));
  EXPECT_EQ(keys({0, 1, 2}, {5, kNan, 7}, 1, "a value that is no number"), (List{0, 5, 2, 7}));
  EXPECT_EQ(keys({0, 1, 2}, {5, kInfinity, 7}, 1, "an infinite value"), (List{0, 5, 2, 7}));
  EXPECT_EQ(keys({kNan, kNan}, {5, 6}, 1, "no usable key").size(), 0u);
  EXPECT_EQ(keys({-1, 0.5f}, {5, 6}, 0, "before the beginning"), (List{-1, 5, 0.5f, 6}));
  EXPECT_EQ(keys({0}, {5}, 0, "a clip of no length"), (List{0, 5}));
  EXPECT_EQ(keys({}, {}, 1, "no key").size(), 0u);
}

TEST(GltfErrors, countsOfClips) {
  const std::vector<float> three{0, 1, 2};
  const auto clips = [](const TestGltf& g, size_t warnings, const char* what) {
    return warned(g, warnings, what).clips.size();
  };
  EXPECT_EQ(clips(clipOf("translation", 3, three, std::vector<float>(6, 1)), 1, "too few values"), 0u);
  EXPECT_EQ(clips(clipOf("translation", 3, three, std::vector<float>(12, 1)), 1, "too many values"), 0u);
  EXPECT_EQ(clips(clipOf("translation", 4, three, std::vector<float>(12, 1)), 1, "the wrong type"), 0u);
  EXPECT_EQ(clips(clipOf("rotation", 3, three, std::vector<float>(9, 1)), 1, "a rotation of three"), 0u);
  EXPECT_EQ(clips(clipOf("scale", 3, three, std::vector<float>(9, 1), "CUBICSPLINE"), 1, "no tangents"), 0u);
  EXPECT_EQ(clips(clipOf("scale", 3, three, std::vector<float>(27, 1), "CUBICSPLINE"), 0, "tangents"), 1u);
  EXPECT_EQ(clips(clipOf("scale", 3, three, std::vector<float>(9, 1), "BEZIER"), 1, "another interpolation"),
            0u);
  EXPECT_EQ(clips(clipOf("colour", 3, three, std::vector<float>(9, 1)), 1, "another path"), 0u);
  EXPECT_EQ(clips(clipOf("weights", 1, three, std::vector<float>(6, 1)), 0, "two weights a key"), 1u);
  EXPECT_EQ(clips(clipOf("weights", 1, three, std::vector<float>(3, 1)), 1, "too few weights"), 0u);
  EXPECT_EQ(clips(clipOf("weights", 1, three, std::vector<float>(7, 1)), 1, "a weight too many"), 0u);
  TestGltf g = clipOf("translation", 3, three, std::vector<float>(9, 1));
  const auto changed = [&](const std::function<void(Json&)>& change, const char* what) {
    TestGltf other = g;
    change(other.json["animations"][0]);
    return clips(other, 1, what);
  };
  EXPECT_EQ(changed([](Json& a) { a["channels"][0]["sampler"] = 4; }, "no such sampler"), 0u);
  EXPECT_EQ(changed([](Json& a) { a["channels"][0]["target"]["node"] = 4; }, "no such node"), 0u);
  EXPECT_EQ(changed([](Json& a) { a["channels"][0].erase("target"); }, "no target"), 0u);
  EXPECT_EQ(changed([](Json& a) { a["samplers"][0]["input"] = 99; }, "no such accessor"), 0u);
  EXPECT_EQ(changed([](Json& a) { a["samplers"][0]["input"] = 0; }, "times of the wrong type"), 0u);
  // A channel without a node is an extension's affair.
  g.json["animations"][0]["channels"][0]["target"].erase("node");
  EXPECT_EQ(clips(g, 0, "no node"), 0u);
}

TEST(GltfErrors, transformsOfClips) {
  SceneData scene =
      warned(clipOf("rotation", 4, {0, 1}, {0, 0, 0, 0, 0, 3, 0, 4}), 0, "rotations of other lengths");
  ASSERT_EQ(scene.clips.size(), 1u);
  EXPECT_EQ(scene.clips[0].channels[0].values, (std::vector<float>{0, 0, 0, 1, 0, 0.6f, 0, 0.8f}));
  warned(clipOf("scale", 3, {0, 1}, {0, 0, 0, 1e14f, 0, 1e14f}), 0, "scales of nothing and of much");
  warned(clipOf("translation", 3, {0, 1}, {1e14f, 0, 0, -1e14f, 0, 0}), 0, "far away");
  // A node whose matrix shears cannot be animated.
  TestGltf g = clipOf("translation", 3, {0, 1}, {0, 0, 0, 1, 0, 0});
  g.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_TRUE(warned(g, 1, "a matrix that shears").clips.empty());
  // One that can be taken apart is.
  g.json["nodes"][0]["matrix"] = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 5, 1};
  EXPECT_EQ(warned(g, 0, "a matrix that does not").clips.size(), 1u);
}

TEST(GltfErrors, skins) {
  const auto skinned = [](const std::vector<float>& weights, const std::vector<uint8_t>& joints,
                          const Json& skin) {
    TestGltf g = quad();
    Json& attributes = g.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = g.add(joints, 5121, "VEC4", 4);
    attributes["WEIGHTS_0"] = g.addFloats(weights, 4);
    g.json["nodes"][0]["skin"] = 0;
    g.json["nodes"].push_back({{"translation", {0, 0, 7}}});
    g.json["scenes"][0]["nodes"].push_back(1);
    g.json["skins"] = {skin};
    return g;
  };
  const std::vector<uint8_t> first(16, 0);
  const Json oneJoint = {{"joints", {1}}};
  const auto rows = [](const std::vector<float>& row) {
    std::vector<float> all;
    for (int v = 0; v < 4; ++v) all.insert(all.end(), row.begin(), row.end());
    return all;
  };
  const auto expectWeight = [&](const std::vector<float>& row, float expected, size_t warnings,
                                const char* what) {
    const SceneData scene = warned(skinned(rows(row), first, oneJoint), warnings, what);
    ASSERT_EQ(scene.meshes.size(), 1u);
    const Primitive& p = scene.meshes[0]->primitives[0];
    for (size_t v = 0; v < 4; ++v) {
      float sum = 0;
      for (size_t k = 0; k < 4; ++k) sum += p.weights[4 * v + k];
      EXPECT_NEAR(sum, 1, 1e-6f) << what;
      EXPECT_NEAR(p.weights[4 * v], expected, 1e-6f) << what;
    }
  };
  expectWeight({0.5f, 0.5f, 0, 0}, 0.5f, 0, "good");
  expectWeight({2, 6, 0, 0}, 0.25f, 1, "they sum to eight");
  expectWeight({0.1f, 0.1f, 0, 0}, 0.5f, 1, "they sum to a fifth");
  expectWeight({0, 0, 0, 0}, 1, 1, "all are zero");
  expectWeight({kNan, 1, 0, 0}, 0, 1, "one is no number");
  expectWeight({-1, 1, 0, 0}, 0, 1, "one is negative");
  const std::vector<float> good = rows({1, 0, 0, 0});
  EXPECT_EQ(
      warned(skinned(good, std::vector<uint8_t>(16, 9), oneJoint), 1, "a joint the skin lacks").nodes[0].skin,
      -1);
  // Where the weight is zero the joint does not count.
  std::vector<uint8_t> unused = first;
  unused[1] = 200;
  EXPECT_EQ(warned(skinned(good, unused, oneJoint), 0, "an unused joint").nodes[0].skin, 0);
  EXPECT_EQ(warned(skinned(good, first, {{"joints", {77}}}), 1, "a joint that is no node").nodes[0].skin, -1);
  EXPECT_EQ(warned(skinned(good, first, {{"joints", Json::array()}}), 1, "no joints").nodes[0].skin, -1);
  TestGltf g = skinned(good, first, oneJoint);
  std::vector<float> bind(16, 0);
  bind[3] = kNan;
  g.json["skins"][0]["inverseBindMatrices"] = g.add(bind, 5126, "MAT4", 16);
  EXPECT_EQ(warned(g, 1, "a bind pose that is no number").nodes[0].skin, -1);
  g.json["skins"][0]["inverseBindMatrices"] = 0;
  EXPECT_EQ(warned(g, 1, "a bind pose of vectors").nodes[0].skin, -1);
}

}  // namespace
}  // namespace scumble::scene
