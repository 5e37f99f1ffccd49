// Facts as other programs rely on them: metres, pixels, whole numbers; and what stands where nothing is.
#include <cmath>
#include <set>

#include "scene/scene_data.h"
#include "tests/support/aov.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"
#include "tests/support/test_device.h"

namespace scumble::passes {
namespace {

using namespace test;

class FactsTest : public BothEyes {
 protected:
  static constexpr int kWidth = 96, kHeight = 72;
};
INSTANTIATE_BOTH_EYES(FactsTest);

TEST_P(FactsTest, depthPositionIdAndMotion) {
  NEEDS_FINE_RASTER();
  const TestScene test = stillLife();
  const Scene scene = test.load();
  auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  for (View& view : views) view.eyeToClip[2][0] = 0.1f;  // off centre
  RenderOptions options = sized(kWidth, kHeight, {"depth", "position", "id", "motion", "uv"});
  options.previousViews =
      viewsFrom(scene, {{1.8f, 2.6f, 6.3f}, {0.1f, 0.7f, 0}, 42, 5}, kWidth, kHeight, GetParam());
  const Frame frame = draw(scene, quietLook(), views, options);
  for (size_t v = 0; v < viewCount(); ++v) {
    size_t hits = 0, wrong = 0, empty = 0;
    Difference motion(0.02), depth(1e-3);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const auto hit = castRay(pixelRay(views[v], x, y, kWidth, kHeight), test.triangles());
        const double id = texel(aov(frame, "id", v), x, y).x, far = texel(aov(frame, "depth", v), x, y).x;
        EXPECT_EQ(id, std::floor(id));
        if (id != (hit ? hit->id : 0)) {
          ++wrong;
          continue;
        }
        if (!hit) {
          ++empty;
          EXPECT_TRUE(std::isinf(far) && far > 0);
          EXPECT_EQ(texel(aov(frame, "position", v), x, y), glm::dvec4(0.0));
          EXPECT_EQ(texel(aov(frame, "motion", v), x, y), glm::dvec4(0.0));
          continue;
        }
        ++hits;
        // Metres along the view axis.
        depth.add(far, -(glm::dmat4(views[v].worldToEye) * glm::dvec4(hit->position, 1)).z);
        const glm::dvec2 moved =
            glm::dvec2(x, y) + 0.5 - pixelOf(options.previousViews[v], hit->position, kWidth, kHeight);
        motion.add(texel(aov(frame, "motion", v), x, y).x, moved.x);
        motion.add(texel(aov(frame, "motion", v), x, y).y, moved.y);
      }
    EXPECT_GT(hits, 1000u);
    EXPECT_GT(empty, 500u);
    EXPECT_LE(wrong, hits / 200);
    EXPECT_LE(depth.beyond, hits / 200) << depth.text();
    EXPECT_LE(motion.beyond, hits / 200) << motion.text();
  }
}

// Which of a node's materials, and its name as looks know it.
TEST_F(FactsTest, materialsByNumber) {
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight);
  const Frame frame = draw(scene, quietLook(), views, sized(kWidth, kHeight, {"id"}));
  const Image& image = aov(frame, "id");
  ASSERT_EQ(image.channels, (std::vector<std::string>{"R", "G"}));
  std::set<std::pair<size_t, std::string>> seen;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const auto node = size_t(image.at(uint32_t(x), uint32_t(y), 0)),
                 material = size_t(image.at(uint32_t(x), uint32_t(y), 1));
      ASSERT_EQ(node == 0, material == 0);
      if (node == 0) continue;
      ASSERT_LE(material, frame.materials.size());
      seen.emplace(node, frame.materials[material - 1]);
    }
  std::set<std::pair<size_t, std::string>> all;
  std::set<size_t> nodes;
  const scene::SceneData& data = scene.data();
  for (size_t n = 0; n < data.nodes.size(); ++n)
    if (data.nodes[n].mesh >= 0)
      for (const scene::Primitive& primitive : data.meshes[size_t(data.nodes[n].mesh)]->primitives)
        all.emplace(n + 1, data.materials[size_t(primitive.material)].name);
  for (const auto& [node, material] : seen) {
    nodes.insert(node);
    if (node <= data.nodes.size()) {
      EXPECT_TRUE(all.contains({node, material})) << node << " " << material;
    }
  }
  EXPECT_GT(nodes.size(), 2u);
}

TEST_F(FactsTest, nothingMovesWhereTheViewStays) {
  NEEDS_FINE_RASTER();
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight);
  const Frame frame = draw(scene, quietLook(), views, sized(kWidth, kHeight, {"motion"}));
  for (const float value : aov(frame, "motion").pixels) EXPECT_NEAR(value, 0, 4e-3);
}

// A parallel projection has its own arithmetic.
TEST_F(FactsTest, depthOfAParallelProjection) {
  NEEDS_FINE_RASTER();
  const TestScene test = stillLife();
  const View view = parallelView(2.5f, 4.0f / 3);
  const Frame frame = draw(test.load(), quietLook(), {view}, sized(kWidth, kHeight, {"depth"}));
  Difference depth(1e-3);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      if (const auto hit = castRay(pixelRay(view, x, y, kWidth, kHeight), test.triangles()))
        depth.add(texel(aov(frame, "depth"), x, y).x, 5 - hit->position.z);
  EXPECT_GT(depth.count, 1000u);
  EXPECT_LE(depth.beyondPart(), 0.005) << depth.text();
}

// A face that is seen from behind shows its normal to the viewer.
TEST_F(FactsTest, normalsOfDoubleSidedFacesTurnToTheViewer) {
  TestScene s;
  Json material = TestScene::colored("Leaf", {0.5f, 0.5f, 0.5f, 1});
  material["doubleSided"] = true;
  s.add(gridMesh({-2, -2, 0}, {0, 4, 0}, {4, 0, 0}), s.material(material));  // faces -Z
  const Frame frame = draw(s.load(), quietLook(), {parallelView(1, 1)}, sized(8, 8, {"normal"}));
  EXPECT_NEAR(texel(aov(frame, "normal"), 4, 4).z, 1, 1e-3);
}

}  // namespace
}  // namespace scumble::passes
