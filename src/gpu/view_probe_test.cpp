#include "gpu/view_probe.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/test_folder.h"
#include "gpu/cache_file.h"
#include "gpu/resources.h"
#include "tests/support/test_device.h"

namespace scumble::gpu {
namespace {

// What a device must give, written from view_probe.vert and view_probe.frag.
ProbePicture rightPicture() {
  constexpr uint32_t kSide = ProbePicture::kSize;
  ProbePicture picture;
  for (int layer = 0; layer < 2; ++layer)
    for (uint32_t y = 0; y < kSide; ++y)
      for (uint32_t x = 0; x < kSide; ++x) {
        const bool drawn = x + 0.5 + y + 0.5 < 160;
        ProbePicture::Layer& l = picture.layers[size_t(layer)];
        l.byVertexShader.push_back(!drawn ? 102 : layer == 0 ? 51 : 204);
        l.byFragmentShader.push_back(!drawn ? 102 : layer == 0 ? 204 : 51);
        l.depth.push_back(!drawn ? 0.0625f : layer == 0 ? 0.25f : 0.75f);
      }
  return picture;
}

TEST(ViewProbe, seesEveryWayInWhichLayersGoWrong) {
  const ProbePicture right = rightPicture();
  EXPECT_TRUE(isRight(right));
  const std::pair<const char*, void (*)(ProbePicture&)> faults[] = {
      {"layers exchanged", [](ProbePicture& p) { std::swap(p.layers[0], p.layers[1]); }},
      {"the same view twice", [](ProbePicture& p) { p.layers[1] = p.layers[0]; }},
      {"a layer that was never resolved",
       [](ProbePicture& p) {
         for (uint8_t& value : p.layers[1].byVertexShader) value = 0;
       }},
      {"depth that was never resolved",
       [](ProbePicture& p) {
         for (float& depth : p.layers[1].depth) depth = 0;
       }},
      {"only vertex shaders know the view",
       [](ProbePicture& p) { p.layers[1].byFragmentShader = p.layers[0].byFragmentShader; }},
      {"a layer that was not cleared",
       [](ProbePicture& p) {
         for (uint8_t& value : p.layers[1].byVertexShader)
           if (value == 102) value = 0;
       }},
      {"a tile that went elsewhere", [](ProbePicture& p) {
         for (size_t y = 0; y < 64; ++y)
           for (size_t x = 0; x < 64; ++x) p.layers[1].byVertexShader[y * ProbePicture::kSize + x] = 102;
       }}};
  for (const auto& [name, fault] : faults) {
    ProbePicture wrong = right;
    fault(wrong);
    EXPECT_FALSE(isRight(wrong)) << name;
  }
}

TEST(ViewProbe, whatADeviceIsSaidToDrawRightItDrawsRight) {
  DeviceOptions options;
  options.validation = true;
  options.choice = test::testDevice();
  const Result<std::unique_ptr<Device>> device = Device::create(options);
  ASSERT_TRUE(device.ok()) << device.error().message();
  for (const uint32_t samples : {1u, 4u}) {
    if (samples == 4 && !(*device)->supports4Samples()) continue;
    const std::optional<ViewDrawing> way = (*device)->viewDrawing(samples);
    ASSERT_TRUE(way) << samples;
    const ProbePicture drawn = drawProbe(**device, *way, samples), right = rightPicture();
    for (size_t layer = 0; layer < 2; ++layer) {
      size_t differing = 0;
      for (size_t i = 0; i < right.layers[layer].depth.size(); ++i)
        differing += drawn.layers[layer].byVertexShader[i] != right.layers[layer].byVertexShader[i];
      EXPECT_LE(differing, 2 * ProbePicture::kSize) << "layer " << layer << ": more than the edge";
    }
  }
  EXPECT_EQ((*device)->validationMessages(), 0);
}

// What lies in memory from an earlier probe is no answer: asked again, after pictures that are right, a
// device says the same of each way.
TEST(ViewProbe, answersDoNotComeFromMemory) {
  DeviceOptions options;
  options.validation = true;
  options.choice = test::testDevice();
  const Result<std::unique_ptr<Device>> device = Device::create(options);
  ASSERT_TRUE(device.ok()) << device.error().message();
  // Something that keeps the block of memory from going back to the system, which would give it back empty.
  const Image other(**device, {.format = VK_FORMAT_R8G8B8A8_UNORM, .width = 8, .height = 8},
                    VK_IMAGE_USAGE_SAMPLED_BIT);
  constexpr ViewDrawing kAll[] = {ViewDrawing::together, ViewDrawing::separately,
                                  ViewDrawing::resolvedTogether};
  for (const uint32_t samples : {1u, 4u}) {
    if (samples == 4 && !(*device)->supports4Samples()) continue;
    for (const ViewDrawing way : kAll) {
      const bool first = isRight(drawProbe(**device, way, samples));
      for (const ViewDrawing before : kAll) {
        (void)drawProbe(**device, before, samples);
        EXPECT_EQ(isRight(drawProbe(**device, way, samples)), first)
            << samples << " samples, way " << int(way) << " after " << int(before);
      }
    }
  }
  EXPECT_EQ((*device)->validationMessages(), 0);
}

TEST(ViewProbe, answersAreKeptForOneDriver) {
  const TestFolder folder;
  const std::string file = folder.file("views.bin");
  EXPECT_FALSE(readViewDrawings(file, "driver 1"));
  for (const ViewDrawings& drawings :
       {ViewDrawings{ViewDrawing::together, ViewDrawing::separately},
        ViewDrawings{ViewDrawing::separately, ViewDrawing::resolvedTogether},
        ViewDrawings{ViewDrawing::together, std::nullopt}, ViewDrawings{std::nullopt, std::nullopt}}) {
    writeViewDrawings(file, "driver 1", drawings);
    EXPECT_EQ(readViewDrawings(file, "driver 1"), drawings);
    EXPECT_FALSE(readViewDrawings(file, "driver 2"));
  }
  writeCache(file, std::vector<char>(3, 'x'));
  EXPECT_FALSE(readViewDrawings(file, "driver 1"));
}

// The device asks its file, not the driver: what stands there is what it says.
TEST(ViewProbe, aDeviceProbesOnce) {
  const TestFolder folder;
  DeviceOptions options;
  options.cacheFolder = folder.path();
  options.choice = test::testDevice();
  Result<std::unique_ptr<Device>> first = Device::create(options);
  ASSERT_TRUE(first.ok()) << first.error().message();
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties((*first)->physical(), &properties);
  const std::string file = cacheFile(folder.path(), "views", properties);
  const std::string driver = (*first)->info().name + ", " + (*first)->info().driver;
  EXPECT_FALSE(readViewDrawings(file, driver)) << "nobody has asked yet";
  const ViewDrawings found{(*first)->viewDrawing(1), (*first)->viewDrawing(4)};
  EXPECT_EQ(readViewDrawings(file, driver), found);

  const ViewDrawings other{std::nullopt, ViewDrawing::separately};
  writeViewDrawings(file, driver, other);
  EXPECT_EQ((*first)->viewDrawing(1), found.of1Sample);
  Result<std::unique_ptr<Device>> second = Device::create(options);
  ASSERT_TRUE(second.ok());
  EXPECT_EQ((*second)->viewDrawing(1), other.of1Sample);
  EXPECT_EQ((*second)->viewDrawing(4), other.of4Samples);
}

}  // namespace
}  // namespace scumble::gpu
