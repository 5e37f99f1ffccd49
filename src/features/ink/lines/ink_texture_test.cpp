// Marks of brushes, pencils and ballpoints: fixed to the surface and not to the screen or to edges, as long
// on the screen at any distance, and the line's own without them.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/aov.h"
#include "tests/support/render_test.h"

namespace scumble::ink {
namespace {

using namespace test;

constexpr int kAcross = 240, kDown = 160;
constexpr float kHalfHeight = 1.6f;  // metres: a pixel is 2 cm
constexpr float kPixel = 2 * kHalfHeight / kDown;

const char* const kTextures[] = {"brush", "pencil", "ballpoint"};

class InkTexture : public BothEyes {
 protected:
  // A sheet whose borders are lines, in a parallel projection that is moved and enlarged.
  Texels lines(const std::string& texture, int cells, const glm::vec2& moved = {0, 0}, float larger = 1,
               const Knobs& more = {}) {
    TestScene s;
    s.add(gridMesh({-2, -1, 0}, {4, 0, 0}, {0, 2, 0}, cells),
          s.material(TestScene::colored("Sheet", {0.6f, 0.5f, 0.4f, 1})));
    Knobs knobs{{"ink.shown", "on"},  {"ink.least", "90"},           {"ink.greatest", "90"},
                {"warp.amount", "0"}, {"ink.boundaries.width", "1"}, {"ink.texture", texture}};
    knobs.insert(knobs.end(), more.begin(), more.end());
    std::vector<View> views(viewCount(), parallelView(kHalfHeight / larger, float(kAcross) / kDown));
    for (View& view : views)
      view.worldToEye = glm::translate(glm::mat4(1.0f), glm::vec3(moved, 0)) * view.worldToEye;
    const Frame frame = draw(s.load(), quietLook(knobs), views, sized(kAcross, kDown, {"ink"}));
    Texels ink(kAcross, kDown);
    for (int y = 0; y < kDown; ++y)
      for (int x = 0; x < kAcross; ++x) ink.at(x, y) = texel(aov(frame, "ink", viewCount() - 1), x, y);
    return ink;
  }
  // By how much ink differs where there is some, on average.
  static double difference(const Texels& a, const Texels& b, int shift = 0) {
    double sum = 0, inked = 0;
    for (int y = 0; y < kDown; ++y)
      for (int x = 40; x < kAcross - 40; ++x) {
        const double first = a.clamped(x, y).w, second = b.clamped(x + shift, y).w;
        sum += std::abs(first - second), inked += std::max(first, second);
      }
    return sum / inked;
  }
  // How much ink changes over some pixels along the lower line.
  static double changeAlong(const Texels& ink, int y, int pixels) {
    double sum = 0;
    for (int x = 20; x + pixels < kAcross - 20; ++x)
      sum += std::abs(ink.clamped(x, y).w - ink.clamped(x + pixels, y).w);
    return sum / (kAcross - 40 - pixels);
  }
};
INSTANTIATE_BOTH_EYES(InkTexture);

TEST_P(InkTexture, marksAreFixedToTheSurface) {
  for (const char* const texture : kTextures) {
    const Texels still = lines(texture, 1);
    // Whole pixels: the same ink elsewhere; and it is not the same everywhere.
    EXPECT_LT(difference(still, lines(texture, 1, {16 * kPixel, 0}), 16), 0.02) << texture;
    EXPECT_GT(difference(still, still, 16), 0.04) << texture;
    EXPECT_GT(difference(still, lines("plain", 1)), 0.04) << texture;
  }
}

TEST_P(InkTexture, marksDoNotKnowOfEdges) {
  for (const char* const texture : kTextures)
    EXPECT_LT(difference(lines(texture, 1), lines(texture, 23)), 0.03) << texture;
}

TEST_P(InkTexture, marksAreAsLongAtAnyDistance) {
  for (const char* const texture : kTextures) {
    // The lower border stays where it is.
    const auto at = [&](float larger) {
      return lines(texture, 1, {0, larger > 1 ? 1 - 0.8f / larger : 0.2f}, larger);
    };
    const int row = int((kHalfHeight + 0.8f) / kPixel);
    const double near = changeAlong(at(1), row, 6), far = changeAlong(at(3.3f), row, 6);
    EXPECT_GT(near, 0.005) << texture;
    EXPECT_GT(far, 0.5 * near) << texture;
    EXPECT_LT(far, 2.0 * near) << texture;
    // Where one octave gives way to the next, nothing jumps.
    double most = 0;
    for (float larger = 1; larger < 2; larger *= 1.0905f)
      most = std::max(most, difference(at(larger), at(larger * 1.0005f)));
    EXPECT_LT(most, 0.08) << texture;
  }
}

TEST_P(InkTexture, amountAndSizeAreKnobs) {
  const Texels plain = lines("plain", 1);
  for (const char* const texture : kTextures) {
    EXPECT_EQ(difference(plain, lines(texture, 1, {0, 0}, 1, {{"ink.textureAmount", "0"}})), 0) << texture;
    const double half = difference(plain, lines(texture, 1, {0, 0}, 1, {{"ink.textureAmount", "0.5"}}));
    const Texels whole = lines(texture, 1);
    EXPECT_GT(half, 0) << texture;
    EXPECT_LT(half, difference(plain, whole)) << texture;
    const Texels longer = lines(texture, 1, {0, 0}, 1, {{"ink.textureSize", "480"}});
    const int row = int((kHalfHeight + 1) / kPixel);
    EXPECT_LT(changeAlong(longer, row, 1), changeAlong(whole, row, 1)) << texture;
  }
}

// Ink has no grey: of a line that is thinner than a pixel as much is drawn as it has of one, in strokes.
TEST_P(InkTexture, thinLinesBreakAndAreNotPale) {
  const auto thin = [&](const char* breaks, const glm::vec2& moved, float larger = 1) {
    return lines(
        "plain", 9, moved + glm::vec2(0, 0.5f * kPixel), larger,
        {{"ink.least", "3"}, {"ink.greatest", "3"}, {"ink.placement", "centred"}, {"ink.breaks", breaks}});
  };
  const Texels pale = thin("off", {0, 0}), broken = thin("on", {0, 0});
  double ink[2] = {0, 0};
  int inked[2] = {0, 0}, grey[2] = {0, 0}, black = 0;
  for (int y = 0; y < kDown; ++y)
    for (int x = 40; x < kAcross - 40; ++x)
      for (const int i : {0, 1}) {
        const double coverage = (i == 0 ? pale : broken).clamped(x, y).w;
        ink[i] += coverage, inked[i] += coverage > 0.05, grey[i] += coverage > 0.15 && coverage < 0.85;
        black += i == 1 && coverage > 0.95;
      }
  EXPECT_GT(grey[0], 0.95 * inked[0]);
  EXPECT_LT(grey[1], 0.25 * inked[1]);
  EXPECT_NEAR(ink[1] / ink[0], 1, 0.25);
  EXPECT_GT(black, 0.25 * inked[0]);
  // Gaps lie on the surface, and not on edges or on the screen.
  EXPECT_LT(difference(broken, thin("on", {16 * kPixel, 0}), 16), 0.05);
  EXPECT_GT(difference(broken, broken, 16), 0.2);
  // A line that is wide enough is as it was.
  const Knobs wide{{"ink.least", "9"}, {"ink.greatest", "12"}};
  Knobs breaking = wide;
  breaking.emplace_back("ink.breaks", "on");
  EXPECT_LT(difference(lines("plain", 9, {}, 1, wide), lines("plain", 9, {}, 1, breaking)), 1e-6);
}

}  // namespace
}  // namespace scumble::ink
