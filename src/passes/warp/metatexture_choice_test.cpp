// What the `metatexture` AOV says that MetaTexture chose: by the middle of both eyes, whatever way their
// frusta lean (FORMULAS 4 and 7), and with the knobs' defaults.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/aov.h"
#include "tests/support/metatexture_reference.h"
#include "tests/support/posed_surface.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"
#include "tests/support/test_device.h"

namespace scumble::passes {
namespace {

using namespace test;

class MetaTextureChoiceTest : public RenderTest {
 protected:
  static constexpr int kWidth = 96, kHeight = 72;

  // Two walls, so that every gradient differs from pixel to pixel.
  static Scene walls() {
    TestScene s;
    const int grey = s.material(TestScene::colored("Wall", {0.5f, 0.5f, 0.5f, 1}));
    s.add(gridMesh({-3, -2, -1}, {6, 0, -1}, {0, 4, 1}, 1, {2.3f, 1.7f}), grey);
    s.add(gridMesh({-1, -0.8f, 0}, {1.4f, 0, 1.6f}, {0, 1.5f, 0.3f}, 1, {0.9f, 0.8f}), grey);
    return s.load();
  }
  // The view between the eyes, which these tests start from; headsets see more downwards than upwards.
  static View middle() {
    View view;
    view.worldToEye = glm::rotate(glm::mat4(1.0f), 0.2f, glm::vec3(0, 0, 1)) *
                      glm::lookAt(glm::vec3(1, 0.7f, 4), glm::vec3(0.2f, 0, 0), glm::vec3(0, 1, 0));
    view.eyeToClip = perspectiveProjection(glm::radians(55.0f), float(kWidth) / kHeight, 0.01f);
    view.eyeToClip[2][1] = 0.15f;
    return view;
  }
  // Eyes 0.5 m apart that look past each other by 2 x 7 degrees, with frusta that lean outwards.
  static std::vector<View> eyesAround(const View& between) {
    std::vector<View> eyes(2, between);
    for (const int i : {0, 1}) {
      const float side = i == 0 ? 1.0f : -1.0f;
      eyes[size_t(i)].worldToEye =
          glm::rotate(glm::mat4(1.0f), side * glm::radians(-7.0f), glm::vec3(0, 1, 0)) *
          glm::translate(glm::mat4(1.0f), glm::vec3(0.25f * side, 0, 0)) * between.worldToEye;
      eyes[size_t(i)].eyeToClip[2][0] = -0.2f * side;
    }
    return eyes;
  }
  static glm::dvec3 eyeOfView(const View& view) {
    return glm::dvec3(glm::inverse(glm::dmat4(view.worldToEye))[3]);
  }

  // Exponents and q for a point of a triangle as a view sees it.
  static MetaTextureReference::Result chosenBy(const View& view, const SurfaceTriangle& triangle,
                                               const ScreenHit& hit, bool radial) {
    glm::dvec3 point(0.0);
    for (size_t k = 0; k < 3; ++k) point += hit.barycentric[int(k)] * triangle.corners[k].position;
    const glm::dmat2 back =
        glm::inverse(glm::dmat2(pixelsAlong(view, point, triangle.corners[0].dPdu, kWidth, kHeight),
                                pixelsAlong(view, point, triangle.corners[0].dPdv, kWidth, kHeight)));
    const glm::dvec4 eye = glm::dmat4(view.worldToEye) * glm::dvec4(point, 1);
    const double tangent = glm::length(glm::dvec2(eye)) / -eye.z;
    MetaTextureReference reference;
    reference.texture.pixels = {1, 1, {0, 0, 0, 0}};
    reference.size = 400.0 * kHeight / 1080;
    reference.skew = MetaTextureReference::exact;
    reference.skewLevels = 2;
    return reference.at({0, 0}, {back[0][0], back[1][0]}, {back[0][1], back[1][1]},
                        radial ? 1 + tangent * tangent : 1);
  }
};

TEST_F(MetaTextureChoiceTest, theMiddleOfBothEyesChooses) {
  NEEDS_FINE_RASTER();
  const Scene scene = walls();
  const auto surface = posedSurface(scene.data());
  const View between = middle();
  const std::vector<View> eyes = eyesAround(between);
  ASSERT_LT(glm::length(0.5 * (eyeOfView(eyes[0]) + eyeOfView(eyes[1])) - eyeOfView(between)), 1e-5);
  for (const bool radial : {false, true}) {
    const Frame frame = draw(scene,
                             quietLook({{"light.shadowWarp", "0"},
                                        {"warp.metatexture.size", "400"},
                                        {"warp.metatexture.radial", radial ? "on" : "off"}}),
                             eyes, sized(kWidth, kHeight, {"metatexture", "id"}));
    for (size_t v = 0; v < 2; ++v) {
      const auto hits = rasterised(onScreen(surface, eyes[v], kWidth, kHeight,
                                            [](const auto&, const auto&) { return glm::dvec2(0.0); }),
                                   kWidth, kHeight);
      Difference chosen(1e-3), byLeft(1e-3), byRight(1e-3);
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const auto& hit = hits[size_t(y * kWidth + x)];
          if (!hit || texel(aov(frame, "id", v), x, y).x != surface[hit->surface].id) continue;
          const glm::dvec4 got = texel(aov(frame, "metatexture", v), x, y);
          const auto add = [&](Difference& difference, const View& view) {
            const auto expected = chosenBy(view, surface[hit->surface], *hit, radial);
            difference.add(got.x, expected.exponent.x), difference.add(got.y, expected.exponent.y);
            difference.add(got.z, expected.q);
          };
          add(chosen, between), add(byLeft, eyes[0]), add(byRight, eyes[1]);
        }
      EXPECT_GT(chosen.count, 6000u);
      EXPECT_LT(chosen.beyondPart(), 2e-3) << chosen.text() << ", eye " << v << ", radial " << radial;
      EXPECT_GT(byLeft.beyondPart(), 0.9) << "the left eye chooses otherwise";
      EXPECT_GT(byRight.beyondPart(), 0.9) << "and so does the right one";
    }
  }
}

// The shadow map is finest around the middle of the eyes.
TEST_F(MetaTextureChoiceTest, theShadowMapIsOfTheMiddleToo) {
  const Scene scene = stillLife().load();
  View between = middle();
  between.worldToEye = glm::lookAt(glm::vec3(1, 1, 3), glm::vec3(0, 0.5f, 0), glm::vec3(0, 1, 0));
  const std::vector<View> eyes = eyesAround(between);
  const auto mapOf = [&](const std::vector<View>& views) {
    const Frame frame =
        draw(scene, quietLook({{"light.shadowWarp", "8"}}), views, sized(16, 12, {"shadow-map"}));
    return aov(frame, "shadow-map");
  };
  const auto apart = [](const Image& a, const Image& b) {
    size_t count = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) count += std::abs(a.pixels[i] - b.pixels.at(i)) > 1e-3;
    return double(count) / double(a.pixels.size());
  };
  const Image both = mapOf(eyes);
  EXPECT_LT(apart(both, mapOf({between})), 1e-3) << "edges may fall otherwise by a rounding";
  EXPECT_GT(apart(both, mapOf({eyes[0]})), 5e-3);
  EXPECT_GT(apart(both, mapOf({eyes[1]})), 5e-3);
}

// Knobs as they are: 256 pixels at 1080 lines, base 2, blends all the way, contrast by itself, which for the
// built-in field means by variance. On a wall that faces a parallel projection everything is in closed form:
// E = -log2(256 H / 1080 |grad|), and contrast is divided by the root of the sum of the squares of shares.
TEST_F(MetaTextureChoiceTest, contrastByDefault) {
  size_t blended = 0;
  for (const float uvs : {0.7f, 1.0f, 1.3f, 1.6f}) {
    TestScene s;
    s.add(gridMesh({-3, -2, 0}, {6, 0, 0}, {0, 4, 0}, 1, {uvs, 1.1f * uvs}),
          s.material(TestScene::colored("Wall", {0.5f, 0.5f, 0.5f, 1})));
    const Frame frame =
        draw(s.load(), quietLook(), {parallelView(1, 4.0f / 3)}, sized(16, 12, {"metatexture"}));
    // 6 pixels a metre.
    const double size = 256 * 12 / 1080.0;
    const glm::dvec2 gradients = double(uvs) * glm::dvec2(1 / 6.0, 1.1 / 4) / 6.0,
                     e = -glm::log2(size * gradients), t = e - glm::floor(e), b = t * t * (3.0 - 2.0 * t),
                     shares = b * b + (1.0 - b) * (1.0 - b);
    const glm::dvec4 got = texel(aov(frame, "metatexture"), 8, 6);
    EXPECT_NEAR(got.x, e.x, 1e-4);
    EXPECT_NEAR(got.y, e.y, 1e-4);
    EXPECT_NEAR(got.z, 0, 1e-5);
    EXPECT_NEAR(got.w, 1 / std::sqrt(shares.x * shares.y), 1e-3) << uvs;
    blended += got.w > 1.3;
  }
  EXPECT_GE(blended, 1u);
}

}  // namespace
}  // namespace scumble::passes
