// Stamps by material (paper 004, section 3.3 and figure 11): brushes that are taken by
// chance, how strong and dense stamps are, and their colours.
#include <cmath>
#include <functional>

#include "base/test_folder.h"
#include "scumble/image.h"
#include "tests/support/aov.h"
#include "tests/support/plain_wash.h"
#include "tests/support/render_test.h"

namespace scumble::watercolor {
namespace {

using namespace test;

class Stamps : public BothEyes {
 protected:
  static constexpr int kWidth = 160, kHeight = 120;

  void SetUp() override {
    write("white.png", [](int, int) { return 1.0f; });
    write("black.png", [](int, int) { return 0.0f; });
    write("bar.png", [](int x, int) { return float(x >= 24 && x < 40); });
  }
  void write(const char* name, const std::function<float(int, int)>& white) {
    constexpr int kSide = 64;
    Image image{kSide, kSide, {"R", "G", "B", "A"}, {}};
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x)
        for (int c = 0; c < 4; ++c) image.pixels.push_back(c < 3 ? white(x, y) : 1.0f);
    EXPECT_TRUE(writePng(folder_.file(name), image).ok());
  }
  // Two boards beside each other, of two materials.
  Frame seen(const Knobs& more, const std::string& brush = "white.png") {
    TestScene s;
    for (const auto& [name, x] : {std::pair{"Left", -4.0f}, {"Right", 0.0f}})
      s.add(gridMesh({x, -4, 0}, {4, 0, 0}, {0, 8, 0}, 8),
            s.material(TestScene::unlit(name, {0.3f, 0.5f, 0.7f, 1})));
    Knobs knobs = plainWash({{"watercolor.generator", "shapes"},
                             {"watercolor.brush", folder_.file(brush)},
                             {"watercolor.spacing", "120"},
                             {"watercolor.stampSize", "0.4"},
                             {"watercolor.backruns", "0"}});
    knobs.insert(knobs.end(), more.begin(), more.end());
    const Scene scene = s.load();
    const auto views = viewsFrom(scene, {{0, 0, 5}, {0, 0, 0}, 40}, kWidth, kHeight, GetParam());
    return draw(scene, quietLook(knobs), views, sized(kWidth, kHeight, {"pigment"}));
  }
  // How much is under stamps, of the left half and of the right one.
  glm::dvec2 covered(const Frame& frame) {
    glm::dvec2 sum(0);
    const Image& pigment = aov(frame, "pigment", viewCount() - 1);
    for (int y = 4; y < kHeight - 4; ++y)
      for (int x = 4; x < kWidth - 4; ++x)
        if (std::abs(x - kWidth / 2) > 12)
          sum[x > kWidth / 2] += texel(pigment, x, y).w / (0.5 * kWidth * kHeight);
    return sum;
  }
  std::string file(const char* name) { return folder_.file(name); }

 private:
  const TestFolder folder_;
};
INSTANTIATE_BOTH_EYES(Stamps);

TEST_P(Stamps, takeBrushesByChance) {
  const Knobs two{{"watercolor.brush2", file("black.png")}, {"watercolor.brushes", "2"}};
  const auto with = [&](const char* brush) {
    Knobs knobs = two;
    if (*brush) knobs.emplace_back("materials.Left.watercolor.stamps.brush", brush);
    return seen(knobs);
  };
  const glm::dvec2 one = covered(seen({})), any = covered(with("")), first = covered(with("first")),
                   second = covered(with("second"));
  EXPECT_GT(one.x, 0.07);
  EXPECT_GT(any.x, 0.25 * one.x);
  EXPECT_LT(any.x, 0.8 * one.x);
  EXPECT_NEAR(first.x, one.x, 1e-6);
  EXPECT_EQ(second.x, 0);
  // The other material keeps its own.
  EXPECT_NEAR(first.y, any.y, 1e-6);
  EXPECT_NEAR(second.y, any.y, 1e-6);
}

TEST_P(Stamps, areAsStrongAndDenseAsTheirMaterialSays) {
  const glm::dvec2 usual = covered(seen({}));
  const glm::dvec2 none = covered(seen({{"materials.Left.watercolor.stamps.strength", "0"}}));
  EXPECT_EQ(none.x, 0);
  EXPECT_NEAR(none.y, usual.y, 1e-6);
  const glm::dvec2 pale = covered(seen({{"materials.Left.watercolor.stamps.strength", "0.5"}}));
  EXPECT_GT(pale.x, 0.35 * usual.x);
  EXPECT_LT(pale.x, 0.65 * usual.x);
  const glm::dvec2 dense = covered(seen({{"materials.Left.watercolor.stamps.density", "4"}})),
                   sparse = covered(seen({{"materials.Left.watercolor.stamps.density", "0.25"}}));
  // They lie over each other as well.
  EXPECT_GT(dense.x, 2 * usual.x);
  EXPECT_LT(sparse.x, 0.5 * usual.x);
  EXPECT_NEAR(dense.y, usual.y, 1e-6);
  EXPECT_EQ(covered(seen({{"nodes.*.watercolor.stamps.strength", "0"}})), glm::dvec2(0));
}

TEST_P(Stamps, haveColorsOfTheirOwn) {
  const Knobs red{{"materials.Left.watercolor.stamps.color", "#D03020"},
                  {"materials.Left.watercolor.stamps.colorAmount", "1"}};
  for (const char* const generator : {"stamps", "shapes", "cells"}) {
    Knobs knobs{{"watercolor.generator", generator},
                {"watercolor.stampSize", "1"},
                {"watercolor.hue", "0"},
                {"watercolor.turbulence", "0"}};
    const Frame plain = seen(knobs);
    knobs.insert(knobs.end(), red.begin(), red.end());
    const Frame colored = seen(knobs);
    for (size_t v = 0; v < viewCount(); ++v) {
      double redder = 0, amount[2] = {0, 0};
      int count = 0;
      for (int y = 8; y < kHeight - 8; ++y)
        for (int x = 8; x < kWidth - 8; ++x) {
          const glm::dvec4 was = texel(aov(plain, "", v), x, y), is = texel(aov(colored, "", v), x, y);
          if (x > kWidth / 2 + 16) {
            ASSERT_NEAR(is.r, was.r, 0.003) << generator;
          }
          if (x > kWidth / 2 - 16) continue;
          redder += is.r / (is.r + is.g + is.b) - was.r / (was.r + was.g + was.b), ++count;
          for (int c = 0; c < 3; ++c) amount[0] -= std::log(was[c]), amount[1] -= std::log(is[c]);
        }
      EXPECT_GT(redder / count, 0.04) << generator;
      EXPECT_NEAR(amount[1] / amount[0], 1, 0.1) << generator;
    }
  }
}

TEST_P(Stamps, standUprightWhereNothingTurnsThem) {
  // How often pigment begins or ends, along rows and along columns.
  const auto changes = [&](const char* turns) {
    const Frame frame = seen({{"watercolor.turns", turns}, {"watercolor.stampSize", "0.5"}}, "bar.png");
    const Image& pigment = aov(frame, "pigment", 0);
    glm::dvec2 sum(0);
    for (int y = 4; y < kHeight - 8; ++y)
      for (int x = 4; x < kWidth - 8; ++x) {
        const double here = texel(pigment, x, y).w;
        sum += glm::dvec2(std::abs(texel(pigment, x + 4, y).w - here),
                          std::abs(texel(pigment, x, y + 4).w - here));
      }
    return sum.x / sum.y;
  };
  EXPECT_GT(changes("0"), 1.45);
  EXPECT_NEAR(changes("1"), 1, 0.2);
}

TEST_P(Stamps, differInSize) {
  const glm::dvec2 usual = covered(seen({})), varied = covered(seen({{"watercolor.sizes", "1"}}));
  // From a quarter to four times the area: more on average.
  EXPECT_GT(varied.x, 1.1 * usual.x);
  EXPECT_LT(varied.x, 2.5 * usual.x);
}

}  // namespace
}  // namespace scumble::watercolor
