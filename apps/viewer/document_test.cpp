#include "document.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>

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

using Files = std::vector<std::string>;

class Documents : public testing::Test {
 protected:
  Document make() {
    return Document({{{scene_}, "", ""},
                     [this](const Files& files, const Progress& progress) {
                       SceneOptions options;
                       options.progress = progress, options.mapsFiles = false;
                       return ++scenes_, Scene::load(files[0], options);
                     },
                     [this](const Scene&, const Opened& opened) {
                       return ++looks_,
                              Look::load(opened.look.empty() ? ownLook(opened.scenes).name : opened.look);
                     },
                     [this](const Files& files) { return ownLook(files); }},
                    [this] { wake(); });
  }
  OwnLook ownLook(const Files& files) const {
    const bool isFirst = files[0] == scene_;
    const std::string file =
        isFirst ? look_ : std::filesystem::path(files[0]).replace_extension(".look.json").string();
    return {!isFirst ? "manga" : lookName_.empty() ? look_ : lookName_, file};
  }
  void wake() {
    const std::lock_guard lock(mutex_);
    ++wakes_;
    woken_.notify_all();
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
  static std::string problem(const Document& document) {
    std::string all;
    for (const auto& [concern, text] : document.problems()) all += text;
    return all;
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
  std::string lookName_;  // another one that it is opened with
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
  EXPECT_NE(problem(document).find("a.look.json:2"), std::string::npos) << problem(document);
  EXPECT_EQ(threshold(document), 0.25);
  folder_.put("a.look.json", lookText("0.5"));
  ASSERT_TRUE(changes(document));
  EXPECT_EQ(problem(document), "");
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
  document.openLook("dusk");
  ASSERT_TRUE(changes(document));
  EXPECT_EQ(document.opened().look, "dusk");
  EXPECT_EQ(document.look().description(), Look::load("dusk")->description());
  document.openLook("no such look");
  ASSERT_TRUE(changes(document));
  EXPECT_NE(problem(document).find("no such look"), std::string::npos);
  EXPECT_EQ(document.opened().look, "dusk");
  document.openLook("");
  ASSERT_TRUE(changes(document));
  EXPECT_EQ(threshold(document), 0.25);
  EXPECT_EQ(scenes_, 1);
}

TEST_F(Documents, aLookThatCannotBeReadIsNotReadAgain) {
  Document document = make();
  ASSERT_TRUE(changes(document));
  document.openLook("no such look");
  ASSERT_TRUE(changes(document));
  EXPECT_NE(problem(document), "");
  folder_.put("a.look.json", lookText("0.75"));
  ASSERT_TRUE(changes(document));
  EXPECT_EQ(problem(document), "");
  EXPECT_EQ(threshold(document), 0.75);
}

TEST_F(Documents, savesIntoTheFileAndUndoesBeyondThat) {
  folder_.put("a.look.json", "{\n  // as it was\n  \"shadow\": {\"threshold\": 0.25}\n}\n");
  Document document = make();
  ASSERT_TRUE(changes(document));
  ASSERT_TRUE(document.set("shadow.threshold", "0.5").ok());
  document.closeStep();
  ASSERT_TRUE(document.set("shadow.steps", "3").ok());
  const Result<std::string> saved = document.save();
  ASSERT_TRUE(saved.ok()) << saved.error().message();
  EXPECT_EQ(*saved, look_);
  EXPECT_EQ(contentOf(look_), "{\n  // as it was\n  \"shadow\": {\"threshold\": 0.5, \"steps\": 3}\n}\n");
  ASSERT_TRUE(changes(document));
  EXPECT_TRUE(document.edits().empty());
  EXPECT_EQ(threshold(document), 0.5);
  EXPECT_TRUE(document.undo());
  EXPECT_EQ(std::get<int>(document.look().get("shadow.steps").value()), 1);
  EXPECT_EQ(threshold(document), 0.5);
  EXPECT_TRUE(document.undo());
  EXPECT_EQ(threshold(document), 0.25);
  EXPECT_TRUE(document.redo());
  EXPECT_TRUE(document.redo());
  EXPECT_EQ(std::get<int>(document.look().get("shadow.steps").value()), 3);
  EXPECT_EQ(threshold(document), 0.5);
}

TEST_F(Documents, aLookThatShipsIsSavedAsOneThatExtendsIt) {
  lookName_ = "dusk";
  std::filesystem::remove(look_);
  Document document = make();
  ASSERT_TRUE(changes(document));
  ASSERT_TRUE(document.set("shadow.threshold", "0.5").ok());
  ASSERT_TRUE(document.save().ok());
  EXPECT_EQ(contentOf(look_), "{\n  \"extends\": \"dusk\",\n  \"shadow\": { \"threshold\": 0.5 }\n}\n");
  ASSERT_TRUE(changes(document));
  EXPECT_EQ(threshold(document), 0.5);
  EXPECT_EQ(document.opened().look, look_);
  // What is there already is somebody else's.
  document.openLook("fauve");
  while (document.opened().look != "fauve")
    ASSERT_TRUE(changes(document));  // what was saved may be read first
  const Result<std::string> other = document.save();
  ASSERT_TRUE(other.ok());
  EXPECT_EQ(*other, folder_.file("a.fauve.look.json"));
}

TEST_F(Documents, whatCannotBeSavedStays) {
  Document document = make();
  ASSERT_TRUE(changes(document));
  ASSERT_TRUE(document.set("shadow.threshold", "0.5").ok());
  folder_.put("a.look.json", "{\"shadow\": 3}");
  EXPECT_EQ(document.save().error().kind, ErrorKind::unusableFile);
  EXPECT_EQ(contentOf(look_), "{\"shadow\": 3}");
  EXPECT_EQ(threshold(document), 0.5);
  std::filesystem::remove(look_);
  EXPECT_EQ(document.save().error().kind, ErrorKind::unusableFile);
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

TEST_F(Documents, otherScenesComeWithTheirLook) {
  Document document = make();
  ASSERT_TRUE(changes(document));
  const uint64_t scenes = document.sceneVersion();
  ASSERT_TRUE(document.set("shadow.threshold", "0.5").ok());
  const std::string other = folder_.put("other.gltf", kScene);
  document.openScenes({folder_.file("none.gltf")});
  ASSERT_TRUE(changes(document));
  EXPECT_TRUE(document.problems().count(Concern::scene)) << problem(document);
  EXPECT_EQ(document.opened().scenes, Files{scene_});
  EXPECT_EQ(threshold(document), 0.5);
  document.openScenes({other});
  ASSERT_TRUE(changes(document));
  EXPECT_TRUE(document.problems().empty()) << problem(document);
  EXPECT_EQ(document.opened().scenes, Files{other});
  EXPECT_GT(document.sceneVersion(), scenes);
  EXPECT_TRUE(document.edits().empty()) << "they were those of the other look";
  EXPECT_FALSE(document.undo());
  // A look that was chosen stays, and what was turned on it.
  document.openLook("dusk");
  ASSERT_TRUE(changes(document));
  ASSERT_TRUE(document.set("shadow.threshold", "0.5").ok());
  document.openScenes({scene_});
  ASSERT_TRUE(changes(document));
  EXPECT_EQ(document.opened().look, "dusk");
  EXPECT_EQ(threshold(document), 0.5);
}

TEST_F(Documents, aPictureBehindEverything) {
  Document document = make();
  ASSERT_TRUE(changes(document));
  const std::string picture = folder_.file("sky.png");
  ASSERT_TRUE(writePng(picture, {2, 1, {"R", "G", "B"}, {1, 0, 0, 0, 1, 0}}).ok());
  document.openBackground(picture);
  ASSERT_TRUE(changes(document));
  ASSERT_TRUE(document.background());
  EXPECT_EQ(document.background()->width, 2u);
  ASSERT_TRUE(writePng(picture, {3, 1, {"R", "G", "B"}, {1, 0, 0, 0, 1, 0, 0, 0, 1}}).ok());
  ASSERT_TRUE(changes(document));
  EXPECT_EQ(document.background()->width, 3u);
  folder_.put("sky.png", "nothing");
  ASSERT_TRUE(changes(document));
  EXPECT_TRUE(document.problems().count(Concern::background));
  EXPECT_EQ(document.background()->width, 3u);
  document.openBackground("");
  ASSERT_TRUE(changes(document));
  EXPECT_FALSE(document.background());
  EXPECT_TRUE(document.problems().empty()) << problem(document);
}

TEST_F(Documents, manyKnobsAreOneStep) {
  Document document = make();
  ASSERT_TRUE(changes(document));
  document.take({{"shadow.threshold", "0.5"}, {"shadow.steps", "3"}});
  EXPECT_EQ(document.edits().size(), 2u);
  EXPECT_EQ(threshold(document), 0.5);
  EXPECT_TRUE(document.undo());
  EXPECT_TRUE(document.edits().empty());
}

// What is cut off while it is read is told, and read again when it is whole.
TEST_F(Documents, aSceneThatIsWrittenWhileItIsRead) {
  Document document = make();
  ASSERT_TRUE(changes(document));
  for (size_t size : {0, 1, 200}) {
    folder_.put("a.gltf", std::string(kScene).substr(0, size));
    ASSERT_TRUE(changes(document));
    EXPECT_TRUE(document.problems().count(Concern::scene)) << size;
  }
  folder_.put("a.gltf", kScene);
  ASSERT_TRUE(changes(document));
  EXPECT_TRUE(document.problems().empty()) << problem(document);
}

// Every knob of everything that has one, as the window turns it.
TEST_F(Documents, knobsOfOneMaterialAreSavedBelowIt) {
  Document document = make();
  ASSERT_TRUE(changes(document));
  ASSERT_TRUE(document.set("materials.Paint.001.warp.amount", "2").ok());
  ASSERT_TRUE(document.save().ok());
  EXPECT_EQ(contentOf(look_),
            R"({"shadow": {"threshold": 0.25}, "materials": { "Paint.001": { "warp": { "amount": 2 } } }})");
  ASSERT_TRUE(changes(document));
  EXPECT_TRUE(document.edits().empty());
  EXPECT_EQ(std::get<double>(document.look().get("materials.Paint.001.warp.amount").value()), 2);
  EXPECT_TRUE(document.undo());
  EXPECT_NE(std::get<double>(document.look().get("materials.Paint.001.warp.amount").value()), 2);
}

// What is wanted meanwhile stays wanted when a reading fails, and what failed does not.
TEST_F(Documents, aSceneThatCannotBeReadIsNeverTheOpenOne) {
  Document document = make();
  ASSERT_TRUE(changes(document));
  document.openScenes({folder_.file("none.gltf")});
  document.openLook("dusk");
  while (document.opened().look != "dusk") ASSERT_TRUE(changes(document));
  EXPECT_EQ(document.opened().scenes, Files{scene_});
  EXPECT_EQ(document.lookName(), "dusk");
}

TEST_F(Documents, nothingIsSavedWhileSomethingElseIsRead) {
  Document document = make();
  ASSERT_TRUE(changes(document));
  ASSERT_TRUE(document.set("shadow.threshold", "0.5").ok());
  document.openScenes({folder_.put("other.gltf", kScene)});
  EXPECT_EQ(document.save().error().kind, ErrorKind::usage);
  EXPECT_EQ(contentOf(look_), lookText("0.25"));
}

// A look refuses pictures outside of its folder: it would never be read again.
TEST_F(Documents, whatCouldNotBeReadAgainIsNotWritten) {
  const TestFolder elsewhere;
  const Image picture{8, 8, {"R", "G", "B"}, std::vector<float>(192, 0.5f)};
  const std::string far = elsewhere.file("mark.png"), near = folder_.file("marks/mark.png");
  folder_.put("marks/of ours", "");
  ASSERT_TRUE(writePng(far, picture).ok());
  ASSERT_TRUE(writePng(near, picture).ok());
  Document document = make();
  ASSERT_TRUE(changes(document));
  ASSERT_TRUE(document.set("warp.metatexture.example", far).ok());
  EXPECT_EQ(document.save().error().kind, ErrorKind::unusableFile);
  EXPECT_EQ(contentOf(look_), lookText("0.25"));
  ASSERT_TRUE(document.set("warp.metatexture.example", near).ok());
  ASSERT_TRUE(document.save().ok());
  EXPECT_NE(contentOf(look_).find("\"marks/mark.png\""), std::string::npos) << contentOf(look_);
  ASSERT_TRUE(changes(document));
  EXPECT_TRUE(document.edits().empty());
  EXPECT_TRUE(document.problems().empty()) << problem(document);
}

// Whatever the present folder is: those of a hand are from there, those of a file from its folder.
TEST_F(Documents, tracksOfPicturesAreSavedByWhereTheyLie) {
  folder_.put("marks/of ours", "");
  const std::string mark = folder_.file("marks/mark.png");
  ASSERT_TRUE(writePng(mark, {8, 8, {"R", "G", "B"}, std::vector<float>(192, 0.5f)}).ok());
  for (const std::string& named : {mark, std::filesystem::relative(mark).string()}) {
    folder_.put("a.look.json", lookText("0.25"));
    Document document = make();
    ASSERT_TRUE(changes(document));
    const std::string track = R"({ "keys": [[0, "paper"], [1.5, ")" + named + R"("]], "repeat": true })";
    ASSERT_TRUE(document.set("warp.metatexture.example", track).ok());
    const Result<std::string> saved = document.save();
    ASSERT_TRUE(saved.ok()) << saved.error().message();
    EXPECT_NE(contentOf(look_).find(R"({ "keys": [[0, "paper"], [1.5, "marks/mark.png"]], "repeat": true })"),
              std::string::npos)
        << contentOf(look_);
    ASSERT_TRUE(changes(document));
    EXPECT_TRUE(document.edits().empty());
    EXPECT_TRUE(document.problems().empty()) << problem(document);
  }
}

TEST_F(Documents, scenesThatAreAddedKeepWhatWasTurned) {
  Document document = make();
  ASSERT_TRUE(changes(document));
  ASSERT_TRUE(document.set("shadow.threshold", "0.5").ok());
  document.addScenes({folder_.put("b.gltf", kScene)});
  document.addScenes({folder_.put("c.gltf", kScene)});
  while (document.opened().scenes.size() < 3) ASSERT_TRUE(changes(document));
  EXPECT_EQ(document.edits().size(), 1u);
  EXPECT_TRUE(document.undo());
}

TEST_F(Documents, aLookThatIsReadDoesNotMendTheScene) {
  Document document = make();
  ASSERT_TRUE(changes(document));
  folder_.put("a.gltf", "{");
  ASSERT_TRUE(changes(document));
  ASSERT_TRUE(document.problems().count(Concern::scene));
  folder_.put("a.look.json", lookText("0.5"));
  ASSERT_TRUE(changes(document));
  EXPECT_EQ(threshold(document), 0.5);
  EXPECT_TRUE(document.problems().count(Concern::scene));
}

TEST_F(Documents, whatWasUndoneIsTheLooksOwn) {
  Document document = make();
  ASSERT_TRUE(changes(document));
  ASSERT_TRUE(document.set("shadow.threshold", "0.5").ok());
  ASSERT_TRUE(document.save().ok());
  ASSERT_TRUE(changes(document));
  document.openLook("dusk");
  while (document.opened().look != "dusk") ASSERT_TRUE(changes(document));
  EXPECT_FALSE(document.undo());
  EXPECT_TRUE(document.edits().empty());
}

TEST_F(Documents, readersThatThrowAreProblemsLikeOthers) {
  bool throws = false;
  Document document({{{scene_}, "", ""},
                     [&](const Files& files, const Progress&) -> Result<Scene> {
                       if (throws) throw std::bad_alloc();
                       return Scene::load(files[0]);
                     },
                     [](const Scene&, const Opened&) { return Look::load("dusk"); },
                     [this](const Files& files) { return ownLook(files); }},
                    [this] { wake(); });
  ASSERT_TRUE(changes(document));
  throws = true;
  document.openScenes({folder_.file("b.gltf")});
  ASSERT_TRUE(changes(document));
  EXPECT_TRUE(document.problems().count(Concern::scene));
}

TEST_F(Documents, oneOfTheClipsUntilOtherScenesAreThere) {
  std::vector<std::string> clips;
  Document document({{{scene_}, "", ""},
                     [](const Files& files, const Progress&) { return Scene::load(files[0]); },
                     [&](const Scene&, const Opened& opened) -> Result<Look> {
                       clips.push_back(opened.clip);
                       if (opened.clip == "none")
                         return Error{ErrorKind::usage, "", 0, "", "no such clip", ""};
                       return Look::load("dusk");
                     },
                     [this](const Files& files) { return ownLook(files); }},
                    [this] { wake(); });
  ASSERT_TRUE(changes(document));
  document.openClip("Walk");
  ASSERT_TRUE(changes(document));
  EXPECT_EQ(document.opened().clip, "Walk");
  document.openClip("none");
  ASSERT_TRUE(changes(document));
  EXPECT_EQ(document.opened().clip, "Walk");
  EXPECT_TRUE(document.problems().count(Concern::look));
  document.addScenes({folder_.put("b.gltf", kScene)});
  ASSERT_TRUE(changes(document));
  EXPECT_EQ(document.opened().clip, "Walk");
  document.openScenes({folder_.file("b.gltf")});
  ASSERT_TRUE(changes(document));
  EXPECT_EQ(clips, (std::vector<std::string>{"", "Walk", "none", "Walk", ""}));
}

}  // namespace
}  // namespace scumble::viewer
