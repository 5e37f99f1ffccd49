#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "base/srgb.h"
#include "base/test_folder.h"
#include "film/test_ffmpeg.h"
#include "scumble/film.h"

namespace scumble {
namespace {

using film::outputOf;
using scumble::linearFromSrgb8;

std::string facts(const std::string& film, const std::string& entries) {
  return outputOf("ffprobe -v error -select_streams v -of default=nw=1 -show_entries " + entries + " '" +
                  film + "'");
}

// Pixels of all frames, 3 bytes each.
std::string decoded(const std::string& film) {
  return outputOf("ffmpeg -v error -i '" + film +
                  "' -f rawvideo -pix_fmt rgb24 -sws_flags accurate_rnd+full_chroma_int+bicubic -");
}

Image flatCodes(uint32_t width, uint32_t height, const std::vector<int>& codes, float alpha = 1) {
  Image image{width, height, {"R", "G", "B", "A"}, {}};
  for (uint32_t i = 0; i < width * height; ++i) {
    for (const int code : codes) image.pixels.push_back(linearFromSrgb8()[size_t(code)]);
    image.pixels.push_back(alpha);
  }
  return image;
}

// Something to encode: stripes that wander.
Image stripes(uint32_t width, uint32_t height, int frame) {
  Image image{width, height, {"R", "G", "B"}, {}};
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        image.pixels.push_back(0.5f +
                               0.5f * std::sin(0.3f * float(x) + 0.1f * float(y) * float(c) + float(frame)));
  return image;
}

FilmOptions options(uint32_t width, uint32_t height) {
  FilmOptions result;
  result.width = width;
  result.height = height;
  return result;
}

Status writeFilm(const std::string& path, const FilmOptions& given, const std::vector<Image>& pictures) {
  Result<std::unique_ptr<FilmWriter>> writer = FilmWriter::create(path, given);
  if (!writer) return writer.error();
  for (const Image& picture : pictures)
    if (Status status = (*writer)->add(picture); !status) return status;
  return (*writer)->finish();
}

TEST(FilmWriter, framesSizeRateAndMarksComeBack) {
  NEEDS_FFMPEG();
  TestFolder folder;
  const std::string path = folder.file("a film's name.mp4"), plain = folder.file("a.mp4");
  FilmOptions given = options(96, 64);
  given.fps = 23.976;
  std::vector<Image> pictures;
  for (int i = 0; i < 30; ++i) pictures.push_back(stripes(96, 64, i));
  const Status status = writeFilm(path, given, pictures);
  ASSERT_TRUE(status.ok()) << status.error().message();
  EXPECT_EQ(folder.count(), 1u);
  std::filesystem::rename(path, plain);
  EXPECT_EQ(facts(plain,
                  "stream=codec_name,width,height,pix_fmt,color_range,color_space,color_transfer,"
                  "color_primaries,chroma_location,avg_frame_rate,nb_frames"),
            "codec_name=h264\nwidth=96\nheight=64\npix_fmt=yuv420p\ncolor_range=tv\ncolor_space=bt709\n"
            "color_transfer=iec61966-2-1\ncolor_primaries=bt709\nchroma_location=left\n"
            "avg_frame_rate=24000/1001\nnb_frames=30\n");
  EXPECT_EQ(decoded(plain).size(), 96u * 64 * 3 * 30);
  const std::string bytes = contentOf(plain);
  EXPECT_LT(bytes.find("moov"), bytes.find("mdat"));
  EXPECT_EQ(bytes.find("st3d"), std::string::npos);
  struct stat modes = {};
  ASSERT_EQ(stat(plain.c_str(), &modes), 0);
  const mode_t mask = umask(0);
  umask(mask);
  EXPECT_EQ(modes.st_mode & 0777, 0666 & ~mask);
}

TEST(FilmWriter, flatColoursComeBack) {
  NEEDS_FFMPEG();
  TestFolder folder;
  const std::string path = folder.file("a.mp4");
  const std::vector<int> colours[] = {{255, 0, 0},     {0, 255, 0},    {0, 0, 255},
                                      {255, 255, 255}, {0, 0, 0},      {128, 64, 32},
                                      {20, 140, 220},  {250, 200, 10}, {127, 127, 127}};
  for (const std::vector<int>& colour : colours) {
    ASSERT_TRUE(writeFilm(path, options(32, 32), {flatCodes(32, 32, colour)}).ok());
    const std::string pixels = decoded(path);
    ASSERT_EQ(pixels.size(), 32u * 32 * 3);
    for (size_t i = 0; i < pixels.size(); ++i)
      ASSERT_NEAR(uint8_t(pixels[i]), colour[i % 3], 2) << colour[0] << " " << colour[1] << " " << colour[2];
  }
}

TEST(FilmWriter, alphaIsOverBlack) {
  NEEDS_FFMPEG();
  TestFolder folder;
  ASSERT_TRUE(
      writeFilm(folder.file("a.mp4"), options(32, 32), {flatCodes(32, 32, {255, 255, 255}, 0.25f)}).ok());
  EXPECT_NEAR(uint8_t(decoded(folder.file("a.mp4"))[0]), std::lround(255 * srgbFromLinear(0.25)), 2);
}

TEST(FilmWriter, smallAndOddSizesGrowToEvenOnes) {
  NEEDS_FFMPEG();
  TestFolder folder;
  const std::string path = folder.file("a.mp4");
  for (const auto& [width, height] : {std::pair{1u, 1u}, {2u, 2u}, {33u, 17u}, {64u, 35u}, {321u, 8u}}) {
    const Status status =
        writeFilm(path, options(width, height), {stripes(width, height, 0), stripes(width, height, 1)});
    ASSERT_TRUE(status.ok()) << width << "x" << height << ": " << status.error().message();
    EXPECT_EQ(facts(path, "stream=width,height,nb_frames"),
              "width=" + std::to_string((width + 1) / 2 * 2) +
                  "\nheight=" + std::to_string((height + 1) / 2 * 2) + "\nnb_frames=2\n");
  }
}

TEST(FilmWriter, sameBytesEveryTime) {
  NEEDS_FFMPEG();
  TestFolder folder;
  std::vector<Image> pictures;
  for (int i = 0; i < 40; ++i) pictures.push_back(stripes(320, 180, i));
  FilmOptions given = options(320, 180);
  given.layout = FilmLayout::sideBySide;
  ASSERT_TRUE(writeFilm(folder.file("a.mp4"), given, pictures).ok());
  ASSERT_TRUE(writeFilm(folder.file("b.mp4"), given, pictures).ok());
  EXPECT_EQ(contentOf(folder.file("a.mp4")), contentOf(folder.file("b.mp4")));
}

TEST(FilmWriter, playersLearnTheLayoutOfEyes) {
  NEEDS_FFMPEG();
  TestFolder folder;
  const std::string path = folder.file("a.mp4");
  const struct {
    FilmLayout layout;
    std::string stream, frame;
  } cases[] = {
      {FilmLayout::mono, "", ""},
      {FilmLayout::sideBySide, "side_data_type=Stereo 3D\ntype=side by side\ninverted=0\n", "left_right"},
      {FilmLayout::overUnder, "side_data_type=Stereo 3D\ntype=top and bottom\ninverted=0\n", "top_bottom"}};
  for (const auto& c : cases) {
    FilmOptions given = options(64, 64);
    given.layout = c.layout;
    ASSERT_TRUE(writeFilm(path, given, {stripes(64, 64, 0), stripes(64, 64, 1)}).ok());
    const std::string inFile = facts(path, "stream_side_data=side_data_type,type,inverted");
    EXPECT_EQ(inFile, c.stream);
    EXPECT_EQ(facts(path, "frame_tags=stereo_mode").find("TAG:stereo_mode=" + c.frame) != std::string::npos,
              !c.frame.empty());
    EXPECT_EQ(decoded(path).size(), 64u * 64 * 3 * 2);
  }
}

TEST(FilmWriter, qualityCounts) {
  NEEDS_FFMPEG();
  TestFolder folder;
  FilmOptions fine = options(160, 96), coarse = fine;
  fine.quality = 0;
  coarse.quality = 51;
  const std::vector<Image> pictures = {stripes(160, 96, 0), stripes(160, 96, 1)};
  ASSERT_TRUE(writeFilm(folder.file("fine.mp4"), fine, pictures).ok());
  ASSERT_TRUE(writeFilm(folder.file("coarse.mp4"), coarse, pictures).ok());
  EXPECT_GT(contentOf(folder.file("fine.mp4")).size(), 2 * contentOf(folder.file("coarse.mp4")).size());
}

TEST(FilmWriter, anUnfinishedFilmLeavesNothing) {
  NEEDS_FFMPEG();
  TestFolder folder;
  const std::string path = folder.file("a.mp4");
  putContent(path, "old");
  {
    Result<std::unique_ptr<FilmWriter>> writer = FilmWriter::create(path, options(64, 64));
    ASSERT_TRUE(writer.ok());
    ASSERT_TRUE((*writer)->add(stripes(64, 64, 0)).ok());
  }
  EXPECT_EQ(contentOf(path), "old");
  EXPECT_EQ(folder.count(), 1u);
}

TEST(FilmWriter, aKilledProcessLeavesNothing) {
  NEEDS_FFMPEG();
  TestFolder folder;
  if (!folder.hasNamelessFiles()) GTEST_SKIP() << "the file system of temporary files knows no O_TMPFILE";
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    Result<std::unique_ptr<FilmWriter>> writer = FilmWriter::create(folder.file("a.mp4"), options(64, 64));
    if (writer.ok() && (*writer)->add(stripes(64, 64, 0))) kill(getpid(), SIGKILL);
    _exit(1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(folder.count(), 0u);
}

TEST(FilmWriter, whatMakesNoSenseIsRefused) {
  TestFolder folder;
  const std::string path = folder.file("a.mp4");
  const auto with = [](const auto& change) {
    FilmOptions changed = options(64, 64);
    change(changed);
    return changed;
  };
  const FilmOptions cases[] = {with([](FilmOptions& o) { o.width = 0; }),
                               with([](FilmOptions& o) { o.height = 0; }),
                               with([](FilmOptions& o) { o.width = 16385; }),
                               with([](FilmOptions& o) { o.fps = 0; }),
                               with([](FilmOptions& o) { o.fps = NAN; }),
                               with([](FilmOptions& o) { o.fps = 1e9; }),
                               with([](FilmOptions& o) { o.quality = -1; }),
                               with([](FilmOptions& o) { o.quality = 52; }),
                               with([](FilmOptions& o) { o.width = 63, o.layout = FilmLayout::sideBySide; }),
                               with([](FilmOptions& o) { o.height = 63, o.layout = FilmLayout::overUnder; })};
  for (const FilmOptions& given : cases) {
    const auto writer = FilmWriter::create(path, given);
    ASSERT_FALSE(writer.ok());
    EXPECT_EQ(writer.error().kind, ErrorKind::usage);
    EXPECT_EQ(writer.error().file, path);
  }
  EXPECT_EQ(folder.count(), 0u);
}

TEST(FilmWriter, aPictureThatDoesNotFitCostsNotTheFilm) {
  NEEDS_FFMPEG();
  TestFolder folder;
  const std::string path = folder.file("a.mp4");
  Result<std::unique_ptr<FilmWriter>> writer = FilmWriter::create(path, options(64, 64));
  ASSERT_TRUE(writer.ok());
  EXPECT_EQ((*writer)->finish().error().kind, ErrorKind::usage);
  EXPECT_EQ((*writer)->add(stripes(64, 62, 0)).error().kind, ErrorKind::usage);
  EXPECT_EQ((*writer)->add(Image{}).error().kind, ErrorKind::usage);
  ASSERT_TRUE((*writer)->add(stripes(64, 64, 0)).ok());
  ASSERT_TRUE((*writer)->finish().ok());
  EXPECT_EQ((*writer)->add(stripes(64, 64, 0)).error().kind, ErrorKind::usage);
  EXPECT_EQ((*writer)->finish().error().kind, ErrorKind::usage);
  EXPECT_EQ(facts(path, "stream=nb_frames"), "nb_frames=1\n");
}

TEST(FilmWriter, placesThatCannotBeWrittenAreKnownAtOnce) {
  TestFolder folder;
  for (const std::string& path : {folder.file("missing/a.mp4"), folder.file(""), std::string("/dev/null"),
                                  std::string("/proc/a.mp4"), std::string()}) {
    const auto writer = FilmWriter::create(path, options(64, 64));
    ASSERT_FALSE(writer.ok()) << path;
    EXPECT_EQ(writer.error().kind, ErrorKind::outputNotWritten);
  }
}

TEST(FilmWriter, aHostThatIgnoresItsChildrenGetsItsFilm) {
  NEEDS_FFMPEG();
  TestFolder folder;
  const auto handler = signal(SIGCHLD, SIG_IGN);
  const Status status = writeFilm(folder.file("a.mp4"), options(64, 64), {stripes(64, 64, 0)});
  signal(SIGCHLD, handler);
  ASSERT_TRUE(status.ok()) << status.error().message();
  EXPECT_EQ(facts(folder.file("a.mp4"), "stream=nb_frames"), "nb_frames=1\n");
}

// A limit on a file's size fails ffmpeg's write just as a full disk does.
TEST(FilmWriter, fullDiskIsNamedAndLeavesTheOldFile) {
  NEEDS_FFMPEG();
  TestFolder folder;
  const std::string path = folder.file("a.mp4");
  putContent(path, "old");
  std::vector<Image> pictures;
  for (int i = 0; i < 60; ++i) pictures.push_back(stripes(160, 96, i));
  struct rlimit before = {};
  getrlimit(RLIMIT_FSIZE, &before);
  for (const rlim_t limit : {rlim_t(0), rlim_t(3000), rlim_t(12000)}) {
    struct rlimit small = before;
    small.rlim_cur = limit;
    setrlimit(RLIMIT_FSIZE, &small);
    const Status status = writeFilm(path, options(160, 96), pictures);
    setrlimit(RLIMIT_FSIZE, &before);
    ASSERT_FALSE(status.ok()) << limit;
    EXPECT_EQ(status.error().kind, ErrorKind::outputNotWritten);
    EXPECT_NE(status.error().message().find("cannot be written: File "), std::string::npos)
        << status.error().message();
    EXPECT_NE(status.error().advice.find("make room on the disk"), std::string::npos);
    EXPECT_EQ(contentOf(path), "old");
    EXPECT_EQ(folder.count(), 1u);
  }
}

// Another program in ffmpeg's place.
class OtherFfmpeg : public testing::Test {
 protected:
  OtherFfmpeg() { setenv("PATH", (programs_.file("") + ":/usr/bin:/bin").c_str(), 1); }
  ~OtherFfmpeg() override { setenv("PATH", path_.c_str(), 1); }

  void put(const std::string& script) {
    putContent(programs_.file("ffmpeg"), "#!/bin/sh\n" + script + "\n");
    chmod(programs_.file("ffmpeg").c_str(), 0755);
  }

  // The message for a film of many frames.
  std::string failure() {
    TestFolder folder;
    const std::vector<Image> pictures(200, stripes(64, 64, 0));
    const Status status = writeFilm(folder.file("a.mp4"), options(64, 64), pictures);
    EXPECT_EQ(folder.count(), 0u);
    if (status) return "";
    EXPECT_EQ(status.error().kind, ErrorKind::outputNotWritten);
    EXPECT_EQ(status.error().file, folder.file("a.mp4"));
    return status.error().problem + "; " + status.error().advice;
  }

  TestFolder programs_;
  std::string path_ = getenv("PATH");
};

TEST_F(OtherFfmpeg, absent) {
  setenv("PATH", programs_.file("").c_str(), 1);
  EXPECT_EQ(failure(),
            "films need the program ffmpeg, which is not installed; install ffmpeg, or write a.####.png");
}

TEST_F(OtherFfmpeg, withoutTheEncoder) {
  put("echo \"Unknown encoder 'libx264'\" >&2; exit 1");
  EXPECT_EQ(failure(),
            "this ffmpeg has no libx264, which films are encoded with; install an ffmpeg with libx264, or "
            "write a.####.png");
}

TEST_F(OtherFfmpeg, fails) {
  put("head -c 20000 >/dev/null; printf '[libx264 @ 0x55d0] it is broken\\nConversion failed!\\n\\n' >&2; "
      "exit 3");
  EXPECT_EQ(failure(), "cannot be written: ffmpeg ended with code 3: it is broken; write a.####.png instead");
  put("cat >/dev/null; exit 4");
  EXPECT_EQ(failure(), "cannot be written: ffmpeg ended with code 4; write a.####.png instead");
  put("exit 0");
  EXPECT_EQ(failure(), "cannot be written: ffmpeg ended too early; write a.####.png instead");
  put("kill -SEGV $$");
  EXPECT_EQ(failure().find("cannot be written: ffmpeg was ended: Segmentation fault"), 0u);
}

TEST_F(OtherFfmpeg, writesSomethingElse) {
  put("cat >/dev/null; echo no film >/proc/self/fd/3");
  EXPECT_NE(failure().find("ffmpeg left something that is no film of ours"), std::string::npos);
}

TEST_F(OtherFfmpeg, fullDisk) {
  put("cat >/dev/null; echo 'Error writing trailer: No space left on device' >&2; exit 1");
  EXPECT_EQ(failure(),
            "cannot be written: No space left on device; make room on the disk or choose another place");
}

TEST_F(OtherFfmpeg, anErrorStays) {
  put("exit 1");
  TestFolder folder;
  Result<std::unique_ptr<FilmWriter>> writer = FilmWriter::create(folder.file("a.mp4"), options(640, 640));
  ASSERT_TRUE(writer.ok());
  std::string first;
  for (int i = 0; i < 10 && first.empty(); ++i)
    if (const Status status = (*writer)->add(stripes(640, 640, 0)); !status) first = status.error().message();
  EXPECT_NE(first, "");
  EXPECT_EQ((*writer)->add(stripes(640, 640, 0)).error().message(), first);
  EXPECT_EQ((*writer)->finish().error().message(), first);
}

Status resumeFilm(const std::string& path, const FilmOptions& given, const std::vector<Image>& pictures) {
  Result<std::unique_ptr<FilmWriter>> writer = FilmWriter::resume(path, given);
  if (!writer) return writer.error();
  for (size_t i = size_t((*writer)->frames()); i < pictures.size(); ++i)
    if (Status status = (*writer)->add(pictures[i]); !status) return status;
  EXPECT_EQ((*writer)->frames(), pictures.size());
  return (*writer)->finish();
}

TEST(FilmWriter, goesOnWithAFilmThatIsThere) {
  NEEDS_FFMPEG();
  TestFolder folder;
  const std::string path = folder.file("a film's name.mp4");
  FilmOptions given = options(33, 19);
  given.fps = 12.34;
  std::vector<Image> pictures;
  size_t parts = 0;
  for (const size_t count : {1, 2, 9, 9}) {
    while (pictures.size() < count) pictures.push_back(stripes(33, 19, int(pictures.size())));
    const Status status = resumeFilm(path, given, pictures);
    ASSERT_TRUE(status.ok()) << ++parts << ": " << status.error().message();
  }
  EXPECT_EQ(folder.count(), 1u);
  const std::string plain = folder.file("a.mp4");
  std::filesystem::rename(path, plain);
  EXPECT_EQ(facts(plain, "stream=width,height,avg_frame_rate,nb_frames"),
            "width=34\nheight=20\navg_frame_rate=617/50\nnb_frames=9\n");
  EXPECT_EQ(decoded(plain).size(), 34u * 20 * 3 * 9);
}

TEST(FilmWriter, goesOnWithItsOwnOnly) {
  NEEDS_FFMPEG();
  TestFolder folder;
  const std::string path = folder.file("a.mp4");
  const std::vector<Image> pictures{stripes(32, 16, 0), stripes(32, 16, 1)};
  ASSERT_TRUE(writeFilm(path, options(32, 16), pictures).ok());
  const std::string before = contentOf(path);
  FilmOptions other = options(32, 16);
  for (const int quality : {0, 15, 17}) {
    other.quality = quality;
    const auto writer = FilmWriter::resume(path, other);
    ASSERT_FALSE(writer);
    EXPECT_EQ(writer.error().kind, ErrorKind::usage);
  }
  other = options(32, 16);
  other.format = FilmFormat::gif;
  EXPECT_FALSE(FilmWriter::resume(path, other));
  // A folder and what may not be read are no films.
  EXPECT_FALSE(FilmWriter::resume(folder.path(), options(32, 16)));
  // One that is not gone on with stays.
  ASSERT_TRUE(FilmWriter::resume(path, options(32, 16)));
  EXPECT_EQ(contentOf(path), before);
  EXPECT_EQ(folder.count(), 1u);
}

}  // namespace
}  // namespace scumble
