#include "visible.h"

#include <gtest/gtest.h>

#include <limits>

namespace scumble::viewer {
namespace {

Image imageOf(std::vector<std::string> channels, std::vector<float> pixels) {
  const auto width = uint32_t(pixels.size() / channels.size());
  return {width, 1, std::move(channels), std::move(pixels)};
}

using Bytes = std::vector<uint8_t>;

TEST(Visible, coloursAreThemselvesOverBlack) {
  Image image = imageOf({"R", "G", "B", "A"}, {1, 0.2158605f, 0, 1, 1, 1, 1, 0, -1, 7, 0, 1});
  image.isColor = true;
  EXPECT_EQ(visibleBytes(image, "color"), (Bytes{255, 128, 0, 255, 0, 0, 0, 255, 0, 255, 0, 255}));
}

TEST(Visible, numbersAreStretchedOverWhatIsFinite) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  EXPECT_EQ(visibleBytes(imageOf({"R"}, {2, 4, 3}), "blur"),
            (Bytes{0, 0, 0, 255, 255, 255, 255, 255, 128, 128, 128, 255}));
  const Bytes depth = visibleBytes(imageOf({"R"}, {2, 4, kFar}), "depth");
  EXPECT_GT(depth[0], depth[4]) << "what is near is lighter";
  EXPECT_GT(depth[4], depth[8]) << "and nothing is black";
  EXPECT_EQ(visibleBytes(imageOf({"R"}, {0, 0}), "blur"), (Bytes{0, 0, 0, 255, 0, 0, 0, 255}));
  EXPECT_EQ(visibleBytes(imageOf({"R", "G"}, {0, 5, 1, 7}), "uv"), (Bytes{0, 0, 0, 255, 255, 255, 0, 255}));
  const float none = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(visibleBytes(imageOf({"R"}, {none, none}), "blur").size(), 8u);
}

TEST(Visible, factsHaveColoursOfTheirOwn) {
  EXPECT_EQ(visibleBytes(imageOf({"R", "G", "B"}, {0, 0, 1, 0, 0, 0}), "normal"),
            (Bytes{128, 128, 255, 255, 0, 0, 0, 255}));
  const Bytes id = visibleBytes(imageOf({"R", "G"}, {1, 1, 2, 1, 1, 2, 0, 0}), "id");
  EXPECT_NE(Bytes(id.begin(), id.begin() + 4), Bytes(id.begin() + 4, id.begin() + 8));
  EXPECT_EQ(Bytes(id.begin(), id.begin() + 4), Bytes(id.begin() + 8, id.begin() + 12));
  EXPECT_EQ(Bytes(id.begin() + 12, id.end()), (Bytes{0, 0, 0, 255}));
  const Bytes motion = visibleBytes(imageOf({"R", "G"}, {4, 0, 2, 0, 0, 0, -4, 0}), "motion");
  EXPECT_NEAR(motion[0], 2 * motion[4], 1) << "half as far, half as light";
  EXPECT_EQ(motion[8], 0);
  EXPECT_NE(Bytes(motion.begin(), motion.begin() + 4), Bytes(motion.begin() + 12, motion.end()));
}

TEST(Visible, aPixelInWords) {
  EXPECT_EQ(pixelText(imageOf({"R", "G"}, {0, 1, 0.12345f, 1e9f}), 1, 0), "R 0.123  G 1e+09");
}

}  // namespace
}  // namespace scumble::viewer
