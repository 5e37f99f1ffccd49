#include "look_text.h"

#include <gtest/gtest.h>

#include <random>

namespace scumble::viewer {
namespace {

std::string with(const std::string& text, const Edits& edits) {
  return withKnobs(text, edits).value_or("refused");
}

TEST(LookText, replacesAValueAndNothingElse) {
  const std::string text = R"({
  // Low sun.
  "light" : {"azimuth":-20 /* west */, "elevation":  8},
	"shadow": {
    "threshold":0.4   , // "threshold": 9
    "steps": 2
  }
}
)";
  std::string expected = text;
  expected.replace(expected.find("0.4"), 3, "0.55");
  EXPECT_EQ(with(text, {{"shadow.threshold", "0.55"}}), expected);
  expected.replace(expected.find("-20"), 3, "-90");
  EXPECT_EQ(with(text, {{"shadow.threshold", "0.55"}, {"light.azimuth", "-90"}}), expected);
  EXPECT_EQ(with(text, {}), text);
}

TEST(LookText, addsWhatDoesNotStandThere) {
  EXPECT_EQ(with("{\n  \"shadow\": {\n    \"steps\": 2\n  }\n}\n", {{"shadow.threshold", "0.5"}}),
            "{\n  \"shadow\": {\n    \"steps\": 2,\n    \"threshold\": 0.5\n  }\n}\n");
  EXPECT_EQ(with(R"({"shadow": {"steps": 2}})", {{"shadow.threshold", "0.5"}}),
            R"({"shadow": {"steps": 2, "threshold": 0.5}})");
  EXPECT_EQ(with(R"({"description": "a: \"b\""})", {{"texture.metatexture.size", "3"}}),
            R"({"description": "a: \"b\"", "texture": { "metatexture": { "size": 3 } }})");
  EXPECT_EQ(with(R"({"shadow": {}})", {{"shadow.threshold", "0.5"}}), R"({"shadow": { "threshold": 0.5 }})");
  EXPECT_EQ(with("", {{"shadow.threshold", "0.5"}, {"shadow.steps", "3"}}),
            "{ \"shadow\": { \"steps\": 3, \"threshold\": 0.5 } }\n");
  EXPECT_EQ(with("{ // nothing yet\n}", {{"ground.mode", "off"}}),
            "{ \"ground\": { \"mode\": \"off\" } // nothing yet\n}");
}

TEST(LookText, valuesAreWrittenAsTheirKnobsAre) {
  EXPECT_EQ(with("{}", {{"background.horizon", "#C04030"}}), R"({ "background": { "horizon": "#C04030" } })");
  EXPECT_EQ(with("{}", {{"shadowMap.cast", "false"}}), R"({ "shadowMap": { "cast": false } })");
}

TEST(LookText, aTrackGivesWay) {
  EXPECT_EQ(with(R"({"shadow": {"threshold": {"keys": [[0, 0.4], [2.5, {"a": "]}"}]]}, "steps": 1}})",
                 {{"shadow.threshold", "0.5"}}),
            R"({"shadow": {"threshold": 0.5, "steps": 1}})");
}

TEST(LookText, refusesWhatItCannotChange) {
  for (const char* text : {"[]", "3", "{", "{\"shadow\": 3}", "{\"a\": }", "nonsense", "{} {}"})
    EXPECT_EQ(withKnobs(text, {{"shadow.threshold", "0.5"}}), std::nullopt) << text;
}

// Whatever is set in whatever order: the look says that, and nothing else has changed.
TEST(LookText, everyKnobIsReadAgain) {
  std::vector<Knob> knobs;
  for (const Knob& knob : Look::knobs())
    if (std::find(knob.targets.begin(), knob.targets.end(), "scene") != knob.targets.end() &&
        knob.type != "name")
      knobs.push_back(knob);
  std::string text = "{\n  \"description\": \"All of it\" // said\n}\n";
  std::mt19937 random(7);
  std::shuffle(knobs.begin(), knobs.end(), random);
  for (const Knob& knob : knobs) text = with(text, {{knob.path, knob.defaultValue}});
  const Result<Look> look = Look::fromJson(text, "all.json");
  ASSERT_TRUE(look.ok()) << look.error().message() << text;
  EXPECT_TRUE(look->warnings().empty());
  EXPECT_NE(text.find("// said"), std::string::npos);
  Look defaults;
  for (const Knob& knob : knobs)
    EXPECT_EQ(look->get(knob.path).value(), defaults.get(knob.path).value()) << knob.path;
}

TEST(LookText, knobsOfSomeNamesStandBelowThem) {
  EXPECT_EQ(with(R"({"materials": {"Paint.001": {"warp": {"amount": 1}}}})",
                 {{"materials.Paint.001.warp.amount", "2"}, {"materials.Sail*.warp.amount", "3"}}),
            R"({"materials": {"Paint.001": {"warp": {"amount": 2}}, "Sail*": { "warp": { "amount": 3 } }}})");
  EXPECT_EQ(withKnobs("{}", {{"materials.Paint.no.knob", "2"}}), std::nullopt);
}

TEST(LookText, marksAndCommentsOfOtherEditors) {
  EXPECT_EQ(with("\xEF\xBB\xBF{\"shadow\": {\"threshold\": 1}}", {{"shadow.threshold", "0.5"}}),
            "\xEF\xBB\xBF{\"shadow\": {\"threshold\": 0.5}}");
  EXPECT_EQ(with("{/*/ {\"shadow\": 3 */ \"shadow\": {\"threshold\": 1}}", {{"shadow.threshold", "0.5"}}),
            "{/*/ {\"shadow\": 3 */ \"shadow\": {\"threshold\": 0.5}}");
  EXPECT_EQ(withKnobs("{}", {{"warp.metatexture.example", "m\xFF.png"}}), std::nullopt);
}

}  // namespace
}  // namespace scumble::viewer
