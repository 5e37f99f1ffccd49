#include <gtest/gtest.h>
#include <png.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "base/srgb.h"
#include "base/test_folder.h"
#include "scumble/image.h"

namespace scumble {
namespace {

using scumble::linearFromSrgb8;

// Every sRGB code in turn, so that what comes back must be exactly what went in.
Image codes(uint32_t width, uint32_t height, std::vector<std::string> channels, bool opaque) {
  Image image{width, height, std::move(channels), {}};
  const size_t count = image.channels.size();
  image.pixels.resize(size_t(width) * height * count);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const uint32_t code = uint32_t(i * 2654435761u >> 16) & 255;
    const bool alpha = count == 4 && i % 4 == 3;
    image.pixels[i] = alpha ? (opaque ? 1.0f : float(code) / 255) : linearFromSrgb8()[code];
  }
  return image;
}

int colorTypeOf(const std::string& path) {
  return contentOf(path)[25];
}

TEST(Png, comesBackExactlyInAllSizes) {
  TestFolder folder;
  const uint32_t sizes[][2] = {{1, 1}, {1, 700}, {3, 2}, {1000, 1}, {257, 401}, {1280, 720}};
  for (const auto& size : sizes)
    for (const bool opaque : {true, false}) {
      const Image image = codes(size[0], size[1], {"R", "G", "B", "A"}, opaque);
      const std::string path = folder.file("a.png");
      const Status status = writePng(path, image);
      ASSERT_TRUE(status.ok()) << status.error().message();
      const Result<Image> back = readPng(path);
      ASSERT_TRUE(back.ok()) << back.error().message();
      EXPECT_EQ(back->width, image.width);
      EXPECT_EQ(back->height, image.height);
      EXPECT_EQ(back->channels, image.channels);
      EXPECT_EQ(back->pixels, image.pixels);
      EXPECT_EQ(folder.count(), 1u);
    }
}

TEST(Png, alphaIsKeptOnlyWhereItSaysSomething) {
  TestFolder folder;
  const std::string path = folder.file("a.png");
  ASSERT_TRUE(writePng(path, codes(8, 8, {"R", "G", "B", "A"}, true)).ok());
  EXPECT_EQ(colorTypeOf(path), PNG_COLOR_TYPE_RGB);
  ASSERT_TRUE(writePng(path, codes(8, 8, {"R", "G", "B", "A"}, false)).ok());
  EXPECT_EQ(colorTypeOf(path), PNG_COLOR_TYPE_RGB_ALPHA);
}

TEST(Png, anyNumberOfChannelsGivesAPicture) {
  TestFolder folder;
  const std::string path = folder.file("a.png");
  const float half = linearFromSrgb8()[128], quarter = linearFromSrgb8()[64];
  const struct {
    std::vector<float> in, out;
  } cases[] = {{{half}, {half, half, half, 1}},
               {{half, quarter}, {half, quarter, 0, 1}},
               {{half, quarter, 1}, {half, quarter, 1, 1}},
               {{half, quarter, 1, 0}, {half, quarter, 1, 0}},
               {{half, quarter, 1, 0, 0}, {half, quarter, 1, 1}}};
  // Twice, so that after a pixel's channels come the other's.
  const auto twice = [](const std::vector<float>& pixel) {
    std::vector<float> both = pixel;
    both.insert(both.end(), pixel.begin(), pixel.end());
    return both;
  };
  for (const auto& c : cases) {
    ASSERT_TRUE(writePng(path, {2, 1, std::vector<std::string>(c.in.size(), "x"), twice(c.in)}).ok());
    const Result<Image> back = readPng(path);
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(back->pixels, twice(c.out)) << c.in.size();
  }
}

TEST(Png, valuesThatAreNoColoursAreClamped) {
  TestFolder folder;
  const std::string path = folder.file("a.png");
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  ASSERT_TRUE(
      writePng(path, {2, 1, {"R", "G", "B", "A"}, {nan, -1, infinity, nan, 0, 2, -infinity, 5}}).ok());
  EXPECT_EQ(readPng(path)->pixels, (std::vector<float>{0, 0, 1, 0, 0, 1, 0, 1}));
}

// To the nearest code, not the one below.
TEST(Png, alphaIsRounded) {
  TestFolder folder;
  const std::string path = folder.file("a.png");
  Image image{2 * 255, 1, {"R", "G", "B", "A"}, {}};
  for (int code = 0; code < 255; ++code)
    for (const double beyond : {0.4, 0.6})
      image.pixels.insert(image.pixels.end(), {1, 1, 1, float((code + beyond) / 255)});
  ASSERT_TRUE(writePng(path, image).ok());
  const Result<Image> back = readPng(path);
  ASSERT_TRUE(back.ok()) << back.error().message();
  for (uint32_t x = 0; x < image.width; ++x) {
    const uint32_t code = x / 2 + x % 2;
    EXPECT_NEAR(back->at(x, 0, 3) * 255, double(code), 1e-4) << x;
  }
}

TEST(Png, sameBytesEveryTime) {
  TestFolder folder;
  const Image image = codes(640, 480, {"R", "G", "B"}, true);
  ASSERT_TRUE(writePng(folder.file("a.png"), image).ok());
  ASSERT_TRUE(writePng(folder.file("b.png"), image).ok());
  EXPECT_EQ(contentOf(folder.file("a.png")), contentOf(folder.file("b.png")));
}

// -- Reading what others have written

// Writes with libpng itself.
void writeWithLibpng(const std::string& path, uint32_t width, uint32_t height, int depth, int colorType,
                     int interlace, const std::vector<uint8_t>& rows) {
  FILE* file = fopen(path.c_str(), "wb");
  ASSERT_TRUE(file);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, width, height, depth, colorType, interlace, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  if (colorType == PNG_COLOR_TYPE_PALETTE) {
    const png_color palette[2] = {{255, 0, 0}, {0, 0, 255}};
    const png_byte alpha[1] = {0};
    png_set_PLTE(png, info, palette, 2);
    png_set_tRNS(png, info, alpha, 1, nullptr);
  }
  png_write_info(png, info);
  std::vector<png_bytep> pointers;
  for (uint32_t y = 0; y < height; ++y)
    pointers.push_back(const_cast<uint8_t*>(rows.data()) + y * png_get_rowbytes(png, info));
  png_write_image(png, pointers.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  fclose(file);
}

TEST(Png, readsPalettesGreySixteenBitsAndInterlaced) {
  TestFolder folder;
  const std::string path = folder.file("a.png");
  writeWithLibpng(path, 2, 1, 1, PNG_COLOR_TYPE_PALETTE, PNG_INTERLACE_NONE, {0x40});
  EXPECT_EQ(readPng(path)->pixels, (std::vector<float>{1, 0, 0, 0, 0, 0, 1, 1}));

  writeWithLibpng(path, 2, 1, 4, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, {0x0f});
  EXPECT_EQ(readPng(path)->pixels, (std::vector<float>{0, 0, 0, 1, 1, 1, 1, 1}));

  writeWithLibpng(path, 1, 1, 16, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_INTERLACE_NONE, {0x12, 0x34, 0x80, 0x01});
  const Result<Image> wide = readPng(path);
  ASSERT_TRUE(wide.ok());
  EXPECT_FLOAT_EQ(wide->pixels[1], float(linearFromSrgb(0x1234 / 65535.0)));
  EXPECT_FLOAT_EQ(wide->pixels[3], 0x8001 / 65535.0f);

  std::vector<uint8_t> rows;
  for (int i = 0; i < 9 * 9 * 3; ++i) rows.push_back(uint8_t(i));
  writeWithLibpng(path, 9, 9, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_ADAM7, rows);
  const Result<Image> interlaced = readPng(path);
  ASSERT_TRUE(interlaced.ok());
  EXPECT_EQ(interlaced->at(8, 8, 2), linearFromSrgb8()[uint8_t(9 * 9 * 3 - 1)]);
}

TEST(Png, brokenFilesAreErrorsOfOneLine) {
  TestFolder folder;
  const std::string good = folder.file("good.png"), bad = folder.file("bad.png");
  ASSERT_TRUE(writePng(good, codes(40, 30, {"R", "G", "B"}, true)).ok());
  const std::string bytes = contentOf(good);
  const auto expectBad = [&](const std::string& path) {
    const Result<Image> result = readPng(path);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().kind, ErrorKind::unusableFile);
    EXPECT_EQ(result.error().file, path);
    EXPECT_FALSE(result.error().problem.empty());
  };
  for (const size_t length :
       {size_t(0), size_t(1), size_t(8), size_t(20), size_t(40), bytes.size() / 2, bytes.size() - 13}) {
    putContent(bad, bytes.substr(0, length));
    expectBad(bad);
  }
  for (size_t i = 0; i < bytes.size(); i += 7) {  // no crash; some changes happen to be harmless
    std::string changed = bytes;
    changed[i] = char(changed[i] ^ 0x55);
    putContent(bad, changed);
    (void)readPng(bad);
  }
  expectBad(folder.file("absent.png"));
  expectBad(folder.file(""));
  expectBad("/dev/zero");
}

// A header that promises far more than the file can hold must not cost memory.
TEST(Png, absurdSizesAreRefusedBeforeMemoryIsTaken) {
  TestFolder folder;
  const std::string path = folder.file("a.png");
  ASSERT_TRUE(writePng(path, codes(4, 4, {"R", "G", "B"}, true)).ok());
  const std::string good = contentOf(path);
  for (const uint32_t side : {0x7fffffffu, 100000u, 11000u}) {
    std::string bytes = good;
    for (int i = 0; i < 4; ++i) bytes[16 + i] = bytes[20 + i] = char(side >> (24 - 8 * i));
    // libpng checks the header's checksum first.
    const uLong crc = crc32(0, reinterpret_cast<const Bytef*>(bytes.data()) + 12, 17);
    for (int i = 0; i < 4; ++i) bytes[29 + i] = char(crc >> (24 - 8 * i));
    putContent(path, bytes);
    EXPECT_FALSE(readPng(path).ok()) << side;
  }
}

}  // namespace
}  // namespace scumble
