// Paper 000, section 3.5 and figure 8: strokes on the sea show its contour.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/aov.h"
#include "tests/support/render_test.h"

namespace scumble::ocean {
namespace {

using namespace test;

constexpr int kAcrossWidth = 240, kAcrossHeight = 135;

class StrokesAcross : public BothEyes {
 protected:
  static Scene sea() {
    TestScene s;
    s.add(boxMesh({-0.1f, -9, -0.1f}, {0.1f, -8.9f, 0.1f}),
          s.material(TestScene::colored("Wood", {0.5f, 0.4f, 0.3f, 1})));
    s.light({0.3f, 1, 0.2f});
    return s.load();
  }
  // Flat water, whose strokes alone differ.
  Frame seen(const Scene& scene, const std::vector<View>& views, const char* follow) {
    const Look look = quietLook({{"ocean.mode", "on"},
                                 {"ocean.wind", "0"},
                                 {"ocean.paint.reflection", "0"},
                                 {"ocean.paint.foam", "0"},
                                 {"ocean.paint.dither", "1"},
                                 {"ocean.paint.live", "0"},
                                 {"ocean.paint.follow", follow}});
    return draw(scene, look, views, sized(kAcrossWidth, kAcrossHeight, {"lit"}));
  }
  std::vector<View> from(const Scene& scene, double azimuth, double turn = 0) {
    const glm::vec3 eye(9 * std::sin(azimuth), 3, 9 * std::cos(azimuth));
    const glm::vec3 target = eye - glm::vec3(std::sin(azimuth + turn), 0.25f, std::cos(azimuth + turn));
    return viewsFrom(scene, {eye, target, 40}, kAcrossWidth, kAcrossHeight, GetParam());
  }
  // How much colours change from row to row, against from column to column, in the water's nearer part; and
  // their deviation.
  static glm::dvec2 runOf(const Image& lit) {
    double down = 0, across = 0, sum = 0, squares = 0;
    int count = 0;
    for (int y = kAcrossHeight / 2; y < kAcrossHeight - 1; ++y)
      for (int x = 0; x < kAcrossWidth - 1; ++x, ++count) {
        const double here = texel(lit, x, y).g;
        down += std::abs(texel(lit, x, y + 1).g - here), across += std::abs(texel(lit, x + 1, y).g - here);
        sum += here, squares += here * here;
      }
    return {down / across, std::sqrt(std::max(squares / count - sum * sum / count / count, 0.0))};
  }
};
INSTANTIATE_BOTH_EYES(StrokesAcross);

TEST_P(StrokesAcross, runAlongTheHorizonFromEverywhere) {
  const Scene scene = sea();
  double least = 1e9, most = 0, deviationLeast = 1e9, deviationMost = 0;
  for (int i = 0; i < 16; ++i) {
    const auto views = from(scene, i * glm::radians(22.5));
    for (size_t v = 0; v < viewCount(); ++v) {
      const glm::dvec2 run = runOf(aov(seen(scene, views, "on"), "lit", v));
      least = std::min(least, run.x), most = std::max(most, run.x);
      deviationLeast = std::min(deviationLeast, run.y), deviationMost = std::max(deviationMost, run.y);
    }
  }
  EXPECT_GT(least, 1.5);
  EXPECT_LT(most, 2.5 * least);
  // Two directions, blended, have the contrast of one.
  EXPECT_LT(deviationMost, 1.7 * deviationLeast);
  // Without it they run away from a viewer who looks along X.
  EXPECT_LT(runOf(aov(seen(scene, from(scene, glm::radians(90.0)), "off"), "lit", 0)).x, 0.75 * least);
}

TEST_P(StrokesAcross, aTurnOfTheHeadChangesNothing) {
  const Scene scene = sea();
  for (const double azimuth : {0.0, 0.39, 0.6}) {
    const auto ahead = from(scene, azimuth), turned = from(scene, azimuth, 0.12);
    const Frame first = seen(scene, ahead, "on"), second = seen(scene, turned, "on");
    double apart = 0, differs = 0;
    int count = 0;
    for (int y = kAcrossHeight * 2 / 3; y < kAcrossHeight - 8; y += 2)
      for (int x = 8; x < kAcrossWidth - 8; x += 2) {
        // The same water in the other picture: the eyes' middle stays, so that it is a turn alone in
        // mono.
        const glm::vec2 ndc = (glm::vec2(x, y) + 0.5f) / glm::vec2(kAcrossWidth, kAcrossHeight) * 2.0f - 1.0f;
        const glm::mat4 toClip = ahead[0].eyeToClip * ahead[0].worldToEye;
        const glm::vec4 near = glm::inverse(toClip) * glm::vec4(ndc, 0.5f, 1),
                        far = glm::inverse(toClip) * glm::vec4(ndc, 0.4f, 1);
        const glm::vec3 a = glm::vec3(near) / near.w, way = glm::vec3(far) / far.w - a;
        const glm::vec3 place = a - way * (a.y / way.y);
        const glm::vec4 clip = turned[0].eyeToClip * turned[0].worldToEye * glm::vec4(place, 1);
        const glm::vec2 at =
            (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(kAcrossWidth, kAcrossHeight);
        if (at.x < 2 || at.y < 2 || at.x > kAcrossWidth - 2 || at.y > kAcrossHeight - 2) continue;
        const Image &one = aov(first, "lit", 0), &other = aov(second, "lit", 0);
        const double here = texel(one, x, y).g;
        apart += std::abs(texel(other, int(at.x), int(at.y)).g - here);
        differs += std::abs(texel(one, x / 2 + 20, y).g - here), ++count;
      }
    EXPECT_GT(count, 800);
    EXPECT_LT(apart, 0.45 * differs) << azimuth;
  }
}

}  // namespace
}  // namespace scumble::ocean
