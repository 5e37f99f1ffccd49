// Marks in the sky of a limited palette, for sizes that divide the circle and sizes that do not: against the
// pattern at each direction, in double precision, above all behind the viewer's default direction, where
// angles begin anew.
#include <cmath>
#include <numbers>

#include "passes/limit/limit_knobs.h"
#include "tests/support/aov.h"
#include "tests/support/metatexture_reference.h"
#include "tests/support/palette_reference.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"
#include "world/example_textures.h"

namespace scumble::passes {
namespace {

using namespace test;

constexpr int kMarksWidth = 64, kMarksHeight = 48;

class SkyMarksTest : public BothEyes {
 protected:
  // Two greys, and a sky between them.
  static constexpr uint32_t kDarkGrey = 0x707070, kSkyGrey = 0x8A8A8A, kLightGrey = 0xA0A0A0;

  static Scene emptySky() {
    TestScene s;
    s.add(sphereMesh({0, -900, 0}, 0.5f, 8), s.material(TestScene::colored("Grey", {0.5f, 0.5f, 0.5f, 1})));
    return s.load();
  }

  // Whether the lighter grey stands in a direction: by how much it does, or does not where below 0.
  static double lighterBy(const RepeatingTexture& strokes, const glm::dvec3& direction, double size,
                          double dither) {
    // From the direction behind, all the way around: what repeats after a whole number of copies has no seam.
    double turn = std::atan2(direction.x, -direction.z) / (2 * std::numbers::pi) + 0.5;
    const double rise =
        std::atan2(direction.y, std::hypot(direction.x, direction.z)) / (2 * std::numbers::pi);
    const double copies = std::round(360 / size);
    const glm::dvec2 at(copies * (turn - 0.5), 360 / size * rise);
    static const double dark = referenceLab(referenceColor(kDarkGrey)).x,
                        light = referenceLab(referenceColor(kLightGrey)).x,
                        own = referenceLab(referenceColor(kSkyGrey)).x;
    return (own - dark) / (light - dark) + 0.8 * dither * (strokes.sample(at).x - 0.5) - 0.5;
  }
};
INSTANTIATE_BOTH_EYES(SkyMarksTest);

TEST_P(SkyMarksTest, areThePatternInEveryDirection) {
  const Scene scene = emptySky();
  const RepeatingTexture strokes{builtInExample(1)};
  const double dither = 0.9;
  size_t atSeam = 0;
  for (const double size : {120.0, 100.0, 7.0}) {
    const Look look = quietLook({{"limit.palette", "look"},
                                 {"limit.colors", "2"},
                                 {"limit.color1", "#707070"},
                                 {"limit.color2", "#A0A0A0"},
                                 {"background.horizon", "#8A8A8A"},
                                 {"background.zenith", "#8A8A8A"},
                                 {"limit.softness", "0"},
                                 {"limit.skyDither", std::to_string(dither)},
                                 {"limit.skySize", std::to_string(size)}});
    // So narrow that a texel of the pattern, of 256, is a pixel or more.
    const float fov = float(std::min(40.0, 0.85 * size * kMarksHeight / 256));
    // Ahead, aside and above, and behind, where the angle goes from half a turn to minus half a turn.
    for (const glm::dvec3& to :
         {glm::dvec3(0.02, 0.01, -1), glm::dvec3(0.9, 0.5, 0.3), glm::dvec3(0, 0.02, 1)}) {
      const auto views =
          viewsFrom(scene, {{0, 0, 0}, glm::vec3(100.0 * to), fov}, kMarksWidth, kMarksHeight, GetParam());
      const Frame frame = draw(scene, look, views, sized(kMarksWidth, kMarksHeight, {"limit"}));
      for (size_t v = 0; v < viewCount(); ++v) {
        size_t light = 0, dark = 0, wrong = 0;
        double least = 9, most = -9;
        for (int y = 0; y < kMarksHeight; ++y)
          for (int x = 0; x < kMarksWidth; ++x) {
            const glm::dvec3 ray = pixelRay(views[v], x, y, kMarksWidth, kMarksHeight).direction;
            least = std::min(least, ray.x), most = std::max(most, ray.x);
            const double by = lighterBy(strokes, ray, size, dither);
            // Filter weights have steps of 1/256 and texels as many; half floats hold the sky's colour.
            if (std::abs(by) < 0.02) continue;
            const glm::dvec3 got(texel(aov(frame, "limit", v), x, y)),
                expected = referenceColor(by > 0 ? kLightGrey : kDarkGrey);
            ++(by > 0 ? light : dark);
            wrong += glm::length(got - expected) > 2e-3;
          }
        EXPECT_GT(light, 50u) << size;
        EXPECT_GT(dark, 50u) << size;
        // Where the pattern is steep, rounded angles decide.
        EXPECT_LE(double(wrong), 0.005 * double(light + dark))
            << size << " degrees, towards " << to.x << " " << to.y << " " << to.z << ": " << wrong;
        atSeam += to.z > 0.9 && least < 0 && most > 0;
      }
    }
  }
  EXPECT_EQ(atSeam, 3 * viewCount()) << "the seam is in the picture";
}

}  // namespace
}  // namespace scumble::passes
