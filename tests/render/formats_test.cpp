// What a frame comes back as: floats, halves, and 8-bit codes that are made without floats between, but are
// those that floats would give.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/packing.hpp>

#include "base/test_folder.h"
#include "scumble/image.h"
#include "tests/support/aov.h"
#include "tests/support/render_test.h"

namespace scumble {
namespace {

using namespace test;

class Formats : public BothEyes {
 protected:
  static constexpr uint32_t kWidth = 60, kHeight = 40;
  const Scene scene = stillLife().load();
  Frame frameIn(const std::map<std::string, PixelFormat>& formats, bool transparent) const {
    RenderOptions options = sized(kWidth, kHeight, {"lit", "depth", "blur", "final-color"}, 4);
    options.transparent = transparent;
    options.formats = formats;
    return draw(scene, Look(), viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam()),
                options);
  }
};
INSTANTIATE_BOTH_EYES(Formats);

TEST_P(Formats, areWhatFloatsWouldGive) {
  for (const bool transparent : {false, true}) {
    const Frame floats = frameIn({}, transparent);
    const Frame halves = frameIn({{"", PixelFormat::half},
                                  {"lit", PixelFormat::half},
                                  {"depth", PixelFormat::half},
                                  {"blur", PixelFormat::half}},
                                 transparent);
    const Frame codes = frameIn({{"", PixelFormat::srgb8}, {"lit", PixelFormat::srgb8}}, transparent);
    size_t partial = 0;
    for (size_t layer = 0; layer < floats.layers.size(); ++layer)
      for (size_t v = 0; v < viewCount(); ++v) {
        const Image& expected = floats.layers[layer].views[v];
        const Image& half = halves.layers[layer].views[v];
        const Image& code = codes.layers[layer].views[v];
        const bool isHalf = layer < 4, isCode = layer < 2;
        ASSERT_EQ(half.format, isHalf ? PixelFormat::half : PixelFormat::float32) << layer;
        ASSERT_EQ(code.format, isCode ? PixelFormat::srgb8 : PixelFormat::float32) << layer;
        EXPECT_EQ(half.channels, expected.channels);
        EXPECT_EQ(code.isColor, expected.isColor);
        if (!isHalf) {
          EXPECT_EQ(half.pixels, expected.pixels);
        }
        if (!isCode) {
          EXPECT_EQ(code.pixels, expected.pixels);
        }
        for (size_t i = 0; i < expected.pixels.size(); ++i) {
          const float value = expected.pixels[i];
          if (isHalf) {
            ASSERT_EQ(half.halves[i], glm::packHalf1x16(value)) << layer << ", " << i;
          }
          if (!isCode) continue;
          const bool isAlpha = i % 4 == 3;
          partial += isAlpha && value > 0 && value < 1;
          ASSERT_EQ(code.codes[i], isAlpha ? std::lround(255.0 * value) : srgbCode(value))
              << layer << ", " << i;
        }
      }
    if (transparent) {
      EXPECT_GT(partial, 20u) << "nothing was partly covered";
    }
  }
}

TEST_P(Formats, filesOfCodesAreThoseOfFloats) {
  const TestFolder folder;
  for (const bool transparent : {false, true}) {
    const Frame floats = frameIn({}, transparent), codes = frameIn({{"", PixelFormat::srgb8}}, transparent);
    const auto arranged = [&](const Frame& frame) {
      const std::vector<Image>& views = frame.layers[0].views;
      return views.size() > 1 ? sideBySide(views[0], overUnder(views[0], views[1])) : views[0];
    };
    const Image a = arranged(floats), b = arranged(codes);
    for (const std::string extension : {".png", ".webp", ".jpg"}) {
      // Over black, codes of partly covered pixels would be rounded twice.
      if (transparent && extension == ".jpg") continue;
      const std::string first = folder.file("a" + extension), second = folder.file("b" + extension);
      const auto write = [&](const std::string& path, const Image& image) {
        return extension == ".png"   ? writePng(path, image)
               : extension == ".jpg" ? writeJpeg(path, image)
                                     : writeWebp(path, image, 100);
      };
      ASSERT_TRUE(write(first, a).ok() && write(second, b).ok());
      EXPECT_EQ(contentOf(first), contentOf(second)) << extension;
      EXPECT_GT(contentOf(first).size(), 500u);
    }
    const Status exr = writeExr(folder.file("x.exr"), {{"", "", &b}});
    EXPECT_EQ(exr.error().kind, ErrorKind::usage);
  }
}

TEST_P(Formats, thatMakeNoSenseAreRefused) {
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  RenderOptions options = sized(kWidth, kHeight, {"depth"});
  options.formats = {{"depth", PixelFormat::srgb8}};
  EXPECT_EQ(renderer().render(scene, Look(), 0, views, options).error().kind, ErrorKind::usage);
  options.formats = {{"normal", PixelFormat::half}};
  EXPECT_EQ(renderer().render(scene, Look(), 0, views, options).error().kind, ErrorKind::usage);
  options.formats = {{"depth", PixelFormat::half}};
  EXPECT_TRUE(renderer().render(scene, Look(), 0, views, options).ok());
  Frame frame = frameIn({{"", PixelFormat::half}}, false);
  const TestFolder folder;
  EXPECT_EQ(writePng(folder.file("x.png"), frame.layers[0].views[0]).error().kind, ErrorKind::usage);
}

}  // namespace
}  // namespace scumble
