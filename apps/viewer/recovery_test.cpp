#include "recovery.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "base/test_folder.h"
#include "recent_files.h"
#include "unsaved.h"

namespace scumble::viewer {
namespace {

class Recoveries : public testing::Test {
 protected:
  const TestFolder folder_;
  const Opened opened_{{folder_.put("a.glb", ""), folder_.put("b.glb", "")}, "dusk", ""};
  const Edits edits_{{"shadow.threshold", "0.5"}, {"materials.\xFF.warp.amount", "2"}};
};

TEST_F(Recoveries, whatWasKeptIsFoundUntilItIsNothing) {
  const Recovery recovery(folder_.file("state/of ours"));
  EXPECT_FALSE(recovery.find(opened_.scenes));
  ASSERT_TRUE(recovery.keep(opened_.scenes, opened_.look, {{"shadow.threshold", "0.5"}}).ok());
  const auto kept = Recovery(folder_.file("state/of ours")).find(opened_.scenes);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->look, "dusk");
  EXPECT_EQ(kept->edits, (Edits{{"shadow.threshold", "0.5"}}));
  EXPECT_FALSE(kept->when.empty());
  EXPECT_FALSE(recovery.find({opened_.scenes[0]})) << "other scenes";
  ASSERT_TRUE(recovery.keep(opened_.scenes, opened_.look, {}).ok());
  EXPECT_FALSE(recovery.find(opened_.scenes));
}

// Names of files need not be UTF-8.
TEST_F(Recoveries, whateverTheNames) {
  const Recovery recovery(folder_.file("state"));
  const std::vector<std::string> scenes{folder_.put("boat \xFF.glb", "")};
  EXPECT_TRUE(recovery.keep(scenes, "dusk", edits_).ok());
  EXPECT_TRUE(recovery.find(scenes));
  EXPECT_FALSE(recovery.find(opened_.scenes));
}

TEST_F(Recoveries, whatIsDamagedOrNowhereIsNothing) {
  const Recovery recovery(folder_.file("state"));
  ASSERT_TRUE(recovery.keep(opened_.scenes, opened_.look, edits_).ok());
  std::string file;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.file("state"))) file = entry.path();
  for (const char* text : {"", "{", "[]", "{\"scenes\": 3}", "null"}) {
    folder_.put(std::filesystem::relative(file, folder_.file("")).string(), text);
    EXPECT_FALSE(recovery.find(opened_.scenes)) << text;
  }
  const Recovery nowhere("");
  EXPECT_TRUE(nowhere.keep(opened_.scenes, "", edits_).ok());
  EXPECT_FALSE(nowhere.find(opened_.scenes));
  folder_.put("a file", "");
  EXPECT_EQ(Recovery(folder_.file("a file/state")).keep(opened_.scenes, "", edits_).error().kind,
            ErrorKind::outputNotWritten);
}

TEST_F(Recoveries, recentFilesInTheirOrder) {
  RecentFiles recent(folder_.file("state"));
  EXPECT_TRUE(recent.files().empty());
  const std::string a = std::filesystem::canonical(opened_.scenes[0]),
                    b = std::filesystem::canonical(opened_.scenes[1]);
  recent.add({a});
  recent.add({b});
  recent.add({a});
  EXPECT_EQ(RecentFiles(folder_.file("state")).files(), (std::vector<std::string>{a, b}));
  std::filesystem::remove(b);
  EXPECT_EQ(recent.files(), std::vector<std::string>{a});
  for (int i = 0; i < 20; ++i) recent.add({folder_.put("scene " + std::to_string(i), "")});
  EXPECT_EQ(recent.files().size(), RecentFiles::kMost);
  folder_.put("state/recent.json", "[3, {");
  EXPECT_TRUE(recent.files().empty());
  RecentFiles("").add({a});
}

// A document without files, whose looks are those that ship.
class UnsavedKnobs : public Recoveries {
 protected:
  static DocumentSources sources(const Opened& opened) {
    return {opened, [](const auto&, const Progress&) -> Result<Scene> { return Scene::combine({}); },
            [](const Scene&, const Opened& now) { return Look::load(now.look.empty() ? "fauve" : now.look); },
            [](const auto&) { return OwnLook(); }};
  }
  static void read(Document& document) {
    for (int turn = 0; turn < 500; ++turn) {
      const Result<bool> news = document.poll();
      ASSERT_TRUE(news.ok());
      if (*news) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    FAIL() << "nothing was read";
  }
};

TEST_F(UnsavedKnobs, areKeptInTimeAndOfferedUntilTheyAreAnswered) {
  const std::string state = folder_.file("state");
  const Recovery recovery(state);
  Document document(sources(opened_), [] {});
  read(document);
  Unsaved unsaved(state);
  unsaved.open(document);
  EXPECT_FALSE(unsaved.offered());
  ASSERT_TRUE(unsaved.keep(document, 10, false).ok());
  EXPECT_FALSE(unsaved.untilDue(10)) << "nothing is to be kept: nothing wakes the window";
  ASSERT_TRUE(document.set("shadow.threshold", "0.5").ok());
  ASSERT_TRUE(unsaved.keep(document, 10, false).ok());
  EXPECT_EQ(unsaved.untilDue(10.5), Unsaved::kSeconds - 0.5);
  // However long somebody goes on.
  ASSERT_TRUE(document.set("shadow.threshold", "0.6").ok());
  ASSERT_TRUE(unsaved.keep(document, 11.9, false).ok());
  EXPECT_FALSE(recovery.find(opened_.scenes));
  ASSERT_TRUE(unsaved.keep(document, 12, false).ok());
  EXPECT_EQ(recovery.find(opened_.scenes)->edits, (Edits{{"shadow.threshold", "0.6"}}));
  EXPECT_FALSE(unsaved.untilDue(12));
  ASSERT_TRUE(document.set("shadow.steps", "2").ok());
  ASSERT_TRUE(unsaved.keep(document, 12.1, true).ok());
  EXPECT_EQ(recovery.find(opened_.scenes)->edits.size(), 2u) << "at once";

  // The next start.
  for (const bool isTaken : {true, false}) {
    Document again(sources({opened_.scenes, "manga", ""}), [] {});
    read(again);
    Unsaved found(state);
    found.open(again);
    ASSERT_TRUE(found.offered());
    ASSERT_TRUE(found.answer(again, isTaken).ok());
    EXPECT_FALSE(found.offered());
    EXPECT_EQ(again.edits().size(), isTaken ? 2u : 0u);
    if (isTaken) read(again);
    EXPECT_EQ(again.opened().look, isTaken ? "dusk" : "manga") << "the look that they were turned on";
  }
  EXPECT_FALSE(recovery.find(opened_.scenes)) << "thrown away";
}

TEST_F(UnsavedKnobs, whatIsOfferedIsNotLostBeforeItIsAnswered) {
  const Recovery recovery(folder_.file("state"));
  ASSERT_TRUE(recovery.keep(opened_.scenes, "dusk", {{"shadow.threshold", "0.5"}}).ok());
  Document document(sources(opened_), [] {});
  read(document);
  Unsaved unsaved(folder_.file("state"));
  unsaved.open(document);
  ASSERT_TRUE(unsaved.offered());
  ASSERT_TRUE(document.set("shadow.steps", "2").ok());
  ASSERT_TRUE(unsaved.keep(document, 1, true).ok());
  EXPECT_EQ(recovery.find(opened_.scenes)->edits,
            (Edits{{"shadow.steps", "2"}, {"shadow.threshold", "0.5"}}));
  ASSERT_TRUE(document.undo());
  ASSERT_TRUE(unsaved.keep(document, 2, true).ok());
  EXPECT_EQ(recovery.find(opened_.scenes)->edits, (Edits{{"shadow.threshold", "0.5"}}));
}

TEST_F(UnsavedKnobs, areThoseOfTheLookThatIsThere) {
  const Recovery recovery(folder_.file("state"));
  Document document(sources({opened_.scenes, "", ""}), [] {});
  read(document);
  Unsaved unsaved(folder_.file("state"));
  unsaved.open(document);
  ASSERT_TRUE(document.set("shadow.steps", "2").ok());
  document.openLook("manga");
  read(document);
  ASSERT_TRUE(unsaved.keep(document, 1, true).ok());
  EXPECT_EQ(recovery.find(opened_.scenes)->look, "manga");
  document.openLook("dusk");
  read(document);
  ASSERT_TRUE(unsaved.keep(document, 2, true).ok());
  EXPECT_EQ(recovery.find(opened_.scenes)->look, "dusk") << "the same knobs on another one";
}

}  // namespace
}  // namespace scumble::viewer
