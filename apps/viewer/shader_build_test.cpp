// Shaders that are compiled while somebody writes them, with a compiler that copies.
#include "shader_build.h"

#include <gtest/gtest.h>

#include <chrono>

#include "base/test_folder.h"

namespace scumble::viewer {
namespace {

using Clock = std::chrono::steady_clock;

TEST(VisibleShaderBuild, readsRulesOfMake) {
  EXPECT_EQ(dependenciesIn("out.h: a.glsl b/c.glsl\n"), (std::vector<std::string>{"a.glsl", "b/c.glsl"}));
  EXPECT_EQ(dependenciesIn("out.h: a\\ b.glsl \\\n  c.glsl"),
            (std::vector<std::string>{"a b.glsl", "c.glsl"}));
  EXPECT_TRUE(dependenciesIn("").empty());
  EXPECT_TRUE(dependenciesIn("out.h:").empty());
}

class Building : public testing::Test {
 protected:
  // A compiler that copies, and complains of what is broken.
  void SetUp() override {
    const std::string script = folder_.put("glslc", R"sh(#!/bin/sh
# -MD -MF RULE -o OUT SOURCE; the source names what it includes in its second line.
if grep -q broken "$6"; then echo "$6:7: error: 'x' : undeclared"; echo "$6:9: error: more"; exit 1; fi
echo "out: $(echo "$6" | sed 's/ /\\ /g') $(sed -n 2p "$6")" > "$3"
cp "$6" "$5"
)sh");
    std::filesystem::permissions(script, std::filesystem::perms::owner_all);
    std::string list = "[";
    for (const char* const name : {"one", "two"})
      list += R"({"name": ")" + std::string(name) + R"(", "source": ")" +
              folder_.file(std::string(name) + ".frag") + R"(", "command": [")" + script + R"("]},)";
    folder_.put("build/generated/shaders/commands.json", list + R"({"validator": ""}])");
    for (const std::string name : {"one", "two"}) {
      folder_.put(name + ".frag", "first");
      folder_.put("build/generated/shaders/" + name + ".spv", "built");
      folder_.put(
          "build/generated/shaders/" + name + ".spv.d",
          name + ".h: " + escaped(folder_.file(name + ".frag")) + " " + escaped(folder_.file("both.glsl")));
    }
    folder_.put("both.glsl", "both");
    // Nothing is newer than what was built.
    for (const char* const built : {"one.spv", "two.spv"})
      std::filesystem::last_write_time(
          folder_.file(std::string("build/generated/shaders/") + built),
          std::filesystem::file_time_type::clock::now() + std::chrono::seconds(5));
  }
  static std::string escaped(std::string path) {
    for (size_t at = 0; (at = path.find(' ', at)) != std::string::npos; at += 2) path.insert(at, 1, '\\');
    return path;
  }
  static std::optional<Status> waited(ShaderBuild& build, int milliseconds = 5000) {
    for (const auto end = Clock::now() + std::chrono::milliseconds(milliseconds); Clock::now() < end;) {
      if (auto done = build.poll()) return done;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return std::nullopt;
  }
  std::unique_ptr<ShaderBuild> opened() {
    auto build = ShaderBuild::open(folder_.file("build"), [] {});
    EXPECT_TRUE(build.ok()) << build.error().message();
    return std::move(build).value();
  }
  static std::string compiled(const ShaderBuild& build, const std::string& name) {
    return contentOf(build.folder() + "/" + name + ".spv");
  }

  const TestFolder folder_;
};

TEST_F(Building, compilesWhatWasSavedAndKeepsWhatWasGood) {
  std::string folder;
  {
    const auto build = opened();
    folder = build->folder();
    EXPECT_FALSE(waited(*build, 200)) << "nothing is newer than the build";
    folder_.put("one.frag", "second");
    ASSERT_TRUE(waited(*build)->ok());
    EXPECT_EQ(compiled(*build, "one"), "second");
    EXPECT_FALSE(std::filesystem::exists(build->folder() + "/two.spv")) << "nobody has saved it";
    folder_.put("one.frag", "broken");
    const auto wrong = waited(*build);
    ASSERT_TRUE(wrong && !wrong->ok());
    EXPECT_EQ(wrong->error().problem, folder_.file("one.frag") + ":7: error: 'x' : undeclared");
    EXPECT_EQ(compiled(*build, "one"), "second");
    folder_.put("one.frag", "third");
    ASSERT_TRUE(waited(*build)->ok());
    EXPECT_EQ(compiled(*build, "one"), "third");
    // What both include is of both; and one that is broken leaves all as they were.
    folder_.put("two.frag", "broken");
    ASSERT_FALSE(waited(*build)->ok());
    folder_.put("one.frag", "fourth");
    ASSERT_TRUE(waited(*build)->ok());
    folder_.put("both.glsl", "2");
    ASSERT_FALSE(waited(*build)->ok());
    EXPECT_FALSE(std::filesystem::exists(build->folder() + "/two.spv"));
  }
  EXPECT_FALSE(std::filesystem::exists(folder)) << "it goes with the window";
}

TEST_F(Building, followsWhatIsIncludedAnew) {
  const auto build = opened();
  folder_.put("new.glsl", "1");
  folder_.put("one.frag", "first\n" + escaped(folder_.file("new.glsl")));
  ASSERT_TRUE(waited(*build)->ok());
  folder_.put("new.glsl", "2");
  ASSERT_TRUE(waited(*build)) << "it is watched";
  folder_.put("both.glsl", "2");
  ASSERT_TRUE(waited(*build)) << "the other one includes it still";
  folder_.put("two.frag", "second");
  ASSERT_TRUE(waited(*build)->ok());
  folder_.put("both.glsl", "3");
  EXPECT_FALSE(waited(*build, 300)) << "nobody includes it any more";
}

TEST_F(Building, compilesWhatIsNewerThanTheBuild) {
  std::filesystem::last_write_time(folder_.file("build/generated/shaders/two.spv"),
                                   std::filesystem::file_time_type::clock::now() - std::chrono::hours(1));
  const auto build = opened();
  ASSERT_TRUE(waited(*build)->ok());
  EXPECT_EQ(compiled(*build, "two"), "first");
}

TEST_F(Building, needsTheFolderOfABuild) {
  for (const char* const text :
       {"", "{", "[]", "{}", "[1]", R"([{"name": "a", "source": "b", "command": []}])", R"([{"name": 1}])",
        R"([{"name": "a", "source": "b", "command": [2]}])"}) {
    folder_.put("build/generated/shaders/commands.json", text);
    const auto build = ShaderBuild::open(folder_.file("build"), [] {});
    ASSERT_FALSE(build.ok()) << text;
    EXPECT_EQ(build.error().kind, ErrorKind::unusableFile);
  }
  EXPECT_FALSE(ShaderBuild::open(folder_.file("nowhere"), [] {}).ok());
}

}  // namespace
}  // namespace scumble::viewer
