#include "world/surface_colors.h"

#include <gtest/gtest.h>

namespace scumble::world {
namespace {

// Quads in the plane, each with its material; all have one picture, of two texels: red and green.
class SurfaceColorsTest : public ::testing::Test {
 protected:
  SurfaceColorsTest() {
    scene::TextureImage image;
    image.width = 2, image.height = 1;
    image.rgba = {255, 0, 0, 255, 0, 255, 0, 255};
    images_.emplace_back(std::move(image));
  }
  // `uv`: of its corners, from and to. `textured` materials have the picture.
  void addQuad(const glm::vec2& size, const glm::vec2& from, const glm::vec2& to, bool textured) {
    auto& primitive = *primitives_.emplace_back(std::make_unique<scene::Primitive>());
    for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1), glm::vec2(1, 1)}) {
      primitive.positions.emplace_back(corner * size, 0);
      primitive.uv0.push_back(glm::mix(from, to, corner));
    }
    primitive.indices = {0, 1, 2, 2, 1, 3};
    scene::Material material;
    material.baseColorTexture.image = textured ? 0 : -1;
    GeometryItem item{&primitive};
    item.material = uint32_t(materials_.size());
    materials_.push_back(material);
    items_.push_back(item);
  }
  SceneColors colors() {
    const auto materialOf = [this](size_t i) -> const scene::Material& { return materials_[i]; };
    colors_.look(items_, materialOf, images_);
    return colors_.colors(items_, materialOf);
  }
  static void expectNear(const glm::vec3& actual, const glm::vec3& expected) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(actual[c], expected[c], 0.03) << c;
  }

  std::vector<std::unique_ptr<scene::Primitive>> primitives_;
  std::vector<scene::Material> materials_;
  std::vector<Shared<scene::TextureImage>> images_;
  std::vector<GeometryItem> items_;
  SurfaceColors colors_;
};

// An atlas has corners that nothing uses.
TEST_F(SurfaceColorsTest, onlyWhatIsUsedOfAPictureCounts) {
  addQuad({1, 1}, {0.1f, 0.1f}, {0.4f, 0.9f}, true);
  expectNear(colors().meanRootRgb, {1, 0, 0});
  EXPECT_NEAR(colors().variety, 0, 1e-3);
  materials_[0].baseColorTexture.transform[2][0] = 0.5f;
  expectNear(colors().meanRootRgb, {0, 1, 0});
}

TEST_F(SurfaceColorsTest, areWeighedByArea) {
  addQuad({1, 1}, {0, 0}, {1, 1}, true);
  addQuad({3, 1}, {0, 0}, {1, 1}, false);
  expectNear(colors().meanRootRgb, {0.125f + 0.75f, 0.125f + 0.75f, 0.75f});
  items_[1].model = glm::scale(glm::mat4(1.0f), glm::vec3(1.0f / 3, 1, 1));
  expectNear(colors().meanRootRgb, {0.75f, 0.75f, 0.5f});
  items_[1].shown = false;
  expectNear(colors().meanRootRgb, {0.5f, 0.5f, 0});
}

// Coordinates beyond the picture follow its wrapping.
TEST_F(SurfaceColorsTest, picturesAreWrapped) {
  addQuad({1, 1}, {1.1f, 0}, {1.4f, 1}, true);
  scene::Sampler& sampler = materials_[0].baseColorTexture.sampler;
  expectNear(colors().meanRootRgb, {1, 0, 0});
  for (const scene::Wrap wrap : {scene::Wrap::mirroredRepeat, scene::Wrap::clampToEdge}) {
    sampler.wrapU = wrap;
    colors_ = {};
    expectNear(colors().meanRootRgb, {0, 1, 0});
  }
}

TEST_F(SurfaceColorsTest, factorsAndVertexColoursCount) {
  addQuad({1, 1}, {0, 0}, {0.4f, 1}, true);
  materials_[0].baseColor = {0.25f, 1, 1, 1};
  expectNear(colors().meanRootRgb, {0.5f, 0, 0});
  primitives_[0]->colors.assign(4, {64, 255, 255, 255});
  colors_ = {};
  expectNear(colors().meanRootRgb, {0.25f, 0, 0});
}

// What nothing new is asked of reads no vertices: they may be gone.
TEST_F(SurfaceColorsTest, whatStaysIsNotReadAgain) {
  addQuad({1, 1}, {0, 0}, {0.4f, 1}, true);
  expectNear(colors().meanRootRgb, {1, 0, 0});
  primitives_[0]->positions.clear();
  primitives_[0]->uv0.clear();
  materials_[0].baseColor = {0.25f, 1, 1, 1};
  expectNear(colors().meanRootRgb, {0.5f, 0, 0});
}

// Every 64th of many triangles is white: such a step meets all of them or none.
TEST_F(SurfaceColorsTest, whatComesBackRegularlyIsNotTakenForAll) {
  addQuad({1, 1}, {0, 0}, {1, 1}, false);
  scene::Primitive& primitive = *primitives_[0];
  primitive = {};
  for (uint32_t i = 0; i < 8192; ++i) {
    const float x = float(i);
    for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)}) {
      primitive.positions.emplace_back(x + corner.x, corner.y, 0);
      primitive.uv0.push_back(corner);
      primitive.colors.emplace_back(glm::u8vec4(i % 64 == 0 ? 255 : 0));
      primitive.indices.push_back(uint32_t(primitive.indices.size()));
    }
  }
  EXPECT_LT(colors().meanRootRgb.g, 0.1f);
}

// Alpha counts where it is seen.
TEST_F(SurfaceColorsTest, whatIsOpaqueCountsWhateverItsAlpha) {
  scene::TextureImage image;
  image.width = 2, image.height = 1;
  image.rgba = {255, 0, 0, 0, 0, 255, 0, 255};
  images_[0] = Shared<scene::TextureImage>(std::move(image));
  addQuad({1, 1}, {0, 0}, {1, 1}, true);
  expectNear(colors().meanRootRgb, {0.5f, 0.5f, 0});
  materials_[0].alphaMode = scene::AlphaMode::mask;
  colors_ = {};
  expectNear(colors().meanRootRgb, {0, 1, 0});
}

}  // namespace
}  // namespace scumble::world
