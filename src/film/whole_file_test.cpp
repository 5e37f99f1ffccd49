#include "base/whole_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

#include "base/passing_file.h"
#include "base/test_folder.h"
#include "scumble/image.h"

namespace scumble {
namespace {

// Both writers, so that every promise is tested for each of them.
struct Writer {
  const char* name;
  Status (*write)(const std::string& path, const Image& image);
};
const Writer kWriters[] = {
    {"png", writePng},
    {"exr",
     [](const std::string& path, const Image& image) {
       return writeExr(path, {{"", "", &image}});
     }},
};

Image noise(uint32_t width, uint32_t height) {
  Image image{width, height, {"R", "G", "B"}, {}};
  image.pixels.resize(size_t(width) * height * 3);
  uint32_t state = 1;
  for (float& v : image.pixels) v = float((state = state * 1664525 + 1013904223) >> 8) / float(1 << 24);
  return image;
}

class WholeFileTest : public testing::TestWithParam<Writer> {};
INSTANTIATE_TEST_SUITE_P(Writers, WholeFileTest, testing::ValuesIn(kWriters),
                         [](const auto& writer) { return std::string(writer.param.name); });

TEST_P(WholeFileTest, missingFolderIsNamed) {
  TestFolder folder;
  const std::string path = folder.file("missing/picture");
  const Status status = GetParam().write(path, noise(4, 4));
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::outputNotWritten);
  EXPECT_EQ(status.error().file, path);
  EXPECT_NE(status.error().message().find("No such file or directory; create the folder first"),
            std::string::npos)
      << status.error().message();
  EXPECT_EQ(folder.count(), 0u);
}

TEST_P(WholeFileTest, foldersAndDevicesAreNotReplaced) {
  TestFolder folder;
  std::filesystem::create_directory(folder.file("inner"));
  for (const std::string& path : {folder.file("inner"), folder.file("inner/"), folder.file("inner/."),
                                  std::string("/dev/null"), std::string("/dev/full"), std::string()}) {
    const Status status = GetParam().write(path, noise(4, 4));
    ASSERT_FALSE(status.ok()) << path;
    EXPECT_EQ(status.error().kind, ErrorKind::outputNotWritten);
  }
  EXPECT_EQ(folder.count(), 1u);
  struct stat facts = {};
  ASSERT_EQ(stat("/dev/null", &facts), 0);
  EXPECT_TRUE(S_ISCHR(facts.st_mode));
}

TEST_P(WholeFileTest, placesWithoutPermissionAreRefused) {
  EXPECT_FALSE(GetParam().write("/sys/picture", noise(4, 4)).ok());
  EXPECT_FALSE(GetParam().write("/proc/picture", noise(4, 4)).ok());
}

// A limit on a file's size fails a write in the middle just as a full disk does. The signal that comes with
// it would end this process.
TEST_P(WholeFileTest, fullDiskLeavesTheOldFileAndNothingElse) {
  TestFolder folder;
  const std::string path = folder.file("picture");
  putContent(path, "old");
  struct rlimit before = {};
  getrlimit(RLIMIT_FSIZE, &before);
  for (const rlim_t limit : {rlim_t(0), rlim_t(100), rlim_t(20000)}) {
    struct rlimit small = before;
    small.rlim_cur = limit;
    setrlimit(RLIMIT_FSIZE, &small);
    const Status status = GetParam().write(path, noise(200, 200));
    setrlimit(RLIMIT_FSIZE, &before);
    ASSERT_FALSE(status.ok()) << limit;
    EXPECT_EQ(status.error().kind, ErrorKind::outputNotWritten);
    EXPECT_NE(status.error().problem.find("File too large"), std::string::npos) << status.error().message();
    EXPECT_EQ(contentOf(path), "old");
    EXPECT_EQ(folder.count(), 1u);
    sigset_t pending, blocked;
    sigpending(&pending);
    pthread_sigmask(SIG_BLOCK, nullptr, &blocked);
    EXPECT_FALSE(sigismember(&pending, SIGXFSZ) || sigismember(&blocked, SIGXFSZ));
  }
}

TEST_P(WholeFileTest, replacesAFileAndKeepsItsModeAndLinksToIt) {
  TestFolder folder;
  const std::string path = folder.file("picture"), link = folder.file("link");
  putContent(path, "old");
  ASSERT_EQ(chmod(path.c_str(), 0640), 0);
  std::filesystem::create_symlink("picture", link);
  ASSERT_TRUE(GetParam().write(link, noise(4, 4)).ok());
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_GT(contentOf(path).size(), 20u);
  struct stat facts = {};
  ASSERT_EQ(stat(path.c_str(), &facts), 0);
  EXPECT_EQ(facts.st_mode & 0777, 0640u);
  EXPECT_EQ(folder.count(), 2u);
}

TEST_P(WholeFileTest, longestNamesWork) {
  TestFolder folder;
  const std::string path = folder.file(std::string(255, 'n'));
  ASSERT_TRUE(GetParam().write(path, noise(4, 4)).ok());
  EXPECT_TRUE(std::filesystem::exists(path));
}

TEST_P(WholeFileTest, picturesThatContradictThemselvesAreRefused) {
  TestFolder folder;
  const std::string path = folder.file("picture");
  Image shortOfPixels = noise(4, 4);
  shortOfPixels.pixels.pop_back();
  for (const Image& image : {Image{}, Image{0, 4, {"R"}, {}}, Image{4, 0, {"R"}, {}}, Image{1, 1, {}, {}},
                             Image{0x80000000u, 0x80000000u, {"R", "G", "B", "A"}, {}}, shortOfPixels}) {
    const Status status = GetParam().write(path, image);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().kind, ErrorKind::usage);
  }
  EXPECT_EQ(folder.count(), 0u);
}

TEST(WholeFile, aKilledProcessLeavesNothing) {
  TestFolder folder;
  if (!folder.hasNamelessFiles()) GTEST_SKIP() << "the file system of temporary files knows no O_TMPFILE";
  const std::string path = folder.file("picture"), bytes(1 << 20, 'x');
  for (const bool there : {false, true}) {
    if (there) putContent(path, "old");
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      WholeFile file(path);
      file.write(bytes.data(), bytes.size());
      if (file.ok()) kill(getpid(), SIGKILL);
      _exit(1);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    EXPECT_EQ(folder.count(), there ? 1u : 0u);
    EXPECT_EQ(contentOf(path), there ? "old" : "");
  }
}

// Both ways of putting a file in its place, whichever of them this file system takes by itself.
TEST(PassingFile, namedAndNamelessTakeTheirPlace) {
  TestFolder folder;
  const std::string path = folder.file("picture");
  for (const bool named : {false, true})
    for (const bool there : {false, true}) {
      std::filesystem::remove(path);
      if (there) putContent(path, "an older and longer one");
      PassingFile file = openPassingFile(folder.file(""));
      ASSERT_GE(file.descriptor, 0) << strerror(errno);
      if (named && file.name.empty()) {
        file.name = folder.file("passing");
        ASSERT_EQ(putInPlace(file.descriptor, "", file.name), 0);
      }
      ASSERT_EQ(write(file.descriptor, "new", 3), 3);
      EXPECT_EQ(putInPlace(file.descriptor, file.name, path), 0);
      close(file.descriptor);
      EXPECT_EQ(contentOf(path), "new");
      EXPECT_EQ(folder.count(), 1u);
    }
}

TEST(PassingFile, aFailureSaysWhyAndLeavesNothing) {
  TestFolder folder;
  std::filesystem::create_directory(folder.file("inner"));
  EXPECT_LT(openPassingFile(folder.file("missing/")).descriptor, 0);
  EXPECT_EQ(errno, ENOENT);
  const PassingFile file = openPassingFile(folder.file(""));
  ASSERT_GE(file.descriptor, 0);
  EXPECT_EQ(putInPlace(file.descriptor, file.name, folder.file("inner")), EISDIR);
  EXPECT_EQ(putInPlace(file.descriptor, file.name, folder.file("missing/picture")), ENOENT);
  close(file.descriptor);
  if (!file.name.empty()) unlink(file.name.c_str());
  EXPECT_EQ(folder.count(), 1u);
}

}  // namespace
}  // namespace scumble
