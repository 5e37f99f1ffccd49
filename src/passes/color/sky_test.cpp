// The sky in tones: few colours, on the average those of a sky that goes over evenly; borders of strokes that
// are as long on the screen through any lens, and stand still in the world.
#include <array>
#include <cmath>
#include <map>

#include "tests/support/aov.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble::passes {
namespace {

using namespace test;

constexpr int kSide = 160, kTones = 6;

class Sky : public BothEyes {
 protected:
  static Scene nothing() {
    TestScene s;
    s.add(sphereMesh({0, -900, 0}, 0.5f, 8), s.material(TestScene::colored("Grey", {0.5f, 0.5f, 0.5f, 1})));
    return s.load();
  }
  // From black at the horizon to white above, so that a colour is a share of the tones.
  static Frame drawSky(const Stand& stand, const Knobs& more = {}) {
    Knobs knobs{{"background.horizon", "#000000"},
                {"background.zenith", "#FFFFFF"},
                {"background.height", "30"},
                {"background.skyTones", std::to_string(kTones)},
                {"background.skyStrokeSize", "300"}};
    knobs.insert(knobs.end(), more.begin(), more.end());
    const Scene scene = nothing();
    return draw(scene, quietLook(knobs), viewsFrom(scene, stand, kSide, kSide, GetParam()),
                sized(kSide, kSide));
  }
  static double toneAt(const Frame& frame, size_t view, int x, int y) {
    return kTones * texel(aov(frame, "", view), x, y).x;
  }
  static constexpr Stand kUpwards{{0, 0, 0}, {0, 1, -4}, 40, 0, 0.2f};
};
INSTANTIATE_BOTH_EYES(Sky);

TEST_P(Sky, hasFewTonesThatAreRightOnTheAverage) {
  const Frame painted = drawSky(kUpwards), even = drawSky(kUpwards, {{"background.skyTones", "0"}});
  for (size_t v = 0; v < viewCount(); ++v) {
    int whole = 0;
    std::map<int, int> tones;
    double sum = 0, evenSum = 0;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const double tone = toneAt(painted, v, x, y);
        whole += std::abs(tone - std::round(tone)) < 0.01;
        ++tones[int(std::round(tone))];
        sum += tone, evenSum += toneAt(even, v, x, y);
        // A stroke reaches into the tones beside its own.
        EXPECT_LT(std::abs(tone - toneAt(even, v, x, y)), 2.2) << x << ", " << y;
      }
    EXPECT_GT(whole, 0.8 * kSide * kSide);
    EXPECT_GE(tones.size(), 4u);
    EXPECT_NEAR(sum / (kSide * kSide), evenSum / (kSide * kSide), 0.15);
  }
}

// Both eyes see one sky, endlessly far away, and a turn of the camera leaves it where it is.
TEST_P(Sky, standsStillInTheWorld) {
  const Scene scene = nothing();
  Stand turned = kUpwards;
  turned.target = {0.9f, 1.2f, -4}, turned.roll = 12, turned.eye += glm::vec3(3, 0, 1),
  turned.target += glm::vec3(3, 0, 1);
  const auto views = viewsFrom(scene, kUpwards, kSide, kSide, GetParam()),
             other = viewsFrom(scene, turned, kSide, kSide, GetParam());
  const Frame here = drawSky(kUpwards), there = drawSky(turned);
  for (size_t v = 0; v < viewCount(); ++v) {
    int same = 0, all = 0;
    const glm::dmat4 toWorld = glm::inverse(glm::dmat4(other[v].worldToEye));
    const glm::dvec3 eye(toWorld[3]);
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const glm::dvec3 far = pixelRay(other[v], x, y, kSide, kSide).direction * 1e6;
        const glm::dvec2 at = pixelOf(views[v], far, kSide, kSide);
        if (at.x < 0 || at.y < 0 || at.x >= kSide || at.y >= kSide) continue;
        ++all;
        same += std::abs(toneAt(here, v, int(at.x), int(at.y)) - toneAt(there, v, x, y)) < 0.5;
      }
    EXPECT_GT(all, kSide * kSide / 4);
    EXPECT_GT(same, 0.93 * all);
  }
}

// Through a long lens as well as a wide one.
TEST_P(Sky, strokesAreAsLongThroughAnyLens) {
  std::map<int, double> changes;  // by angle: of tones, between pixels of a row
  for (const int angle : {10, 20, 40}) {
    Stand stand = kUpwards;
    stand.fov = float(angle);
    const Frame frame = drawSky(stand, {{"background.height", "60"}, {"background.skyStrokes", "3"}});
    for (size_t v = 0; v < viewCount(); ++v)
      for (int y = 0; y < kSide; ++y)
        for (int x = 1; x < kSide; ++x)
          changes[angle] += std::abs(toneAt(frame, v, x, y) - toneAt(frame, v, x - 1, y)) / (kSide * kSide);
  }
  EXPECT_GT(changes[40], 0.01);
  EXPECT_LT(std::abs(std::log2(changes[10] / changes[40])), 0.8);
  EXPECT_LT(std::abs(std::log2(changes[20] / changes[40])), 0.8);
}

// In a parallel projection there is one direction, and no strokes.
TEST_F(RenderTest, skyOfAParallelViewIsOfOneTone) {
  TestScene s;
  s.add(sphereMesh({0, -900, 0}, 0.5f, 8), s.material(TestScene::colored("Grey", {0.5f, 0.5f, 0.5f, 1})));
  const Frame frame =
      draw(s.load(), quietLook({{"background.skyTones", "5"}}), {parallelView(2, 1)}, sized(32, 32));
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) EXPECT_EQ(texel(aov(frame, ""), x, y), texel(aov(frame, ""), 0, 0));
}

}  // namespace
}  // namespace scumble::passes
