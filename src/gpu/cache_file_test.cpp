#include "gpu/cache_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <numeric>

#include "base/test_folder.h"
#include "gpu/device.h"
#include "tests/support/test_device.h"

namespace scumble::gpu {
namespace {

namespace fs = std::filesystem;

class CacheFile : public testing::Test, protected TestFolder {
 protected:
  CacheFile() { std::iota(data_.begin(), data_.end(), 0); }

  std::vector<char> data_ = std::vector<char>(5000);
};

TEST_F(CacheFile, comesBackAsItWas) {
  const std::string cache = file("new/cache.bin");
  writeCache(cache, data_);
  EXPECT_EQ(readCache(cache), data_);
  data_.resize(300);
  writeCache(cache, data_);
  EXPECT_EQ(readCache(cache), data_);
  EXPECT_EQ(count("new"), 1u);
}

TEST_F(CacheFile, isNotGivenOnWhenItIsDamaged) {
  const std::string cache = file("cache.bin");
  writeCache(cache, data_);
  for (const int at : {0, 10, 20, 24, 4000}) {
    std::fstream(cache, std::ios::in | std::ios::out).seekp(at).put(char(0x5a));
    EXPECT_TRUE(readCache(cache).empty()) << at;
    writeCache(cache, data_);
    EXPECT_EQ(readCache(cache), data_);
  }
  for (const int size : {4999, 24, 3, 0}) {
    fs::resize_file(cache, uintmax_t(size));
    EXPECT_TRUE(readCache(cache).empty()) << size;
  }
  fs::resize_file(cache, uintmax_t(1) << 40);  // of holes
  EXPECT_TRUE(readCache(cache).empty());
}

TEST_F(CacheFile, aPipelineCacheOfNothingIsNotKept) {
  DeviceOptions options;
  options.choice = test::testDevice();
  options.cacheFolder = path();
  const Result<std::unique_ptr<Device>> device = Device::create(options);
  ASSERT_TRUE(device.ok()) << device.error().message();
  (*device)->savePipelineCache();  // nothing was compiled
  EXPECT_EQ(count(), 0u);
}

TEST_F(CacheFile, aLimitOnSizesLeavesNothing) {
  struct rlimit before = {};
  getrlimit(RLIMIT_FSIZE, &before);
  struct rlimit small = before;
  small.rlim_cur = 1000;
  setrlimit(RLIMIT_FSIZE, &small);
  writeCache(file("cache.bin"), data_);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(count(), 0u);
}

TEST_F(CacheFile, whateverStandsInItsPlaceADeviceIsThereAndItStays) {
  Result<std::unique_ptr<Device>> plain = Device::create({test::testDevice()});
  ASSERT_TRUE(plain.ok()) << plain.error().message();
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties((*plain)->physical(), &properties);
  const fs::path cache = cacheFile(path(), "pipelines", properties);
  const std::pair<const char*, std::function<void()>> kinds[] = {
      {"a folder", [&] { fs::create_directory(cache); }},
      {"a pipe", [&] { ASSERT_EQ(mkfifo(cache.c_str(), 0600), 0); }},
      {"an endless device", [&] { fs::create_symlink("/dev/zero", cache); }},
      {"a circle of links", [&] { fs::create_symlink(cache, cache); }},
      {"another file", [&] { std::ofstream(cache) << std::string(10000, 'x'); }}};
  for (const auto& [name, put] : kinds) {
    put();
    const fs::file_type type = fs::symlink_status(cache).type();
    DeviceOptions options;
    options.choice = test::testDevice();
    options.cacheFolder = path();
    const Result<std::unique_ptr<Device>> device = Device::create(options);
    ASSERT_TRUE(device.ok()) << name << ": " << device.error().message();
    writeCache(cache, data_);
    EXPECT_EQ(fs::symlink_status(cache).type(), type) << name;
    EXPECT_EQ(count(), 1u) << name;
    fs::remove(cache);
  }
  // Nor does it matter what stands in the folder's place.
  DeviceOptions options;
  options.choice = test::testDevice();
  options.cacheFolder = file("file");
  std::ofstream(file("file")) << "mine";
  ASSERT_TRUE(Device::create(options).ok());
  writeCache(cacheFile(options.cacheFolder, "pipelines", properties), data_);
  EXPECT_TRUE(fs::is_regular_file(file("file")));
}

}  // namespace
}  // namespace scumble::gpu
