// Materials are rows of tables: there may be thousands, and a look may set all that there is for each.
#include "look/test_rows.h"
#include "tests/support/aov.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"
#include "tests/support/sanitized.h"

namespace scumble {
namespace {

using namespace test;

class ManyMaterials : public BothEyes {
 protected:
  static constexpr uint32_t kWidth = 200, kHeight = 160;
  static constexpr int kColumns = kSanitized ? 10 : 50, kRows = kSanitized ? 10 : 40;

  static std::string nameOf(int i) { return "M" + std::to_string(i); }
  static glm::vec4 colorOf(int i) {
    const int green = i / 7 % 11, blue = i / 77 % 13;
    return {float(i % 7) / 6, float(green) / 10, float(blue) / 12, 1};
  }
  static Scene scene() {
    TestScene s;
    for (int i = 0; i < kColumns * kRows; ++i) {
      const int row = i / kColumns;
      s.add(gridMesh({-2.5f + 5.0f * float(i % kColumns) / kColumns, -2 + 4.0f * float(row) / kRows, 0},
                     {5.0f / kColumns, 0, 0}, {0, 4.0f / kRows, 0}),
            s.material(TestScene::unlit(nameOf(i), colorOf(i))));
    }
    return s.load();
  }
  static Look lookOf(const nlohmann::json& materials) {
    const Result<Look> look = Look::fromJson(nlohmann::json{{"materials", materials}}.dump(), "materials");
    if (!look) throw std::runtime_error(look.error().message());
    return *look;
  }
  // Every knob that a material may have, none at its default.
  static nlohmann::json everyKnob() {
    nlohmann::json all;
    for (const Row& row : allRows())
      if (row.block->targets & look::kMaterials) {
        if (row.row->kind == look::ParamKind::picture) continue;  // other files are another test's
        all.merge_patch(nlohmann::json::parse(nested(row.path(), sampleOf(*row.row).value)));
      }
    return all;
  }
};
INSTANTIATE_BOTH_EYES(ManyMaterials);

TEST_P(ManyMaterials, eachHasItsColor) {
  const Scene many = scene();
  const auto views = viewsFrom(many, {{0, 0, 6}}, kWidth, kHeight, GetParam());
  const Frame frame = draw(many, quietLook(), views, sized(kWidth, kHeight, {"lit"}));
  for (size_t v = 0; v < viewCount(); ++v)
    for (int i = 0; i < kColumns * kRows; ++i) {
      const int row = i / kColumns;
      const glm::dvec3 middle(-2.5 + 5.0 * (i % kColumns + 0.5) / kColumns, -2 + 4.0 * (row + 0.5) / kRows,
                              0);
      const glm::ivec2 at(pixelOf(views[v], middle, kWidth, kHeight));
      const glm::dvec4 got = texel(aov(frame, "lit", v), at.x, at.y);
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(std::sqrt(got[c]), std::sqrt(colorOf(i)[c]), 1.5 / 255) << i;
    }
}

// Said of all at once, or of each by its name: the same picture.
TEST_P(ManyMaterials, everyKnobForEachOfThem) {
  const Scene many = scene();
  const auto views = viewsFrom(many, {{1, 0, 6}}, kWidth, kHeight, GetParam());
  const nlohmann::json all = everyKnob();
  nlohmann::json each, own;
  each["Ground"] = own["Ground"] = all;
  for (int i = 0; i < kColumns * kRows; ++i) {
    each[nameOf(i)] = own[nameOf(i)] = all;
    own[nameOf(i)]["lit"]["brightness"] = 0.3 + 0.9 * i / (kColumns * kRows);
  }
  const Frame atOnce = draw(many, lookOf({{"*", all}}), views, sized(kWidth, kHeight));
  const Frame byName = draw(many, lookOf(each), views, sized(kWidth, kHeight));
  const Frame differently = draw(many, lookOf(own), views, sized(kWidth, kHeight));
  for (size_t v = 0; v < viewCount(); ++v) {
    EXPECT_TRUE(sameBytes(atOnce.layers[0].views[v], byName.layers[0].views[v]));
    EXPECT_FALSE(sameBytes(atOnce.layers[0].views[v], differently.layers[0].views[v]));
  }
}

}  // namespace
}  // namespace scumble
