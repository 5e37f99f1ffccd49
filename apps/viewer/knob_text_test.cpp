#include "knob_text.h"

#include <gtest/gtest.h>

namespace scumble::viewer {
namespace {

TEST(KnobText, numbersAreShortAndMeanThemselves) {
  EXPECT_EQ(textOf(0.4), "0.4");
  EXPECT_EQ(textOf(double(0.4f)), "0.4");
  EXPECT_EQ(textOf(-90), "-90");
  EXPECT_EQ(std::stod(textOf(1 / 3.0)), 1 / 3.0);
  EXPECT_EQ(textOf(glm::vec3(1, 0.5f, -2)), "1,0.5,-2");
}

// Whatever a look may have, in the curve and back.
TEST(KnobText, colorsAreThoseOfLooks) {
  Look look;
  for (int level = 0; level < 256; ++level) {
    char text[8];
    std::snprintf(text, sizeof text, "#%02X%02X%02X", unsigned(level), unsigned(255 - level),
                  unsigned(level / 2));
    ASSERT_TRUE(look.set("background.horizon", std::string(text)).ok());
    const auto linear = std::get<glm::vec3>(look.get("background.horizon").value());
    EXPECT_EQ(hexOf(linear), text);
    EXPECT_EQ(hexOf(linearOf(curveOf(linear))), text);
  }
}

TEST(KnobText, everyDefaultIsReadAgain) {
  for (const Knob& knob : Look::knobs()) {
    if (std::find(knob.targets.begin(), knob.targets.end(), "scene") == knob.targets.end()) continue;
    Look look;
    const KnobValue value = look.get(knob.path).value();
    const std::string text = valueText(look, knob.path);
    EXPECT_EQ(text, knob.defaultValue) << knob.path;
    if (text.empty()) continue;
    ASSERT_TRUE(look.set(knob.path, text).ok()) << knob.path << " = " << text;
    EXPECT_EQ(look.get(knob.path).value(), value) << knob.path;
  }
}

TEST(KnobText, choicesHaveTheirWords) {
  size_t choices = 0;
  for (const Knob& knob : Look::knobs()) {
    if (knob.type != "choice") continue;
    ++choices;
    const std::vector<std::string> words = wordsOf(knob);
    EXPECT_GT(words.size(), 1u) << knob.path;
    EXPECT_NE(std::find(words.begin(), words.end(), knob.defaultValue), words.end()) << knob.path;
  }
  EXPECT_GT(choices, 10u);
}

TEST(KnobText, searchesByAllWords) {
  const Knob knob{
      .path = "shadow.threshold", .unit = "px at 1080p", .meaning = "Roundness of the Shadow shapes."};
  EXPECT_TRUE(isFound(knob, ""));
  EXPECT_TRUE(isFound(knob, "round SHAD"));
  EXPECT_TRUE(isFound(knob, "1080p"));
  EXPECT_FALSE(isFound(knob, "round light"));
}

}  // namespace
}  // namespace scumble::viewer
