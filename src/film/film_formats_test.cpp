// WebM and GIF. What all films promise is tested with MP4 in film_writer_test.cpp.
#include <gtest/gtest.h>

#include <cmath>

#include "base/srgb.h"
#include "base/test_folder.h"
#include "film/test_ffmpeg.h"
#include "scumble/film.h"

namespace scumble {
namespace {

class FilmFormats : public testing::TestWithParam<FilmFormat> {
 protected:
  void SetUp() override { NEEDS_FFMPEG(); }
  FilmOptions options(uint32_t width, uint32_t height) const {
    FilmOptions result;
    result.format = GetParam();
    result.width = width, result.height = height;
    return result;
  }
  std::string facts(const std::string& entries) const {
    return film::outputOf("ffprobe -v error -count_frames -select_streams v -of default=nw=1 -show_entries " +
                          entries + " '" + path_ + "'");
  }
  void write(const FilmOptions& given, int frames, float alpha = 1) {
    Result<std::unique_ptr<FilmWriter>> writer = FilmWriter::create(path_, given);
    ASSERT_TRUE(writer.ok()) << writer.error().message();
    for (int i = 0; i < frames; ++i) {
      Image image{given.width, given.height, {"R", "G", "B", "A"}, {}};
      for (uint32_t y = 0; y < given.height; ++y)
        for (uint32_t x = 0; x < given.width; ++x)
          for (const float value : {0.5f + 0.4f * std::sin(0.2f * float(x) + float(i)), 0.3f, 0.6f, alpha})
            image.pixels.push_back(value);
      ASSERT_TRUE((*writer)->add(image).ok());
    }
    const Status status = (*writer)->finish();
    ASSERT_TRUE(status.ok()) << status.error().message();
  }

  TestFolder folder_;
  const std::string path_ = folder_.file("film");
};
INSTANTIATE_TEST_SUITE_P(, FilmFormats, testing::Values(FilmFormat::webm, FilmFormat::gif),
                         [](const auto& one) { return one.param == FilmFormat::gif ? "gif" : "webm"; });

TEST_P(FilmFormats, framesSizeAndLengthComeBack) {
  write(options(64, 36), 24);
  const std::string found = facts("stream=codec_name,width,height,nb_read_frames:format=duration");
  const bool isGif = GetParam() == FilmFormat::gif;
  for (const char* fact : {isGif ? "codec_name=gif" : "codec_name=vp9", "width=64", "height=36",
                           "nb_read_frames=24", "duration=1.000000"})
    EXPECT_NE(found.find(fact), std::string::npos) << found;
  EXPECT_EQ(folder_.count(), 1u);
}

TEST_P(FilmFormats, coloursComeBackAndAlphaIsOverBlack) {
  FilmOptions given = options(32, 32);
  if (GetParam() == FilmFormat::webm) given.quality = 0;
  for (const float alpha : {1.0f, 0.5f}) {
    write(given, 2, alpha);
    const std::string codes =
        film::outputOf("ffmpeg -v error -i '" + path_ + "' -vsync passthrough -f rawvideo -pix_fmt rgb24 -");
    ASSERT_EQ(codes.size(), size_t(2 * 32 * 32 * 3));
    for (size_t i = 0; i < codes.size(); i += 3 * 7) {
      EXPECT_NEAR(uint8_t(codes[i + 1]), 255 * srgbFromLinear(0.3 * alpha), 8) << i;
      EXPECT_NEAR(uint8_t(codes[i + 2]), 255 * srgbFromLinear(0.6 * alpha), 8) << i;
    }
  }
}

TEST_P(FilmFormats, sameBytesEveryTimeAndUnfinishedLeavesNothing) {
  write(options(96, 64), 6);
  const std::string once = contentOf(path_);
  write(options(96, 64), 6);
  EXPECT_EQ(contentOf(path_), once);
  std::filesystem::remove(path_);
  {
    Result<std::unique_ptr<FilmWriter>> writer = FilmWriter::create(path_, options(16, 16));
    ASSERT_TRUE(writer.ok());
    ASSERT_TRUE((*writer)->add({16, 16, {"R", "G", "B"}, std::vector<float>(16 * 16 * 3, 0.2f)}).ok());
  }
  EXPECT_EQ(folder_.count(), 0u);
}

TEST_P(FilmFormats, whatTheyCannotDoIsRefused) {
  FilmOptions given = options(16, 16);
  given.quality = GetParam() == FilmFormat::gif ? 10 : 64;
  EXPECT_EQ(FilmWriter::create(path_, given).error().kind, ErrorKind::usage);
  if (GetParam() != FilmFormat::gif) return;
  given = options(16, 16);
  given.fps = 60;
  EXPECT_EQ(FilmWriter::create(path_, given).error().kind, ErrorKind::usage);
}

TEST_P(FilmFormats, oddSizes) {
  write(options(33, 17), 3);
  const std::string size = facts("stream=width,height");
  const bool isGif = GetParam() == FilmFormat::gif;
  EXPECT_NE(size.find(isGif ? "width=33" : "width=34"), std::string::npos) << size;
}

// Players of WebM learn the layout and the colours from it.
TEST_P(FilmFormats, marks) {
  if (GetParam() != FilmFormat::webm) GTEST_SKIP() << "a GIF has none";
  for (const auto& [layout, says] :
       {std::pair{FilmLayout::sideBySide, "side by side"}, {FilmLayout::overUnder, "top and bottom"}}) {
    FilmOptions given = options(64, 64);
    given.layout = layout;
    write(given, 2);
    const std::string found =
        facts("stream=color_space,color_transfer,color_primaries,color_range:stream_side_data");
    for (const char* fact : {says, "color_space=bt709", "color_transfer=iec61966-2-1",
                             "color_primaries=bt709", "color_range=tv"})
      EXPECT_NE(found.find(fact), std::string::npos) << fact << ": " << found;
  }
}

}  // namespace
}  // namespace scumble
