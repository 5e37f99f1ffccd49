#include "document.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>

#include "base/test_folder.h"

namespace scumble::viewer {
namespace {

// A triangle.
constexpr const char* kScene =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri":
  "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

class Documents : public testing::Test {
 protected:
  Document make() {
    return Document({{scene_},
                     look_,
                     [this] { return ++scenes_, Scene::load(scene_); },
                     [this](const Scene&, const std::string& name) {
                       return ++looks_, Look::load(name.empty() ? look_ : name);
                     }},
                    [this] {
                      const std::lock_guard lock(mutex_);
                      ++wakes_;
                      woken_.notify_all();
                    });
  }
  // Until there is news.
  testing::AssertionResult changes(Document& document) {
    for (int turn = 0; turn < 100; ++turn) {
      std::unique_lock lock(mutex_);
      woken_.wait_for(lock, std::chrono::milliseconds(100), [&] { return wakes_ > 0; });
      wakes_ = 0;
      lock.unlock();
      const Result<bool> news = document.poll();
      if (!news) return testing::AssertionFailure() << news.error().message();
      if (*news) return testing::AssertionSuccess();
    }
    return testing::AssertionFailure() << "nothing has changed";
  }
  static double threshold(const Document& document) {
    return std::get<double>(document.look().get("shadow.threshold").value());
  }
  static std::string lookText(const char* threshold) {
    return std::string(R"({"shadow": {"threshold": )") + threshold + "}}";
  }

  const TestFolder folder_;
  const std::string scene_ = folder_.put("a.gltf", kScene),
                    look_ = folder_.put("a.look.json", lookText("0.25"));
  std::atomic<int> scenes_ = 0, looks_ = 0;
  std::mutex mutex_;
  std::condition_variable woken_;
  int wakes_ = 0;
};

TEST_F(Documents, readsWhatIsSaved) {
  Document document = make();
  ASSERT_TRUE(changes(document));
  EXPECT_EQ(document.scene().summary().nodes, 1u);
  EXPECT_EQ(threshold(document), 0.25);
  const uint64_t version = document.version();
  folder_.put("a.look.json", lookText("0.75"));
  ASSERT_TRUE(changes(document));
  EXPECT_EQ(threshold(document), 0.75);
  EXPECT_GT(document.version(), version);
  EXPECT_EQ(scenes_, 1);
  EXPECT_EQ(looks_, 2);
  folder_.put("a.gltf", kScene);
  ASSERT_TRUE(changes(document));
  EXPECT_EQ(scenes_, 2);
}

TEST_F(Documents, whatCannotBeUsedLeavesWhatWasThere) {
  Document document = make();
  ASSERT_TRUE(changes(document));
  folder_.put("a.look.json", "{\n\"shadow\": {\"threshhold\": 0.5}}");
  ASSERT_TRUE(changes(document));
  EXPECT_NE(document.problem().find("a.look.json:2"), std::string::npos) << document.problem();
  EXPECT_EQ(threshold(document), 0.25);
  folder_.put("a.look.json", lookText("0.5"));
  ASSERT_TRUE(changes(document));
  EXPECT_EQ(document.problem(), "");
  EXPECT_EQ(threshold(document), 0.5);
}

TEST_F(Documents, theFirstReadingMustBeRight) {
  folder_.put("a.gltf", "{}");
  Document document = make();
  const testing::AssertionResult result = changes(document);
  EXPECT_FALSE(result);
  EXPECT_NE(std::string(result.message()).find("a.gltf"), std::string::npos) << result.message();
}

TEST_F(Documents, editsWinOverFilesAndAreUndone) {
  Document document = make();
  ASSERT_TRUE(changes(document));
  ASSERT_TRUE(document.set("shadow.threshold", "0.3").ok());
  ASSERT_TRUE(document.set("shadow.threshold", "0.4").ok());  // the same turn of the knob
  document.closeStep();
  ASSERT_TRUE(document.set("shadow.threshold", "0.6").ok());
  EXPECT_EQ(threshold(document), 0.6);
  folder_.put("a.look.json", lookText("0.1"));
  ASSERT_TRUE(changes(document));
  EXPECT_EQ(threshold(document), 0.6);
  EXPECT_TRUE(document.undo());
  EXPECT_EQ(threshold(document), 0.4);
  EXPECT_TRUE(document.undo());
  EXPECT_EQ(threshold(document), 0.1);
  EXPECT_TRUE(document.edits().empty());
  EXPECT_FALSE(document.undo());
  EXPECT_TRUE(document.redo());
  EXPECT_EQ(threshold(document), 0.4);
  document.unset("shadow.threshold");
  EXPECT_EQ(threshold(document), 0.1);
  EXPECT_FALSE(document.redo());  // something else was done
  EXPECT_TRUE(document.undo());
  EXPECT_EQ(threshold(document), 0.4);
}

TEST_F(Documents, anotherLookTakesThePlaceOfTheFirst) {
  Document document = make();
  ASSERT_TRUE(changes(document));
  document.chooseLook("dusk");
  ASSERT_TRUE(changes(document));
  EXPECT_EQ(document.lookName(), "dusk");
  EXPECT_EQ(document.look().description(), Look::load("dusk")->description());
  document.chooseLook("no such look");
  ASSERT_TRUE(changes(document));
  EXPECT_NE(document.problem().find("no such look"), std::string::npos);
  EXPECT_EQ(document.lookName(), "dusk");
  document.chooseLook("");
  ASSERT_TRUE(changes(document));
  EXPECT_EQ(threshold(document), 0.25);
  EXPECT_EQ(scenes_, 1);
}

TEST_F(Documents, aKnobThatIsNotThereChangesNothing) {
  Document document = make();
  ASSERT_TRUE(changes(document));
  const uint64_t version = document.version();
  EXPECT_EQ(document.set("shadow.treshold", "0.3").error().kind, ErrorKind::usage);
  EXPECT_EQ(document.set("shadow.threshold", "9e9").error().kind, ErrorKind::usage);
  EXPECT_EQ(document.version(), version);
  EXPECT_FALSE(document.undo());
}

}  // namespace
}  // namespace scumble::viewer
