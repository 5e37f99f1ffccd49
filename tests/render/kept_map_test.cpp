// The shadow map stays from frame to frame where nothing that it is made from changes: what a renderer that
// goes through changes has is, to the byte, what one has that draws the map anew each time; and it costs
// nothing. (passes/shadow_map)

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "scumble/scene_editor.h"
#include "tests/support/aov.h"
#include "tests/support/render_test.h"

namespace scumble {
namespace {

using namespace test;

class KeptMap : public BothEyes {
 protected:
  static constexpr uint32_t kWidth = 48, kHeight = 36;

  // A leaf with holes, a ball that a clip moves, and one that stands.
  static TestScene moving() {
    TestScene s;
    Image leaf{4, 4, {"R", "G", "B", "A"}, {}};
    for (int i = 0; i < 16; ++i) leaf.pixels.insert(leaf.pixels.end(), {0.3f, 0.5f, 0.2f, float(i % 4) / 3});
    Json masked = TestScene::colored("Leaf", {1, 1, 1, 1});
    masked["pbrMetallicRoughness"]["baseColorTexture"]["index"] = s.texture(leaf);
    masked["alphaMode"] = "MASK", masked["doubleSided"] = true;
    const int sand = s.material(TestScene::colored("Sand", {0.6f, 0.5f, 0.4f, 1})),
              red = s.material(TestScene::colored("Red", {0.6f, 0.1f, 0.1f, 1}));
    s.add(gridMesh({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}), sand);
    s.add(gridMesh({-1, 1.5f, 1}, {1, 0, 0}, {0, 0, -1}), s.material(masked));
    s.add(sphereMesh({1.5f, 1, 0}, 0.5f, 64), red);
    s.add(sphereMesh({0, 0, 0}, 0.4f, 24), red);
    s.clip("Roll", {0, 1, 2}, {{0, 0, 0}, {0, 1, 1}, {0, 1, 1}});
    return s;
  }
  static std::vector<View> from(const Scene& scene, const glm::vec3& eye) {
    return viewsFrom(scene, {eye, {0, 0.5f, 0}}, kWidth, kHeight, GetParam());
  }
};
INSTANTIATE_BOTH_EYES(KeptMap);

TEST_P(KeptMap, isThatOfWhoDrawsItAnew) {
  const TestScene described = moving();
  SceneEditor editor(described.load());
  const glm::vec3 near(1, 2, 4), far(-3, 3, 6);
  struct Moment {
    std::string what;
    bool changes;
    Knobs knobs = {};
    double time = 0;
    glm::vec3 eye{1, 2, 4};
    std::function<void()> edit = [] {};
  };
  const NodeId still{2};
  MaterialDesc leaf = editor.material(*editor.findMaterial("Leaf")).value();
  const auto setCutoff = [&](float cutoff) {
    leaf.alphaCutoff = cutoff;
    EXPECT_TRUE(editor.setMaterial(*editor.findMaterial("Leaf"), leaf).ok());
  };
  const Knobs warped{{"light.shadowWarp", "4"}};
  const std::vector<Moment> moments{
      {"first", true},
      {"the same", false},
      {"from elsewhere", false, {}, 0, far},
      {"another look of the same things", false, {{"shadow.threshold", "0.7"}, {"warp.amount", "9"}}},
      {"a caster moves", true, {}, 0.5},
      {"on", true, {}, 1.5},
      {"and stands", false, {}, 1.8},
      {"another light", true, {{"light.azimuth", "20"}}, 1.8},
      {"back", true, {}, 1.8},
      {"other details", true, {{"levels.error", "16"}}, 1.8},
      {"warped", true, warped, 1.8},
      {"warped, from elsewhere", true, warped, 1.8, far},
      {"holes", true, {}, 1.8, near, [&] { setCutoff(0.9f); }},
      {"who casts", true, {{"materials.Red.shadowMap.cast", "off"}}, 1.8},
      {"all again", true, {}, 1.8},
      {"an edit",
       true,
       {},
       1.8,
       near,
       [&] {
         EXPECT_TRUE(editor.setTransform(still, glm::translate(glm::mat4(1.0f), {-0.5f, 0.3f, 0})).ok());
       }},
      {"hidden", true, {}, 1.8, near, [&] { EXPECT_TRUE(editor.setVisible(still, false).ok()); }},
      {"nothing after it", false, {}, 1.8, far},
  };
  Frame before;
  for (const Moment& moment : moments) {
    moment.edit();
    const Scene scene = editor.scene().value();
    Knobs knobs = moment.knobs;
    knobs.insert(knobs.begin(), {{"light.source", "look"}, {"light.shadowWarp", "0"}});
    const Look look = quietLook(knobs);
    const auto views = from(scene, moment.eye);
    const RenderOptions options = sized(kWidth, kHeight, {"shadow-map", "shadow"});
    Frame kept = renderer().render(scene, look, moment.time, views, options).value();
    // Who comes from another size has all images anew.
    (void)otherRenderer()
        .render(scene, look, moment.time, from(scene, near), sized(20, 15, options.aovs))
        .value();
    const Frame anew = otherRenderer().render(scene, look, moment.time, views, options).value();
    EXPECT_TRUE(sameBytes(aov(kept, "shadow-map"), aov(anew, "shadow-map"))) << moment.what;
    for (size_t v = 0; v < viewCount(); ++v)
      EXPECT_TRUE(sameBytes(aov(kept, "shadow", v), aov(anew, "shadow", v))) << moment.what;
    if (!before.layers.empty()) {
      EXPECT_NE(sameBytes(aov(kept, "shadow-map"), aov(before, "shadow-map")), moment.changes) << moment.what;
    }
    before = std::move(kept);
  }
}

// 80,000 triangles take some milliseconds; to leave them as they are takes none.
TEST_P(KeptMap, costsNothing) {
  TestScene s;
  s.add(sphereMesh({0, 1, 0}, 1, 200), s.material(TestScene::colored("Red", {0.6f, 0.1f, 0.1f, 1})));
  const Scene scene = s.load();
  const auto milliseconds = [&](const Knobs& knobs) {
    const Frame frame = draw(scene, quietLook(knobs), from(scene, {1, 2, 4}), sized(kWidth, kHeight));
    for (const PassTime& pass : frame.stats.passes)
      if (pass.name == "shadow-map") return pass.milliseconds;
    return -1.0;
  };
  double drawn = 1e9, kept = 1e9;
  for (int i = 0; i < 5; ++i) {
    const Knobs knobs{{"light.source", "look"}, {"light.azimuth", std::to_string(10 * i)}};
    drawn = std::min(drawn, milliseconds(knobs));
    kept = std::min(kept, milliseconds(knobs));
  }
  if (drawn < 0) GTEST_SKIP() << "the device has no timestamps";
  EXPECT_LT(kept, 0.2 * drawn);
}

}  // namespace
}  // namespace scumble
