// Tracks in look files: what is read, who wins, and every mistake with its path.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <set>

#include "look/look_json.h"
#include "look/test_rows.h"
#include "scumble/look.h"

namespace scumble {
namespace {

using look::LookData;
using nlohmann::json;

// A number or whole number of a look, for the whole scene or for a name.
template <class T>
T valueOf(const LookData& look, const std::string& path, look::Target target = look::kScene,
          const std::string& name = "") {
  const Result<look::KnobRef> knob = look::findKnob(path);
  EXPECT_TRUE(knob.ok()) << path;
  std::vector<char> bytes(knob->block->structSize);
  look.fillFor(*knob->block, target, name, bytes.data());
  T value;
  std::memcpy(&value, bytes.data() + knob->row->offset, sizeof(value));
  return value;
}

TEST(LookTracks, everyKnobTakesOne) {
  for (const Row& row : allRows()) {
    const json value = sampleOf(*row.row).value;
    const json track{{"keys", json::array({json::array({-1, value}), json::array({1, value})})}};
    const Look moving = mustRead(nested(row.settingPath(), track)),
               still = mustRead(nested(row.settingPath(), value));
    EXPECT_TRUE(moving.data().isAnimated()) << row.path();
    EXPECT_FALSE(still.data().isAnimated()) << row.path();
    const LookData moment = moving.data().at(0.5);
    EXPECT_FALSE(moment.isAnimated());
    std::vector<char> expected(row.block->structSize), atTime = expected, withoutTime = expected;
    still.data().fillFor(*row.block, look::kClips, "any", expected.data());
    moment.fillFor(*row.block, look::kClips, "any", atTime.data());
    moving.data().fillFor(*row.block, look::kClips, "any", withoutTime.data());
    if (row.row->kind == look::ParamKind::color) continue;  // mixed, so not the same to the bit
    EXPECT_EQ(atTime, expected) << row.path();
    EXPECT_EQ(withoutTime, expected) << row.path();
  }
}

TEST(LookTracks, areReadAsTheyAreWritten) {
  const Look look = mustRead(R"({
      "shadow": { "threshold": { "keys": [[1, 0.2], [3, 0.6]] } },
      "palette": { "shadowTint": { "interpolation": "cubic", "keys": [[0, "#000000"], [2, "#FFFFFF"]] } },
      "ground": { "mode": { "keys": [[0, "on"], [1, "off"]], "interpolation": "step" } },
      "shadowMap": { "cast": { "keys": [[0, true], [1, false]], "repeat": true } },
      "warp": { "metatexture": { "example": { "keys": [[0, "paper"], [1, "torn"]] } } } })");
  const LookData& data = look.data();
  ASSERT_EQ(data.assignments.size(), 5u);
  const auto track = [&](size_t i) { return *data.assignments[i].track; };
  EXPECT_EQ(track(0).interpolation, Interpolation::linear);
  EXPECT_FALSE(track(0).repeat);
  EXPECT_EQ(track(0).keys[1].time, 3);
  EXPECT_EQ(track(0).keys[1].value.number, 0.6);
  EXPECT_EQ(track(1).interpolation, Interpolation::cubic);
  EXPECT_EQ(track(1).keys[1].value.linear, glm::vec3(1));
  for (const size_t i : {2u, 3u, 4u}) EXPECT_EQ(track(i).interpolation, Interpolation::step);
  EXPECT_TRUE(track(3).repeat);
  EXPECT_FLOAT_EQ(valueOf<float>(data.at(2), "shadow.threshold"), 0.4f);
  EXPECT_FLOAT_EQ(valueOf<float>(data, "shadow.threshold"), 0.2f) << "without a time: as at 0";
  EXPECT_EQ(valueOf<int>(data.at(0.9), "ground.mode"), 1);
  EXPECT_EQ(valueOf<int>(data.at(1), "ground.mode"), 2);
  EXPECT_EQ(valueOf<uint32_t>(data.at(0.9), "shadowMap.cast"), 1u);
}

TEST(LookTracks, standInSectionsAndKeepTheOrder) {
  Look look = mustRead(R"({
      "animation": { "hold": { "keys": [[0, 1], [10, 11]] } },
      "nodes": { "Gull*": { "animation": { "hold": { "keys": [[0, 4], [10, 24]] } } } },
      "clips": { "Walk": { "play": { "weight": { "keys": [[0, 1], [2, 0]] } } },
                 "Run": { "play": { "weight": { "keys": [[0, 0], [2, 1]] } } } } })");
  const auto hold = [&](double time, const std::string& node) {
    return valueOf<int>(look.data().at(time), "animation.hold", look::kNodes, node);
  };
  const auto weight = [&](double time, const std::string& clip) {
    return valueOf<float>(look.data().at(time), "play.weight", look::kClips, clip);
  };
  EXPECT_EQ(hold(5, "Gull"), 14);
  EXPECT_EQ(hold(5, "Boat"), 6);
  EXPECT_FLOAT_EQ(weight(0.5, "Walk"), 0.75f);
  EXPECT_FLOAT_EQ(weight(0.5, "Run"), 0.25f);
  EXPECT_EQ(weight(0.5, "Swim"), 0);
  EXPECT_TRUE(look.data().at(1).setsAny(*look::findKnob("play.weight")->block, "weight", look::kClips));
  // What is set by hand wins over tracks, at every time.
  const Look before = look;
  ASSERT_TRUE(look.set("animation.hold", "3").ok());
  for (const double time : {0.0, 5.0}) EXPECT_EQ(hold(time, "Gull"), 3);
  EXPECT_TRUE(before.data().isAnimated());
}

TEST(LookTracks, momentsShareTheirPictures) {
  LookData data = mustRead(R"({"shadow": {"threshold": {"keys": [[0, 0.2], [1, 0.6]]}}})").data();
  data.description = "D";
  data.pictures.push_back(std::make_shared<const look::LookPicture>());
  const LookData moment = data.at(1);
  EXPECT_EQ(moment.pictures, data.pictures);
  EXPECT_EQ(moment.description, "D");
}

TEST(LookTracks, mistakesNameTheirPath) {
  const struct {
    const char *track, *path, *says;
  } cases[] = {
      {R"({})", "", "no keys"},
      {R"({"repeat": true})", "", "no keys"},
      {R"({"key": []})", ".key", "did you mean 'keys'?"},
      {R"({"keys": [[0, 1]], "interpolate": "step"})", ".interpolate", "'interpolation'"},
      {R"({"keys": [[0, 1]], "qqqqqqqqq": 1})", ".qqqqqqqqq", "keys, interpolation and repeat"},
      {R"({"keys": 3})", ".keys", "no list"},
      {R"({"keys": {"0": 1}})", ".keys", "no list"},
      {R"({"keys": []})", ".keys", "at least one"},
      {R"({"keys": [3]})", ".keys[0]", "a time and a value"},
      {R"({"keys": [[0, 1], []]})", ".keys[1]", "a time and a value"},
      {R"({"keys": [[0, 1], [1]]})", ".keys[1]", "a time and a value"},
      {R"({"keys": [[0, 1, 2]]})", ".keys[0]", "a time and a value"},
      {R"({"keys": [["0", 1]]})", ".keys[0][0]", "no number"},
      {R"({"keys": [[null, 1]]})", ".keys[0][0]", "no number"},
      {R"({"keys": [[1e10, 1]]})", ".keys[0][0]", "out of range"},
      {R"({"keys": [[0, 1], [0, 2]]})", ".keys[1][0]", "not later"},
      {R"({"keys": [[0, 1], [2, 2], [1, 2]]})", ".keys[2][0]", "not later"},
      {R"({"keys": [[0, 1], [2, 1e6]]})", ".keys[1][1]", "out of range"},
      {R"({"keys": [[0, 1], [1, 1], [2, "1"]]})", ".keys[2][1]", "wrong type"},
      {R"({"keys": [[0, [1]]]})", ".keys[0][1]", "wrong type"},
      {R"({"keys": [[0, {"keys": [[0, 1]]}]]})", ".keys[0][1]", "wrong type"},
      {R"({"keys": [[0, 1]], "interpolation": 1})", ".interpolation", "step, linear, cubic or ease"},
      {R"({"keys": [[0, 1]], "interpolation": "liner"})", ".interpolation", "'linear'"},
      {R"({"keys": [[0, 1]], "interpolation": "bezier by hand"})", ".interpolation",
       "step, linear, cubic or ease"},
      {R"({"keys": [[0, 1]], "repeat": 1})", ".repeat", "true or false"},
  };
  for (const auto& c : cases)
    for (const std::string path : {"warp.amount", "materials.Sail*.warp.amount"}) {
      const Result<Look> look = Look::fromJson(nested(path, json::parse(c.track)), "a.json");
      ASSERT_FALSE(look.ok()) << c.track;
      EXPECT_EQ(look.error().kind, ErrorKind::unusableFile);
      EXPECT_EQ(look.error().jsonPath, path + c.path) << c.track;
      EXPECT_EQ(look.error().file, "a.json");
      EXPECT_NE(look.error().message().find(c.says), std::string::npos) << look.error().message();
    }
}

TEST(LookTracks, whatHasNothingBetweenOnlySteps) {
  for (const Row& row : allRows())
    for (const char* interpolation : {"linear", "cubic"}) {
      const json track{{"interpolation", interpolation},
                       {"keys", json::array({json::array({0, sampleOf(*row.row).value})})}};
      const Result<Look> look = Look::fromJson(nested(row.settingPath(), track), "a.json");
      EXPECT_EQ(look.ok(), look::isSmooth(row.row->kind)) << row.path();
      if (look.ok()) continue;
      EXPECT_EQ(look.error().jsonPath, row.settingPath() + ".interpolation");
      EXPECT_NE(look.error().advice.find("step"), std::string::npos);
    }
}

TEST(LookTracks, ofKnobsThatDoNotExistOrHoldElsewhere) {
  const json track = json::parse(R"({"keys": [[0, 1]]})");
  const Result<Look> misspelled = Look::fromJson(nested("warp.amont", track), "a.json");
  EXPECT_EQ(misspelled.error().jsonPath, "warp.amont");
  EXPECT_NE(misspelled.error().advice.find("'warp.amount'"), std::string::npos);
  const Result<Look> elsewhere = Look::fromJson(nested("materials.A.blur.radius", track), "a.json");
  EXPECT_NE(elsewhere.error().message().find("whole scene"), std::string::npos);
  const Result<Look> outside = Look::fromJson(nested("play.weight", track), "a.json");
  EXPECT_NE(outside.error().message().find("'clips'"), std::string::npos);
}

TEST(LookTracks, byHandAreThoseOfFiles) {
  for (const Row& row : allRows()) {
    const std::string path = row.settingPath();
    const json other = look::isSmooth(row.row->kind) ? sampleOf(*row.row).value : json();
    json track{{"keys", json::array({json::array({-1, sampleOf(*row.row).value})})}, {"repeat", true}};
    if (!other.is_null()) track["interpolation"] = "cubic";
    const Look fromFile = mustRead(nested(path, track));
    Look asText, typed;
    const Status status = asText.set(path, track.dump());
    ASSERT_TRUE(status.ok()) << path << ": " << status.error().message();
    const auto read = fromFile.track(path);
    ASSERT_TRUE(read.ok() && *read) << path;
    EXPECT_EQ((*read)->keys.size(), 1u);
    EXPECT_EQ((*read)->keys[0].time, -1);
    EXPECT_TRUE((*read)->repeat);
    ASSERT_TRUE(typed.set(path, **read).ok()) << path;
    for (const Look* const look : {&asText, &typed}) {
      const auto again = look->track(path);
      ASSERT_TRUE(again.ok() && *again) << path;
      EXPECT_EQ((*again)->interpolation, (*read)->interpolation) << path;
      EXPECT_EQ((*again)->keys[0].value, (*read)->keys[0].value) << path;
      EXPECT_EQ(*look->get(path, 3), *fromFile.get(path, 3)) << path;
    }
  }
}

TEST(LookTracks, byHandWinOverTheFile) {
  Look look = mustRead(R"({"warp": {"amount": {"keys": [[0, 1], [1, 2]]}}})");
  ASSERT_TRUE(look.set("warp.amount", R"({"keys": [[0, 3], [2, 5]]})").ok());
  EXPECT_EQ(std::get<double>(*look.get("warp.amount", 1)), 4);
  ASSERT_TRUE(look.set("materials.Sail.warp.amount", R"({"keys": [[0, 7], [2, 9]]})").ok());
  EXPECT_EQ(std::get<double>(*look.get("materials.Sail.warp.amount", 1)), 8);
  EXPECT_EQ((*look.track("materials.Hull.warp.amount"))->keys[0].value, KnobValue(3.0)) << "the scene's";
  ASSERT_TRUE(look.set("warp.amount", 6).ok());
  EXPECT_FALSE(*look.track("warp.amount")) << "a value ends a track";
  ASSERT_TRUE(look.unset("warp.amount").ok());
  EXPECT_EQ((*look.track("warp.amount"))->keys.size(), 2u);
  EXPECT_EQ(std::get<double>(*look.get("warp.amount", 0.5)), 1.5);
  EXPECT_FALSE(look.track("materials.*.warp.amount").ok());
  EXPECT_FALSE(look.track("warp.amont").ok());
}

TEST(LookTracks, areListedByTheirPaths) {
  Look look = mustRead(R"({"warp": {"amount": {"keys": [[0, 1]]}, "distance": 2},
                           "materials": {"Sa*": {"warp": {"amount": {"keys": [[0, 1]]}}}},
                           "colorizers": {"Glow": {"volume": {"radius": {"keys": [[0, 1]]}}}}})");
  ASSERT_TRUE(look.set("warp.amount", R"({"keys": [[0, 3]]})").ok());
  const std::vector<std::string> animated = look.animated();
  EXPECT_EQ(
      std::set<std::string>(animated.begin(), animated.end()),
      (std::set<std::string>{"warp.amount", "materials.Sa*.warp.amount", "colorizers.Glow.volume.radius"}));
  EXPECT_EQ(animated.size(), 3u);
  EXPECT_EQ(look.lastKeyTime(), 0);
  ASSERT_TRUE(look.set("materials.Sb*.warp.amount", R"({"keys": [[-5, 3], [2.5, 1]]})").ok());
  EXPECT_EQ(look.lastKeyTime(), 2.5);
  ASSERT_TRUE(look.set("colorizers.Mist.volume.radius", 2).ok());
  EXPECT_EQ(look.names("colorizers"), (std::vector<std::string>{"Glow", "Mist"}));
  EXPECT_TRUE(look.names("materials").empty());
  EXPECT_TRUE(look.names("nothing").empty());
}

TEST(LookTracks, byHandMayBeWrong) {
  const struct {
    const char *path, *text, *said;
  } cases[] = {{"warp.amount", "{", "no JSON"},
               {"warp.amount", "{}", "no keys"},
               {"warp.amount", R"({"keys": [[0, 1], [0, 2]]})", "warp.amount.keys[1][0]: "},
               {"warp.amount", R"({"keys": [[0, 900]]})", "warp.amount.keys[0][1]: "},
               {"warp.amount", R"({"keys": [[0, 1]], "interpolation": "bezier"})", "interpolation"},
               {"warp.amount", R"({"kees": [[0, 1]]})", "'keys'"},
               {"ground.mode", R"({"keys": [[0, "on"]], "interpolation": "cubic"})", "nothing lies between"}};
  for (const auto& c : cases) {
    Look look;
    const Status status = look.set(c.path, c.text);
    ASSERT_FALSE(status.ok()) << c.text;
    EXPECT_EQ(status.error().kind, ErrorKind::usage) << c.text;
    EXPECT_NE(status.error().message().find(c.said), std::string::npos) << status.error().message();
    EXPECT_TRUE(look.data().assignments.empty()) << "nothing has changed";
  }
  const auto key = [](double time, KnobValue value) { return KnobTrack::Key{time, std::move(value)}; };
  const double inf = std::numeric_limits<double>::infinity();
  const KnobTrack wrong[] = {{},
                             {{key(0, 1.0), key(0, 2.0)}},
                             {{key(inf, 1.0)}},
                             {{key(0, 900.0)}},
                             {{key(0, std::string("much"))}},
                             {{key(0, true)}}};
  for (const KnobTrack& track : wrong)
    EXPECT_EQ(Look().set("warp.amount", track).error().kind, ErrorKind::usage);
  EXPECT_FALSE(Look().set("ground.mode", KnobTrack{{key(0, std::string("on"))}}).ok()) << "steps alone";
  // Files are told as files are, and NUL is in nothing.
  const Status gone = Look().set("texture.metatexture.example", R"({"keys": [[0, "gone.png"]]})");
  EXPECT_EQ(gone.error().kind, ErrorKind::unusableFile);
  EXPECT_EQ(gone.error().file, "gone.png");
  EXPECT_FALSE(Look().set("camera.target", R"({"keys": [[0, "a\u0000b"]]})").ok());
  EXPECT_FALSE(
      Look().set("camera.target", KnobTrack{{key(0, std::string("a\0b", 3))}, Interpolation::step}).ok());
  EXPECT_FALSE(Look().set(std::string("warp.amount\0", 12), KnobTrack{{key(0, 1.0)}}).ok());
  // A name may look like a track.
  Look look;
  ASSERT_TRUE(look.set("camera.target", std::string("{Lamp}")).ok());
  EXPECT_EQ(std::get<std::string>(*look.get("camera.target")), "{Lamp}");
}

TEST(LookTracks, haveALimit) {
  json keys = json::array();
  for (size_t i = 0; i < look::kMaxTrackKeys; ++i) keys.push_back({0.1 * double(i), 1});
  EXPECT_TRUE(Look::fromJson(nested("warp.amount", {{"keys", keys}}), "a").ok());
  keys.push_back({1e8, 1});
  const Result<Look> look = Look::fromJson(nested("warp.amount", {{"keys", keys}}), "a");
  ASSERT_FALSE(look.ok());
  EXPECT_EQ(look.error().jsonPath, "warp.amount.keys");
}

}  // namespace
}  // namespace scumble
