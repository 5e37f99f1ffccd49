#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMultiView.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "base/test_folder.h"
#include "scumble/image.h"

namespace scumble {
namespace {

Image pattern(uint32_t width, uint32_t height, std::vector<std::string> channels, float first = 0) {
  Image image{width, height, std::move(channels), {}};
  image.pixels.resize(size_t(width) * height * image.channels.size());
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = first + float(i) * 0.37f;
  return image;
}

std::vector<std::string> channelNames(const Imf::ChannelList& list) {
  std::vector<std::string> names;
  for (auto i = list.begin(); i != list.end(); ++i) {
    EXPECT_EQ(i.channel().type, Imf::FLOAT);
    names.push_back(i.name());
  }
  return names;
}
std::vector<std::string> channelNames(const std::string& path) {
  return channelNames(Imf::InputFile(path.c_str()).header().channels());
}

std::vector<float> channelOf(const std::string& path, const std::string& name) {
  Imf::InputFile file(path.c_str());
  const auto window = file.header().dataWindow();
  const size_t width = size_t(window.max.x + 1), height = size_t(window.max.y + 1);
  std::vector<float> values(width * height, -1);
  Imf::FrameBuffer frame;
  frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 4 * width));
  file.setFrameBuffer(frame);
  file.readPixels(0, int(height) - 1);
  return values;
}

TEST(Exr, layersAreNamedAndComeBackExactly) {
  TestFolder folder;
  const std::string path = folder.file("a.exr");
  const Image beauty = pattern(33, 21, {"R", "G", "B", "A"}), shadow = pattern(33, 21, {"R", "G", "B"}, 100);
  const Status status = writeExr(path, {{"", "", &beauty}, {"final-shadow", "", &shadow}});
  ASSERT_TRUE(status.ok()) << status.error().message();
  EXPECT_EQ(channelNames(path), (std::vector<std::string>{"A", "B", "G", "R", "final-shadow.B",
                                                          "final-shadow.G", "final-shadow.R"}));
  const std::vector<float> alpha = channelOf(path, "A"), green = channelOf(path, "final-shadow.G");
  for (uint32_t y = 0; y < 21; ++y)
    for (uint32_t x = 0; x < 33; ++x) {
      ASSERT_EQ(alpha[y * 33 + x], beauty.at(x, y, 3));
      ASSERT_EQ(green[y * 33 + x], shadow.at(x, y, 1));
    }
  const Imf::InputFile file(path.c_str());
  EXPECT_EQ(file.header().compression(), Imf::ZIP_COMPRESSION);
  EXPECT_FALSE(Imf::hasMultiView(file.header()));
  EXPECT_TRUE(file.isComplete());
  EXPECT_EQ(folder.count(), 1u);
}

// OpenEXR's convention: compositors would draw fringes around straight colours.
TEST(Exr, coloursAreMultipliedByTheirAlpha) {
  TestFolder folder;
  const std::string path = folder.file("a.exr");
  Image picture{3, 1, {"R", "G", "B", "A"}, {0.5f, 2, 0.25f, 1, 0.5f, 2, 0.25f, 0.5f, 0.5f, 2, 0.25f, 0}};
  Image gradients = picture, opaque{3, 1, {"R", "G", "B"}, std::vector<float>(9, 0.5f)};
  picture.isColor = opaque.isColor = true;
  ASSERT_TRUE(
      writeExr(
          path,
          {{"", "", &picture}, {"lit", "", &picture}, {"uv-gradient", "", &gradients}, {"rgb", "", &opaque}})
          .ok());
  const std::vector<float> multiplied{2, 1, 0}, straight{2, 2, 2}, half{0.5f, 0.5f, 0.5f};
  EXPECT_EQ(channelOf(path, "G"), multiplied);
  EXPECT_EQ(channelOf(path, "lit.G"), multiplied);
  EXPECT_EQ(channelOf(path, "A"), (std::vector<float>{1, 0.5f, 0}));
  EXPECT_EQ(channelOf(path, "uv-gradient.G"), straight);
  EXPECT_EQ(channelOf(path, "rgb.G"), half);
  EXPECT_EQ(picture.at(1, 0, 1), 2);  // the caller's own
}

TEST(Exr, whatIsNoColourSurvivesBitByBit) {
  TestFolder folder;
  const std::string path = folder.file("a.exr");
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<float> values = {
      0.0f,        -0.0f,    1.0f,      16777215.0f, 16777216.0f, -16777216.0f,
      12345677.0f, infinity, -infinity, 1e-42f,      3.4e38f,     std::numeric_limits<float>::quiet_NaN()};
  const Image ids{uint32_t(values.size()), 1, {"R"}, values};
  ASSERT_TRUE(writeExr(path, {{"id", "", &ids}}).ok());
  const std::vector<float> back = channelOf(path, "id.R");
  EXPECT_EQ(std::memcmp(back.data(), values.data(), values.size() * sizeof(float)), 0);
}

TEST(Exr, anySizeAndManyChannels) {
  TestFolder folder;
  const std::string path = folder.file("a.exr");
  std::vector<std::string> many;
  for (int i = 0; i < 64; ++i) many.push_back("c" + std::to_string(100 + i));
  const uint32_t sizes[][2] = {{1, 1}, {1, 50}, {50, 1}, {17, 16}, {16, 17}, {500, 300}};
  for (const auto& size : sizes) {
    const Image image = pattern(size[0], size[1], many);
    ASSERT_TRUE(writeExr(path, {{"", "", &image}}).ok());
    EXPECT_EQ(channelNames(path), many);
    EXPECT_EQ(channelOf(path, "c163").back(), image.pixels.back());
  }
}

// OpenEXR's own functions must find every channel in the right view.
TEST(Exr, stereoFollowsTheMultiViewConvention) {
  TestFolder folder;
  const std::string path = folder.file("a.exr");
  const Image left = pattern(5, 4, {"R", "G", "B"}), right = pattern(5, 4, {"R", "G", "B"}, 50);
  const Image map = pattern(5, 4, {"R"}, 90);
  ASSERT_TRUE(writeExr(path, {{"", "right", &right},
                              {"", "left", &left},
                              {"warp", "left", &left},
                              {"warp", "right", &right},
                              {"shadow-map", "", &map}})
                  .ok());
  const Imf::InputFile file(path.c_str());
  ASSERT_TRUE(Imf::hasMultiView(file.header()));
  const Imf::StringVector views = Imf::multiView(file.header());
  EXPECT_EQ(views, (Imf::StringVector{"left", "right"}));
  const Imf::ChannelList& all = file.header().channels();
  EXPECT_EQ(channelNames(Imf::channelsInView("left", all, views)),
            (std::vector<std::string>{"B", "G", "R", "warp.left.B", "warp.left.G", "warp.left.R"}));
  EXPECT_EQ(channelNames(Imf::channelsInView("right", all, views)),
            (std::vector<std::string>{"right.B", "right.G", "right.R", "warp.right.B", "warp.right.G",
                                      "warp.right.R"}));
  EXPECT_EQ(channelNames(Imf::channelsInNoView(all, views)), (std::vector<std::string>{"shadow-map.R"}));
  EXPECT_EQ(channelOf(path, "G")[0], left.pixels[1]);
  EXPECT_EQ(channelOf(path, "warp.right.G")[0], right.pixels[1]);
}

TEST(Exr, aFileOfOneViewSaysWhichAndKeepsPlainNames) {
  TestFolder folder;
  const std::string path = folder.file("a.right.exr");
  const Image right = pattern(5, 4, {"R"});
  ASSERT_TRUE(writeExr(path, {{"", "right", &right}, {"warp", "right", &right}}).ok());
  const Imf::InputFile file(path.c_str());
  EXPECT_EQ(Imf::multiView(file.header()), (Imf::StringVector{"right"}));
  EXPECT_EQ(file.header().view(), "right");
  EXPECT_EQ(channelNames(path), (std::vector<std::string>{"R", "warp.R"}));
}

TEST(Exr, halfLayersAreRoundedAndNeverOverflow) {
  TestFolder folder;
  const std::string path = folder.file("a.exr");
  const float infinity = std::numeric_limits<float>::infinity();
  const Image values{8, 1, {"R"}, {0.1f, -2.5f, 65504, 65519, 65536, 3e38f, -1e9f, infinity}};
  const Image whole = pattern(8, 1, {"Z"});
  ASSERT_TRUE(writeExr(path, {{"", "", &values, true}, {"depth", "", &whole}}).ok());
  const Imf::InputFile file(path.c_str());
  EXPECT_EQ(file.header().channels().findChannel("R")->type, Imf::HALF);
  EXPECT_EQ(file.header().channels().findChannel("depth.Z")->type, Imf::FLOAT);
  EXPECT_EQ(channelOf(path, "R"),
            (std::vector<float>{0.0999755859375f, -2.5f, 65504, 65504, 65504, 65504, -65504, infinity}));
  EXPECT_EQ(channelOf(path, "depth.Z"), whole.pixels);
}

TEST(Exr, halfChannelsLieWhereTheyBelong) {
  TestFolder folder;
  const std::string path = folder.file("a.exr");
  Image image{7, 5, {"R", "G", "B"}, {}};
  for (int i = 0; i < 7 * 5 * 3; ++i) image.pixels.push_back(float(i));
  ASSERT_TRUE(writeExr(path, {{"", "", &image, true}}).ok());
  const std::vector<float> green = channelOf(path, "G");
  for (uint32_t y = 0; y < 5; ++y)
    for (uint32_t x = 0; x < 7; ++x) ASSERT_EQ(green[y * 7 + x], image.at(x, y, 1));
}

TEST(Exr, pizIsLosslessToo) {
  TestFolder folder;
  const std::string path = folder.file("a.exr");
  const Image image = pattern(61, 47, {"R"});
  ExrOptions options;
  options.compression = ExrCompression::piz;
  ASSERT_TRUE(writeExr(path, {{"", "", &image}}, options).ok());
  EXPECT_EQ(Imf::InputFile(path.c_str()).header().compression(), Imf::PIZ_COMPRESSION);
  EXPECT_EQ(channelOf(path, "R"), image.pixels);
}

std::string textOf(const Imf::Header& header, const std::string& attribute) {
  const auto* text = header.findTypedAttribute<Imf::StringAttribute>(attribute);
  return text ? text->value() : "";
}

// Two ranks more than one layer holds; object 3 has the name of object 1.
Image ranks(uint32_t width, uint32_t height) {
  Image image{width, height, {"id0", "coverage0", "id1", "coverage1", "id2", "coverage2"}, {}};
  for (uint32_t i = 0; i < width * height; ++i)
    for (const float value : {float(i % 4), 0.5f, float((i + 1) % 4), 0.3f, float((i + 2) % 4), 0.2f})
      image.pixels.push_back(value);
  return image;
}
const std::vector<std::string> kObjects = {"bunny", "default", "bunny"};

TEST(Exr, cryptomatteLayersAndTheirDescription) {
  TestFolder folder;
  const std::string path = folder.file("a.exr");
  const Image beauty = pattern(4, 1, {"R", "G", "B", "A"}), objects = ranks(4, 1);
  ExrOptions options;
  options.cryptomattes = {{"CryptoObject", kObjects}};
  // A wish for half is not heard: the numbers would be lost.
  const Status status = writeExr(path, {{"", "", &beauty}, {"CryptoObject", "", &objects, true}}, options);
  ASSERT_TRUE(status.ok()) << status.error().message();
  EXPECT_EQ(channelNames(path),
            (std::vector<std::string>{"A", "B", "CryptoObject00.A", "CryptoObject00.B", "CryptoObject00.G",
                                      "CryptoObject00.R", "CryptoObject01.A", "CryptoObject01.B",
                                      "CryptoObject01.G", "CryptoObject01.R", "G", "R"}));
  const float bunny = std::bit_cast<float>(0x13851a76u), other = std::bit_cast<float>(0x42c9679fu);
  EXPECT_EQ(channelOf(path, "CryptoObject00.R"), (std::vector<float>{0, bunny, other, bunny}));
  EXPECT_EQ(channelOf(path, "CryptoObject00.G"), (std::vector<float>{0, 0.5f, 0.5f, 0.5f}));
  EXPECT_EQ(channelOf(path, "CryptoObject01.R"), (std::vector<float>{other, bunny, 0, bunny}));
  EXPECT_EQ(channelOf(path, "CryptoObject01.A"), (std::vector<float>{0, 0, 0, 0}));
  const Imf::InputFile file(path.c_str());
  EXPECT_EQ(textOf(file.header(), "cryptomatte/3ae39a5/name"), "CryptoObject");
  EXPECT_EQ(textOf(file.header(), "cryptomatte/3ae39a5/hash"), "MurmurHash3_32");
  EXPECT_EQ(textOf(file.header(), "cryptomatte/3ae39a5/conversion"), "uint32_to_float32");
  EXPECT_EQ(textOf(file.header(), "cryptomatte/3ae39a5/manifest"),
            R"({"bunny":"13851a76","default":"42c9679f"})");
}

TEST(Exr, cryptomattesHaveViews) {
  TestFolder folder;
  const std::string path = folder.file("a.exr");
  const Image beauty = pattern(4, 2, {"R"}), left = ranks(4, 2);
  Image right = left;
  right.pixels[0] = 1;
  ExrOptions options;
  options.cryptomattes = {{"CryptoObject", kObjects}};
  ASSERT_TRUE(writeExr(path,
                       {{"", "left", &beauty},
                        {"", "right", &beauty},
                        {"CryptoObject", "left", &left},
                        {"CryptoObject", "right", &right}},
                       options)
                  .ok());
  EXPECT_EQ(channelOf(path, "CryptoObject00.left.R")[0], 0);
  EXPECT_EQ(channelOf(path, "CryptoObject00.right.R")[0], std::bit_cast<float>(0x13851a76u));
  const Imf::InputFile file(path.c_str());
  EXPECT_EQ(Imf::channelsInView("right", file.header().channels(), {"left", "right"})
                .findChannel("CryptoObject01.left.A"),
            nullptr);
}

// Programs that others use read all of it.
TEST(Exr, otherProgramsReadIt) {
  TestFolder folder;
  const std::string path = folder.file("a.exr");
  const Image beauty = pattern(4, 2, {"R", "G", "B", "A"}), depth = pattern(4, 2, {"Z"}),
              objects = ranks(4, 2);
  ExrOptions given;
  given.compression = ExrCompression::piz;
  given.cryptomattes = {{"CryptoObject", kObjects}};
  ASSERT_TRUE(writeExr(path,
                       {{"", "left", &beauty, true},
                        {"", "right", &beauty, true},
                        {"depth", "left", &depth},
                        {"depth", "right", &depth},
                        {"CryptoObject", "left", &objects},
                        {"CryptoObject", "right", &objects}},
                       given)
                  .ok());
  const struct {
    const char *program, *command;
    std::vector<const char*> says;
  } readers[] = {
      {"exrheader",
       "exrheader",
       {"compression (type compression): piz", "multiView (type stringvector):",
        "CryptoObject00.left.A, 32-bit floating-point", "right.R, 16-bit floating-point",
        R"(cryptomatte/3ae39a5/manifest (type string): "{"bunny":"13851a76","default":"42c9679f"}")"}},
      {"oiiotool",
       "oiiotool --info -v --stats",
       {"4 x    2, 26 channel", "multiView: \"left\", \"right\"",
        "cryptomatte/3ae39a5/conversion: \"uint32_to_float32\"",
        "cryptomatte/3ae39a5/hash: \"MurmurHash3_32\"", "CryptoObject01.right.B (float)", "right.G (half)",
        "compression: \"piz\""}}};
  size_t missing = 0;
  for (const auto& reader : readers) {
    if (system(("command -v " + std::string(reader.program) + " >/dev/null").c_str()) != 0) {
      ++missing;
      continue;
    }
    const std::string said = folder.file("said");
    ASSERT_EQ(system((std::string(reader.command) + " '" + path + "' >'" + said + "' 2>&1").c_str()), 0)
        << contentOf(said);
    for (const char* expected : reader.says)
      EXPECT_NE(contentOf(said).find(expected), std::string::npos)
          << reader.program << " does not say: " << expected << "\nbut: " << contentOf(said);
  }
  if (missing > 0) GTEST_SKIP() << "exrheader or oiiotool is not installed";
}

TEST(Exr, cryptomattesThatMakeNoSenseAreRefused) {
  TestFolder folder;
  const std::string path = folder.file("a.exr");
  const Image good = ranks(4, 1), odd = pattern(4, 1, {"id"});
  const struct {
    std::vector<ImageLayer> layers;
    Cryptomatte cryptomatte;
    const char* says;
  } cases[] = {{{{"a", "", &good}}, {"b", kObjects}, "there is no layer 'b'"},
               {{{"", "", &good}}, {"", kObjects}, "has no name"},
               {{{"a", "", &odd}}, {"a", kObjects}, "no pairs"},
               {{{"a", "", &good}}, {"a", {"bunny"}}, "an object 2, but there are 1 names"}};
  for (const auto& c : cases) {
    ExrOptions options;
    options.cryptomattes = {c.cryptomatte};
    const Status status = writeExr(path, c.layers, options);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().kind, ErrorKind::usage);
    EXPECT_NE(status.error().problem.find(c.says), std::string::npos) << status.error().problem;
  }
  EXPECT_EQ(folder.count(), 0u);
}

TEST(Exr, layersThatDoNotFitTogetherAreRefused) {
  TestFolder folder;
  const std::string path = folder.file("a.exr");
  const Image a = pattern(5, 4, {"R"}), b = pattern(4, 5, {"R"}), unnamed = pattern(5, 4, {""}),
              twice = pattern(5, 4, {"R", "R"});
  const std::vector<std::vector<ImageLayer>> cases = {{},
                                                      {{"", "", nullptr}},
                                                      {{"", "", &a}, {"x", "", &b}},
                                                      {{"", "", &a}, {"", "", &a}},
                                                      {{"", "", &unnamed}},
                                                      {{"", "", &twice}},
                                                      {{"", "le.ft", &a}}};
  for (const auto& layers : cases) {
    const Status status = writeExr(path, layers);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().kind, ErrorKind::usage) << status.error().message();
  }
  EXPECT_EQ(folder.count(), 0u);
}

}  // namespace
}  // namespace scumble
