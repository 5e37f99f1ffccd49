// The real files beside the checkout: every good one loads, every bad one ends in a scene or in one line.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/image_decode.h"
#include "scene/scene_data.h"
#include "scumble/scene.h"
#include "tests/support/asset_files.h"
#include "tests/support/test_gltf.h"

namespace scumble::scene {
namespace {

using test::filesBelow;
using test::kAssets;

std::vector<uint8_t> bytesOf(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void expectLines(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) EXPECT_EQ(line.find('\n'), std::string::npos);
}

TEST(SceneAssets, everyGoodFileLoads) {
  auto files = filesBelow(kAssets / "gltf", {".gltf", ".glb"});
  for (const auto& file : filesBelow(kAssets / "classic/converted", {".glb"})) files.push_back(file);
  if (files.empty()) GTEST_SKIP() << "no files below " << kAssets;
  for (const auto& file : files) {
    const Result<Scene> scene = Scene::load(file.string());
    ASSERT_TRUE(scene.ok()) << scene.error().message();
    EXPECT_GT(scene->summary().triangles, 0u) << file;
    EXPECT_FALSE(scene->data().bounds.empty);
    expectLines(scene->warnings());
  }
}

TEST(SceneAssets, everyBadFileEndsInASceneOrInOneLine) {
  const auto files = filesBelow(kAssets / "bad", {".gltf", ".glb"});
  if (files.empty()) GTEST_SKIP() << "no files below " << kAssets;
  for (const auto& file : files) {
    const Result<Scene> scene = Scene::load(file.string());
    if (scene) {
      expectLines(scene->warnings());
      continue;
    }
    EXPECT_EQ(scene.error().kind, ErrorKind::unusableFile) << file;
    EXPECT_FALSE(scene.error().problem.empty()) << file;
    expectLines({scene.error().message()});
  }
}

TEST(SceneAssets, everyBadPictureEndsInATextureOrAStandIn) {
  const auto files = filesBelow(kAssets / "bad", {".png", ".jpg", ".jpeg"});
  if (files.empty()) GTEST_SKIP() << "no files below " << kAssets;
  size_t standIns = 0;
  for (const auto& file : files) {
    TestGltf g;
    g.addQuad();
    g.addImage(bytesOf(file));
    const std::string text = g.glb();
    const Result<Scene> scene = Scene::loadFromMemory(text.data(), text.size(), "wrapped.glb", "");
    ASSERT_TRUE(scene.ok()) << file << scene.error().message();
    ASSERT_EQ(scene->data().images.size(), 1u);
    const TextureImage& image = scene->data().images[0];
    EXPECT_EQ(image.rgba.size(), size_t(image.width) * image.height * 4) << file;
    if (image.standIn) {
      ++standIns;
      EXPECT_EQ(scene->warnings().size(), 1u) << file;
    }
  }
  EXPECT_GT(standIns, 0u);
  EXPECT_LT(standIns, files.size());
}

// One scene in several encodings: what comes out must be the same, up to what quantisation takes.
TEST(SceneAssets, encodingsAgree) {
  const std::filesystem::path duck = kAssets / "gltf/khronos/Duck";
  if (!std::filesystem::exists(duck)) GTEST_SKIP() << "no files below " << kAssets;
  const Result<Scene> plain = Scene::load((duck / "glTF-Binary/Duck.glb").string());
  ASSERT_TRUE(plain.ok());
  for (const char* other : {"glTF-Draco/Duck.gltf", "glTF-Quantized/Duck.gltf"}) {
    const Result<Scene> scene = Scene::load((duck / other).string());
    ASSERT_TRUE(scene.ok()) << scene.error().message();
    EXPECT_EQ(scene->summary().triangles, plain->summary().triangles);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(scene->summary().min[i], plain->summary().min[i], 2e-3);
      EXPECT_NEAR(scene->summary().max[i], plain->summary().max[i], 2e-3);
    }
  }
  const std::filesystem::path boxes = kAssets / "gltf/compressed";
  for (const char* name : {"BoxMeshopt.glb", "BoxMeshopt.gltf", "BoxDraco.gltf"}) {
    const Result<Scene> scene = Scene::load((boxes / name).string());
    ASSERT_TRUE(scene.ok()) << scene.error().message();
    // All are a cube of 24 vertices, though in units of their own.
    const Primitive& p = scene->data().meshes[0]->primitives[0];
    Bounds box;
    for (const glm::vec3& position : p.positions) box.add(position);
    const glm::vec3 halfSize = 0.5f * (box.max - box.min);
    ASSERT_EQ(p.vertexCount(), 24u);
    for (size_t i = 0; i < p.vertexCount(); ++i)
      EXPECT_NEAR(glm::dot(p.normals[i], (p.positions[i] - box.center()) / halfSize), 1.0f, 2e-2f) << name;
  }
}

TEST(ImageDecode, refusesWhatItCannotRead) {
  TextureImage image;
  std::string problem;
  EXPECT_FALSE(decodeImage({}, image, problem));
  EXPECT_FALSE(problem.empty());
  // A header that claims four thousand million pixels.
  std::vector<uint8_t> png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0, 0, 0, 13, 'I', 'H', 'D', 'R', 0,
                              1,    0,   0,   0,   1,    0,    0,    8,    6, 0, 0, 0,  0,   0,   0,   0};
  EXPECT_FALSE(decodeImage(png, image, problem));
}

TEST(ImageDecode, webp) {
  const auto file = kAssets / "gltf/compressed/test-lossy.webp";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const std::vector<uint8_t> bytes = bytesOf(file);
  TextureImage image;
  std::string problem;
  EXPECT_TRUE(decodeImage(bytes, image, problem)) << problem;
  EXPECT_GT(image.width, 0u);
}

}  // namespace
}  // namespace scumble::scene
