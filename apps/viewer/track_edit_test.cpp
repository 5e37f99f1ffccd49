// Tracks as hands change them, and their texts against what looks make of them.
#include "track_edit.h"

#include <gtest/gtest.h>

#include "knob_text.h"

namespace scumble::viewer {
namespace {

// Any track that a look takes is told by a text that means it again.
TEST(KnobTextOfTracks, meansTheSameAgain) {
  for (const auto& [path, text] : std::vector<std::pair<std::string, std::string>>{
           {"shadow.threshold",
            R"({"keys": [[0, 0.25], [2.5, 0.625]], "interpolation": "ease", "repeat": true})"},
           {"palette.shadowTint", R"({"keys": [[-1, "#102030"], [1, "#FFFFFF"]]})"},
           {"camera.eye", R"({"keys": [[0, [1, 2, 3]], [4, [0.5, 0.25, -8]]], "interpolation": "cubic"})"},
           {"camera.target", R"({"keys": [[0, "A \"B\""], [1, ""]]})"},
           {"ground.mode", R"({"keys": [[0, "on"], [1, "off"]]})"},
           {"animation.hold", R"({"keys": [[0, 1], [1, 3]], "interpolation": "step"})"},
           {"materials.A.b.warp.amount", R"({"keys": [[0, 1]]})"}}) {
    Look look, again;
    ASSERT_TRUE(look.set(path, text).ok()) << path;
    const std::string written = valueText(look, path);
    ASSERT_TRUE(again.set(path, written).ok()) << written;
    const KnobTrack first = **look.track(path), second = **again.track(path);
    EXPECT_EQ(first.interpolation, second.interpolation) << written;
    EXPECT_EQ(first.repeat, second.repeat) << written;
    ASSERT_EQ(first.keys.size(), second.keys.size());
    for (size_t i = 0; i < first.keys.size(); ++i) {
      EXPECT_EQ(first.keys[i].time, second.keys[i].time) << written;
      EXPECT_EQ(first.keys[i].value, second.keys[i].value) << written;
    }
    EXPECT_TRUE(isTrackText(written));
  }
  EXPECT_TRUE(isTrackText("{\"keys\": 1}"));
  for (const char* const text : {"2", "{", "{}", "{Lamp}", "[1]", ""})
    EXPECT_FALSE(isTrackText(text)) << text;
  // Names of files need not be UTF-8.
  const KnobTrack odd{{{0, std::string("caf\xE9.png")}}, Interpolation::step};
  EXPECT_FALSE(textOf(odd, *settingOf("texture.metatexture.example")->knob));
}

TEST(KnobTextOfTracks, keysComeAndGo) {
  Look look;
  ASSERT_TRUE(look.set("warp.amount", 2).ok());
  const auto toggled = [&](double time) {
    const auto text = keyToggledAt(look, "warp.amount", time);
    EXPECT_TRUE(text && look.set("warp.amount", *text)) << *text;
    return *text;
  };
  EXPECT_EQ(toggled(1.25), R"({ "keys": [[1.25, 2]] })");
  // What is turned while there is a track makes keys.
  ASSERT_TRUE(look.set("warp.amount", *turnedAt(look, "warp.amount", "4", 3)).ok());
  EXPECT_EQ(valueText(look, "warp.amount"), R"({ "keys": [[1.25, 2], [3, 4]] })");
  EXPECT_EQ(toggled(2.125), R"({ "keys": [[1.25, 2], [2.125, 3], [3, 4]] })") << "as it was there";
  EXPECT_EQ(*turnedAt(look, "warp.amount", "5", 3.004), R"({ "keys": [[1.25, 2], [2.125, 3], [3, 5]] })");
  toggled(1.25), toggled(3);
  EXPECT_EQ(toggled(2.125), "3") << "the last key leaves its value";
  EXPECT_FALSE(*look.track("warp.amount"));
  EXPECT_FALSE(keyToggledAt(look, "warp.amont", 0));
  EXPECT_EQ(*turnedAt(look, "warp.amount", "7", 1), "7");
  EXPECT_EQ(*keyToggledAt(look, "ground.mode", 0), R"({ "keys": [[0, "auto"]] })");
  EXPECT_EQ(keyedAt(Look(), "camera.roll", 5.0, 1, Interpolation::ease),
            R"({ "keys": [[1, 5]], "interpolation": "ease" })");
}

TEST(KnobTextOfTracks, keysStayInTheirOrder) {
  KnobTrack track;
  for (const double time : {1.0, 2.0, 3.0}) putKey(track, time, time);
  EXPECT_NEAR(moveKey(track, 1, 2.5), 2.5, 1 / kKeysPerSecond);
  EXPECT_NEAR(moveKey(track, 1, 7), 3 - 2 * kNearKey, 2 / kKeysPerSecond);
  EXPECT_NEAR(moveKey(track, 1, -7), 1 + 2 * kNearKey, 2 / kKeysPerSecond);
  EXPECT_NEAR(moveKey(track, 2, 9), 9, 1 / kKeysPerSecond);
  EXPECT_NEAR(moveKey(track, 0, 0), 0, 1 / kKeysPerSecond);
  for (size_t i = 1; i < track.keys.size(); ++i) EXPECT_LT(track.keys[i - 1].time, track.keys[i].time);
  // A picture's own time has reached a key that was set there.
  for (int picture = 0; picture < 500; ++picture) EXPECT_LE(onKeyGrid(picture / 24.0), picture / 24.0);
  // Of two that are near the nearer one.
  const KnobTrack pair{{{4.992, 1.0}, {5, 2.0}}};
  EXPECT_EQ(keyAt(pair, 5), 1u);
  EXPECT_EQ(keyAt(pair, 4.993), 0u);
  EXPECT_FALSE(keyAt(pair, 5.02));
  // No room is left between two.
  KnobTrack narrow{{{0, 1.0}, {1e-3, 2.0}, {2e-3, 3.0}}};
  moveKey(narrow, 1, 1);
  EXPECT_LT(narrow.keys[0].time, narrow.keys[1].time);
  EXPECT_LT(narrow.keys[1].time, narrow.keys[2].time);
}

}  // namespace
}  // namespace scumble::viewer
