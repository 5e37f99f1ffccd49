// Looks that extend looks, colours as words, and comments.
#include "look/look_source.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/test_folder.h"
#include "look/setting_path.h"
#include "look/test_rows.h"
#include "scumble/look.h"

namespace scumble {
namespace {

class LookExtends : public testing::Test, protected TestFolder {
 protected:
  static Look mustLoad(const std::string& file) {
    const Result<Look> look = Look::load(file);
    EXPECT_TRUE(look.ok()) << look.error().message();
    return look.ok() ? look.value() : Look();
  }
  static Error mustFail(const std::string& file) {
    const Result<Look> look = Look::load(file);
    EXPECT_FALSE(look.ok()) << file;
    return look.ok() ? Error() : look.error();
  }
};

float knob(const Look& look, const char* block, const char* row, const std::string* material = nullptr,
           double time = 0) {
  const look::LookData now = look.data().at(time);
  const look::ParamBlock& rows = *blockAt(block);
  std::vector<char> bytes(rows.structSize, 0);
  if (material)
    now.fillFor(rows, look::kMaterials, *material, bytes.data());
  else
    now.fill(rows, bytes.data());
  for (const look::ParamRow& one : rows.rows)
    if (std::string(one.name) == row) return numberIn(bytes, one);
  ADD_FAILURE() << row;
  return 0;
}

TEST_F(LookExtends, aShippedLookAndAFileAndChainsOfThem) {
  const Look storm = mustLoad("storm");
  const Look mine = mustLoad(put("mine.json", R"({"shadow": {"threshold": 0.11}, "extends": "storm"})"));
  EXPECT_FLOAT_EQ(knob(mine, "shadow", "threshold"), 0.11f);
  EXPECT_EQ(mine.description(), storm.description());
  ASSERT_EQ(mine.data().assignments.size(), storm.data().assignments.size() + 1);
  for (size_t i = 0; i < storm.data().assignments.size(); ++i)
    EXPECT_EQ(mine.data().assignments[i].row, storm.data().assignments[i].row) << i;
  put("looks/base.json", R"({"description": "Base", "blur": {"radius": 3}, "shadow": {"threshold": 0.2}})");
  put("looks/middle.json", R"({"extends": "base.json", "shadow": {"threshold": 0.3}})");
  const Look chain = mustLoad(put("own.json", R"({"description": "Own", "extends": "looks/middle.json"})"));
  EXPECT_FLOAT_EQ(knob(chain, "blur", "radius"), 3);
  EXPECT_FLOAT_EQ(knob(chain, "shadow", "threshold"), 0.3f);
  EXPECT_EQ(chain.description(), "Own");
}

// As if the lines of the extended look stood first: a track gives way to a value, a pattern to a pattern that
// says the same, and what is said for the whole scene to neither.
TEST_F(LookExtends, whatWins) {
  put("base.json", R"({"shadow": {"threshold": {"keys": [[0, 0.2], [1, 0.4]]}}, "blur": {"radius": 5},
                       "materials": {"Sail*": {"warp": {"amount": 2}}, "Mast": {"warp": {"amount": 3}}},
                       "colorizers": {"Mist": {"grade": {"gain": 0.5}}, "Glow": {"grade": {"gain": 2}}}})");
  const Look look = mustLoad(put("own.json", R"({
      "extends": "base.json", "shadow": {"threshold": 0.9}, "warp": {"amount": 1},
      "blur": {"radius": {"keys": [[0, 1], [2, 3]]}},
      "materials": {"*": {"warp": {"amount": 4}}, "Mast": {"warp": {"amount": 5}}},
      "colorizers": {"Glow": {"grade": {"gamma": [2, 2, 2]}}, "New": {"grade": {"gain": 3}}}})"));
  const std::string sail = "Sail.001", mast = "Mast";
  for (const double time : {0.0, 1.0}) {
    EXPECT_FLOAT_EQ(knob(look, "shadow", "threshold", nullptr, time), 0.9f);
    EXPECT_FLOAT_EQ(knob(look, "blur", "radius", nullptr, time), float(1 + time));
    EXPECT_FLOAT_EQ(knob(look, "warp", "amount", &sail, time), 4);
    EXPECT_FLOAT_EQ(knob(look, "warp", "amount", &mast, time), 5);
  }
  // Colorizers of one name are one, and act in the order in which they are named first.
  EXPECT_EQ(look.data().declared(look::kColorizers), (std::vector<std::string>{"Mist", "Glow", "New"}));
  const Look whole = mustLoad(put("whole.json", R"({"extends": "base.json", "warp": {"amount": 1}})"));
  EXPECT_FLOAT_EQ(knob(whole, "warp", "amount", &sail), 2);
  EXPECT_FLOAT_EQ(knob(whole, "warp", "amount"), 1);
}

TEST_F(LookExtends, circlesNameTheirFiles) {
  const std::string self = put("self.json", R"({"extends": "self.json"})");
  EXPECT_NE(mustFail(self).problem.find("self.json -> "), std::string::npos) << mustFail(self).message();
  put("b.json", R"({"extends": "c.json"})"), put("c.json", R"({"extends": "./a.json"})");
  const Error circle = mustFail(put("a.json", R"({"extends": "b.json"})"));
  EXPECT_EQ(circle.kind, ErrorKind::unusableFile);
  EXPECT_EQ(circle.jsonPath, "extends");
  EXPECT_NE(circle.file.find("c.json"), std::string::npos);
  for (const char* name : {"a.json -> ", "b.json -> ", "c.json -> "})
    EXPECT_NE(circle.problem.find(name), std::string::npos) << circle.message();
  // A link is the same file.
  std::filesystem::create_symlink(file("d.json"), file("link.json"));
  EXPECT_NE(mustFail(put("d.json", R"({"extends": "link.json"})")).problem.find("each other"),
            std::string::npos);
}

TEST_F(LookExtends, whatCannotBeExtended) {
  const struct {
    const char *extends, *says;
  } cases[] = {{R"("strom")", "did you mean 'storm'"},
               {R"("absent.json")", "'absent.json': there is no such look"},
               {R"("../base.json")", "outside of the look's folder"},
               {R"("/tmp/base.json")", "outside of the look's folder"},
               {R"(["storm"])", "names no look"},
               {R"("")", "names no look"}};
  for (const auto& c : cases) {
    const Error error = mustFail(put("own.json", std::string(R"({"extends": )") + c.extends + "}"));
    EXPECT_EQ(error.kind, ErrorKind::unusableFile);
    EXPECT_EQ(error.jsonPath, "extends");
    EXPECT_NE(error.message().find(c.says), std::string::npos) << error.message();
  }
  // A mistake in the other file is told of where it is.
  const std::string base = put("base.json", R"({"shadow": {"treshold": 1}})");
  const Error within = mustFail(put("own.json", R"({"extends": "base.json"})"));
  EXPECT_EQ(within.file, base);
  EXPECT_EQ(within.jsonPath, "shadow.treshold");
  // And so is one in how many there are.
  std::string many;
  for (int i = 0; i < 40; ++i)
    many += (i ? ", \"" : "\"") + std::to_string(i) + R"(": {"grade": {"gain": 2}})";
  put("base.json", R"({"colorizers": {)" + many + "}}");
  std::string more;
  for (int i = 40; i < 80; ++i)
    more += (i > 40 ? ", \"" : "\"") + std::to_string(i) + R"(": {"grade": {"gain": 2}})";
  EXPECT_NE(mustFail(put("own.json", R"({"extends": "base.json", "colorizers": {)" + more + "}}"))
                .problem.find("too many colorizers"),
            std::string::npos);
  // A long way is cut off.
  for (int i = 0; i < 40; ++i)
    put("l" + std::to_string(i) + ".json", R"({"extends": "l)" + std::to_string(i + 1) + R"(.json"})");
  EXPECT_NE(mustFail(file("l0.json")).problem.find("more than 16 looks"), std::string::npos);
}

// -- Comments and colours

TEST(LookText, commentsAreSkipped) {
  const Look look = mustRead("// Mine.\n{ /* low */ \"blur\": { \"radius\": 3 } // end\n}");
  EXPECT_FLOAT_EQ(knob(look, "blur", "radius"), 3);
  const Result<Look> broken = Look::fromJson("// one\n/* two\n */ {\"blur\" }", "a");
  ASSERT_FALSE(broken.ok());
  EXPECT_EQ(broken.error().line, 3);
  EXPECT_FALSE(Look::fromJson("{} /* open", "a").ok());
}

TEST(LookText, coloursByShortDigitsAndByName) {
  const auto colorOf = [](const std::string& text) {
    Look look;
    const Status status = look.set("palette.shadowTint", text);
    EXPECT_TRUE(status.ok()) << status.error().message();
    return look.data().assignments[0].value.linear;
  };
  EXPECT_EQ(colorOf("#abc"), look::linearFromSrgb(0xAABBCC));
  EXPECT_EQ(colorOf("steelblue"), look::linearFromSrgb(0x4682B4));
  EXPECT_EQ(mustRead(R"({"palette": {"shadowTint": "navy"}})").data().assignments[0].value.linear,
            look::linearFromSrgb(0x000080));
  EXPECT_TRUE(isColor("#fff") && isColor("plum") && !isColor("plumm") && !isColor("#ffff"));
  Look look;
  for (const auto& [text, says] :
       {std::pair{"stealblue", "'steelblue'"}, {"SteelBlue", "'steelblue'"}, {"#ab", "#RGB"}}) {
    const Status status = look.set("palette.shadowTint", text);
    ASSERT_FALSE(status.ok()) << text;
    EXPECT_NE(status.error().message().find(says), std::string::npos) << status.error().message();
  }
}

}  // namespace
}  // namespace scumble
