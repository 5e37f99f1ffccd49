// Paper 000, section 2.1: edges are lost where values meet, and found where they differ.
#include <algorithm>
#include <cmath>

#include "base/oklab.h"
#include "passes/final_color/final_color_knobs.h"
#include "passes/lost_edges/lost_edges.shared.h"
#include "tests/support/aov.h"
#include "tests/support/render_test.h"

namespace scumble::passes {
namespace {

using namespace test;

constexpr int kLostWidth = 240, kLostHeight = 180;

// The linear colour of a lightness and a hue.
glm::vec4 colorOf(double lightness, double a, double b) {
  return glm::vec4(glm::vec3(linearFromOklab({lightness, a, b})), 1);
}

class LostEdgesTest : public BothEyes {
 protected:
  // A wall of two colours that meet upright in its middle, and a ball of the second one before the first.
  static Scene twoColors(const glm::vec4& left, const glm::vec4& right) {
    TestScene s;
    const int first = s.material(TestScene::unlit("Left", left)),
              second = s.material(TestScene::unlit("Right", right));
    s.add(gridMesh({-3, -2, 0}, {3, 0, 0}, {0, 4, 0}, 12), first);
    s.add(gridMesh({0, -2, 0}, {3, 0, 0}, {0, 4, 0}, 12), second);
    s.add(sphereMesh({-0.8f, 0, 0.6f}, 0.45f, 32), second);
    return s.load();
  }
  static Look losing(const Knobs& knobs) {
    Knobs all{{"warp.amount", "24"},
              {"warp.inflation", "12"},
              {"final.lostEdges", "1"},
              {"final.lostWidth", "48"},
              {"final.lostValues", "0.1"}};
    all.insert(all.end(), knobs.begin(), knobs.end());
    return quietLook(all);
  }
  Frame drawn(const Scene& scene, const Look& look, uint32_t samples = 1,
              std::vector<std::string> aovs = {}) {
    const auto views = viewsFrom(scene, {{0, 0, 3}, {0, 0, 0}, 50}, kLostWidth, kLostHeight, GetParam());
    return draw(scene, look, views, sized(kLostWidth, kLostHeight, std::move(aovs), samples));
  }
  // Pixels that are neither of two colours, by more than a tenth of their difference, of all views.
  size_t mixed(const Frame& frame, const glm::vec4& left, const glm::vec4& right) {
    size_t count = 0;
    for (size_t v = 0; v < viewCount(); ++v)
      for (int y = 20; y < kLostHeight - 20; ++y)
        for (int x = 20; x < kLostWidth - 20; ++x) {
          const glm::dvec4 color = texel(aov(frame, "", v), x, y);
          const double apart = glm::distance(glm::dvec4(left), glm::dvec4(right));
          count += glm::distance(color, glm::dvec4(left)) > 0.1 * apart &&
                   glm::distance(color, glm::dvec4(right)) > 0.1 * apart;
        }
    return count;
  }
};
INSTANTIATE_BOTH_EYES(LostEdgesTest);

TEST_P(LostEdgesTest, colorsRunWhereValuesMeetAndNowhereElse) {
  const glm::vec4 ochre = colorOf(0.6, 0.03, 0.1);
  for (const uint32_t samples : {1u, 4u}) {
    double before = 1e9;
    // Lightness apart: none, a third of the way from lost to found, and found.
    for (const double apart : {0.0, 0.066, 0.15, 0.3}) {
      const glm::vec4 blue = colorOf(0.6 - apart, -0.02, -0.08);
      const Scene scene = twoColors(ochre, blue);
      const size_t crisp = mixed(drawn(scene, losing({{"final.lostEdges", "0"}}), samples), ochre, blue),
                   lost = mixed(drawn(scene, losing({}), samples), ochre, blue);
      if (apart == 0) {
        EXPECT_GT(lost, 3 * crisp) << samples;
      }
      // Between two colours lie those of pixels that see both, whose values meet.
      if (apart > 0.1) {
        EXPECT_LT(double(lost), (apart > 0.2 ? 1.15 : 1.4) * double(crisp)) << samples << ", " << apart;
      }
      EXPECT_LE(double(lost), before) << samples << ", " << apart;
      before = double(lost) + 0.1 * double(crisp);
    }
  }
}

TEST_P(LostEdgesTest, equalsItsReference) {
  const Scene scene = twoColors(colorOf(0.6, 0.03, 0.1), colorOf(0.66, -0.02, -0.08));
  const FinalColorParams knobs = losing({}).data().get<FinalColorParams>();
  const Frame frame = drawn(scene, losing({}), 4, {"final-color", "warp"});
  const double scale = kLostHeight / 1080.0, width = knobs.lostWidth * scale, whole = 2 * scale;
  const auto valueOf = [](const glm::dvec4& color) { return oklabFromLinear(glm::dvec3(color)).x; };
  size_t changed = 0;
  for (size_t v = 0; v < viewCount(); ++v) {
    const Image &before = aov(frame, "final-color", v), &warp = aov(frame, "warp", v);
    const auto filtered = [&](const glm::dvec2& at) {
      const glm::dvec2 place = at - 0.5, low = glm::floor(place), part = place - low;
      const auto get = [&](int x, int y) {
        return texel(before, std::clamp(int(low.x) + x, 0, kLostWidth - 1),
                     std::clamp(int(low.y) + y, 0, kLostHeight - 1));
      };
      return glm::mix(glm::mix(get(0, 0), get(1, 0), part.x), glm::mix(get(0, 1), get(1, 1), part.x), part.y);
    };
    Difference difference(0.01);
    for (int y = 0; y < kLostHeight; ++y)
      for (int x = 0; x < kLostWidth; ++x) {
        const glm::dvec2 vector(texel(warp, x, y)), middle(x + 0.5, y + 0.5);
        const double tear = glm::length(vector), reach = width * std::min(tear / whole, 1.0);
        const glm::dvec4 own = texel(before, x, y);
        glm::dvec4 sum = own;
        double weights = 1;
        for (int side = -1; side <= 1 && reach >= 0.5; side += 2) {
          double open = knobs.lostEdges;
          for (int i = 1; i <= shared::kLostSteps; ++i) {
            const glm::dvec4 there =
                filtered(middle + vector * (reach / tear * side * i / shared::kLostSteps));
            const double t =
                std::clamp(std::abs(valueOf(there) - valueOf(own)) / (0.5 * knobs.lostValues) - 1, 0.0, 1.0);
            open *= 1 - t * t * (3 - 2 * t);
            sum += open * there, weights += open;
          }
        }
        const glm::dvec4 expected = sum / weights, got = texel(aov(frame, "", v), x, y);
        for (int c = 0; c < 3; ++c) difference.add(got[c], expected[c]);
        changed += glm::distance(expected, own) > 0.05;
      }
    // The vectors of an AOV are those of the whole picture; where nothing is near they move nothing that is
    // seen.
    EXPECT_LT(difference.beyondPart(), 2e-3) << difference.text();
    EXPECT_LT(difference.mean(), 5e-4) << difference.text();
  }
  EXPECT_GT(changed, 300 * viewCount());
}

TEST_P(LostEdgesTest, aPaletteStaysThePalette) {
  const glm::vec4 ochre = colorOf(0.6, 0.03, 0.1), blue = colorOf(0.6, -0.02, -0.08);
  const Scene scene = twoColors(ochre, blue);
  const Knobs palette{{"limit.palette", "look"},   {"limit.colors", "2"}, {"limit.color1", "#A8823C"},
                      {"limit.color2", "#5A8CB8"}, {"limit.dither", "0"}, {"limit.skyDither", "0"},
                      {"limit.softness", "0"}};
  Knobs crisp = palette;
  crisp.emplace_back("final.lostEdges", "0");
  const Frame lost = drawn(scene, losing(palette)), found = drawn(scene, losing(crisp));
  const glm::vec4 first(texel(aov(found, "", 0), 10, 10)),
      second(texel(aov(found, "", 0), kLostWidth - 10, 10));
  EXPECT_LE(mixed(lost, first, second), mixed(found, first, second) * 2);
  size_t differ = 0;
  for (int y = 0; y < kLostHeight; ++y)
    for (int x = 0; x < kLostWidth; ++x)
      differ += glm::distance(texel(aov(lost, "", 0), x, y), texel(aov(found, "", 0), x, y)) > 0.05;
  EXPECT_GT(differ, 200u);
}

TEST_P(LostEdgesTest, whatIsOffIsNotThere) {
  const Scene scene = twoColors(colorOf(0.6, 0.03, 0.1), colorOf(0.6, -0.02, -0.08));
  const auto hasPass = [](const Frame& frame) {
    return std::any_of(frame.stats.passes.begin(), frame.stats.passes.end(),
                       [](const auto& pass) { return pass.name == "lost-edges"; });
  };
  EXPECT_TRUE(hasPass(drawn(scene, losing({}))));
  EXPECT_FALSE(hasPass(drawn(scene, losing({{"final.lostEdges", "0"}}))));
  EXPECT_FALSE(hasPass(drawn(scene, losing({{"warp.amount", "0"}}))));
}

// A silhouette before nothing is as it was.
TEST_P(LostEdgesTest, whatIsTransparentHasNoValue) {
  const Scene scene = twoColors(colorOf(0.6, 0.03, 0.1), colorOf(0.6, -0.02, -0.08));
  const auto views = viewsFrom(scene, {{0, 0, 9}, {0, 0, 0}, 50}, kLostWidth, kLostHeight, GetParam());
  RenderOptions options = sized(kLostWidth, kLostHeight, {}, 4);
  options.transparent = true;
  const Frame lost = draw(scene, losing({}), views, options),
              found = draw(scene, losing({{"final.lostEdges", "0"}}), views, options);
  for (size_t v = 0; v < viewCount(); ++v)
    for (int y = 0; y < kLostHeight; ++y)
      for (int x = 0; x < kLostWidth; ++x)
        ASSERT_NEAR(texel(aov(lost, "", v), x, y).a, texel(aov(found, "", v), x, y).a, 0.004)
            << x << " " << y;
}

}  // namespace
}  // namespace scumble::passes
