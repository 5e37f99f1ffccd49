// The files beside the checkout, drawn: every good scene in one view and some in two, and every bad picture
// as a texture.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/support/aov.h"
#include "tests/support/asset_files.h"
#include "tests/support/render_test.h"

namespace scumble {
namespace {

using namespace test;

class Assets : public RenderTest {
 protected:
  // The picture is finite, and shows something.
  static void check(const Scene& scene, const std::string& what, Stereo stereo) {
    Result<std::vector<View>> views = makeViews(scene, {}, 64.0f / 36, stereo);
    ASSERT_TRUE(views.ok()) << what << ": " << views.error().message();
    const int before = renderer().validationMessages();
    const Result<Frame> frame = renderer().render(scene, Look(), 0, *views, sized(64, 36));
    ASSERT_TRUE(frame.ok()) << what << ": " << frame.error().message();
    EXPECT_EQ(renderer().validationMessages(), before) << what;
    for (const Image& image : frame->layers[0].views)
      for (const float value : image.pixels) ASSERT_TRUE(std::isfinite(value)) << what;
  }
};

TEST_F(Assets, everyGoodSceneIsDrawn) {
  std::vector<std::filesystem::path> files = filesBelow(kAssets / "gltf", {".gltf", ".glb"});
  for (const auto& file : filesBelow(kAssets / "classic", {".gltf", ".glb"})) files.push_back(file);
  if (files.empty()) GTEST_SKIP() << "no files below " << kAssets;
  size_t number = 0;
  for (const auto& file : files) {
    const Result<Scene> scene = Scene::load(file.string());
    ASSERT_TRUE(scene.ok()) << scene.error().message();
    check(*scene, file.string(), number++ % 8 == 3 ? Stereo::stereo : Stereo::mono);
  }
}

TEST_F(Assets, everyBadPictureIsDrawn) {
  const auto files = filesBelow(kAssets / "bad", {".png", ".jpg", ".jpeg"});
  if (files.empty()) GTEST_SKIP() << "no files below " << kAssets;
  // A wall of tiles, each with a picture of its own: one scene for many files.
  constexpr size_t kTiles = 36;
  for (size_t first = 0; first < files.size(); first += kTiles) {
    TestScene s;
    for (size_t i = first; i < std::min(first + kTiles, files.size()); ++i) {
      std::ifstream stream(files[i], std::ios::binary);
      const std::vector<uint8_t> bytes{std::istreambuf_iterator<char>(stream), {}};
      Json json = TestScene::colored("Tile", {1, 1, 1, 1});
      json["pbrMetallicRoughness"]["baseColorTexture"] = {
          {"index", s.textureFile(bytes, files[i].extension() == ".png" ? "image/png" : "image/jpeg")}};
      const size_t column = (i - first) % 6, row = (i - first) / 6;
      s.add(gridMesh({float(column), float(row), 0}, {1, 0, 0}, {0, 1, 0}), s.material(json));
    }
    const std::string text = s.text();
    const Result<Scene> scene = Scene::loadFromMemory(text.data(), text.size(), "tiles.gltf", "");
    ASSERT_TRUE(scene.ok()) << scene.error().message();
    check(*scene, files[first].string() + " and those after it", first == 0 ? Stereo::stereo : Stereo::mono);
  }
}

}  // namespace
}  // namespace scumble
