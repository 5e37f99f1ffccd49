// What stays black where paper lies over colours in the light, and where shadows end on facets of round
// forms.
#include <cmath>

#include "base/oklab.h"
#include "tests/support/aov.h"
#include "tests/support/render_test.h"

namespace scumble::passes {
namespace {

using namespace test;

constexpr int kBlacksWidth = 120, kBlacksHeight = 90;

class BlacksTest : public BothEyes {
 protected:
  enum class From { constant, vertices, texture };
  // A sheet of a colour that faces the light, from a material, from vertices or from a texture.
  static Scene sheetOf(const glm::vec4& color, From from, bool isUnlit) {
    TestScene s;
    const glm::vec4 own = from == From::constant ? color : glm::vec4(1);
    Json material = isUnlit ? TestScene::unlit("Sheet", own) : TestScene::colored("Sheet", own);
    if (from == From::texture) {
      Image image{4, 4, {"R", "G", "B", "A"}, {}};
      for (int i = 0; i < 16; ++i) image.pixels.insert(image.pixels.end(), {color.r, color.g, color.b, 1});
      material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", s.texture(image)}};
    }
    TestMesh sheet = gridMesh({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, 2);
    if (from == From::vertices) sheet.colors.assign(sheet.positions.size(), color);
    s.add(sheet, s.material(material));
    s.light({0, 0.2f, 1});
    return s.load();
  }
  // A ball of few triangles, flat or with the ball's own normals, before nothing.
  static Scene ball(int segments, bool isFlat) {
    TestScene s;
    const TestMesh round = sphereMesh({}, 1, segments);
    TestMesh mesh = round;
    if (isFlat) {
      mesh = {};
      for (size_t i = 0; i < round.indices.size(); i += 3) {
        glm::vec3 at[3];
        for (size_t k = 0; k < 3; ++k) at[k] = round.positions[round.indices[i + k]];
        const glm::vec3 normal = glm::normalize(glm::cross(at[1] - at[0], at[2] - at[0]));
        for (size_t k = 0; k < 3; ++k) {
          mesh.indices.push_back(uint32_t(mesh.positions.size()));
          mesh.positions.push_back(at[k]), mesh.normals.push_back(normal);
          mesh.uvs.push_back(round.uvs[round.indices[i + k]]);
        }
      }
    }
    s.add(mesh, s.material(TestScene::colored("Ball", {0.6f, 0.6f, 0.6f, 1})));
    s.light({-1, 0.6f, 0.5f});
    return s.load();
  }
  Frame seen(const Scene& scene, const Knobs& knobs, std::vector<std::string> aovs) {
    const auto views = viewsFrom(scene, {{0, 0, 4}, {0, 0, 0}, 40}, kBlacksWidth, kBlacksHeight, GetParam());
    return draw(scene, quietLook(knobs), views, sized(kBlacksWidth, kBlacksHeight, std::move(aovs)));
  }
};
INSTANTIATE_BOTH_EYES(BlacksTest);

TEST_P(BlacksTest, darkColorsStayBlackWherePaperLiesOverTheRest) {
  const Knobs paper{{"lit.overlay", "#FFFFFF"},
                    {"lit.overlayAmount", "1"},
                    {"shadowed.overlay", "#000000"},
                    {"shadowed.overlayAmount", "1"},
                    {"palette.skyTint", "0"}};
  for (const bool isUnlit : {false, true})
    for (const From from : {From::constant, From::vertices, From::texture})
      for (const float lightness : {0.02f, 0.2f, 0.3f, 0.6f}) {
        const glm::vec4 color(glm::vec3(lightness * lightness * lightness), 1);
        for (const char* const blacks : {"0", "0.25"}) {
          Knobs knobs = paper;
          knobs.emplace_back("palette.blacks", blacks);
          const Frame frame = seen(sheetOf(color, from, isUnlit), knobs, {"lit"});
          const bool isBlack = std::string(blacks) != "0" && lightness < 0.25f;
          for (size_t v = 0; v < viewCount(); ++v)
            EXPECT_NEAR(texel(aov(frame, "lit", v), kBlacksWidth / 2, kBlacksHeight / 2).g, isBlack ? 0 : 1,
                        0.02)
                << int(from) << (isUnlit ? ", unlit, " : ", ") << lightness << ", " << blacks;
        }
      }
}

// Pixels where the light on facets differs from that on the round form, of those that both show.
TEST_P(BlacksTest, shadowsEndAsOnTheRoundForm) {
  const Frame smooth = seen(ball(12, false), {}, {"shadow", "id"}),
              flat = seen(ball(12, true), {}, {"shadow", "id"}),
              rounded = seen(ball(12, true), {{"light.roundness", "1"}}, {"shadow", "id"});
  for (size_t v = 0; v < viewCount(); ++v) {
    double facets = 0, form = 0;
    int count = 0;
    for (int y = 0; y < kBlacksHeight; ++y)
      for (int x = 0; x < kBlacksWidth; ++x) {
        if (texel(aov(smooth, "id", v), x, y).x != 1) continue;
        const double own = texel(aov(smooth, "shadow", v), x, y).x;
        facets += std::abs(texel(aov(flat, "shadow", v), x, y).x - own);
        form += std::abs(texel(aov(rounded, "shadow", v), x, y).x - own);
        ++count;
      }
    EXPECT_GT(count, 1000);
    EXPECT_GT(facets, 0.03 * count);
    EXPECT_LT(form, 0.35 * facets);
  }
}

TEST_P(BlacksTest, aBoxHasItsSides) {
  TestScene s;
  s.add(boxMesh({-0.8f, -0.8f, -0.8f}, {0.8f, 0.8f, 0.8f}),
        s.material(TestScene::colored("Box", {0.6f, 0.6f, 0.6f, 1})),
        glm::mat4(glm::mat3({0.8f, 0, -0.6f}, {0, 1, 0}, {0.6f, 0, 0.8f})));
  s.light({-1, 0.6f, 0.5f});
  const Scene scene = s.load();
  EXPECT_EQ(aov(seen(scene, {}, {"shadow"}), "shadow", 0).pixels,
            aov(seen(scene, {{"light.roundness", "1"}}, {"shadow"}), "shadow", 0).pixels);
}

}  // namespace
}  // namespace scumble::passes
