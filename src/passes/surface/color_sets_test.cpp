// The two sets of colours: graded, from files and from looks, by material, by node and over time.
#include <cmath>

#include "base/test_folder.h"
#include "passes/surface/surface_knobs.h"
#include "scumble/image.h"
#include "tests/support/aov.h"
#include "tests/support/palette_reference.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble::passes {
namespace {

using namespace test;

constexpr double kSetsByte = 1.0 / 255;
constexpr int kSetsWidth = 64, kSetsHeight = 48;

// Four texels of one colour each, linear.
Image fourColors(const std::vector<glm::vec3>& colors) {
  Image image{2, 2, {"R", "G", "B", "A"}, {}};
  for (const glm::vec3& c : colors) image.pixels.insert(image.pixels.end(), {c.r, c.g, c.b, 1});
  return image;
}
const std::vector<glm::vec3> kLight{
    {0.8f, 0.3f, 0.1f}, {0.2f, 0.6f, 0.1f}, {0.9f, 0.9f, 0.8f}, {0.1f, 0.2f, 0.5f}};
const std::vector<glm::vec3> kDark{
    {0.1f, 0.05f, 0.3f}, {0.02f, 0.2f, 0.2f}, {0.4f, 0.1f, 0.1f}, {0.3f, 0.3f, 0.3f}};

class ColorSetsTest : public BothEyes {
 protected:
  static void expectColor(const glm::dvec4& got, const glm::dvec3& expected, double roots = 1.0) {
    // Targets hold square roots in 8 bits.
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(std::sqrt(got[c]), std::sqrt(std::max(expected[c], 0.0)), roots * kSetsByte)
          << "channel " << c;
  }

  // Where the four texels stand on the wall, x and y.
  static glm::dvec3 quarter(int i) { return {i % 2 ? 0.5 : -0.5, i / 2 ? 0.5 : -0.5, 0}; }
  static TestMesh wall() { return gridMesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}); }

  struct Sets {
    glm::dvec4 lit[4], shadowed[4];
  };
  // What a wall with the material shows at each quarter, in all views (which must agree).
  static Sets drawn(const Scene& scene, const Look& look, double time = 0) {
    const auto views = viewsFrom(scene, {{0, 0, 3.5f}}, kSetsWidth, kSetsHeight, GetParam());
    Result<Frame> result =
        renderer().render(scene, look, time, views, sized(kSetsWidth, kSetsHeight, {"lit", "shadowed"}));
    if (!result) throw std::runtime_error(result.error().message());
    Sets sets;
    for (size_t v = 0; v < viewCount(); ++v)
      for (int i = 0; i < 4; ++i) {
        const glm::ivec2 at(pixelOf(views[v], quarter(i), kSetsWidth, kSetsHeight));
        const glm::dvec4 lit = texel(aov(result.value(), "lit", v), at.x, at.y),
                         shadowed = texel(aov(result.value(), "shadowed", v), at.x, at.y);
        if (v > 0) {
          EXPECT_LT(glm::length(lit - sets.lit[i]), 6 * kSetsByte);
          EXPECT_LT(glm::length(shadowed - sets.shadowed[i]), 6 * kSetsByte);
        }
        sets.lit[i] = lit, sets.shadowed[i] = shadowed;
      }
    return sets;
  }

  // A wall whose material has these textures; empty: none.
  static Scene texturedWall(const std::vector<glm::vec3>& base, const std::vector<glm::vec3>& lit,
                            const std::vector<glm::vec3>& shadowed) {
    TestScene s;
    Json json = TestScene::colored("Wall", {1, 1, 1, 1});
    if (!base.empty())
      json["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", s.texture(fourColors(base))}};
    if (!lit.empty()) json["extras"]["scumble_lit_texture"] = s.texture(fourColors(lit));
    if (!shadowed.empty())
      json["extras"]["scumble_shadowed_texture"] = {{"index", s.texture(fourColors(shadowed))}};
    s.add(wall(), s.material(json));
    return s.load();
  }
};
INSTANTIATE_BOTH_EYES(ColorSetsTest);

// Constant colours by the rule itself, vertex colours by its fit.
TEST_P(ColorSetsTest, gradesEachSide) {
  const glm::vec3 color(0.3f, 0.15f, 0.1f);
  for (const bool varied : {false, true}) {
    TestScene s;
    TestMesh mesh = wall();
    if (varied) mesh.colors.assign(4, glm::vec4(color, 1));
    s.add(mesh, s.material(TestScene::colored("Wall", varied ? glm::vec4(1) : glm::vec4(color, 1))));
    const Sets got = drawn(s.load(), quietLook({{"palette.skyTint", "0"},
                                                {"lit.saturation", "1.2"},
                                                {"lit.hue", "-10"},
                                                {"shadowed.brightness", "1.2"},
                                                {"shadowed.overlay", "#203060"},
                                                {"shadowed.overlayAmount", "0.5"}}));
    const PaletteReference palette;
    const GradeReference lit{-10, 1.2, 1, 1, 0, {}}, shadowed{0, 1, 1.2, 1, 0.5, referenceColor(0x203060)};
    const auto litRule = [&](const glm::dvec3& c) { return lit(palette.lit(c)); };
    const auto shadowedRule = [&](const glm::dvec3& c) { return shadowed(palette.shadowed(c)); };
    // Vertex colours have 8 bits.
    const glm::dvec3 own(color);
    expectColor(got.lit[0], varied ? FitReference(litRule)(own) : litRule(own), varied ? 2 : 1);
    expectColor(got.shadowed[0], varied ? FitReference(shadowedRule)(own) : shadowedRule(own),
                varied ? 2 : 1);
  }
}

// A whole set for each side, from the file, as painted.
TEST_P(ColorSetsTest, texturesOfTheFile) {
  const Look plain = quietLook({{"surface.simplify", "0"}});
  const std::vector<glm::vec3> base(4, glm::vec3(0.5f));
  Sets got = drawn(texturedWall(base, kLight, kDark), plain);
  for (int i = 0; i < 4; ++i) {
    expectColor(got.lit[i], kLight[size_t(i)], 1.5);
    expectColor(got.shadowed[i], kDark[size_t(i)], 1.5);
  }
  // Without one for light, the file's own colours are; they have been chosen as well.
  got = drawn(texturedWall(kLight, {}, kDark), plain);
  for (int i = 0; i < 4; ++i) {
    expectColor(got.lit[i], kLight[size_t(i)], 1.5);
    expectColor(got.shadowed[i], kDark[size_t(i)], 1.5);
  }
  // Without one for shadow, it is derived from that for light.
  got =
      drawn(texturedWall(base, kLight, {}), quietLook({{"surface.simplify", "0"}, {"palette.skyTint", "0"}}));
  PaletteReference palette;
  palette.darkest = 0, palette.lightest = 1, palette.litTintAmount = 0;
  const FitReference fit([&](const glm::dvec3& c) { return palette.shadowed(c); });
  for (int i = 0; i < 4; ++i) {
    expectColor(got.lit[i], kLight[size_t(i)], 1.5);
    expectColor(got.shadowed[i], fit(glm::dvec3(kLight[size_t(i)])), 2);
  }
}

// ownShadow goes from the derived set to the file's, `derived` leaves the file's out, and both are graded.
TEST_P(ColorSetsTest, mixesAndGradesTextures) {
  const Scene scene = texturedWall(kLight, {}, kDark), without = texturedWall(kLight, {}, {});
  const std::pair<std::string, std::string> sharp{"surface.simplify", "0"}, level{"palette.skyTint", "0"};
  const Sets derived = drawn(without, quietLook({sharp, level}));
  const Sets half = drawn(scene, quietLook({sharp, level, {"palette.ownShadow", "0.5"}}));
  const Sets left = drawn(scene, quietLook({sharp, level, {"shadowed.texture", "derived"}}));
  const Sets grey = drawn(scene, quietLook({sharp, level, {"shadowed.saturation", "0"}}));
  const FitReference withoutColor(GradeReference{0, 0, 1, 1, 0, {}});
  for (int i = 0; i < 4; ++i) {
    const glm::dvec3 root =
        glm::mix(glm::sqrt(glm::dvec3(derived.shadowed[i])), glm::dvec3(glm::sqrt(kDark[size_t(i)])), 0.5);
    expectColor(half.shadowed[i], root * root, 2);
    expectColor(half.lit[i], glm::dvec3(derived.lit[i]), 1);
    EXPECT_EQ(left.shadowed[i], derived.shadowed[i]);
    EXPECT_EQ(left.lit[i], derived.lit[i]);
    expectColor(grey.shadowed[i], withoutColor(glm::dvec3(kDark[size_t(i)])), 2);
  }
}

// Pictures beside the look, for one material, on what has no texture at all; their colours, not their values.
TEST_P(ColorSetsTest, texturesOfTheLook) {
  TestScene s;
  s.add(wall(), s.material(TestScene::colored("Sail.001", {0.5f, 0.5f, 0.5f, 1})));
  s.add(gridMesh({1, -1, -1}, {2, 0, 0}, {0, 2, 0}),
        s.material(TestScene::colored("Other", {0.5f, 0.5f, 0.5f, 1})));
  const Scene scene = s.load();
  const TestFolder folder;
  ASSERT_TRUE(writePng(folder.file("light.png"), fourColors(kLight)));
  ASSERT_TRUE(writePng(folder.file("dark.png"), fourColors(kDark)));
  const std::string file = folder.file("test.look.json");
  const std::string rest =
      R"("ground": {"mode": "off"}, "background": {"mode": "look", "air": 0}, "surface": {"simplify": 0})";
  Result<Look> look = Look::fromJson(
      "{" + rest +
          R"(, "materials": {"Sail*": {"lit": {"texture": "light.png"}, "shadowed": {"texture": "dark.png"}}}})",
      file);
  ASSERT_TRUE(look) << look.error().message();
  const Sets got = drawn(scene, look.value());
  // Two texels over two metres are magnified: at the middle of each stands its own colour.
  for (int i = 0; i < 4; ++i) {
    expectColor(got.lit[i], kLight[size_t(i)], 6);
    expectColor(got.shadowed[i], kDark[size_t(i)], 6);
  }
}

// By node, with what is below; the nodes share one material.
TEST_P(ColorSetsTest, byNode) {
  TestScene s;
  const int paint = s.material(TestScene::colored("Paint", {0.4f, 0.1f, 0.1f, 1}));
  for (int i = 0; i < 4; ++i) {
    const glm::vec3 middle(quarter(i));
    s.add(gridMesh(middle - glm::vec3(0.5f, 0.5f, 0), {1, 0, 0}, {0, 1, 0}), paint);
    s.json()["nodes"][size_t(i)]["name"] = std::string("Part") + char('A' + i);
  }
  // A > (B > C), D.
  s.json()["nodes"][0]["children"] = {1};
  s.json()["nodes"][1]["children"] = {2};
  s.json()["scenes"][0]["nodes"] = {0, 3};
  const Scene scene = s.load();
  const Sets plain = drawn(scene, quietLook());
  const Sets got = drawn(scene, quietLook({{"nodes.PartA.lit.saturation", "0"},
                                           {"nodes.PartC.lit.saturation", "1"},
                                           {"nodes.PartA.palette.shadowValue", "0.4"},
                                           {"materials.Paint.lit.saturation", "1"}}));
  const auto isGrey = [](const glm::dvec4& c) {
    return std::abs(c.r - c.g) < 0.01 && std::abs(c.g - c.b) < 0.01;
  };
  EXPECT_TRUE(isGrey(got.lit[0]));
  EXPECT_TRUE(isGrey(got.lit[1]));
  EXPECT_EQ(got.lit[2], plain.lit[2]);
  EXPECT_EQ(got.lit[3], plain.lit[3]);
  for (int i = 0; i < 3; ++i) EXPECT_LT(got.shadowed[i].r, 0.8 * plain.shadowed[i].r) << i;
  EXPECT_EQ(got.shadowed[3], plain.shadowed[3]);
}

// Settings that change nothing change no bit, also where nodes have materials of their own.
TEST_P(ColorSetsTest, defaultsChangeNothing) {
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2, 5}}, kSetsWidth, kSetsHeight, GetParam());
  const auto options = sized(kSetsWidth, kSetsHeight, {"lit", "shadowed", "shadow"}, 4);
  const Frame plain = draw(scene, quietLook(), views, options);
  const Frame same = draw(scene,
                          quietLook({{"nodes.*.lit.saturation", "1"},
                                     {"materials.*.shadowed.hue", "0"},
                                     {"shadowed.overlay", "#123456"},
                                     {"palette.shadowCurve", "1"},
                                     {"surface.glow", "0"},
                                     {"light.punctual", "0"}}),
                          views, options);
  for (const char* name : {"", "lit", "shadowed", "shadow"})
    for (size_t v = 0; v < viewCount(); ++v)
      EXPECT_TRUE(sameBytes(aov(plain, name, v), aov(same, name, v))) << name;
}

TEST_P(ColorSetsTest, tracksMoveThem) {
  TestScene s;
  s.add(wall(), s.material(TestScene::colored("Wall", {0.4f, 0.1f, 0.1f, 1})));
  const Scene scene = s.load();
  Result<Look> look = Look::fromJson(
      R"({"ground": {"mode": "off"}, "background": {"mode": "look", "air": 0},
          "materials": {"W*": {"lit": {"saturation": {"keys": [[0, 1], [2, 0]]}}}}})",
      "test");
  ASSERT_TRUE(look) << look.error().message();
  for (const float time : {0.0f, 1.0f, 2.0f}) {
    const GradeReference grade{0, 1 - time / 2, 1, 1, 0, {}};
    expectColor(drawn(scene, look.value(), time).lit[0], grade(PaletteReference().lit({0.4, 0.1, 0.1})));
  }
}

// A texture for all of a scene is not laid on the ground that is put under it.
TEST_P(ColorSetsTest, leaveTheGroundAlone) {
  const TestFolder folder;
  const std::string file = folder.file("ground.png");
  ASSERT_TRUE(writePng(file, fourColors(kLight)));
  TestScene s;
  s.add(boxMesh({-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f}),
        s.material(TestScene::colored("Box", {0.4f, 0.4f, 0.4f, 1})));
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{1, 2, 4}, {0, 0.4f, 0}}, kSetsWidth, kSetsHeight, GetParam());
  const RenderOptions options = sized(kSetsWidth, kSetsHeight, {"lit", "id"});
  const Frame without = draw(scene, quietLook({{"ground.mode", "on"}}), views, options),
              with = draw(scene, quietLook({{"ground.mode", "on"}, {"lit.texture", file}}), views, options);
  size_t ground = 0, changed = 0;
  for (int y = 0; y < kSetsHeight; ++y)
    for (int x = 0; x < kSetsWidth; ++x) {
      const bool isSame = texel(aov(with, "lit"), x, y) == texel(aov(without, "lit"), x, y);
      const double id = texel(aov(with, "id"), x, y).x;
      ground += id > 1, changed += id == 1 && !isSame;
      EXPECT_TRUE(id == 1 || isSame);
    }
  EXPECT_GT(ground, 500u);
  EXPECT_GT(changed, 200u);
}

// Any material may act on the lens.
TEST_P(ColorSetsTest, glow) {
  TestScene s;
  s.add(wall(), s.material(TestScene::colored("Wall", {0.2f, 0.2f, 0.2f, 1})));
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 3.5f}}, kSetsWidth, kSetsHeight, GetParam());
  const auto brightnessBeside = [&](const Look& look) {
    const Frame frame = draw(scene, look, views, sized(kSetsWidth, kSetsHeight, {"shadow"}));
    const glm::ivec2 inside(pixelOf(views[0], {0, 0, 0}, kSetsWidth, kSetsHeight)),
        beside(pixelOf(views[0], {0, 1.05, 0}, kSetsWidth, kSetsHeight));
    return std::pair(texel(aov(frame, "shadow"), inside.x, inside.y).y,
                     texel(aov(frame, ""), beside.x, beside.y).r);
  };
  const auto without = brightnessBeside(quietLook({{"final.bloom", "1"}}));
  const auto with = brightnessBeside(quietLook({{"final.bloom", "1"}, {"materials.W*.surface.glow", "0.6"}}));
  EXPECT_EQ(without.first, 0);
  EXPECT_NEAR(with.first, 0.6, kSetsByte);
  EXPECT_GT(with.second, without.second + 0.02);
}

}  // namespace
}  // namespace scumble::passes
