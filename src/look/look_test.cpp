// The parameter mechanism and looks. The first tests walk over every knob there is, so that a new row of a
// .params file is tested without a new test. (That the structs' defaults are the rows' is in
// frame/pass_list_test.cpp, since this room does not know the structs.)
#include "scumble/look.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "base/test_folder.h"
#include "look/setting_path.h"
#include "look/shipped_looks.h"
#include "look/test_rows.h"

namespace scumble {
namespace {

using look::ParamBlock;
using look::ParamKind;
using nlohmann::json;

void expectRefused(const Row& row, const std::string& text) {
  Look look;
  const Status status = look.set(row.settingPath(), text);
  ASSERT_FALSE(status.ok()) << row.path() << "=" << text;
  EXPECT_EQ(status.error().kind, ErrorKind::usage);
  EXPECT_NE(status.error().message().find(row.path()), std::string::npos) << status.error().message();
  EXPECT_TRUE(look.data().assignments.empty()) << "a refused value must change nothing";
}

// -- Every knob

TEST(Look, thereAreKnobsAndTheirRowsMakeSense) {
  const std::vector<Row> rows = allRows();
  EXPECT_GT(rows.size(), 20u);
  std::set<std::string> paths;
  for (const Row& row : rows) {
    EXPECT_TRUE(paths.insert(row.path()).second) << row.path() << " is there twice";
    for (const look::Section& section : look::kSections)
      EXPECT_NE(row.path().substr(0, row.path().find('.')), section.name) << "the name of a section";
    EXPECT_NE(row.row->name, std::string("keys")) << "a track's word";
    EXPECT_NE(*row.row->meaning, '\0') << row.path();
    EXPECT_LT(row.row->min, row.row->max) << row.path();
    EXPECT_GE(row.row->defaultValue, row.row->min) << row.path();
    EXPECT_LE(row.row->defaultValue, row.row->max) << row.path();
    EXPECT_LE(row.row->offset + 4, row.block->structSize) << row.path();
    if (row.row->kind == ParamKind::choice) {
      const std::vector<std::string> names = look::choiceNames(*row.row);
      EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size()) << row.path();
      EXPECT_EQ(row.row->min, 0) << row.path();
      EXPECT_EQ(row.row->max, double(names.size() - 1)) << row.path();
    }
  }
}

TEST(Look, theListOfKnobsSaysWhatTheRowsSay) {
  const std::vector<Row> rows = allRows();
  const std::vector<Knob> knobs = Look::knobs();
  ASSERT_EQ(knobs.size(), rows.size());
  for (size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(knobs[i].path, rows[i].path());
    look::Targets targets = 0;
    for (const std::string& name : knobs[i].targets)
      targets |= name == "scene" ? look::kScene : look::findSection(name)->target;
    EXPECT_EQ(targets, rows[i].block->targets) << knobs[i].path;
    EXPECT_EQ(knobs[i].meaning, rows[i].row->meaning);
    // What the list shows, set() reads: and it means the default.
    Look look;
    const Status status = look.set(rows[i].settingPath(), knobs[i].defaultValue);
    ASSERT_TRUE(status.ok()) << status.error().message();
    if (rows[i].isNumber()) {
      EXPECT_FLOAT_EQ(float(look.data().assignments[0].value.number), float(rows[i].row->defaultValue));
    }
    if (rows[i].row->kind == ParamKind::color) {
      EXPECT_EQ(look::srgbFromLinear(look.data().assignments[0].value.linear),
                uint32_t(rows[i].row->defaultValue));
    }
  }
}

TEST(Look, theEndsOfARangeAreInIt) {
  for (const Row& row : allRows()) {
    if (!row.isNumber()) continue;
    for (const double end : {row.row->min, row.row->max}) {
      Look look;
      EXPECT_TRUE(look.set(row.settingPath(), json(end).dump()).ok()) << row.path();
      EXPECT_TRUE(Look::fromJson(nested(row.settingPath(), end), "f").ok()) << row.path();
    }
    const double step = row.row->kind == ParamKind::integer ? 1 : 1e-3 * (row.row->max - row.row->min);
    for (const double beyond : {row.row->min - step, row.row->max + step, -1e300, 1e300}) {
      expectRefused(row, json(beyond).dump());
      EXPECT_FALSE(Look::fromJson(nested(row.settingPath(), beyond), "f").ok()) << row.path();
    }
  }
}

TEST(Look, setAndFileGiveTheSameAndChangeOnlyThatKnob) {
  const Look defaults;
  for (const Row& row : allRows()) {
    const Sample sample = sampleOf(*row.row);
    Look bySet;
    const Status status = bySet.set(row.settingPath(), sample.text);
    ASSERT_TRUE(status.ok()) << status.error().message();
    const Look byFile = mustRead(nested(row.settingPath(), sample.value));
    EXPECT_EQ(bytesOf(*row.block, bySet), bytesOf(*row.block, byFile)) << row.path();
    // Only the row's own bytes may differ from an untouched block.
    const size_t size = row.size();
    std::vector<char> filled(row.block->structSize, 0x55), untouched = filled;
    bySet.data().fillFor(
        *row.block,
        row.block->targets & look::kScene ? look::kClips : look::firstSection(row.block->targets).target,
        "any", filled.data());
    for (size_t i = 0; i < filled.size(); ++i)
      if (i < row.row->offset || i >= row.row->offset + size) {
        ASSERT_EQ(filled[i], untouched[i]) << row.path();
      }
    if (row.row->kind == ParamKind::number) {
      EXPECT_EQ(numberIn(filled, *row.row), float(sample.value.get<double>())) << row.path();
    }
    for (const ParamBlock* other : look::allBlocks())
      if (other != row.block) {
        ASSERT_EQ(bytesOf(*other, bySet), bytesOf(*other, defaults));
      }
  }
}

// What set() takes, get() gives; what it took back is the default again; and typed values are the same ones
// as their text.
TEST(Look, knobsAreReadSetAndUnset) {
  for (const Row& row : allRows()) {
    const Sample sample = sampleOf(*row.row);
    const std::string path = row.settingPath();
    const bool isOfASection = !(row.block->targets & look::kScene);
    Look look;
    const KnobValue before = *look.get(path);
    ASSERT_TRUE(look.set(path, sample.text).ok());
    const KnobValue after = *look.get(path);
    EXPECT_NE(before, after) << path;
    Look typed;
    const Status set = typed.set(path, after);
    ASSERT_TRUE(set.ok()) << set.error().message();
    EXPECT_EQ(*typed.get(path), after) << path;
    EXPECT_EQ(bytesOf(*row.block, typed), bytesOf(*row.block, look)) << path;
    EXPECT_EQ(before.index(), after.index()) << path;
    switch (row.row->kind) {
      case ParamKind::number:
        EXPECT_EQ(float(std::get<double>(after)), float(sample.value.get<double>())) << path;
        break;
      case ParamKind::integer:
        EXPECT_EQ(std::get<int>(after), sample.value.get<int>()) << path;
        break;
      case ParamKind::toggle:
        EXPECT_EQ(std::get<bool>(after), sample.value.get<bool>()) << path;
        break;
      case ParamKind::color:
      case ParamKind::triple:
        EXPECT_TRUE(std::holds_alternative<glm::vec3>(after)) << path;
        break;
      default:
        EXPECT_EQ(std::get<std::string>(after), sample.text) << path;
    }
    // The same one again takes the place of the first.
    ASSERT_TRUE(typed.set(path, before).ok() && typed.set(path, after).ok());
    const bool declares = row.block->targets & (look::kColorizers | look::kDecorations);
    EXPECT_EQ(typed.data().assignments.size(), declares ? 2u : 1u) << path;
    ASSERT_TRUE(typed.unset(path).ok());
    EXPECT_TRUE(typed.data().assignments.empty()) << path;
    EXPECT_EQ(*typed.get(path), before) << path;
    EXPECT_EQ(isOfASection, path != row.path());
  }
}

// Colorizers act in the order in which they are named first, also when a slider sets one of them again.
TEST(Look, settingAgainKeepsTheOrderOfNames) {
  Look look;
  for (const char* path : {"colorizers.A.volume.density", "colorizers.B.volume.density"})
    ASSERT_TRUE(look.set(path, 0.5).ok());
  for (const double value : {0.6, 0.7, 0.8}) {
    ASSERT_TRUE(look.set("colorizers.A.volume.density", value).ok());
    EXPECT_EQ(std::get<double>(*look.get("colorizers.A.volume.density")), value);
    EXPECT_EQ(look.data().declared(look::kColorizers), (std::vector<std::string>{"A", "B"}));
    EXPECT_LE(look.data().assignments.size(), 3u);
  }
  ASSERT_TRUE(look.unset("colorizers.A.volume.density").ok());
  EXPECT_EQ(look.data().declared(look::kColorizers), std::vector<std::string>{"B"});
}

TEST(Look, typedValuesOfAWrongKindAreRefused) {
  const KnobValue values[] = {true, 1, 0.5, glm::vec3(0.5f)};
  for (const Row& row : allRows())
    for (const KnobValue& value : values) {
      const ParamKind kind = row.row->kind;
      const bool fits = std::holds_alternative<bool>(value) ? kind == ParamKind::toggle
                        : std::holds_alternative<glm::vec3>(value)
                            ? kind == ParamKind::color || kind == ParamKind::triple
                            : row.isNumber();
      Look look;
      const Status status = look.set(row.settingPath(), value);
      if (!fits) {
        ASSERT_FALSE(status.ok()) << row.path() << ", " << value.index();
        EXPECT_EQ(status.error().kind, ErrorKind::usage);
        EXPECT_NE(status.error().message().find(row.path()), std::string::npos) << status.error().message();
        EXPECT_TRUE(look.data().assignments.empty());
      }
      const double beyond =
          row.row->max + (kind == ParamKind::integer ? 1 : 1e-3 * (row.row->max - row.row->min));
      if (row.isNumber()) {
        EXPECT_FALSE(look.set(row.settingPath(), beyond).ok()) << row.path();
        EXPECT_FALSE(look.set(row.settingPath(), std::nan("")).ok()) << row.path();
      }
      if (kind == ParamKind::integer) {
        EXPECT_FALSE(look.set(row.settingPath(), row.row->min + 0.5).ok()) << row.path();
      }
      if (kind == ParamKind::color) {
        EXPECT_FALSE(look.set(row.settingPath(), glm::vec3(0, 1.01f, 0)).ok()) << row.path();
      }
    }
}

TEST(Look, whatHoldsIsOfANameAndATime) {
  Look look = mustRead(R"({
    "shadow": {"threshold": {"keys": [[0, 0.2], [2, 0.6]]}},
    "materials": {"Sail*": {"warp": {"amount": 3}}}
  })");
  EXPECT_NEAR(std::get<double>(*look.get("shadow.threshold", 1)), 0.4, 1e-6);
  EXPECT_EQ(std::get<double>(*look.get("materials.Sails.warp.amount")), 3);
  EXPECT_NE(std::get<double>(*look.get("materials.Hull.warp.amount")), 3);
  ASSERT_TRUE(look.set("shadow.threshold", 0.9).ok());
  ASSERT_TRUE(look.set("warp.amount", 5).ok());
  EXPECT_EQ(std::get<double>(*look.get("shadow.threshold", 1)), 0.9);
  EXPECT_EQ(std::get<double>(*look.get("materials.Sails.warp.amount")), 5) << "by hand over the file's names";
  ASSERT_TRUE(look.unset("shadow.threshold").ok() && look.unset("warp.amount").ok());
  EXPECT_NEAR(std::get<double>(*look.get("shadow.threshold", 2)), 0.6, 1e-6);
  EXPECT_EQ(std::get<double>(*look.get("materials.Sails.warp.amount")), 3);
  EXPECT_FALSE(look.get("materials.Sail*.warp.amount").ok());
  for (const char* path : {"shadow.treshold", "shadow", "", "materials.Sail"}) {
    EXPECT_FALSE(look.get(path).ok()) << path;
    EXPECT_FALSE(look.unset(path).ok()) << path;
  }
}

TEST(Look, everyNameOfAChoiceIsItsPlace) {
  for (const Row& row : allRows()) {
    if (row.row->kind != ParamKind::choice) continue;
    const std::vector<std::string> names = look::choiceNames(*row.row);
    for (size_t i = 0; i < names.size(); ++i) {
      Look look;
      ASSERT_TRUE(look.set(row.settingPath(), names[i]).ok()) << row.path() << "=" << names[i];
      int32_t index = -1;
      std::memcpy(&index, bytesOf(*row.block, look).data() + row.row->offset, 4);
      EXPECT_EQ(index, int(i));
    }
    expectRefused(row, names[0] + "x");
    expectRefused(row, row.row->unit);  // "a|b" is no name
  }
}

TEST(Look, valuesOfAWrongTypeAreRefused) {
  for (const Row& row : allRows()) {
    std::vector<json> wrong = {nullptr, json::array({1})};
    switch (row.row->kind) {
      case ParamKind::number:
      case ParamKind::integer:
        for (const char* text : {"", "x", "1x", "1,5", "nan", "inf", "--1", "true"}) expectRefused(row, text);
        wrong.insert(wrong.end(), {true, "1"});
        break;
      case ParamKind::toggle:
        for (const char* text : {"", "2", "yes?", "TRUE "}) expectRefused(row, text);
        wrong.insert(wrong.end(), {1, "true"});
        break;
      case ParamKind::choice:
        for (const char* text : {"", "no such choice", "0"}) expectRefused(row, text);
        wrong.insert(wrong.end(), {0, true});
        break;
      case ParamKind::picture:
        for (const char* text : {"", "no such picture", "0"}) expectRefused(row, text);
        for (const char* text : {"no-such-file.png", "/no/such.png", "../torn.png"}) {
          Look look;
          const Status status = look.set(row.settingPath(), text);
          ASSERT_FALSE(status.ok()) << text;
          EXPECT_EQ(status.error().kind, ErrorKind::unusableFile);
          EXPECT_TRUE(look.data().assignments.empty() && look.data().pictures.empty());
        }
        wrong.insert(wrong.end(), {0, true});
        break;
      case ParamKind::color:
        for (const char* text : {"", "#", "#12345", "#1234567", "123456", "#12345g", "#-12345", "#+12345",
                                 "# 12345", "#0x1234", "rouge"})
          expectRefused(row, text);
        wrong.insert(wrong.end(), {0x123456, true, json::array({1, 0, 0})});
        break;
      case ParamKind::triple: {
        const std::string one = json(row.row->max).dump();
        for (const std::string& text :
             {std::string(), one, one + "," + one, one + "," + one + ",", "," + one + "," + one,
              one + "," + one + ",x", one + "," + one + "," + one + "," + one})
          expectRefused(row, text);
        wrong.insert(wrong.end(), {1, true, "1,1,1", json::array({1, 1, "1"}), json::array({1, 1, 1, 1})});
        break;
      }
      case ParamKind::name:
        wrong.insert(wrong.end(), {0, true});
        break;
    }
    for (const json& value : wrong) {
      const Result<Look> look = Look::fromJson(nested(row.settingPath(), value), "dir/my.json");
      ASSERT_FALSE(look.ok()) << row.path() << " = " << value;
      EXPECT_EQ(look.error().kind, ErrorKind::unusableFile);
      EXPECT_EQ(look.error().file, "dir/my.json");
      EXPECT_EQ(look.error().jsonPath.substr(0, row.settingPath().size()), row.settingPath());
    }
  }
}

TEST(Look, wholeNumbersAreWhole) {
  for (const Row& row : allRows()) {
    if (row.row->kind != ParamKind::integer) continue;
    expectRefused(row, json(row.row->min + 0.5).dump());
    EXPECT_FALSE(Look::fromJson(nested(row.settingPath(), row.row->min + 0.5), "f").ok());
  }
}

// A slip of one letter must lead back to the knob that was meant.
TEST(Look, misspelledKnobsAreSuggested) {
  for (const Row& row : allRows()) {
    const std::string path = row.path();
    // Knobs that a number tells apart are one letter from each other.
    if (std::isdigit(static_cast<unsigned char>(path.back()))) continue;
    std::string without = path, doubled = path;
    without.erase(path.size() - 2, 1);
    doubled.insert(path.size() - 1, 1, 'q');
    for (const std::string& slip : {without, doubled}) {
      // As near to another knob: a number and its plural may both be knobs.
      const std::vector<Row> rows = allRows();
      if (std::any_of(rows.begin(), rows.end(), [&](const Row& other) {
            const std::string name = other.path();
            if (name.size() != slip.size()) return false;
            int differing = 0;
            for (size_t i = 0; i < slip.size(); ++i) differing += slip[i] != name[i];
            return differing == 1;
          }))
        continue;
      Look look;
      const Status status = look.set(slip, "1");
      ASSERT_FALSE(status.ok()) << slip;
      EXPECT_NE(status.error().advice.find("'" + path + "'"), std::string::npos) << status.error().message();
      const Result<Look> file = Look::fromJson(nested(slip, 1), "f");
      ASSERT_FALSE(file.ok());
      EXPECT_NE(file.error().message().find(path), std::string::npos) << file.error().message();
    }
  }
}

TEST(Look, aRightNameInTheWrongPlaceIsSuggestedToo) {
  Look look;
  const Status status = look.set("somewhereElse.completelyDifferent.indicationSteps", "1");
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().advice.find(".indicationSteps'"), std::string::npos) << status.error().message();
}

// The row of a deeper block of the group, rather than one of the same name elsewhere or of a similar path.
TEST(Look, rowsOfTheOwnGroupAreSuggestedFirst) {
  for (const std::string group : {"texture", "warp", "breakup"})
    for (const char* slip : {".example", ".exampel", ".meta.example", ".metatexture.deeper.example"}) {
      const Status status = Look().set(group + slip, "1");
      EXPECT_NE(status.error().advice.find(group + ".metatexture.example"), std::string::npos)
          << group << slip << ": " << status.error().advice;
    }
}

TEST(Look, whatResemblesNothingHasOtherAdvice) {
  for (const char* path :
       {"", ".", "..", "qqqqqqqqqqqq", "shadow", "materials", "materials.", "materials..", "materials.*"}) {
    Look look;
    const Status status = look.set(path, "1");
    ASSERT_FALSE(status.ok()) << path;
    EXPECT_FALSE(status.error().advice.empty()) << path;
  }
}

// -- Files

TEST(LookFile, aSyntaxErrorNamesItsLine) {
  const struct {
    const char* text;
    int line;
  } cases[] = {{"", 1},
               {"{", 1},
               {"{\n  \"shadow\": {\n    \"threshold\": 0.4,,\n  }\n}\n", 3},
               {"{}\n\n\nx", 4},
               {"{\n\"a\": \"\x01\"}", 2},
               {"{\n\n\"description\": \"\xff\"}", 3},
               {"{ /* comment */ }\n/* open", 2}};
  for (const auto& c : cases) {
    const Result<Look> look = Look::fromJson(c.text, "dir/a.look.json");
    ASSERT_FALSE(look.ok()) << c.text;
    EXPECT_EQ(look.error().kind, ErrorKind::unusableFile);
    EXPECT_EQ(look.error().file, "dir/a.look.json");
    EXPECT_EQ(look.error().line, c.line) << c.text;
    EXPECT_EQ(look.error().message().find('\n'), std::string::npos);
  }
}

TEST(LookFile, mistakesNameTheirJsonPath) {
  const struct {
    const char *text, *path;
  } cases[] = {{R"({"description": 3})", "description"},
               {R"({"materials": 3})", "materials"},
               {R"({"materials": {"Sail*": 3}})", "materials.Sail*"},
               {R"({"nothing": {"like": {"it": 3}}})", "nothing.like.it"},
               {R"({"nothing": 3})", "nothing"}};
  for (const auto& c : cases) {
    const Result<Look> look = Look::fromJson(c.text, "a.json");
    ASSERT_FALSE(look.ok()) << c.text;
    EXPECT_EQ(look.error().jsonPath, c.path);
    EXPECT_EQ(look.error().message().substr(0, 10), "a.json:1 (");
  }
  for (const char* text : {"3", "[]", "\"x\"", "null", "true"})
    EXPECT_FALSE(Look::fromJson(text, "a").ok()) << text;
}

TEST(LookFile, emptyDescribedAndWithASchemaAreFine) {
  EXPECT_TRUE(mustRead("{}").data().assignments.empty());
  const Look look =
      mustRead("\n{ \"$schema\": \"look.schema.json\", \"description\": \"Low sun\", \"materials\": {} }\n");
  EXPECT_EQ(look.description(), "Low sun");
  EXPECT_TRUE(look.data().assignments.empty());
}

// Numbers that no double holds, and objects so deep that a careless reader runs out of stack.
TEST(LookFile, hostileFilesAreErrors) {
  EXPECT_FALSE(Look::fromJson(R"({"shadow": {"threshold": 1e999}})", "a").ok());
  for (const size_t depth : {100u, 200000u}) {
    std::string deep;
    for (size_t i = 0; i < depth; ++i) deep += "{\"a\":";
    deep += '1';
    deep.append(depth, '}');
    EXPECT_FALSE(Look::fromJson(deep, "a").ok()) << depth;
    EXPECT_FALSE(Look::fromJson(std::string(depth, '['), "a").ok()) << depth;
  }
}

class LookLoad : public testing::Test, protected TestFolder {};

TEST_F(LookLoad, aFileByItsPath) {
  const Result<Look> look = Look::load(put("mine.json", R"({"description": "Mine"})"));
  ASSERT_TRUE(look.ok()) << look.error().message();
  EXPECT_EQ(look->description(), "Mine");
  // A path needs no ending to be one.
  EXPECT_TRUE(Look::load(put("other", "{}")).ok());
}

TEST_F(LookLoad, filesThatCannotBeReadAreUnusable) {
  const std::string folder = file("folder.json");
  std::filesystem::create_directory(folder);
  for (const std::string& path : {file("absent.json"), std::string("absent.json"), folder,
                                  put("broken.json", "{"), put("empty.json", "")}) {
    const Result<Look> look = Look::load(path);
    ASSERT_FALSE(look.ok()) << path;
    EXPECT_EQ(look.error().kind, ErrorKind::unusableFile) << path;
    EXPECT_EQ(look.error().file, path);
  }
}

// A track that flips between two pictures a thousand times holds two pictures.
TEST_F(LookLoad, picturesOfATrackAreReadOnce) {
  // One orange pixel.
  static const unsigned char kPng[] = {0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D,
                                       0x49, 0x48, 0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01,
                                       0x08, 0x02, 0x00, 0x00, 0x00, 0x90, 0x77, 0x53, 0xDE, 0x00, 0x00, 0x00,
                                       0x0C, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9C, 0x63, 0xF8, 0xDF, 0xC0, 0x00,
                                       0x00, 0x04, 0x01, 0x01, 0x80, 0xC5, 0x2A, 0x18, 0x5D, 0x00, 0x00, 0x00,
                                       0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82};
  const std::string png(reinterpret_cast<const char*>(kPng), sizeof(kPng));
  put("a.png", png), put("b.png", png);
  json keys = json::array();
  for (int i = 0; i < 1000; ++i) keys.push_back({i, i % 2 ? "a.png" : "b.png"});
  const std::string file = put("look.json", nested("materials.*.warp.metatexture.example", {{"keys", keys}}));
  const Result<Look> look = Look::load(file);
  ASSERT_TRUE(look.ok()) << look.error().message();
  EXPECT_EQ(look->data().pictures.size(), 2u);
  EXPECT_EQ(look->data().at(7).assignments[0].value.number, -2);
  EXPECT_EQ(look->data().at(7).pictures, look->data().pictures);
  // The place of a picture that is not there is the key's.
  const Result<Look> absent =
      Look::load(put("look.json", nested("warp.metatexture.example",
                                         json::parse(R"({"keys": [[0, "paper"], [1, "c.png"]]})"))));
  EXPECT_EQ(absent.error().jsonPath, "warp.metatexture.example.keys[1][1]");
  EXPECT_EQ(absent.error().file, file);
}

TEST_F(LookLoad, everyLookThatShipsLoadsAndSaysWhatItIs) {
  const std::vector<ShippedLook> looks = Look::shipped();
  ASSERT_FALSE(looks.empty());
  bool hasDefault = false;
  for (const ShippedLook& shipped : looks) {
    const Result<Look> look = Look::load(shipped.name);
    ASSERT_TRUE(look.ok()) << look.error().message();
    EXPECT_FALSE(shipped.description.empty()) << shipped.name;
    EXPECT_EQ(look->description(), shipped.description);
    hasDefault |= shipped.name == "age-of-sail";
  }
  EXPECT_TRUE(hasDefault) << "the program's default look";
}

TEST_F(LookLoad, unknownNamesAreUsageErrorsWithASuggestion) {
  const Result<Look> near = Look::load("age-of-sial");
  ASSERT_FALSE(near.ok());
  EXPECT_EQ(near.error().kind, ErrorKind::usage);
  EXPECT_NE(near.error().advice.find("'age-of-sail'"), std::string::npos) << near.error().message();
  const Result<Look> far = Look::load("impressionism by candlelight");
  ASSERT_FALSE(far.ok());
  EXPECT_EQ(far.error().kind, ErrorKind::usage);
  EXPECT_NE(far.error().advice.find("scumble looks"), std::string::npos) << far.error().message();
}

// -- Small parts

TEST(LookColor, srgbGoesThereAndBack) {
  for (uint32_t code = 0; code < 256; ++code) {
    const uint32_t packed = code << 16 | (255 - code) << 8 | (code ^ 0x5a);
    EXPECT_EQ(look::srgbFromLinear(look::linearFromSrgb(packed)), packed);
  }
  EXPECT_EQ(look::linearFromSrgb(0xFFFFFF), glm::vec3(1.0f));
  EXPECT_NEAR(look::linearFromSrgb(0x808080).g, 0.2158605f, 1e-6f);
  EXPECT_EQ(look::srgbFromLinear({-1, 0.5f, 9}), 0x00BCFFu);
}

}  // namespace
}  // namespace scumble
