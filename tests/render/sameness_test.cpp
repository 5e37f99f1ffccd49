// A frame is a pure function of its arguments: the same call gives the same bytes, two eyes are two views,
// and how image passes run does not show.
#include <cmath>
#include <thread>

#include "tests/support/aov.h"
#include "tests/support/render_test.h"
#include "tests/support/sanitized.h"

namespace scumble {
namespace {

using namespace test;

std::vector<std::string> perViewAovs() {
  std::vector<std::string> names = Renderer::aovNames();
  std::erase(names, "shadow-map");
  return names;
}

// What stillLife() lacks: textures, holes, panes.
TestScene richScene(float paneAlpha = 0.5f) {
  TestScene s = stillLife();
  Image leaf{4, 4, {"R", "G", "B", "A"}, {}};
  for (int i = 0; i < 16; ++i)
    leaf.pixels.insert(leaf.pixels.end(), {0.2f, 0.1f * float(i % 8), 0.3f, i % 3 ? 1.0f : 0.0f});
  const int texture = s.texture(leaf);
  Json masked = TestScene::colored("Leaf", {1, 1, 1, 1}),
       pane = TestScene::colored("Pane", {0.2f, 0.6f, 0.8f, paneAlpha});
  masked["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture}};
  masked["alphaMode"] = "MASK", masked["doubleSided"] = true, pane["alphaMode"] = "BLEND";
  s.add(gridMesh({-1, 0.2f, 1.5f}, {1, 0, 0}, {0, 1, 0}), s.material(masked));
  s.add(gridMesh({0.2f, 0.2f, 1.2f}, {1.5f, 0, 0}, {0, 1.2f, 0}), s.material(pane));
  return s;
}

class Sameness : public BothEyes {
 protected:
  static constexpr int kWidth = 96, kHeight = 72;
};
INSTANTIATE_BOTH_EYES(Sameness);

TEST_P(Sameness, theSameCallGivesTheSameBytes) {
  const Scene scene = richScene().load(), other = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  for (const uint32_t samples : {1u, 4u}) {
    RenderOptions options = sized(kWidth, kHeight, Renderer::aovNames(), samples);
    options.seed = 5;
    const Frame first = draw(scene, Look(), views, options);
    expectSame(draw(scene, Look(), views, options), first);
    // Another scene, look, size, and number of views in between.
    draw(other, quietLook({{"warp.amount", "64"}}),
         viewsFrom(other, {}, 40, 30, GetParam() == Stereo::mono ? Stereo::stereo : Stereo::mono),
         sized(40, 30, {"id"}, 4));
    expectSame(draw(scene, Look(), views, options), first);
    // Asking for more or less does not change the picture.
    options.aovs.clear();
    EXPECT_TRUE(sameBytes(aov(draw(scene, Look(), views, options), ""), aov(first, "")));
  }
}

// The seed moves patterns, and the time is part of the arguments.
TEST_P(Sameness, theSeedShows) {
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  RenderOptions options = sized(kWidth, kHeight);
  const Frame a = draw(scene, Look(), views, options);
  options.seed = 1;
  EXPECT_FALSE(sameBytes(aov(draw(scene, Look(), views, options), ""), aov(a, "")));
}

TEST_F(Sameness, aPairIsTwoViews) {
  NOT_WITH_SANITIZERS();
  const Scene scene = richScene().load();
  // The shadow map lies around the mean of the eyes: even, it is the same for all.
  // What both eyes share by design is apart: the view between them that chooses MetaTexture's scales.
  const Look look = quietLook({{"light.shadowWarp", "0"},
                               {"final.bloom", "1"},
                               {"warp.metatexture.cyclopean", "off"},
                               {"breakup.metatexture.cyclopean", "off"}});
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, Stereo::stereo);
  auto before = viewsFrom(scene, {{2, 2.4f, 6.1f}, {0, 0.8f, 0}}, kWidth, kHeight, Stereo::stereo);
  for (const uint32_t samples : {1u, 4u}) {
    RenderOptions options = sized(kWidth, kHeight, Renderer::aovNames(), samples);
    options.previousViews = before;
    const Frame pair = draw(scene, look, views, options);
    EXPECT_FALSE(sameBytes(aov(pair, "", 0), aov(pair, "", 1)));
    for (size_t v = 0; v < 2; ++v) {
      options.previousViews = {before[v]};
      const Frame alone = draw(scene, look, {views[v]}, options);
      std::vector<std::string> names = perViewAovs();
      names.push_back("");
      for (const std::string& name : names) {
        const Image &a = aov(pair, name, v), &b = aov(alone, name);
        // The map's sigmoid has a least strength: light, and what follows from it, may round another way here
        // and there.
        bool lighted = name.empty();
        for (const char* other : {"shadow", "blur", "final-shadow", "color", "colorize", "final-color"})
          lighted |= name == other;
        if (!lighted) {
          EXPECT_TRUE(sameBytes(a, b))
              << name << ", eye " << v << ", samples " << samples << ", by up to " << largestDifference(a, b);
          continue;
        }
        Difference difference(1e-9);
        for (size_t i = 0; i < a.pixels.size(); ++i) difference.add(a.pixels[i], b.pixels[i]);
        EXPECT_LT(difference.most, 0.02) << name << ", eye " << v << ": " << difference.text();
        EXPECT_LT(difference.beyondPart(), 0.005) << name << ", eye " << v << ": " << difference.text();
      }
    }
    options.previousViews = before;
  }
}

// Two eyes in one place see what one eye sees there, also by the view between them.
TEST_F(Sameness, aPairWithoutDistanceIsOneView) {
  NOT_WITH_SANITIZERS();
  const Scene scene = richScene().load();
  const Look look =
      quietLook(thoseThere({{"final.bloom", "1"}, {"texture.amount", "0.5"}, {"ocean.mode", "on"}}));
  const auto views =
      viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}, 40, 0, 0.0f}, kWidth, kHeight, Stereo::stereo);
  const RenderOptions options = sized(kWidth, kHeight, Renderer::aovNames(), 4);
  const Frame pair = draw(scene, look, views, options), alone = draw(scene, look, {views[0]}, options);
  std::vector<std::string> names = perViewAovs();
  names.push_back("");
  for (const std::string& name : names)
    for (size_t v = 0; v < 2; ++v)
      EXPECT_TRUE(sameBytes(aov(pair, name, v), aov(alone, name)))
          << name << ", eye " << v << ", by up to "
          << largestDifference(aov(pair, name, v), aov(alone, name));
}

// No pass knows which of two eyes is the left one: their middle, from which marks are placed, is the same.
TEST_F(Sameness, eyesThatAreExchangedAreLayersExchanged) {
  NOT_WITH_SANITIZERS();
  const Scene scene = richScene().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, Stereo::stereo);
  const std::vector<View> exchanged{views[1], views[0]};
  std::vector<std::string> names = perViewAovs();
  names.push_back("");
  for (const ShippedLook& shipped : Look::shipped()) {
    const Look look = *Look::load(shipped.name);
    RenderOptions options = sized(kWidth, kHeight, Renderer::aovNames(), 4);
    options.previousViews = views;
    const Frame pair = draw(scene, look, views, options);
    options.previousViews = exchanged;
    const Frame other = draw(scene, look, exchanged, options);
    EXPECT_FALSE(sameBytes(aov(pair, "", 0), aov(pair, "", 1))) << shipped.name;
    for (const std::string& name : names)
      for (size_t v = 0; v < 2; ++v)
        EXPECT_TRUE(sameBytes(aov(pair, name, v), aov(other, name, 1 - v)))
            << shipped.name << ", " << name << ", eye " << v << ", by up to "
            << largestDifference(aov(pair, name, v), aov(other, name, 1 - v));
  }
}

// Eyes of headsets look out of the middle of their pictures, each to its side. What they see in one direction
// is one thing: so two such eyes in one place see parts of one picture, in every pass. What lies on the
// screen (paper, the edges of a wash) would otherwise lie elsewhere for each eye, and hurt.
TEST_F(Sameness, eyesThatLookOutOfTheMiddleSeePartsOfOnePicture) {
  NOT_WITH_SANITIZERS();
  constexpr int kAcross = 256, kDown = 160, kAside = 64, kMargin = 24;  // pixels
  const Scene scene = richScene(0.6f).load();
  const View ahead = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kAcross, kDown, Stereo::mono).front();
  std::vector<View> eyes{ahead, ahead};
  eyes[0].eyeToClip[2][0] = -float(kAside) / kAcross, eyes[1].eyeToClip[2][0] = float(kAside) / kAcross;
  // Behind everything lies a picture, in every second one: a ramp that both eyes see.
  auto ramp = std::make_shared<Image>(Image{64, 40, {"R", "G", "B"}, {}});
  for (int i = 0; i < 64 * 40; ++i) ramp->pixels.insert(ramp->pixels.end(), 3, float(i % 64) / 64);
  bool hasPicture = false;
  for (const ShippedLook& shipped : Look::shipped()) {
    const Look look = *Look::load(shipped.name);
    RenderOptions options = sized(kAcross, kDown, Renderer::aovNames(), 4);
    if (hasPicture = !hasPicture; hasPicture) options.background = ramp;
    const Frame frame = draw(scene, look, eyes, options);
    std::vector<std::string> names = perViewAovs();
    names.push_back("");
    for (const std::string& name : names) {
      const Image &left = aov(frame, name, 0), &right = aov(frame, name, 1);
      if (left.width != uint32_t(kAcross) || left.channels.size() > 4) continue;
      size_t other = 0, all = 0;
      for (int y = kMargin; y < kDown - kMargin; ++y)
        for (int x = kMargin; x + kAside < kAcross - kMargin; ++x) {
          const auto a = texel(left, x + kAside, y), b = texel(right, x, y);
          float apart = 0;
          for (int c = 0; c < int(left.channels.size()) && c < 4; ++c)
            apart = std::max(apart, std::abs(float(a[c]) - float(b[c])));
          other += apart > 0.02f;
          ++all;
        }
      const double part = double(other) / double(all);
      EXPECT_LT(part, 0.005) << shipped.name << ", " << name;
    }
  }
}

// Image passes as fragment shaders and as compute shaders: within what half floats round.
TEST_P(Sameness, fragmentAndComputeGiveOnePicture) {
  const Scene scene = richScene().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  const RenderOptions options =
      sized(kWidth, kHeight, {"warp", "blur", "final-shadow", "color", "lit", "shadow", "depth"});
  const Look look = quietLook({{"final.bloom", "1"}, {"blur.radius", "60"}});
  const Frame fragment = draw(scene, look, views, options);
  Result<Frame> compute = otherRenderer().render(scene, look, 0, views, options);
  ASSERT_TRUE(compute.ok()) << compute.error().message();
  for (size_t v = 0; v < viewCount(); ++v)
    for (const char* name : {"warp", "lit", "shadow", "depth", "blur", "final-shadow", "color", ""}) {
      const Image &a = aov(fragment, name, v), &b = aov(*compute, name, v);
      // One rounding in each of four steps of the blur, more where a threshold makes it steeper.
      const std::string layer = name;
      const double tolerance = layer == "blur"           ? 6e-3
                               : layer == "final-shadow" ? 0.02
                               : layer == "warp"         ? 0.01
                                                         : 4e-3;
      Difference difference(tolerance);
      for (size_t i = 0; i < a.pixels.size(); ++i) {
        // The fourth channel of the warp and the third of the blur are depths: relative.
        if (a.pixels[i] == b.pixels[i]) {
          difference.add(0, 0);  // infinities among them
          continue;
        }
        const double scale = std::max(1.0, std::abs(double(a.pixels[i])));
        difference.add(a.pixels[i] / scale, b.pixels[i] / scale);
      }
      EXPECT_LT(difference.beyondPart(), 2e-3) << "layer '" << layer << "': " << difference.text();
      EXPECT_LT(difference.mean(), 1e-3) << "layer '" << layer << "': " << difference.text();
    }
}

// Pictures of any size, down to one pixel.
TEST_P(Sameness, oddSizes) {
  const Scene scene = richScene().load();
  for (const auto& [width, height] : {std::pair{1u, 1u}, {3u, 7u}, {17u, 1u}, {1u, 33u}, {1000u, 3u}})
    for (const uint32_t samples : {1u, 4u}) {
      const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, width, height, GetParam());
      const Frame frame = draw(scene, Look(), views, sized(width, height, Renderer::aovNames(), samples));
      for (const Frame::Layer& layer : frame.layers)
        for (const Image& image : layer.views) {
          if (layer.name != "shadow-map") {
            EXPECT_EQ(image.width, width);
            EXPECT_EQ(image.height, height);
          }
          ASSERT_EQ(image.pixels.size(), size_t(image.width) * image.height * image.channels.size());
          for (const float value : image.pixels)
            ASSERT_FALSE(std::isnan(value)) << "layer '" << layer.name << "'";
        }
      for (const float value : aov(frame, "").pixels) ASSERT_TRUE(std::isfinite(value));
    }
}

// Four samples are the mean of more than one: edges are softer, insides the same.
TEST_P(Sameness, fourSamplesSoftenEdges) {
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  const Frame one = draw(scene, quietLook(), views, sized(kWidth, kHeight, {"lit"}, 1));
  const Frame four = draw(scene, quietLook(), views, sized(kWidth, kHeight, {"lit"}, 4));
  for (size_t v = 0; v < viewCount(); ++v) {
    size_t partial = 0, different = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const glm::dvec4 a = texel(aov(one, "lit", v), x, y), b = texel(aov(four, "lit", v), x, y);
        EXPECT_TRUE(a.w == 0 || a.w == 1);
        partial += b.w > 0 && b.w < 1;
        different += glm::length(a - b) > 0.01;
      }
    EXPECT_GT(partial, 50u);
    EXPECT_LT(different, size_t(kWidth * kHeight / 8));
  }
}

TEST_F(Sameness, callsThatMakeNoSenseAreRefused) {
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {}, 8, 8);
  const auto kind = [&](const RenderOptions& options, const std::vector<View>& from, double time = 0) {
    const Result<Frame> frame = renderer().render(scene, Look(), time, from, options);
    return frame ? "rendered" : frame.error().kind == ErrorKind::usage ? "usage" : frame.error().message();
  };
  EXPECT_EQ(kind(sized(8, 8), views), "rendered");
  EXPECT_EQ(kind(sized(0, 8), views), "usage");
  EXPECT_EQ(kind(sized(8, 1u << 30), views), "usage");
  EXPECT_EQ(kind(sized(8, 8, {}, 3), views), "usage");
  EXPECT_EQ(kind(sized(8, 8, {"colour"}), views), "usage");
  EXPECT_EQ(kind(sized(8, 8), {}), "usage");
  EXPECT_EQ(kind(sized(8, 8), std::vector<View>(size_t(Renderer::kMaxViews) + 1, views[0])), "usage");
  EXPECT_EQ(kind(sized(8, 8), views, std::nan("")), "usage");
  View broken = views[0];
  broken.worldToEye[3][0] = INFINITY;
  EXPECT_EQ(kind(sized(8, 8), {broken}), "usage");
}

}  // namespace
}  // namespace scumble
