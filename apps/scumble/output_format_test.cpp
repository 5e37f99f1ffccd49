#include "output_format.h"

#include <gtest/gtest.h>

#include "json_option.h"
#include "panorama_kind.h"

namespace scumble::app {
namespace {

TEST(OutputFormats, areFoundByTheirEndings) {
  struct {
    const char* path;
    OutputKind kind;
    FilmFormat film;
  } const known[] = {{"a.png", OutputKind::picture, {}},
                     {"a.b/c.JPG", OutputKind::picture, {}},
                     {"x.jpeg", OutputKind::picture, {}},
                     {"x.WebP", OutputKind::picture, {}},
                     {"x.exr", OutputKind::exr, {}},
                     {"x.svg", OutputKind::drawing, {}},
                     {"x.mp4", OutputKind::film, FilmFormat::mp4},
                     {"x.webm", OutputKind::film, FilmFormat::webm},
                     {"x.png.gif", OutputKind::film, FilmFormat::gif}};
  for (const auto& [path, kind, film] : known) {
    const auto format = formatOf(path);
    ASSERT_TRUE(format) << path;
    EXPECT_EQ((*format)->kind, kind) << path;
    EXPECT_EQ((*format)->write != nullptr, kind == OutputKind::picture) << path;
    if (kind == OutputKind::film) {
      EXPECT_EQ((*format)->film, film) << path;
    }
  }
  for (const char* path : {"", "png", "a.png/b", "x.tiff", ".png", "x.png~", "x.pn"}) {
    const auto format = formatOf(path);
    ASSERT_FALSE(format) << path;
    EXPECT_EQ(format.error().kind, ErrorKind::usage);
  }
}

TEST(OutputFormats, qualitiesHaveBounds) {
  struct {
    const char* path;
    int least, most;
  } const bounds[] = {
      {"x.jpg", 1, 100}, {"x.jpeg", 1, 100}, {"x.webp", 0, 100}, {"x.mp4", 0, 51}, {"x.webm", 0, 63}};
  for (const auto& [path, least, most] : bounds) {
    const OutputFormat& format = **formatOf(path);
    for (const int quality : {least, (least + most) / 2, most})
      EXPECT_TRUE(format.checkQuality(quality)) << path << " " << quality;
    for (const int quality : {least - 1, most + 1})
      EXPECT_FALSE(format.checkQuality(quality)) << path << " " << quality;
    EXPECT_TRUE(format.checkQuality(std::nullopt));
  }
  for (const char* path : {"x.png", "x.gif", "x.exr", "x.svg"}) {
    EXPECT_TRUE((*formatOf(path))->checkQuality(std::nullopt)) << path;
    for (const int quality : {-1, 0, 1, 50}) EXPECT_FALSE((*formatOf(path))->checkQuality(quality)) << path;
  }
}

// A word that follows --json is its file, but for options and the next input.
TEST(JsonOption, knowsItsFileFromWhatFollows) {
  for (const char* word : {"report.json", "report", "a/b.txt", "x.JSON"})
    EXPECT_TRUE(JsonOption::isFile(word)) << word;
  for (const char* word : {"--quiet", "-o", "a.glb", "b.GLTF", "c.png", "d.jpg", "e.jpeg", "f.webp", "g.exr"})
    EXPECT_FALSE(JsonOption::isFile(word)) << word;
  EXPECT_EQ(textOf({{"a", 1}}), "{\n  \"a\": 1\n}\n");
  EXPECT_EQ(textOf("\xFF"
                   "x"),
            "\"\xEF\xBF\xBDx\"\n")
      << "what is not UTF-8 shows what could be read";
}

TEST(PanoramaKinds, areFoundByName) {
  EXPECT_EQ(panoramaKindOf("").value(), nullptr);
  EXPECT_EQ(panoramaKindOf("vr180").value()->projection, FilmProjection::halfSphere);
  EXPECT_EQ(panoramaKindOf("ods").value()->kind, PanoramaKind::ods);
  EXPECT_STREQ(panoramaKindOf("mono360").value()->stereo, "");
  EXPECT_FALSE(panoramaKindOf("VR180"));
}

}  // namespace
}  // namespace scumble::app
