// The test sweep: every knob at its least and at its most, on a tiny picture that shows light, shadow, edges,
// texture, holes and glow. Nothing may fail, nothing may be infinite.
#include <cmath>

#include "tests/support/aov.h"
#include "tests/support/render_test.h"

namespace scumble {
namespace {

using namespace test;

// Where a knob is set for all that it may be set for; a colorizer is declared by its name.
std::string settingPath(const Knob& knob) {
  return (knob.targets[0] == "scene"        ? ""
          : knob.targets[0] == "colorizers" ? "colorizers.A."
                                            : knob.targets[0] + ".*.") +
         knob.path;
}

class KnobSweep : public BothEyes {};
INSTANTIATE_BOTH_EYES(KnobSweep);

TEST_P(KnobSweep, everyKnobAtItsEnds) {
  constexpr uint32_t kWidth = 24, kHeight = 18;
  TestScene s = stillLife();
  Json masked = TestScene::colored("Leaf", {1, 1, 1, 1}),
       pane = TestScene::colored("Pane", {0.2f, 0.6f, 0.8f, 0.5f});
  Image leaf{2, 2, {"R", "G", "B", "A"}, {0.2f, 0.5f, 0.3f, 1, 0, 0, 0, 0, 1, 1, 1, 1, 0.5f, 0.5f, 0.5f, 1}};
  masked["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", s.texture(leaf)}};
  masked["alphaMode"] = "MASK", pane["alphaMode"] = "BLEND";
  s.add(gridMesh({-1, 0.2f, 1.5f}, {1, 0, 0}, {0, 1, 0}), s.material(masked));
  s.add(gridMesh({0.2f, 0.2f, 1.2f}, {1.5f, 0, 0}, {0, 1.2f, 0}), s.material(pane));
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{2, 1.5f, 6}, {0, 1.2f, 0}}, kWidth, kHeight, GetParam());
  const std::vector<std::string> aovs{"warp", "shadow",       "lit",   "shadowed",
                                      "blur", "final-shadow", "color", "colorize"};
  std::vector<std::vector<float>> seen;
  const auto check = [&](const Look& look, const std::string& what) {
    Result<Frame> frame = renderer().render(scene, look, 0, views, sized(kWidth, kHeight, aovs, 4));
    ASSERT_TRUE(frame.ok()) << what << ": " << frame.error().message();
    for (const Frame::Layer& layer : frame->layers)
      for (const Image& image : layer.views)
        for (const float value : image.pixels)
          ASSERT_TRUE(std::isfinite(value)) << what << ", layer '" << layer.name << "'";
  };
  check(Look(), "defaults");
  size_t count = 0;
  for (const Knob& knob : Look::knobs())
    for (const std::string& value : {knob.min, knob.max}) {
      // What is named has no least and most: every choice is tried.
      Look look;
      // A colorizer that does nothing is left out.
      if (knob.targets[0] == "colorizers" && knob.path != "grade.gain") {
        ASSERT_TRUE(look.set("colorizers.A.grade.gain", "2").ok());
      }
      // An ocean that is quickly drawn.
      if (knob.path.starts_with("ocean.")) {
        ASSERT_TRUE(look.set("ocean.mode", "on").ok());
        ASSERT_TRUE(look.set("ocean.grid", "8").ok());
        ASSERT_TRUE(look.set("ocean.tiles", "3").ok());
      }
      const Status set = look.set(settingPath(knob), value);
      ASSERT_TRUE(set.ok()) << knob.path << " = " << value << ": " << set.error().message();
      check(look, knob.path + " = " + value);
      ++count;
    }
  EXPECT_GT(count, 60u);
  // All at their least, and all at their most.
  for (const bool most : {false, true}) {
    Look look;
    for (const Knob& knob : Look::knobs())
      ASSERT_TRUE(look.set(settingPath(knob), most ? knob.max : knob.min).ok());
    check(look, most ? "all at their most" : "all at their least");
  }
}

}  // namespace
}  // namespace scumble
