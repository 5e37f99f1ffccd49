// A look's text: keys that stand twice, numbers and letters that no look holds, each with its line.
#include "look/look_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "scumble/look.h"

namespace scumble {
namespace {

Result<Look> read(const std::string& text) {
  return Look::fromJson(text, "a.json");
}

std::vector<std::string> warningsOf(const std::string& text) {
  const Result<Look> look = read(text);
  EXPECT_TRUE(look.ok()) << look.error().message();
  return look ? look->warnings() : std::vector<std::string>();
}

std::string failureOf(const std::string& text) {
  const Result<Look> look = read(text);
  EXPECT_FALSE(look.ok()) << text;
  return look ? "" : look.error().message();
}

TEST(LookText, keysThatStandTwiceAreNamedWithBothLines) {
  EXPECT_EQ(warningsOf("{\"shadow\": {\"threshold\": 0.4, \"steps\": 1},\n \"blur\": {\"radius\": 4}}"),
            std::vector<std::string>());
  EXPECT_EQ(
      warningsOf(
          "{\n\"shadow\": {\n\"threshold\": 0.4,\n\"steps\": 1,\n\"threshold\": 0.5\n},\n\"shadow\": {}}"),
      (std::vector<std::string>{
          "a.json:5 (shadow.threshold): it stands in line 3 already; what stands here counts",
          "a.json:7 (shadow): it stands in line 2 already; what stands here counts"}));
  // However they are spelt, and in lists too.
  EXPECT_EQ(warningsOf("{\"shadow\": {\"threshold\": {\"keys\": [[0, 1]],\n\"ke\\u0079s\": [[0, 0.5]]}}}"),
            std::vector<std::string>{
                "a.json:2 (shadow.threshold.keys): it stands in line 1 already; what stands here counts"});
  // Two patterns are two keys; the same in two objects is no fault.
  EXPECT_TRUE(
      warningsOf("{\"materials\": {\"A\": {\"warp\": {\"amount\": 1}}, \"B\": {\"warp\": {\"amount\": 1}}}}")
          .empty());
}

TEST(LookText, whatStandsThereCountsAsTheWarningSays) {
  const Look twice = *read("{\"description\": \"first\", \"description\": \"second\"}");
  EXPECT_EQ(twice.description(), "second");
}

// Whatever is wrong with what a look says, the message names the line beside the path.
TEST(LookText, wrongContentHasItsLine) {
  const auto lineOf = [](const std::string& text) {
    const Result<Look> look = read(text);
    EXPECT_FALSE(look.ok()) << text;
    return look ? -1 : look.error().line;
  };
  EXPECT_EQ(lineOf("{\"shadow\": {\n\"steps\": 1,\n\"treshold\": 0.4}}"), 3);
  EXPECT_EQ(lineOf("{\"shadow\": {\n\"steps\": 1,\n\"threshold\":\n 90}}"), 3) << "where its key stands";
  EXPECT_EQ(lineOf("{\n\"materials\": {\n\"Sail\": {}, \"Sail.001\": {\n\"warp\": {\"amount\": -1}}}}"), 4);
  EXPECT_EQ(lineOf("{\"warp\": {\"amount\": {\"keys\": [\n[0, 1],\n[1, 2],\n[2, 900]]}}}"), 4);
  EXPECT_EQ(lineOf("{\"warp\": {\"amount\":\n{\"keys\": [\n[0, 1],\n[1,\n900]]}}}"), 5) << "within a key";
  EXPECT_EQ(lineOf("{\"shadow\": {\"threshold\": 0.1},\n\"shadow\": {\n\"threshold\": 9}}"), 3)
      << "that counts";
  EXPECT_EQ(lineOf("{\n\n\"warp.amount\": 1}"), 3);
  EXPECT_EQ(lineOf("{\n\"description\": 7}"), 2);
  EXPECT_EQ(lineOf("{\"a\": {},\n\"extends\": 3}"), 2);
  EXPECT_EQ(lineOf("[1]"), 0) << "nothing in it is wrong, but all of it";
  EXPECT_EQ(failureOf("// note\n{\"shadow\": {\"threshold\": true}}").substr(0, 32),
            "a.json:2 (shadow.threshold): the");
}

TEST(LookText, aHostileFileGetsAFewWarningsOnly) {
  std::string text = "{";
  for (int i = 0; i < 5000; ++i) text += "\"description\": \"\",\n";
  const std::vector<std::string> warnings = warningsOf(text + "\"description\": \"\"}");
  ASSERT_EQ(warnings.size(), 101u);
  EXPECT_EQ(warnings.back(), "a.json: 4900 more keys stand twice");
}

TEST(LookText, warningsStayWhenKnobsAreSet) {
  Look look = *read("{\"shadow\": {},\n\"shadow\": {}}");
  ASSERT_TRUE(look.set("shadow.threshold", "0.4").ok());
  EXPECT_EQ(look.warnings().size(), 1u);
}

TEST(LookText, mistakesHaveTheirLine) {
  EXPECT_EQ(failureOf("{\n\"shadow\": {\n\"threshold\": 1e400\n}}"),
            "a.json:3: a number here is too large; no knob takes such a number");
  EXPECT_EQ(failureOf("{\n\"shadow\": {\n\"threshold\": 0.4,,\n}}").substr(0, 9), "a.json:3:");
  EXPECT_EQ(failureOf("{\n\"shadow\": {\n").substr(0, 7), "a.json:");
  EXPECT_EQ(failureOf("").substr(0, 9), "a.json:1:");
}

// C ends a text there: a picture's name would go on.
TEST(LookText, noTextHoldsANul) {
  for (const char* text : {"{\n\"texture\": {\"metatexture\": {\"example\": \"x.png\\u0000.png\"}}}",
                           "{\n\"description\": \"a\\u0000b\"}",
                           "{\n\"materials\": {\"Sail\\u0000\": {\"warp\": {\"amount\": 1}}}}"})
    EXPECT_EQ(failureOf(text), "a.json:2: a text here holds the character NUL; leave \\u0000 out");
  Look look;
  EXPECT_EQ(look.set("lit.texture", std::string("x.png\0.png", 10)).error().kind, ErrorKind::usage);
  EXPECT_EQ(look.set(std::string("shadow.threshold\0", 17), "1").error().kind, ErrorKind::usage);
  EXPECT_FALSE(Look::load(std::string("/dev/null\0.json", 15)).ok());
}

TEST(LookText, aKeyIsOneWordOfAPath) {
  for (const char* text : {"{\"warp.amount\": 0}", "{\"warp\": {\"metatexture.size\": 200}}",
                           "{\"materials\": {\"Sail\": {\"warp.amount\": 0}}}", "{\"materials.Sail\": {}}"})
    EXPECT_NE(failureOf(text).find("a dot stands in this key; nest it: \""), std::string::npos)
        << failureOf(text);
  EXPECT_EQ(failureOf("{\"warp.amount\": 0}"),
            "a.json:1 (warp.amount): a dot stands in this key; nest it: \"warp\": { \"amount\": ... }");
  // Names of a scene may hold dots.
  EXPECT_TRUE(read("{\"materials\": {\"Paint.001\": {\"warp\": {\"amount\": 0}}}}").ok());
}

// Ten times as many names take ten times as long: a hundred times would be too much.
TEST(LookText, timeIsLinear) {
  const auto seconds = [](int names) {
    std::string text = "{\"materials\": {";
    for (int i = 0; i < names; ++i)
      text += (i ? "," : "") + std::string("\n\"Material") + std::to_string(i) +
              "\": {\"warp\": {\"amount\": 1}}";
    text += "}}";
    double least = 1e9;
    for (int run = 0; run < 3; ++run) {
      const auto start = std::chrono::steady_clock::now();
      const Result<Look> look = Look::fromJson(text, "many.json");
      least =
          std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      EXPECT_TRUE(look.ok());
    }
    return least;
  };
  EXPECT_LT(seconds(30000), 40 * seconds(3000));
}

}  // namespace
}  // namespace scumble
