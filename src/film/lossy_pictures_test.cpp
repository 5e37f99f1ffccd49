// JPEG and WebP files: colours, alpha, marks, and that they are whole.
#include <gtest/gtest.h>

#include <cmath>

#include "base/srgb.h"
#include "base/test_folder.h"
#include "scumble/image.h"

namespace scumble {
namespace {

// Soft gradients, with an edge across; alpha fades from left to right.
Image picture(uint32_t width, uint32_t height, bool alpha) {
  Image image{width, height, {"R", "G", "B"}, {}};
  if (alpha) image.channels.push_back("A");
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x) {
      const float u = float(x) / float(width), v = float(y) / float(height);
      for (const float c : {u, v, u > v ? 0.8f : 0.1f}) image.pixels.push_back(c);
      if (alpha) image.pixels.push_back(u);
    }
  return image;
}

double difference(const Image& read, const Image& image, bool overBlack) {
  EXPECT_EQ(read.width, image.width);
  EXPECT_EQ(read.height, image.height);
  double sum = 0;
  for (uint32_t y = 0; y < image.height; ++y)
    for (uint32_t x = 0; x < image.width; ++x)
      for (uint32_t c = 0; c < 3; ++c) {
        const float alpha = image.channels.size() == 4 && overBlack ? image.at(x, y, 3) : 1.0f;
        sum += std::abs(srgbFromLinear(read.at(x, y, c)) - srgbFromLinear(image.at(x, y, c) * alpha));
      }
  return sum / (3.0 * image.width * image.height);
}

Image mustReadPicture(const std::string& path) {
  const Result<Image> image = readPicture(path);
  EXPECT_TRUE(image.ok()) << image.error().message();
  return image.ok() ? image.value() : Image{};
}

TEST(LossyPictures, coloursComeBackAndQualityCounts) {
  const TestFolder folder;
  for (const uint32_t width : {64u, 61u}) {
    const Image image = picture(width, 33, false);
    for (const bool webp : {false, true}) {
      const std::string path = folder.file("a.picture");
      const auto write = [&](int quality) {
        const Status status = webp ? writeWebp(path, image, quality) : writeJpeg(path, image, quality);
        EXPECT_TRUE(status.ok()) << status.error().message();
        return contentOf(path).size();
      };
      const size_t small = write(30);
      const double coarse = difference(mustReadPicture(path), image, false);
      const size_t large = write(95);
      EXPECT_GT(large, small);
      EXPECT_LT(difference(mustReadPicture(path), image, false), 0.02);
      EXPECT_GT(coarse, difference(mustReadPicture(path), image, false));
      const std::string once = contentOf(path);
      write(95);
      EXPECT_EQ(contentOf(path), once);
    }
  }
}

TEST(LossyPictures, alphaIsOverBlackInAJpegAndKeptInAWebp) {
  const TestFolder folder;
  const Image image = picture(48, 32, true);
  ASSERT_TRUE(writeJpeg(folder.file("a.jpg"), image, 100).ok());
  EXPECT_LT(difference(mustReadPicture(folder.file("a.jpg")), image, true), 0.01);
  // 100 is lossless: the codes of a PNG, and what lies under alpha 0.
  ASSERT_TRUE(writeWebp(folder.file("a.webp"), image, 100).ok());
  ASSERT_TRUE(writePng(folder.file("a.png"), image).ok());
  EXPECT_EQ(mustReadPicture(folder.file("a.webp")).pixels, mustReadPicture(folder.file("a.png")).pixels);
  ASSERT_TRUE(writeWebp(folder.file("a.webp"), image, 60).ok());
  const Image lossy = mustReadPicture(folder.file("a.webp"));
  for (uint32_t x = 0; x < 48; x += 5) EXPECT_NEAR(lossy.at(x, 7, 3), image.at(x, 7, 3), 0.02f);
}

TEST(LossyPictures, aJpegSaysThatItIsSrgb) {
  const TestFolder folder;
  ASSERT_TRUE(writeJpeg(folder.file("a.jpg"), picture(8, 8, false)).ok());
  const std::string bytes = contentOf(folder.file("a.jpg"));
  const size_t exif = bytes.find(std::string("Exif\0\0MM\0*", 10));
  ASSERT_NE(exif, std::string::npos);
  EXPECT_NE(bytes.find(std::string("\xA0\x01\0\3\0\0\0\1\0\1", 10), exif), std::string::npos);
}

TEST(LossyPictures, wholeFilesAreKnownFromCutOnes) {
  const TestFolder folder;
  const Image image = picture(48, 32, false);
  const std::string jpeg = folder.file("a.jpg"), webp = folder.file("a.webp");
  ASSERT_TRUE(writeJpeg(jpeg, image).ok() && writeWebp(webp, image).ok());
  for (const std::string& path : {jpeg, webp}) {
    EXPECT_TRUE(isWholePicture(path));
    EXPECT_TRUE(isWholePicture(path, 48, 32));
    EXPECT_FALSE(isWholePicture(path, 48, 33));
    const std::string bytes = contentOf(path);
    for (const size_t kept : {size_t(0), size_t(3), size_t(30), bytes.size() / 2, bytes.size() - 1}) {
      putContent(path, bytes.substr(0, kept));
      EXPECT_FALSE(isWholePicture(path)) << path << " " << kept;
    }
  }
}

TEST(LossyPictures, whatCannotBeWritten) {
  const TestFolder folder;
  const Image image = picture(8, 8, false);
  for (const int quality : {-1, 101}) {
    EXPECT_EQ(writeJpeg(folder.file("a.jpg"), image, quality).error().kind, ErrorKind::usage);
    EXPECT_EQ(writeWebp(folder.file("a.webp"), image, quality).error().kind, ErrorKind::usage);
  }
  Image wide{16384, 1, {"R", "G", "B"}, std::vector<float>(3 * 16384)};
  EXPECT_EQ(writeWebp(folder.file("a.webp"), wide).error().kind, ErrorKind::outputNotWritten);
  EXPECT_TRUE(writeJpeg(folder.file("wide.jpg"), wide).ok());
  EXPECT_EQ(writeJpeg(folder.file("no/a.jpg"), image).error().kind, ErrorKind::outputNotWritten);
  EXPECT_EQ(writeWebp(folder.file("no/a.webp"), image).error().kind, ErrorKind::outputNotWritten);
  EXPECT_EQ(folder.count(), 1u);
}

}  // namespace
}  // namespace scumble
