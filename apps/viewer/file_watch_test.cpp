#include "file_watch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>

#include "base/test_folder.h"

namespace scumble::viewer {
namespace {

class FileWatching : public testing::Test {
 protected:
  void save(const std::string& name, const std::string& text) const { folder_.put(name, text); }
  std::string path(const std::string& name) const { return folder_.file(name); }
  // What was saved, when something was; empty after a while.
  std::set<std::string> saved(int milliseconds = 5000) {
    std::unique_lock lock(mutex_);
    told_.wait_for(lock, std::chrono::milliseconds(milliseconds), [&] { return isTold_; });
    isTold_ = false;
    return watch_.takeSaved();
  }

  const TestFolder folder_;
  const std::string first_ = folder_.put("look.json", "1"), other_ = folder_.put("other/look.json", "1");
  std::mutex mutex_;
  std::condition_variable told_;
  bool isTold_ = false;
  FileWatch watch_{[this] {
    const std::lock_guard lock(mutex_);
    isTold_ = true;
    told_.notify_all();
  }};
};

using Names = std::set<std::string>;

TEST_F(FileWatching, tellsOfFilesThatAreWrittenOrRenamedInto) {
  watch_.watch({path("look.json"), path("not there yet.json")});
  save("look.json", "2");
  EXPECT_EQ(saved(), Names{path("look.json")});
  save("look.json~", "3");
  std::filesystem::rename(path("look.json~"), path("look.json"));
  EXPECT_EQ(saved(), Names{path("look.json")});
  save("not there yet.json", "1");
  EXPECT_EQ(saved(), Names{path("not there yet.json")});
}

TEST_F(FileWatching, tellsOfNothingElse) {
  watch_.watch({path("look.json")});
  save("another.json", "2");
  save("other/look.json", "2");
  EXPECT_EQ(saved(200), Names());
  save("look.json", "2");
  EXPECT_EQ(saved(), Names{path("look.json")});
}

TEST_F(FileWatching, watchesOthersFromThenOn) {
  watch_.watch({path("look.json")});
  watch_.watch({path("other/scene.gltf")});
  save("look.json", "2");
  EXPECT_EQ(saved(200), Names());
  save("other/scene.gltf", "2");
  EXPECT_EQ(saved(), Names{path("other/scene.gltf")});
  watch_.watch({path("no such folder/look.json"), path("look.json")});
  save("look.json", "3");
  EXPECT_EQ(saved(), Names{path("look.json")});
}

TEST_F(FileWatching, foldersComeAndGo) {
  const std::string file = path("later/look.json");
  watch_.watch({file});
  for (int time = 0; time < 2; ++time) {
    std::filesystem::create_directory(path("later"));
    save("later/look.json", "2");
    EXPECT_EQ(saved(), Names{file});
    // It may have been there already when the folder was found, and told of once more when it was closed.
    while (!saved(200).empty()) continue;
    save("later/look.json", "3");
    EXPECT_EQ(saved(), Names{file});
    if (time == 0)
      std::filesystem::remove_all(path("later"));
    else
      std::filesystem::rename(path("later"), path("elsewhere"));
  }
  save("elsewhere/look.json", "4");
  EXPECT_EQ(saved(200), Names());
  std::filesystem::rename(path("elsewhere"), path("later"));
  EXPECT_EQ(saved(), Names{file});
}

TEST_F(FileWatching, aFolderAboveMayBeMoved) {
  std::filesystem::create_directories(path("above/in/it"));
  const std::string file = path("above/in/it/look.json");
  watch_.watch({file, path("other/look.json")});
  save("above/in/it/look.json", "1");
  EXPECT_EQ(saved(), Names{file});
  std::filesystem::rename(path("above"), path("elsewhere"));
  save("elsewhere/in/it/look.json", "2");
  EXPECT_EQ(saved(200), Names()) << "that is another file";
  save("other/look.json", "2");
  EXPECT_EQ(saved(), Names{path("other/look.json")}) << "others go on";
  std::filesystem::rename(path("elsewhere"), path("above"));
  EXPECT_EQ(saved(), Names{file});
  while (!saved(200).empty()) continue;
  save("above/in/it/look.json", "3");
  EXPECT_EQ(saved(), Names{file});
}

TEST_F(FileWatching, aFolderThatWasReplacedIsLookedInto) {
  const std::vector<std::string> files{path("other/look.json")};
  watch_.watch(files);
  std::filesystem::rename(path("other"), path("before"));
  save("other/look.json", "2");
  watch_.watch(files);
  EXPECT_EQ(saved(), Names{files[0]});
}

TEST_F(FileWatching, ofALinkWhatItLeadsToIsSaved) {
  std::filesystem::create_symlink(path("other/look.json"), path("link.json"));
  watch_.watch({path("link.json")});
  save("other/look.json", "2");
  EXPECT_EQ(saved(), Names{path("link.json")});
}

}  // namespace
}  // namespace scumble::viewer
