// Pictures of every format, and photographs that lie on their side.
#include <gtest/gtest.h>

#include "base/test_folder.h"
#include "scumble/image.h"

namespace scumble::film {
namespace {

Image gradient() {
  Image image;
  image.width = 5, image.height = 3;
  image.channels = {"R", "G", "B", "A"};
  for (uint32_t i = 0; i < 15; ++i)
    for (const float value : {float(i) / 14, 0.5f, 1.0f - float(i) / 14, 1.0f}) image.pixels.push_back(value);
  return image;
}

TEST(PictureRead, pngIsWhatReadPngReads) {
  const TestFolder folder;
  ASSERT_TRUE(writePng(folder.file("a.png"), gradient()));
  const Result<Image> read = readPicture(folder.file("a.png")), png = readPng(folder.file("a.png"));
  ASSERT_TRUE(read && png);
  EXPECT_EQ(read->pixels, png->pixels);
}

TEST(PictureRead, whatIsNoPictureIsRefused) {
  const TestFolder folder;
  putContent(folder.file("a.jpg"), "no picture");
  putContent(folder.file("empty.jpg"), "");
  putContent(folder.file("cut.jpg"), "\xFF\xD8\xFF\xE1\xFF\xFF");
  for (const char* name : {"a.jpg", "empty.jpg", "cut.jpg", "absent.jpg"}) {
    const Result<Image> read = readPicture(folder.file(name));
    ASSERT_FALSE(read) << name;
    EXPECT_EQ(read.error().kind, ErrorKind::unusableFile);
    EXPECT_FALSE(read.error().problem.empty());
  }
}

}  // namespace
}  // namespace scumble::film
