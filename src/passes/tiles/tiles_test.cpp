#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tests/support/aov.h"
#include "tests/support/render_test.h"

namespace scumble::passes {
namespace {

using namespace test;

class TilesTest : public BothEyes {
 protected:
  // No whole number of tiles.
  static constexpr int kWidth = 300, kHeight = 200;

  // How far two pictures differ, in square roots, which the eye takes for equal steps.
  static double mostInRoots(const Frame& a, const Frame& b, size_t view) {
    double most = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const glm::dvec4 d = glm::sqrt(glm::max(texel(aov(a, "", view), x, y), 0.0)) -
                             glm::sqrt(glm::max(texel(aov(b, "", view), x, y), 0.0));
        for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(d[c]));
      }
    return most;
  }

  // A grade far away: it changes no colour, and has everything be torn, since it might.
  static Knobs withFarGrade(Knobs knobs) {
    knobs.insert(knobs.end(), {{"colorizers.Far.volume.shape", "sphere"},
                               {"colorizers.Far.volume.center", "0,-9000,0"},
                               {"colorizers.Far.grade.bias", "1,0,0"}});
    return knobs;
  }
};
INSTANTIATE_BOTH_EYES(TilesTest);

// What is saved is made in full, and the picture is the same, to the byte.
TEST_P(TilesTest, whatIsSavedLeavesThePictureAlone) {
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  const Knobs looks[] = {{{"ground.mode", "on"}},
                         {{"shadow.dither", "0.3"}},
                         {{"blur.radius", "0"}},
                         {{"blur.radius", "100"}, {"final.ripple", "layered"}},
                         {{"warp.amount", "64"}, {"limit.palette", "dusk"}}};
  for (const Knobs& knobs : looks) {
    const Look look = quietLook(knobs);
    for (Renderer* const by : {&renderer(), &otherRenderer()}) {
      const Frame alone = by->render(scene, look, 0, views, sized(kWidth, kHeight, {}, 4)).value();
      for (const char* name : {"warp", "blur", "final-shadow", "color", "shadow"}) {
        const Frame saved = by->render(scene, look, 0, views, sized(kWidth, kHeight, {name}, 4)).value();
        for (size_t v = 0; v < viewCount(); ++v)
          EXPECT_TRUE(sameBytes(aov(alone, "", v), aov(saved, "", v)))
              << name << ", " << knobs.front().first << " " << knobs.front().second;
      }
    }
  }
}

// Both kinds of image passes run on the same tiles: whatever they leave out differs between them.
TEST_P(TilesTest, fragmentAndComputeLeaveOutTheSame) {
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  const Look look = quietLook({{"ground.mode", "on"}, {"blur.radius", "40"}});
  const RenderOptions options = sized(kWidth, kHeight, {}, 4);
  const Frame a = draw(scene, look, views, options);
  const Frame b = otherRenderer().render(scene, look, 0, views, options).value();
  for (size_t v = 0; v < viewCount(); ++v) {
    Difference difference(0.02);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        for (int c = 0; c < 4; ++c)
          difference.add(texel(aov(a, "", v), x, y)[c], texel(aov(b, "", v), x, y)[c]);
    EXPECT_LT(difference.beyondPart(), 2e-4) << difference.text();
  }
}

// Where nothing is torn, nobody would see that it was: colours that differ less than the eye can tell apart.
TEST_P(TilesTest, noTearIsMissed) {
  // A small ball, a texture of a few texels and a shadow, at all places of a tile.
  TestScene s;
  Image dots{64, 64, {"R", "G", "B", "A"}, std::vector<float>(size_t(64) * 64 * 4, 0.6f)};
  for (size_t c = 0; c < 4; ++c) dots.pixels[4 * (40 * 64 + 20) + c] = 0.05f;
  for (size_t i = 3; i < dots.pixels.size(); i += 4) dots.pixels[i] = 1;
  Json dotted = TestScene::colored("Dotted", {1, 1, 1, 1});
  dotted["pbrMetallicRoughness"]["baseColorTexture"]["index"] = s.texture(dots);
  s.add(gridMesh({-4, 0, 3}, {8, 0, 0}, {0, 0, -6}), s.material(dotted));
  s.add(sphereMesh({1, 0.6f, 0}, 0.08f, 16), s.material(TestScene::colored("Ball", {0.8f, 0.1f, 0.1f, 1})));
  s.light({-0.5f, 1, 0.3f});
  const Scene scene = s.load();
  for (const char* amount : {"8", "40", "64"}) {
    // The last is farther than is looked for.
    const char* const unit = std::string(amount) == "64" ? "percent" : "pixels";
    const Knobs knobs{{"warp.amount", amount},
                      {"warp.inflation", amount},
                      {"warp.inflationUnit", unit},
                      {"surface.simplify", "0"}};
    const Look look = quietLook(knobs), everywhere = quietLook(withFarGrade(knobs));
    for (int i = 0; i < 8; ++i) {
      const float aside = 0.03f * float(i);
      const auto views =
          viewsFrom(scene, {{aside, 3.5f + aside, 5}, {aside, 0, 0}}, kWidth, kHeight, GetParam());
      const RenderOptions options = sized(kWidth, kHeight, {}, 4);
      const Frame some = draw(scene, look, views, options), all = draw(scene, everywhere, views, options);
      for (size_t v = 0; v < viewCount(); ++v) EXPECT_LE(mostInRoots(some, all, v), 3.0 / 255);
    }
  }
}

// A shadow thinner than a tile, which the blur moves and tears move on.
TEST_P(TilesTest, noTornShadowIsMissed) {
  TestScene s;
  const int plain = s.material(TestScene::colored("Plain", {0.6f, 0.6f, 0.5f, 1}));
  s.add(gridMesh({-20, 0, 20}, {40, 0, 0}, {0, 0, -40}), plain);
  s.add(boxMesh({-0.05f, 0, -0.05f}, {0.05f, 3, 0.05f}), plain);
  s.light({-0.9f, 0.6f, 0.1f});
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 6, 1.5f}, {1, 0, 0}}, kWidth, kHeight, GetParam());
  for (const auto& [radius, threshold] :
       {std::pair{"0", "0.5"}, {"9", "0.95"}, {"128", "0.97"}, {"40", "0.03"}}) {
    const Knobs knobs{{"warp.amount", "64"}, {"blur.radius", radius}, {"shadow.threshold", threshold}};
    const RenderOptions options = sized(kWidth, kHeight, {}, 4);
    const Frame some = draw(scene, quietLook(knobs), views, options),
                all = draw(scene, quietLook(withFarGrade(knobs)), views, options);
    for (size_t v = 0; v < viewCount(); ++v)
      EXPECT_LE(mostInRoots(some, all, v), 3.0 / 255) << radius << ", " << threshold;
  }
}

// Light and shadow are what they are where no tile is plain, as with a dither that nobody sees: also over a
// picture, for which the ground has no colour of its own.
TEST_P(TilesTest, plainTilesAreAsTheOthers) {
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  auto picture =
      std::make_shared<Image>(Image{8, 8, {"R", "G", "B", "A"}, std::vector<float>(8 * 8 * 4, 0.4f)});
  for (size_t i = 3; i < picture->pixels.size(); i += 4) picture->pixels[i] = 1;
  for (const bool overPicture : {false, true})
    for (const char* steps : {"1", "3"}) {
      const Knobs knobs{{"ground.mode", "on"}, {"shadow.steps", steps}, {"shadow.indication", "0"}};
      Knobs dithered = knobs;
      dithered.emplace_back("shadow.dither", "1e-6");
      RenderOptions options = sized(kWidth, kHeight, {}, 4);
      if (overPicture) options.background = picture;
      const Frame some = draw(scene, quietLook(knobs), views, options),
                  all = draw(scene, quietLook(dithered), views, options);
      for (size_t v = 0; v < viewCount(); ++v)
        EXPECT_LE(mostInRoots(some, all, v), 2.0 / 255) << (overPicture ? "over a picture" : "");
    }
}

// What a knob switches off is not in the frame, and costs nothing.
TEST_P(TilesTest, whatIsOffIsNotThere) {
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  const auto stepsOf = [&](const Knobs& knobs) {
    const Frame frame = draw(scene, quietLook(knobs), views, sized(kWidth, kHeight));
    std::vector<std::string> names;
    for (const PassTime& pass : frame.stats.passes) names.push_back(pass.name);
    return names;
  };
  const auto has = [](const std::vector<std::string>& names, const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const auto usual = stepsOf({});
  if (usual.empty()) GTEST_SKIP() << "the device has no timestamps";
  EXPECT_TRUE(has(usual, "warp") && has(usual, "blur"));
  EXPECT_TRUE(has(stepsOf({{"warp.amount", "0"}}), "warp")) << "there are marks";
  EXPECT_TRUE(has(stepsOf({{"shadow.indication", "0"}}), "warp")) << "there are tears";
  EXPECT_FALSE(has(stepsOf({{"shadow.indication", "0"}, {"warp.amount", "0"}}), "warp"));
  EXPECT_TRUE(
      has(stepsOf({{"shadow.indication", "0"}, {"warp.amount", "0"}, {"materials.Box.warp.amount", "1"}}),
          "warp"));
  EXPECT_FALSE(has(stepsOf({{"blur.radius", "0"}}), "blur"));
}

// An empty picture is sky, and a sky alone is not torn.
TEST_P(TilesTest, anEmptyPictureIsSky) {
  TestScene s;
  s.add(sphereMesh({0, 0, 0}, 1), s.material(TestScene::colored("Behind", {1, 0, 0, 1})));
  const Scene scene = s.load();
  const auto away = viewsFrom(scene, {{0, 0, 5}, {0, 0, 9}}, kWidth, kHeight, GetParam());
  const Frame frame =
      draw(scene, quietLook({{"warp.amount", "64"}}), away, sized(kWidth, kHeight, {"color"}));
  for (size_t v = 0; v < viewCount(); ++v) EXPECT_TRUE(sameBytes(aov(frame, "", v), aov(frame, "color", v)));
}

}  // namespace
}  // namespace scumble::passes
