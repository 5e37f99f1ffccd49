// Films by time: flat colours that tell the number of the picture, written by FilmWriter.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <random>

#include "base/test_folder.h"
#include "film/test_ffmpeg.h"
#include "scumble/film.h"

namespace scumble::film {
namespace {

constexpr int kFrames = 30;
constexpr uint32_t kWidth = 48, kHeight = 32;

float levelOf(int frame) {
  return 0.05f + 0.9f * float(frame) / (kFrames - 1);
}

class FilmReaderTest : public ::testing::Test {
 protected:
  void SetUp() override { NEEDS_FFMPEG(); }

  void write(double fps) {
    FilmOptions options;
    options.width = kWidth, options.height = kHeight, options.fps = fps, options.quality = 4;
    auto film = FilmWriter::create(folder_.file("film.mp4"), options);
    ASSERT_TRUE(film) << film.error().problem;
    for (int i = 0; i < kFrames; ++i) {
      Image image;
      image.width = kWidth, image.height = kHeight;
      image.channels = {"R", "G", "B"};
      image.pixels.assign(size_t(kWidth) * kHeight * 3, levelOf(i));
      ASSERT_TRUE((*film)->add(image));
    }
    ASSERT_TRUE((*film)->finish());
  }

  static int frameOf(const Image& picture) {
    return int(std::lround((picture.at(kWidth / 2, kHeight / 2, 1) - 0.05f) / 0.9f * (kFrames - 1)));
  }

  TestFolder folder_;
};

TEST_F(FilmReaderTest, timesFindTheirPictures) {
  for (const double fps : {24.0, 29.97, 7.0}) {
    write(fps);
    auto reader = FilmReader::open(folder_.file("film.mp4"));
    ASSERT_TRUE(reader) << reader.error().problem;
    EXPECT_NEAR((*reader)->lastTime(), (kFrames - 1) / fps, 2e-3 * fps);
    for (int i = 0; i < kFrames; ++i)
      for (const double within : {0.0, 0.5, 0.9}) {
        const auto picture = (*reader)->at((i + within) / fps);
        ASSERT_TRUE(picture) << picture.error().problem;
        ASSERT_EQ(frameOf(**picture), i) << fps << ", " << within;
        ASSERT_EQ((*picture)->width, kWidth);
        ASSERT_EQ((*picture)->height, kHeight);
      }
  }
}

// Times count from a film's first picture on, whatever its file says: recorders and broadcasts begin
// anywhere, and cut films where they were cut.
TEST_F(FilmReaderTest, filmsBeginAtTheirFirstPicture) {
  write(24);
  for (const char* name : {"late.mkv", "late.ts", "late.mov"}) {
    const std::string late = folder_.file(name);
    ASSERT_EQ(system(("ffmpeg -v quiet -y -i '" + folder_.file("film.mp4") +
                      "' -c copy -output_ts_offset 7.25 '" + late + "'")
                         .c_str()),
              0);
    const double begins = std::atof(
        outputOf("ffprobe -v error -select_streams v:0 -show_entries packet=pts_time -of csv=p=0 '" + late +
                 "' | sed -n 1p")
            .c_str());
    auto reader = FilmReader::open(late);
    ASSERT_TRUE(reader) << reader.error().problem;
    if (std::string(name) != "late.mov") {
      EXPECT_GT(begins, 7) << name << " begins late";
    }
    EXPECT_NEAR((*reader)->lastTime(), (kFrames - 1) / 24.0, 2e-3) << name;
    for (const int i : {0, 1, 7, kFrames - 1}) {
      const auto picture = (*reader)->at((i + 0.5) / 24);
      ASSERT_TRUE(picture) << picture.error().problem;
      EXPECT_EQ(frameOf(**picture), i) << name;
    }
  }
}

// VP8 has packets that are never shown, with the time of the next picture.
TEST_F(FilmReaderTest, packetsThatAreNotShownAreNoPictures) {
  write(25);
  const std::string film = folder_.file("film.mp4"), webm = folder_.file("film.webm");
  const auto run = [&](const std::string& pass) {
    return system(("cd '" + folder_.file("") + "' && ffmpeg -v quiet -y -stream_loop 3 -i '" + film +
                   "' -c:v libvpx -auto-alt-ref 1 -lag-in-frames 25 -b:v 200k " + pass)
                      .c_str());
  };
  if (run("-pass 1 -f null -") != 0 || run("-pass 2 '" + webm + "'") != 0)
    GTEST_SKIP() << "this ffmpeg has no libvpx";
  auto reader = FilmReader::open(webm);
  ASSERT_TRUE(reader) << reader.error().problem;
  EXPECT_NEAR((*reader)->lastTime(), (4 * kFrames - 1) / 25.0, 2e-3);
  for (int i = 0; i < 4 * kFrames; i += 7) {
    const auto picture = (*reader)->at((i + 0.5) / 25);
    ASSERT_TRUE(picture) << picture.error().problem;
    EXPECT_NEAR(frameOf(**picture), i % kFrames, 1) << i;
  }
}

TEST_F(FilmReaderTest, colorsComeBackAndEndsStand) {
  write(24);
  auto reader = FilmReader::open(folder_.file("film.mp4"));
  ASSERT_TRUE(reader);
  for (const double time : {-3.0, 0.0, 100.0}) {
    const auto picture = (*reader)->at(time);
    ASSERT_TRUE(picture);
    const float level = levelOf(time > 0 ? kFrames - 1 : 0);
    for (uint32_t c = 0; c < 3; ++c)
      EXPECT_NEAR(std::pow((*picture)->at(3, 3, c), 1 / 2.2), std::pow(level, 1 / 2.2), 3.0 / 255) << time;
  }
}

// From wherever one begins and in any order, the bytes are the same; and the same object where it is the same
// picture.
TEST_F(FilmReaderTest, anyOrderGivesTheSameBytes) {
  write(24);
  auto inOrder = FilmReader::open(folder_.file("film.mp4"));
  ASSERT_TRUE(inOrder);
  std::vector<Image> pictures;
  for (int i = 0; i < kFrames; ++i) pictures.push_back(**(*inOrder)->at(i / 24.0));
  std::mt19937 random(7);
  auto reader = FilmReader::open(folder_.file("film.mp4"));
  ASSERT_TRUE(reader);
  for (int i = 0; i < 12; ++i) {
    const int frame = int(random() % kFrames);
    const auto picture = (*reader)->at((frame + 0.3) / 24.0);
    ASSERT_TRUE(picture);
    EXPECT_TRUE((*picture)->pixels == pictures[size_t(frame)].pixels) << frame;
    EXPECT_EQ(*picture, *(*reader)->at((frame + 0.6) / 24.0));
  }
}

TEST_F(FilmReaderTest, whatIsNoFilmIsRefused) {
  putContent(folder_.file("text.mp4"), "no film");
  putContent(folder_.file("list.m3u8"), "#EXTM3U\n#EXTINF:1,\nhttp://127.0.0.1:9/a.ts\n#EXT-X-ENDLIST\n");
  for (const char* name : {"text.mp4", "absent.mp4", "list.m3u8"}) {
    const auto reader = FilmReader::open(folder_.file(name));
    ASSERT_FALSE(reader) << name;
    EXPECT_EQ(reader.error().kind, ErrorKind::unusableFile);
    EXPECT_FALSE(reader.error().problem.empty());
  }
}

}  // namespace
}  // namespace scumble::film
