// Settings for some materials, nodes or clips: patterns, who wins, and where a knob may not stand.
#include <gtest/gtest.h>

#include "look/setting_path.h"
#include "look/test_rows.h"
#include "scumble/look.h"

namespace scumble {
namespace {

using look::Assignment;
using look::LookData;
using look::ParamBlock;
using look::ParamKind;
using nlohmann::json;

// -- Materials

const Row& knobForMaterials() {
  static const Row found = [] {
    for (const Row& row : allRows())
      if ((row.block->targets & look::kMaterials) && row.row->kind == ParamKind::number && row.row->min == 0)
        return row;
    return Row{};
  }();
  return found;
}

float forMaterial(const Look& look, const std::string& material) {
  const Row& row = knobForMaterials();
  return numberIn(bytesOf(*row.block, look, &material), *row.row);
}

// Values that this knob takes, by a number from 1 to 9.
double level(int i) {
  return knobForMaterials().row->max * i / 10;
}
std::string text(int i) {
  return json(level(i)).dump();
}

TEST(LookMaterials, patternsMayHoldWildcardsAndDots) {
  const std::string knob = knobForMaterials().path();
  const struct {
    const char *pattern, *name;
    bool matches;
  } cases[] = {{"Sail", "Sail", true},
               {"Sail", "Sails", false},
               {"Sail*", "Sails", true},
               {"*ail*", "Mainsail.001", true},
               {"S?il", "Soil", true},
               {"S?il", "Sil", false},
               {"*", "", true},
               {"*.001", "Hull.001", true},
               {"Hull.001", "Hull.001", true},
               {"Hull.001", "Hull.002", false},
               {"a*b*c", "a.b.b.c", true},
               {"a*b*c", "a.c", false},
               {"Größe", "Größe", true},
               {"?", "", false},
               {"**", "x", true},
               {"sail", "Sail", false}};
  for (const auto& c : cases) {
    Look bySet;
    const Status status = bySet.set("materials." + std::string(c.pattern) + "." + knob, text(7));
    ASSERT_TRUE(status.ok()) << status.error().message();
    EXPECT_EQ(forMaterial(bySet, c.name) == float(level(7)), c.matches) << c.pattern << " " << c.name;
    const json inner = json::parse(nested(knob, level(7)));
    const Look byFile = mustRead(json{{"materials", {{c.pattern, inner}}}}.dump());
    EXPECT_EQ(forMaterial(byFile, c.name) == float(level(7)), c.matches) << c.pattern << " " << c.name;
    EXPECT_EQ(numberIn(bytesOf(*knobForMaterials().block, byFile), *knobForMaterials().row), 0.0f)
        << "what is set for a material must not hold for the scene";
  }
}

TEST(LookMaterials, theyWinOverTheScene) {
  const std::string knob = knobForMaterials().path();
  Look look;
  ASSERT_TRUE(look.set("materials.Sail*." + knob, text(3)).ok());
  ASSERT_TRUE(look.set(knob, text(5)).ok());  // later, and still weaker
  EXPECT_EQ(forMaterial(look, "Sail"), float(level(3)));
  EXPECT_EQ(forMaterial(look, "Hull"), float(level(5)));
}

TEST(LookMaterials, ofTwoAlikeTheLaterOneWins) {
  const std::string knob = knobForMaterials().path();
  Look look;
  ASSERT_TRUE(look.set("materials.Sail." + knob, text(3)).ok());
  ASSERT_TRUE(look.set("materials.*." + knob, text(4)).ok());
  EXPECT_EQ(forMaterial(look, "Sail"), float(level(4)));
  ASSERT_TRUE(look.set(knob, text(1)).ok());
  ASSERT_TRUE(look.set(knob, text(2)).ok());
  EXPECT_EQ(numberIn(bytesOf(*knobForMaterials().block, look), *knobForMaterials().row), float(level(2)));
}

TEST(LookMaterials, setWinsOverTheFile) {
  const std::string knob = knobForMaterials().path();
  json root = json::parse(nested(knob, level(1)));
  root["materials"]["Sail"] = json::parse(nested(knob, level(2)));
  Look look = mustRead(root.dump());
  const Look before = look;
  ASSERT_TRUE(look.set("materials.S*." + knob, text(6)).ok());
  ASSERT_TRUE(look.set(knob, text(8)).ok());
  EXPECT_EQ(forMaterial(look, "Sail"), float(level(6)));
  EXPECT_EQ(forMaterial(look, "Hull"), float(level(8)));
  // Copies are independent.
  EXPECT_EQ(forMaterial(before, "Sail"), float(level(2)));
  EXPECT_EQ(forMaterial(before, "Hull"), float(level(1)));
}

// Every knob in every section, and outside of them.
TEST(LookMaterials, knobsAreRefusedWhereTheyDoNotHold) {
  for (const Row& row : allRows())
    for (const std::string section : {"", "materials", "nodes", "clips"}) {
      const Sample sample = sampleOf(*row.row);
      const look::Target target = section.empty() ? look::kScene : look::findSection(section)->target;
      const bool holds = row.block->targets & target;
      const std::string path = (section.empty() ? "" : section + ".Sail.") + row.path();
      Look look;
      const Status status = look.set(path, sample.text);
      EXPECT_EQ(status.ok(), holds) << path;
      const Result<Look> file = Look::fromJson(nested(path, sample.value), "f");
      EXPECT_EQ(file.ok(), holds) << path;
      if (holds) {
        EXPECT_EQ(look.data().assignments[0].target, target);
        EXPECT_EQ(file->data().assignments[0].target, target);
        EXPECT_EQ(file->data().assignments[0].pattern, section.empty() ? "" : "Sail");
        continue;
      }
      EXPECT_EQ(status.error().kind, ErrorKind::usage);
      const char* reason = row.block->targets & look::kScene         ? "for the whole scene"
                           : row.block->targets & look::kColorizers  ? "for colorizers"
                           : row.block->targets & look::kDecorations ? "for decorations"
                           : row.block->targets & look::kMaterials   ? "for materials"
                           : row.block->targets & look::kNodes       ? "for nodes"
                                                                     : "for clips";
      EXPECT_NE(status.error().message().find(reason), std::string::npos) << status.error().message();
      EXPECT_NE(file.error().message().find(reason), std::string::npos) << file.error().message();
      EXPECT_FALSE(status.error().advice.empty() || file.error().advice.empty());
      EXPECT_EQ(file.error().jsonPath, path);
    }
  Look look;
  const Status status = look.set("play.weight", "1");
  EXPECT_NE(status.error().message().find("clips.NAME.play.weight"), std::string::npos)
      << status.error().message();
}

// -- Nodes and clips

TEST(LookSections, namesMayHoldDotsBarsAndSpaces) {
  Look look;
  ASSERT_TRUE(look.set("nodes.Gull.001|left wing.animation.hold", "3").ok());
  ASSERT_TRUE(look.set("clips.Armature|Walk.cycle 2.play.weight", "0.5").ok());
  const std::vector<Assignment>& assignments = look.data().assignments;
  EXPECT_EQ(assignments[0].pattern, "Gull.001|left wing");
  EXPECT_EQ(assignments[1].pattern, "Armature|Walk.cycle 2");
  EXPECT_EQ(assignments[1].target, look::kClips);
}

TEST(LookSections, sectionsDoNotMixAndSayWhomTheyName) {
  const Look look = mustRead(R"({"animation": {"hold": 1},
      "materials": {"Gull": {"animation": {"hold": 4}}}, "nodes": {"Gull*": {"animation": {"hold": 3}}},
      "clips": {"Walk": {"play": {"weight": 0.5}}}})");
  const auto hold = [&](look::Target target, const std::string& name) {
    int value = 2;
    look.data().fillFor(*blockAt("animation"), target, name, &value);
    return value;
  };
  EXPECT_EQ(hold(look::kNodes, "Gull"), 3);
  EXPECT_EQ(hold(look::kMaterials, "Gull"), 4);
  EXPECT_EQ(hold(look::kNodes, "Boat"), 1);
  EXPECT_EQ(hold(look::kMaterials, "Gulls"), 1);

  const LookData& data = look.data();
  const ParamBlock &animation = *blockAt("animation"), &play = *blockAt("play");
  EXPECT_TRUE(data.names(animation, "hold", look::kNodes, "Gulls"));
  EXPECT_FALSE(data.names(animation, "hold", look::kNodes, "Boat"));
  EXPECT_FALSE(data.names(animation, "hold", look::kMaterials, "Gulls"));
  EXPECT_TRUE(data.setsAny(play, "weight", look::kClips));
  EXPECT_FALSE(data.setsAny(play, "speed", look::kClips));
  EXPECT_FALSE(data.setsAny(play, "weight", look::kNodes));
  EXPECT_FALSE(data.setsAny(*blockAt("warp"), "amount", look::kMaterials));
}

TEST(LookSections, theOrderIsThatOfMaterials) {
  Look look = mustRead(R"({"nodes": {"Gull": {"animation": {"hold": 3}}}, "animation": {"hold": 4}})");
  const auto hold = [&] {
    int value = 2;
    look.data().fillFor(*blockAt("animation"), look::kNodes, "Gull", &value);
    return value;
  };
  EXPECT_EQ(hold(), 3) << "narrowed over the whole scene";
  ASSERT_TRUE(look.set("nodes.G*.animation.hold", "6").ok());
  ASSERT_TRUE(look.set("animation.hold", "5").ok());
  EXPECT_EQ(hold(), 6) << "by hand over the file, narrowed over the whole scene";
}

TEST(LookSections, mistakesNameTheirPath) {
  for (const std::string section : {"materials", "nodes", "clips"}) {
    const std::string one = section.substr(0, section.size() - 1);
    for (const std::string& path : {section + ".", section + "..", section + ".x"}) {
      Look look;
      const Status status = look.set(path, "1");
      ASSERT_FALSE(status.ok()) << path;
      EXPECT_NE(status.error().advice.find(section + "."), std::string::npos) << status.error().message();
    }
    const Result<Look> noObject = Look::fromJson(json{{section, 3}}.dump(), "a.json");
    EXPECT_EQ(noObject.error().jsonPath, section);
    EXPECT_NE(noObject.error().advice.find(one), std::string::npos);
    const Result<Look> empty = Look::fromJson(json{{section, {{"", json::object()}}}}.dump(), "a.json");
    EXPECT_NE(empty.error().message().find("a " + one + "'s pattern is empty"), std::string::npos);
  }
}

}  // namespace
}  // namespace scumble
