// The geometry pass against the CPU: light from the Lambert term, colours from the palette rule, lens, holes,
// and blended surfaces composited from far to near.
#include <algorithm>
#include <cmath>

#include "frame/metatexture.h"
#include "passes/surface/surface_knobs.h"
#include "stage/light.h"
#include "stage/palette.h"
#include "tests/support/aov.h"
#include "tests/support/metatexture_reference.h"
#include "tests/support/palette_reference.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble::passes {
namespace {

using namespace test;

constexpr double kByte = 1.0 / 255;

class SurfaceTest : public BothEyes {
 protected:
  static constexpr int kWidth = 96, kHeight = 72;

  static void expectColor(const glm::dvec4& got, const glm::dvec3& expected, double roots = 1.0) {
    // Targets hold square roots in 8 bits.
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(std::sqrt(got[c]), std::sqrt(std::max(expected[c], 0.0)), roots * kByte) << "channel " << c;
  }
};
INSTANTIATE_BOTH_EYES(SurfaceTest);

TEST_P(SurfaceTest, lambertOfASphere) {
  TestScene test;
  test.add(sphereMesh({0, 0, 0}, 1, 96), test.material(TestScene::colored("Grey", {0.5f, 0.5f, 0.5f, 1})));
  const glm::dvec3 toLight = glm::normalize(glm::dvec3(-0.5, 0.7, 0.6));
  test.light(glm::vec3(toLight));
  const Scene scene = test.load();
  const auto views = viewsFrom(scene, {{0.3f, 0.5f, 3}}, kWidth, kHeight, GetParam());
  for (const auto& [terminator, sharpness, width] :
       {std::tuple{0.1, 4.0, 0.45}, {-0.4, 1.0, 0.2}, {0.3, 12.0, 1.0}}) {
    const Look look = quietLook({{"shadowMap.cast", "off"},
                                 {"light.terminator", std::to_string(terminator)},
                                 {"light.terminatorSharpness", std::to_string(sharpness)},
                                 {"surface.indicationWidth", std::to_string(width)}});
    const Frame frame = draw(scene, look, views, sized(kWidth, kHeight, {"shadow", "normal", "id"}));
    for (size_t v = 0; v < viewCount(); ++v) {
      // The term is interpolated over triangles of 4 degrees: off by up to 1 - cos(2 degrees) = 6e-4.
      Difference light(0.5 * kByte + 1.5e-3 * sharpness), marks(0.5 * kByte + 1.5e-3 / std::min(width, 0.1));
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          if (texel(aov(frame, "id", v), x, y).x == 0) continue;
          const double turn =
              glm::dot(glm::dvec3(texel(aov(frame, "normal", v), x, y)), toLight) - terminator;
          const glm::dvec4 got = texel(aov(frame, "shadow", v), x, y);
          light.add(got.x, std::clamp(0.5 + turn * sharpness, 0.0, 1.0));
          // Towards the silhouette, and where the term hardly changes, marks grow less.
          const auto turnAt = [&](int dx, int dy) {
            return glm::dot(glm::dvec3(texel(aov(frame, "normal", v), x + dx, y + dy)), toLight);
          };
          const double change =
              kHeight * glm::length(glm::dvec2(turnAt(1, 0) - turnAt(-1, 0), turnAt(0, 1) - turnAt(0, -1))) /
              2;
          // On the dark side they reach to where no light does.
          const double reach = turn < 0 ? std::min(width, std::max(terminator, 1e-3)) : width;
          bool isInside = true;
          for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
            isInside &= texel(aov(frame, "id", v), x + dx, y + dy).x != 0;
          if (isInside && change > 0.8 && change < 15 && std::abs(turn) > 0.01)
            marks.add(got.z, std::clamp(1 - std::abs(turn) / reach, 0.0, 1.0));
          EXPECT_EQ(got.y, 0);
          EXPECT_EQ(got.w, 1);
        }
      EXPECT_GT(light.count, 1500u);
      EXPECT_EQ(light.beyond, 0u) << light.text();
      EXPECT_EQ(marks.beyond, 0u) << marks.text();
    }
  }
}

// The palette rule itself for plain colours; where colours vary, its polynomial.
TEST_P(SurfaceTest, colorsFollowThePalette) {
  const glm::vec4 colors[] = {
      {0.7f, 0.12f, 0.08f, 1}, {0.1f, 0.25f, 0.6f, 1}, {1, 1, 1, 1}, {0.01f, 0.01f, 0.01f, 1}};
  TestScene s;
  for (int i = 0; i < 4; ++i) {
    const float x = float(i) - 2;
    s.add(gridMesh({x, 0, 0}, {1, 0, 0}, {0, 1, 0}), s.material(TestScene::colored("Plain", colors[i])));
    TestMesh varied = gridMesh({x, -1, 0}, {1, 0, 0}, {0, 1, 0});
    varied.colors.assign(4, colors[i]);
    s.add(varied, s.material(TestScene::colored("Varied", {1, 1, 1, 1})));
  }
  const Scene scene = s.load();
  const Look look = quietLook(
      {{"palette.shadowTintAmount", "0.8"}, {"palette.darkest", "0.1"}, {"palette.skyTint", "0.2"}});
  PaletteReference palette;
  palette.shadowTintAmount = 0.8, palette.darkest = 0.1;
  const auto views = viewsFrom(scene, {{0, 0, 3.5f}}, kWidth, kHeight, GetParam());
  const Frame frame = draw(scene, look, views, sized(kWidth, kHeight, {"lit", "shadowed"}));
  // The normals are level: half sky, half ground.
  const glm::dvec3 tint = skyTintReference(0.2, 0);
  const FitReference litFit([&](const glm::dvec3&c) { return palette.lit(c); }),
      shadowedFit([&](const glm::dvec3&c) { return palette.shadowed(c); });
  for (size_t v = 0; v < viewCount(); ++v)
    for (int i = 0; i < 4; ++i)
      for (const bool varied : {false, true}) {
        const glm::dvec2 at = pixelOf(views[v], {i - 1.5, varied ? -0.5 : 0.5, 0}, kWidth, kHeight);
        const glm::dvec3 own(colors[i]);
        const glm::dvec3 lit = varied ? litFit(own) : palette.lit(own);
        const glm::dvec3 shadowed = (varied ? shadowedFit(own) : palette.shadowed(own)) * tint;
        // Vertex colours have 8 bits.
        const double roots = varied ? 2 : 1;
        SCOPED_TRACE(std::to_string(i) + (varied ? " varied" : " plain"));
        expectColor(texel(aov(frame, "lit", v), int(at.x), int(at.y)), lit, roots);
        expectColor(texel(aov(frame, "shadowed", v), int(at.x), int(at.y)), shadowed, roots);
      }
}

// A scene's own colour in shadow wins, and its colour in light is then its own as well.
TEST_F(SurfaceTest, ownShadowedColor) {
  TestScene s;
  Json json = TestScene::colored("Sail", {0.8f, 0.7f, 0.4f, 1});
  json["extras"]["scumble_shadowed"] = "#8E93AC";
  s.add(gridMesh({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}), s.material(json));
  const Frame frame = draw(s.load(), quietLook({{"palette.skyTint", "0"}}), {parallelView(1, 1)},
                           sized(8, 8, {"lit", "shadowed"}));
  const auto linear = [](int srgb) { return std::pow((srgb / 255.0 + 0.055) / 1.055, 2.4); };
  expectColor(texel(aov(frame, "lit"), 4, 4), {0.8, 0.7, 0.4});
  expectColor(texel(aov(frame, "shadowed"), 4, 4), {linear(0x8E), linear(0x93), linear(0xAC)});
}

TEST_P(SurfaceTest, unlitAndEmissive) {
  TestScene s;
  Json lamp = TestScene::colored("Lamp", {0.2f, 0.2f, 0.2f, 1});
  lamp["emissiveFactor"] = {0.4, 0.2, 0.1};
  s.add(gridMesh({-2, -1, 0}, {2, 0, 0}, {0, 2, 0}),
        s.material(TestScene::unlit("Sign", {0.3f, 0.6f, 0.2f, 1})));
  s.add(gridMesh({0, -1, 0}, {2, 0, 0}, {0, 2, 0}), s.material(lamp));
  s.light({0, 0.2f, -1});  // from behind: both would be in shadow
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 3.5f}}, kWidth, kHeight, GetParam());
  const Frame frame = draw(scene, quietLook({{"surface.lens", "1.5"}, {"palette.skyTint", "0"}}), views,
                           sized(kWidth, kHeight, {"shadow", "lit", "shadowed"}));
  const PaletteReference palette;
  for (size_t v = 0; v < viewCount(); ++v) {
    const glm::ivec2 sign(pixelOf(views[v], {-1, 0, 0}, kWidth, kHeight)),
        bulb(pixelOf(views[v], {1, 0, 0}, kWidth, kHeight));
    EXPECT_EQ(texel(aov(frame, "shadow", v), sign.x, sign.y), glm::dvec4(1, 0, 0, 1));
    EXPECT_EQ(texel(aov(frame, "lit", v), sign.x, sign.y), texel(aov(frame, "shadowed", v), sign.x, sign.y));
    const glm::dvec3 emissive(0.4, 0.2, 0.1);
    const glm::dvec4 shadow = texel(aov(frame, "shadow", v), bulb.x, bulb.y);
    EXPECT_NEAR(shadow.x, 0, kByte);
    EXPECT_NEAR(shadow.y, 1.5 * glm::dot(emissive, glm::dvec3(0.2126, 0.7152, 0.0722)), kByte);
    expectColor(texel(aov(frame, "lit", v), bulb.x, bulb.y), palette.lit(glm::dvec3(0.2f)) + emissive);
    expectColor(texel(aov(frame, "shadowed", v), bulb.x, bulb.y),
                palette.shadowed(glm::dvec3(0.2f)) + emissive);
  }
}

// The cutoff is a threshold on the texture's alpha; holes show what is behind, and nothing.
TEST_P(SurfaceTest, maskedHoles) {
  Image leaf{8, 8, {"R", "G", "B", "A"}, {}};
  for (int i = 0; i < 64; ++i) {
    const float alpha = (i % 8 + i / 8) % 2 ? 0.7f : 0.5f;
    leaf.pixels.insert(leaf.pixels.end(), {0.5f, 0.5f, 0.5f, alpha});
  }
  TestScene s;
  const int texture = s.texture(leaf);
  Json json = TestScene::colored("Leaf", {1, 1, 1, 1});
  json["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture}};
  json["alphaMode"] = "MASK";
  json["alphaCutoff"] = 0.6;
  s.add(gridMesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), s.material(json));
  s.light({0.3f, 0.3f, 1});
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 3}}, kWidth, kHeight, GetParam());
  const Frame frame = draw(scene, quietLook({{"surface.simplify", "0"}}), views,
                           sized(kWidth, kHeight, {"shadow", "lit", "id", "warp"}));
  for (size_t v = 0; v < viewCount(); ++v)
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < 8; ++i) {
        // Row 0 of the picture is at v = 0, which this mesh has at its lower side.
        const glm::ivec2 at(pixelOf(views[v], {(i + 0.5) / 4 - 1, (j + 0.5) / 4 - 1, 0}, kWidth, kHeight));
        const double there = (i + j) % 2;
        EXPECT_EQ(texel(aov(frame, "shadow", v), at.x, at.y).w, there);
        EXPECT_EQ(texel(aov(frame, "lit", v), at.x, at.y).w, there);
        EXPECT_EQ(texel(aov(frame, "id", v), at.x, at.y).x, there);
      }
}

// Three panes over each other and a wall, listed in the wrong order.
TEST_P(SurfaceTest, blendedFromFarToNear) {
  TestScene s;
  const glm::vec4 colors[] = {{0.8f, 0.1f, 0.1f, 0.5f}, {0.1f, 0.7f, 0.2f, 0.25f}, {0.1f, 0.2f, 0.8f, 0.75f}};
  const float z[] = {0.5f, -0.5f, 0.0f};
  for (int i = 0; i < 3; ++i) {
    Json json = TestScene::colored("Pane", colors[i]);
    json["alphaMode"] = "BLEND";
    s.add(gridMesh({-1, -1, z[i]}, {2, 0, 0}, {0, 2, 0}), s.material(json));
  }
  s.add(gridMesh({-1, -1, -1}, {1, 0, 0}, {0, 2, 0}),
        s.material(TestScene::colored("Wall", {0.5f, 0.5f, 0.5f, 1})));
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 6}}, kWidth, kHeight, GetParam());
  // Nothing is in shadow: blended surfaces have their light and shadow side in their colours.
  const Look look = quietLook({{"light.terminator", "-0.9"}, {"shadowMap.cast", "off"}});
  const Frame frame = draw(scene, look, views, sized(kWidth, kHeight, {"lit"}));
  const PaletteReference palette;
  for (size_t v = 0; v < viewCount(); ++v)
    for (const bool wall : {false, true}) {
      // Composited as roots, since that is what the target holds.
      glm::dvec3 sum = wall ? glm::sqrt(palette.lit(glm::dvec3(0.5))) : glm::dvec3(0.0);
      double coverage = wall;
      for (const int i : {1, 2, 0}) {
        const double a = colors[i].a;
        sum = glm::mix(sum, glm::sqrt(palette.lit(glm::dvec3(colors[i]))), a);
        coverage += a * (1 - coverage);
      }
      const glm::ivec2 at(pixelOf(views[v], {wall ? -0.5 : 0.5, 0, 0}, kWidth, kHeight));
      const glm::dvec4 got = texel(aov(frame, "lit", v), at.x, at.y);
      EXPECT_NEAR(got.w, coverage, 3 * kByte);
      expectColor(got, glm::dvec3((sum / coverage) * (sum / coverage)), 4);
    }
}

// Panes of one mesh, from both sides: they lie in one list of triangles, whose order is the wrong one from
// one of them. Some hang on a joint that carries them through the others.
TEST_P(SurfaceTest, trianglesOfOneBlendedMeshFromFarToNear) {
  const glm::vec4 colors[] = {
      {0.8f, 0.1f, 0.1f, 0.5f}, {0.1f, 0.7f, 0.2f, 0.5f}, {0.1f, 0.2f, 0.8f, 0.5f}, {0.7f, 0.6f, 0.1f, 0.5f}};
  const float z[] = {0.6f, 0.2f, -0.2f, -0.6f};
  for (const bool isSkinned : {false, true}) {
    TestScene s;
    TestMesh panes;
    for (int i = 0; i < 4; ++i) {
      append(panes, gridMesh({-1, -1, z[i]}, {2, 0, 0}, {0, 2, 0}, 2), colors[i]);
      if (isSkinned)
        while (panes.joints.size() < panes.positions.size())
          panes.joints.push_back({i % 2, 0, 0, 0}), panes.weights.push_back({1, 0, 0, 0});
    }
    Json json = TestScene::unlit("Panes", {1, 1, 1, 1});
    json["alphaMode"] = "BLEND";
    json["doubleSided"] = true;
    const float carried = isSkinned ? 0.9f : 0.0f;
    if (isSkinned)
      s.addSkinned(panes, s.material(json),
                   {glm::mat4(1.0f), glm::translate(glm::mat4(1.0f), {0, 0, carried})},
                   {glm::mat4(1.0f), glm::mat4(1.0f)});
    else
      s.add(panes, s.material(json));
    const Scene scene = s.load();
    for (const float side : {1.0f, -1.0f}) {
      const auto views = viewsFrom(scene, {{0, 0, 6 * side}}, kWidth, kHeight, GetParam());
      const Frame frame = draw(scene, quietLook(), views, sized(kWidth, kHeight, {"lit"}));
      std::vector<std::pair<float, int>> order;
      for (int i = 0; i < 4; ++i) order.push_back({side * (z[i] + (i % 2) * carried), i});
      std::sort(order.begin(), order.end());
      glm::dvec3 sum(0.0);
      double coverage = 0;
      for (const auto& [nearness, i] : order) {
        const double a = colors[i].a;
        sum = glm::mix(sum, glm::sqrt(glm::dvec3(colors[i])), a);
        coverage += a * (1 - coverage);
      }
      for (size_t v = 0; v < viewCount(); ++v) {
        const glm::ivec2 at(pixelOf(views[v], {0.3, 0.2, 0}, kWidth, kHeight));
        const glm::dvec4 got = texel(aov(frame, "lit", v), at.x, at.y);
        EXPECT_NEAR(got.w, coverage, 3 * kByte);
        expectColor(got, glm::dvec3((sum / coverage) * (sum / coverage)), 4);
      }
    }
  }
}

// Two triangles across each other's edges, as one mesh or as two: by their distances from between the eyes;
// of a parallel projection, along its axis. Without the shadow map's warp, which splits triangles: parts that
// lie before each other have nearly the same distance in every sense.
TEST_P(SurfaceTest, blendedByDistancesFromBetweenTheEyes) {
  const glm::vec4 colors[] = {{0.8f, 0.1f, 0.1f, 0.5f}, {0.1f, 0.2f, 0.8f, 0.5f}};
  struct Case {
    bool isParallel;
    glm::vec3 tips[2];  // each triangle goes from its tip to a little beyond the middle
    int nearer;
  };
  // From the left eye the first one is the nearer by far; from the middle it is the farther by a little. And
  // the second one is the nearer along the axis, but its middle is farther away from the eye.
  for (const Case& c :
       {Case{false, {{-4, 0, 0}, {4, 0, 0.1f}}, 1}, Case{true, {{-0.8f, 0, 0}, {4, 0, 0.05f}}, 1}})
    for (const int order : {0, 1, 2, 3}) {  // each of them first, as two meshes and as one
      const bool isOneMesh = order >= 2;
      TestScene s;
      TestMesh both;
      Json json = TestScene::unlit("Panes", {1, 1, 1, 1});
      json["alphaMode"] = "BLEND";
      json["doubleSided"] = true;
      const int material = s.material(json);
      for (const int i : {order % 2, 1 - order % 2}) {
        const glm::vec3 tip = c.tips[i];
        const float beyond = tip.x < 0 ? 0.5f : -0.5f;
        TestMesh one;
        one.positions = {tip, {beyond, -1.5f, tip.z}, {beyond, 1.5f, tip.z}};
        one.normals.assign(3, {0, 0, 1});
        one.uvs.assign(3, {0, 0});
        one.uvs[1] = {1, 0}, one.uvs[2] = {0, 1};
        one.indices = {0, 1, 2};
        TestMesh colored;
        append(colored, one, colors[i]);
        append(both, one, colors[i]);
        if (!isOneMesh) s.add(colored, material);
      }
      if (isOneMesh) s.add(both, material);
      const Scene scene = s.load();
      const auto views =
          c.isParallel ? std::vector<View>(viewCount(), parallelView(2, 4.0f / 3))
                       : viewsFrom(scene, {{0, 0, 4}, {0, 0, 0}, 40, 0, 1}, kWidth, kHeight, GetParam());
      const Frame frame =
          draw(scene, quietLook({{"light.shadowWarp", "0"}}), views, sized(kWidth, kHeight, {"lit"}));
      const glm::dvec4 first(colors[1 - c.nearer]), last(colors[c.nearer]);
      // Composited as roots; coverage 0.5 and then 0.75.
      const glm::dvec3 root =
          (0.25 * glm::sqrt(glm::dvec3(first)) + 0.5 * glm::sqrt(glm::dvec3(last))) / 0.75;
      for (size_t v = 0; v < viewCount(); ++v) {
        const glm::ivec2 at(pixelOf(views[v], {0, 0, 0.05}, kWidth, kHeight));
        SCOPED_TRACE(std::string(c.isParallel ? "parallel" : "perspective") +
                     (isOneMesh ? ", one mesh" : ""));
        expectColor(texel(aov(frame, "lit", v), at.x, at.y), root * root, 4);
      }
    }
}

// A texture of the look, painted by MetaTexture on colours that the scene has: against the reference, in each
// way of painting.
TEST_P(SurfaceTest, paintsTexturesOfTheLook) {
  TestScene s;
  s.add(gridMesh({-4, -3, 0}, {8, 0, 0}, {0, 6, 0}, 1, {5, 3}),
        s.material(TestScene::unlit("Wall", {0.36f, 0.16f, 0.64f, 1})));
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{3, 1, 4}, {0, 0, 0}}, kWidth, kHeight, GetParam());
  const glm::dvec3 root(0.6, 0.4, 0.8);
  for (const char* blend : {"multiply", "overlay", "replace"}) {
    const double amount = 0.75;
    const Look look = quietLook({{"texture.amount", std::to_string(amount)},
                                 {"texture.blend", blend},
                                 {"texture.metatexture.example", "paper"},
                                 {"texture.metatexture.size", "3000"},
                                 {"texture.metatexture.cyclopean", "off"}});
    const Frame frame = draw(scene, look, views, sized(kWidth, kHeight, {"lit", "uv", "uv-gradient", "id"}));
    MetaTextureReference reference;
    reference.texture.pixels = builtInExample(2);
    reference.mean = meanOf(reference.texture.pixels);
    reference.size = 3000.0 * kHeight / 1080;
    reference.skew = MetaTextureReference::exact;
    reference.skewLevels = 2;
    for (size_t v = 0; v < viewCount(); ++v) {
      Difference colors(0.02);
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          if (texel(aov(frame, "id", v), x, y).x == 0) continue;
          const glm::dvec4 g = texel(aov(frame, "uv-gradient", v), x, y);
          const glm::dvec2 uv(texel(aov(frame, "uv", v), x, y));
          const glm::dvec3 over = glm::clamp(glm::dvec3(reference.at(uv, {g.x, g.y}, {g.z, g.w}).value),
                                             glm::dvec3(0.0), glm::dvec3(1.0));
          glm::dvec3 painted = over;
          for (int c = 0; c < 3; ++c) {
            if (blend[0] == 'm') painted[c] = root[c] * over[c];
            if (blend[0] == 'o')
              painted[c] = root[c] > 0.5 ? 1 - 2 * (1 - root[c]) * (1 - over[c]) : 2 * root[c] * over[c];
            colors.add(std::sqrt(texel(aov(frame, "lit", v), x, y)[c]),
                       glm::mix(root[c], painted[c], amount));
          }
        }
      EXPECT_GT(colors.count, 3000u);
      EXPECT_LT(colors.beyondPart(), 0.01) << blend << ": " << colors.text();
      EXPECT_LT(colors.mean(), 5e-3) << blend << ": " << colors.text();
    }
  }
}

}  // namespace
}  // namespace scumble::passes
