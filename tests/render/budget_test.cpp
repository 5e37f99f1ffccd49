// What a frame's images take to be read and written, in bytes a pixel: a budget that a change must not exceed
// unnoticed. Image passes are bound by it on GPUs.
#include <map>

#include "tests/support/render_test.h"

namespace scumble {
namespace {

using namespace test;

class Budget : public BothEyes {
 protected:
  static constexpr uint32_t kWidth = 128, kHeight = 96;  // whole tiles
  struct Bytes {
    double read = 0, written = 0, fetches = 0;
    double all() const { return read + written; }
  };
  // By pass and, by the name "", of all: bytes a pixel of all views. The shadow map has a size of its own.
  static std::map<std::string, Bytes> bytesOf(const Look& look, uint32_t samples) {
    const Scene scene = stillLife().load();
    const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
    RenderOptions options = sized(kWidth, kHeight, {}, samples);
    const Frame frame = draw(scene, look, views, options);
    std::map<std::string, Bytes> bytes;
    const double pixels = double(kWidth) * kHeight * double(viewCount());
    uint64_t map = 0;
    for (const PassTime& pass : frame.stats.passes) {
      if (pass.name == "readback") continue;
      if (pass.name == "shadow-map") {
        map = pass.bytesWritten;
        continue;
      }
      const double read = double(pass.bytesRead - (pass.name == "surface" ? map : 0));
      for (const std::string& name : {pass.name, std::string()})
        bytes[name].read += read / pixels, bytes[name].written += double(pass.bytesWritten) / pixels,
            bytes[name].fetches += double(pass.fetches) / pixels;
    }
    return bytes;
  }
};
INSTANTIATE_BOTH_EYES(Budget);

TEST_P(Budget, ofAUsualFrame) {
  struct Most {
    const char* name;
    double read, written, fetches;
  };
  // Read: textures of the surface are not the frame's. Tiles are flags of 16 x 16 pixels. Fetches: of who
  // does all that there is to do. Pixels of several samples have no colours before they are torn.
  const std::vector<Most> budgets[] = {{{"surface", 0, 16, 0},
                                        {"tiles", 17, 0.6, 4},
                                        {"warp", 29, 36, 35},
                                        {"blur", 24, 4, 8},
                                        {"final-shadow", 17, 4, 7},
                                        {"color", 17, 8, 4},
                                        {"final-color", 33, 8, 58}},
                                       {{"surface", 0, 80, 0},
                                        {"tiles", 17, 0.6, 4},
                                        {"warp", 29, 36, 35},
                                        {"blur", 24, 4, 8},
                                        {"final-shadow", 49, 8, 15},
                                        {"final-color", 85, 8, 53}}};
  for (const uint32_t samples : {1u, 4u}) {
    auto bytes = bytesOf(quietLook(), samples);
    if (bytes.empty()) GTEST_SKIP() << "this device has no timestamps";
    double all = 0, fetches = 0;
    for (const Most& most : budgets[samples == 4]) {
      ASSERT_TRUE(bytes.contains(most.name)) << most.name;
      const Bytes& pass = bytes[most.name];
      EXPECT_LE(pass.read, most.read) << most.name;
      EXPECT_LE(pass.written, most.written) << most.name;
      EXPECT_LE(pass.fetches, most.fetches) << most.name;
      EXPECT_EQ(pass.fetches > 0, most.fetches > 0) << most.name;
      EXPECT_GT(pass.all(), 0) << most.name;
      all += pass.all(), fetches += pass.fetches;
    }
    // Nothing else costs anything.
    EXPECT_DOUBLE_EQ(bytes[""].all(), all);
    EXPECT_DOUBLE_EQ(bytes[""].fetches, fetches);
    EXPECT_LE(all, samples == 4 ? 356 : 209);
    EXPECT_LE(fetches, samples == 4 ? 113 : 114);
  }
}

// What is off is neither read nor written.
TEST_P(Budget, ofWhatIsOff) {
  const auto all = bytesOf(quietLook(), 1);
  if (all.empty()) GTEST_SKIP() << "this device has no timestamps";
  auto still = bytesOf(quietLook({{"warp.amount", "0"}, {"shadow.indication", "0"}}), 1);
  EXPECT_FALSE(still.contains("warp"));
  EXPECT_LE(still[""].all(), 125);
  auto sharp = bytesOf(quietLook({{"blur.radius", "0"}}), 1);
  EXPECT_FALSE(sharp.contains("blur"));
  EXPECT_LT(sharp[""].all(), all.at("").all());
}

}  // namespace
}  // namespace scumble
