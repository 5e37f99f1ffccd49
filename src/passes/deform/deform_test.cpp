// Where meshes are in the world: the `position`, `normal` and `id` AOVs of rigid, mirrored, sheared,
// instanced and skinned ones against rays cast through the same triangles on the CPU.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/aov.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"
#include "tests/support/test_device.h"

namespace scumble::passes {
namespace {

using namespace test;

class DeformTest : public BothEyes {
 protected:
  static constexpr int kWidth = 96, kHeight = 72;

  void check(const TestScene& test, const Stand& stand) {
    const Scene scene = test.load();
    const auto views = viewsFrom(scene, stand, kWidth, kHeight, GetParam());
    const Frame frame = draw(scene, quietLook({{"light.shadowWarp", "0"}}), views,
                             sized(kWidth, kHeight, {"position", "normal", "id"}));
    for (size_t v = 0; v < views.size(); ++v) {
      size_t hits = 0, misplaced = 0, misturned = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const auto hit = castRay(pixelRay(views[v], x, y, kWidth, kHeight), test.triangles());
          const int id = int(texel(aov(frame, "id", v), x, y).x);
          hits += hit.has_value();
          if (id != (hit ? hit->id : 0)) {
            ++misplaced;
            continue;
          }
          if (!hit) continue;
          const glm::dvec3 position(texel(aov(frame, "position", v), x, y)),
              normal(texel(aov(frame, "normal", v), x, y));
          misplaced += glm::length(position - hit->position) > 1e-3 * hit->distance;
          // Octahedral normals in 2 x 16 bits are good to 1e-4.
          misturned += glm::length(normal - hit->normal) > 2e-3;
        }
      EXPECT_GT(hits, size_t(kWidth * kHeight / 10));
      // Only where a ray grazes an edge.
      EXPECT_LE(misplaced, hits / 200) << "view " << v << ", " << hits << " pixels";
      EXPECT_LE(misturned, hits / 200) << "view " << v << ", " << hits << " pixels";
    }
  }

  // A box whose faces all differ, so that a turn by mistake shows.
  static TestMesh oddBox() { return boxMesh({-0.5f, -0.3f, -0.8f}, {0.7f, 0.9f, 0.4f}); }
  static int grey(TestScene& s) { return s.material(TestScene::colored("Grey", {0.5f, 0.5f, 0.5f, 1})); }
};
INSTANTIATE_BOTH_EYES(DeformTest);

TEST_P(DeformTest, rigid) {
  NEEDS_FINE_RASTER();
  TestScene s;
  const int m = grey(s);
  glm::mat4 turned =
      glm::rotate(glm::translate(glm::mat4(1.0f), glm::vec3(0.8f, 0.2f, 0)), 0.7f, glm::vec3(1, 2, 3));
  s.add(oddBox(), m, glm::scale(turned, glm::vec3(1.5f, 0.6f, 1)));
  s.add(sphereMesh({0, 0, 0}, 0.7f, 16), m, glm::translate(glm::mat4(1.0f), glm::vec3(-1, 0, 0)));
  check(s, {{1, 1.5f, 4}});
}

TEST_P(DeformTest, mirrored) {
  NEEDS_FINE_RASTER();
  TestScene s;
  const int m = grey(s);
  const glm::mat4 turned = glm::rotate(glm::mat4(1.0f), 0.6f, glm::vec3(1, 1, 0));
  s.add(oddBox(), m, glm::scale(turned, glm::vec3(-1.2f, 1, 0.8f)));
  s.add(sphereMesh({1.3f, 0, 0.5f}, 0.5f, 16), m, glm::scale(glm::mat4(1.0f), glm::vec3(-1, -1, -1)));
  check(s, {{1, 1.5f, 4}});
}

TEST_P(DeformTest, sheared) {
  NEEDS_FINE_RASTER();
  TestScene s;
  glm::mat4 shear(1.0f);
  shear[1][0] = 0.8f, shear[2][1] = -0.5f, shear[0][2] = 0.3f;
  s.add(oddBox(), grey(s), shear);
  s.add(sphereMesh({0, 0, 0}, 0.5f, 16), 0, glm::translate(glm::mat4(1.0f), glm::vec3(-1.2f, 0, 0)) * shear);
  check(s, {{1, 1.5f, 4}});
}

TEST_P(DeformTest, instanced) {
  NEEDS_FINE_RASTER();
  TestScene s;
  s.addInstances(oddBox(), grey(s), {{-1, 0, 0}, {1, 0.3f, -0.5f}, {0, -0.8f, 0.5f}},
                 {glm::quat(1, 0, 0, 0), glm::normalize(glm::quat(0.8f, 0.3f, -0.4f, 0.2f)),
                  glm::normalize(glm::quat(0.2f, 0.9f, 0, 0))},
                 {{0.8f, 0.8f, 0.8f}, {0.5f, 1.2f, 0.7f}, {-0.6f, 0.6f, 0.6f}});
  check(s, {{1, 1.5f, 4}});
}

TEST_P(DeformTest, skinned) {
  NEEDS_FINE_RASTER();
  TestScene s;
  // A bar along y whose upper end follows a second joint.
  TestMesh bar;
  for (int i = 0; i < 8; ++i) {
    const TestMesh piece =
        boxMesh({-0.3f, 0.25f * float(i) - 1, -0.3f}, {0.3f, 0.25f * float(i + 1) - 1, 0.3f});
    const uint32_t first = uint32_t(bar.positions.size());
    bar.positions.insert(bar.positions.end(), piece.positions.begin(), piece.positions.end());
    bar.normals.insert(bar.normals.end(), piece.normals.begin(), piece.normals.end());
    bar.uvs.insert(bar.uvs.end(), piece.uvs.begin(), piece.uvs.end());
    for (const uint32_t k : piece.indices) bar.indices.push_back(first + k);
  }
  for (const glm::vec3& p : bar.positions) {
    const float upper = glm::clamp(0.5f + 0.5f * p.y, 0.0f, 1.0f);
    bar.joints.push_back({0, 1, 2, 0});
    bar.weights.push_back({(1 - upper) * 0.75f, upper, (1 - upper) * 0.25f, 0});
  }
  const glm::mat4 one(1.0f);
  const glm::mat4 bent =
      glm::rotate(glm::translate(one, glm::vec3(0.5f, 0.2f, 0)), 0.9f, glm::vec3(0, 0.3f, -1));
  s.addSkinned(bar, grey(s),
               {glm::translate(one, glm::vec3(-0.4f, 0, 0)), bent, glm::scale(one, glm::vec3(1.2f, 1, 0.9f))},
               {one, glm::translate(one, glm::vec3(0, -0.3f, 0)), one});
  check(s, {{1, 1.5f, 4}});
}

}  // namespace
}  // namespace scumble::passes
