#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <gtest/gtest.h>

#include <cstring>

#include "base/test_folder.h"
#include "scumble/image.h"

namespace scumble {
namespace {

Image picture(std::vector<std::string> channels, float first) {
  Image image{7, 5, std::move(channels), {}};
  image.isColor = true;
  image.pixels.resize(7 * 5 * image.channels.size());
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = first + float(i) * 0.25f;
  return image;
}

TEST(ExrRead, whatIsWrittenComesBack) {
  const TestFolder folder;
  const Image plain = picture({"R", "G", "B"}, -3);
  Image veiled = picture({"R", "G", "B", "A"}, 1);
  for (size_t i = 3; i < veiled.pixels.size(); i += 4) veiled.pixels[i] = 0.25f * float(i / 4 % 5);
  // Beside other layers, and with half floats, which hold these numbers exactly.
  ASSERT_TRUE(writeExr(folder.file("a.exr"), {{"lit", "", &veiled, true}, {"", "", &plain, true}}).ok());
  ASSERT_TRUE(writeExr(folder.file("b.exr"), {{"", "", &veiled}}).ok());
  const Result<Image> a = readExr(folder.file("a.exr")), b = readExr(folder.file("b.exr"));
  ASSERT_TRUE(a.ok()) << a.error().message();
  ASSERT_TRUE(b.ok()) << b.error().message();
  EXPECT_EQ(a->channels, plain.channels);
  EXPECT_EQ(a->pixels, plain.pixels);
  EXPECT_TRUE(a->isColor);
  ASSERT_EQ(b->channels, veiled.channels);
  for (size_t i = 0; i < b->pixels.size(); ++i) {
    const bool isThere = veiled.pixels[i / 4 * 4 + 3] > 0;
    EXPECT_NEAR(b->pixels[i], isThere ? veiled.pixels[i] : 0, 1e-5f) << i;
  }
}

TEST(ExrRead, eachEye) {
  const TestFolder folder;
  const Image left = picture({"R", "G", "B"}, 0), right = picture({"R", "G", "B"}, 50);
  const std::string both = folder.file("both.exr"), one = folder.file("one.exr"),
                    mono = folder.file("mono.exr");
  ASSERT_TRUE(writeExr(both, {{"", "left", &left}, {"", "right", &right}}).ok());
  ASSERT_TRUE(writeExr(one, {{"", "right", &right}}).ok());
  ASSERT_TRUE(writeExr(mono, {{"", "", &left}}).ok());
  EXPECT_EQ(readExr(both)->pixels, left.pixels);
  EXPECT_EQ(readExr(both, "left")->pixels, left.pixels);
  EXPECT_EQ(readExr(both, "right")->pixels, right.pixels);
  EXPECT_EQ(readExr(both, "right")->channels, right.channels);
  EXPECT_EQ(readExr(one)->pixels, right.pixels);
  EXPECT_EQ(readExr(one, "right")->pixels, right.pixels);
  EXPECT_EQ(readExr(mono, "right")->pixels, left.pixels);
  for (const auto& [path, view] : {std::pair{one, "left"}, {both, "third"}}) {
    const Result<Image> none = readExr(path, view);
    ASSERT_FALSE(none.ok());
    EXPECT_EQ(none.error().kind, ErrorKind::unusableFile);
    EXPECT_NE(none.error().message().find(view), std::string::npos) << none.error().message();
  }
}

// What a compositor has cut to what is there, and what is drawn beyond the picture's edge.
TEST(ExrRead, theDisplayWindowIsWhatIsSeen) {
  const TestFolder folder;
  const std::string path = folder.file("a.exr");
  Imf::Header header(Imath::Box2i({0, 0}, {5, 3}), Imath::Box2i({-1, 1}, {3, 2}));
  std::vector<float> numbers(5 * 2);
  for (size_t i = 0; i < numbers.size(); ++i) numbers[i] = float(i + 1);
  Imf::FrameBuffer buffer;
  for (const char* name : {"R", "G", "B"}) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, numbers.data(), header.dataWindow(), 4, 5 * 4));
  }
  {
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(buffer);
    file.writePixels(2);
  }
  const Result<Image> read = readExr(path);
  ASSERT_TRUE(read.ok()) << read.error().message();
  ASSERT_EQ(read->width, 6u);
  ASSERT_EQ(read->height, 4u);
  for (uint32_t y = 0; y < 4; ++y)
    for (uint32_t x = 0; x < 6; ++x) {
      const bool isThere = (y == 1 || y == 2) && x <= 3;
      EXPECT_EQ(read->at(x, y, 1), isThere ? float((y - 1) * 5 + x + 2) : 0.0f) << x << " " << y;
    }
}

TEST(ExrRead, whatIsNoPictureIsRefusedInOneLine) {
  const TestFolder folder;
  const Image depth = picture({"Z"}, 0);
  ASSERT_TRUE(writeExr(folder.file("depth.exr"), {{"", "", &depth}}).ok());
  folder.put("text.exr", "no picture at all");
  folder.put("empty.exr", "");
  for (const char* name : {"depth.exr", "text.exr", "empty.exr", "none.exr"}) {
    const Result<Image> image = readExr(folder.file(name));
    ASSERT_FALSE(image.ok()) << name;
    EXPECT_EQ(image.error().kind, ErrorKind::unusableFile);
    EXPECT_EQ(image.error().message().find('\n'), std::string::npos) << image.error().message();
  }
}

TEST(ExrRead, damagedFilesGiveAPictureOrAnError) {
  const TestFolder folder;
  const Image image = picture({"R", "G", "B", "A"}, 0);
  const std::string path = folder.file("a.exr");
  ASSERT_TRUE(writeExr(path, {{"", "", &image}}).ok());
  const std::string bytes = contentOf(path);
  size_t refused = 0;
  for (size_t at = 0; at < bytes.size(); at += 2)
    for (const char value : {'\0', '\xff'}) {
      std::string damaged = bytes;
      damaged[at] = value;
      putContent(path, damaged);
      const Result<Image> read = readExr(path);
      if (read)
        EXPECT_EQ(read->pixels.size(), size_t(read->width) * read->height * read->channels.size()) << at;
      else
        ++refused;
    }
  EXPECT_GT(refused, bytes.size() / 8);
}

// A file that was cut has its table of rows all the same.
TEST(ExrRead, aCutFileIsNotWhole) {
  const TestFolder folder;
  Image image{40, 70, {"R", "G", "B"}, {}};
  image.pixels.resize(size_t(40) * 70 * 3);
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = float(i * 2654435761u % 1000);
  for (const ExrCompression compression : {ExrCompression::zip, ExrCompression::piz}) {
    const std::string path = folder.file("a.exr");
    ASSERT_TRUE(writeExr(path, {{"", "", &image}}, {compression, {}}).ok());
    EXPECT_TRUE(isWholePicture(path, 40, 70));
    const std::string bytes = contentOf(path);
    for (const size_t kept : {size_t(30), size_t(400), bytes.size() / 2, bytes.size() - 1}) {
      putContent(path, bytes.substr(0, kept));
      EXPECT_FALSE(isWholePicture(path)) << kept << " of " << bytes.size();
    }
  }
}

}  // namespace
}  // namespace scumble
