// The tint of shadows by the sky above and the ground below, for every tilt of a surface (docs/palette.md).
#include <cmath>

#include "passes/surface/surface_knobs.h"
#include "tests/support/aov.h"
#include "tests/support/palette_reference.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble::passes {
namespace {

using namespace test;

constexpr int kTintWidth = 96, kTintHeight = 72;
constexpr double kTintByte = 1.0 / 255;

class SkyTintTest : public BothEyes {
 protected:
  static constexpr double kAmount = 0.6;
  static inline const glm::vec3 kColor{0.35f, 0.25f, 0.2f};

  static Look tintLook(double amount) { return quietLook({{"palette.skyTint", std::to_string(amount)}}); }
  // A colour of all of a material, or of vertices, which goes through the rule's polynomial.
  static int materialOf(TestScene& s, TestMesh& mesh, bool varied) {
    if (varied) mesh.colors.assign(mesh.positions.size(), glm::vec4(kColor, 1));
    Json json = TestScene::colored("Paint", varied ? glm::vec4(1) : glm::vec4(kColor, 1));
    json["doubleSided"] = true;
    return s.material(json);
  }
  static glm::dvec3 expectedRoot(bool varied, double amount, double up) {
    const PaletteReference palette;
    static const FitReference fit([](const glm::dvec3& c) { return PaletteReference().shadowed(c); });
    const glm::dvec3 own(kColor);
    return glm::sqrt((varied ? fit(own) : palette.shadowed(own)) * skyTintReference(amount, up));
  }
};
INSTANTIATE_BOTH_EYES(SkyTintTest);

// A ball has all normals, from upwards to downwards.
TEST_P(SkyTintTest, followsTheNormal) {
  for (const bool varied : {false, true})
    for (const double amount : {kAmount, 1.0}) {
      TestScene s;
      TestMesh ball = sphereMesh({0, 0, 0}, 1, 64);
      const int paint = materialOf(s, ball, varied);
      s.add(ball, paint);
      const Scene scene = s.load();
      const auto views =
          viewsFrom(scene, {{0.3f, 0.05f, 6}, {0, 0, 0}, 22}, kTintWidth, kTintHeight, GetParam());
      const Frame frame =
          draw(scene, tintLook(amount), views, sized(kTintWidth, kTintHeight, {"shadowed", "normal", "id"}));
      for (size_t v = 0; v < viewCount(); ++v) {
        // The target has 8 bits, vertex colours as well; at full strength the ground has no blue, whose root
        // is steep.
        Difference colors((varied ? 2 : 1) * kTintByte);
        double least = 1, most = -1;
        for (int y = 0; y < kTintHeight; ++y)
          for (int x = 0; x < kTintWidth; ++x) {
            if (texel(aov(frame, "id", v), x, y).x == 0) continue;
            const double up = texel(aov(frame, "normal", v), x, y).y;
            const glm::dvec3 expected = expectedRoot(varied, amount, up);
            for (int c = 0; c < 3; ++c)
              colors.add(std::sqrt(texel(aov(frame, "shadowed", v), x, y)[c]), expected[c]);
            least = std::min(least, up), most = std::max(most, up);
          }
        EXPECT_LT(least, -0.95);
        EXPECT_GT(most, 0.95);
        EXPECT_EQ(colors.beyond, 0u) << varied << ", " << amount << ": " << colors.text();
      }
    }
}

// Flat faces at 90, 60, 30 and 0 degrees upwards and downwards, from the front and from behind, where they
// face the other way.
TEST_P(SkyTintTest, tiltedFacesOfBothSides) {
  const double tilts[] = {90, 60, 30, 0, -30, -60, -90};
  for (const bool varied : {false, true})
    for (const bool fromBehind : {false, true}) {
      TestScene s;
      for (int i = 0; i < 7; ++i) {
        const float tilt = glm::radians(float(tilts[i])), c = std::cos(tilt), n = std::sin(tilt);
        // Level ones lie below and above the eye, so that the side that they turn up or down is seen.
        const glm::vec3 middle(0.7f * float(i - 3), std::abs(tilts[i]) == 90 ? -0.7f * n : 0.0f, 0);
        const glm::vec3 across(0.5f, 0, 0), along = 0.5f * glm::vec3(0, c, -n);
        TestMesh face = gridMesh(middle - 0.5f * (across + along), across, along);
        if (fromBehind) {
          // The same place, wound the other way: its outside looks away from the viewer.
          face = gridMesh(middle - 0.5f * (-across + along), -across, along);
        }
        const int paint = materialOf(s, face, varied);
        s.add(face, paint);
      }
      const Scene scene = s.load();
      const auto views = viewsFrom(scene, {{0, 0, 5}}, kTintWidth, kTintHeight, GetParam());
      const Frame frame =
          draw(scene, tintLook(kAmount), views, sized(kTintWidth, kTintHeight, {"shadowed", "id"}));
      for (size_t v = 0; v < viewCount(); ++v) {
        size_t seen[7] = {};
        for (int y = 0; y < kTintHeight; ++y)
          for (int x = 0; x < kTintWidth; ++x) {
            const int i = int(texel(aov(frame, "id", v), x, y).x) - 1;
            if (i < 0) continue;
            ++seen[i];
            const glm::dvec3 expected = expectedRoot(varied, kAmount, std::sin(glm::radians(tilts[i])));
            for (int c = 0; c < 3; ++c)
              EXPECT_NEAR(std::sqrt(texel(aov(frame, "shadowed", v), x, y)[c]), expected[c],
                          (varied ? 2 : 1) * kTintByte)
                  << tilts[i] << " degrees" << (fromBehind ? " from behind" : "") << ", channel " << c;
          }
        for (int i = 0; i < 7; ++i) EXPECT_GT(seen[i], 5u) << tilts[i];
      }
    }
}

}  // namespace
}  // namespace scumble::passes
