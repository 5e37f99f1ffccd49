#include "gpu/pipeline_cache_file.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numeric>

#include "gpu/device.h"

namespace scumble::gpu {
namespace {

namespace fs = std::filesystem;

class PipelineCacheFile : public testing::Test {
 protected:
  PipelineCacheFile() {
    std::string name = (fs::temp_directory_path() / "scumble-cache-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    std::iota(data_.begin(), data_.end(), 0);
  }
  ~PipelineCacheFile() override { fs::remove_all(folder_); }

  size_t count(const fs::path& folder) const {
    return size_t(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }

  fs::path folder_;
  std::vector<char> data_ = std::vector<char>(5000);
};

TEST_F(PipelineCacheFile, comesBackAsItWas) {
  const fs::path file = folder_ / "new" / "cache.bin";
  writePipelineCache(file, data_);
  EXPECT_EQ(readPipelineCache(file), data_);
  data_.resize(300);
  writePipelineCache(file, data_);
  EXPECT_EQ(readPipelineCache(file), data_);
  EXPECT_EQ(count(file.parent_path()), 1u);
}

TEST_F(PipelineCacheFile, isNotGivenOnWhenItIsDamaged) {
  const fs::path file = folder_ / "cache.bin";
  writePipelineCache(file, data_);
  for (const int at : {0, 10, 20, 24, 4000}) {
    std::fstream(file, std::ios::in | std::ios::out).seekp(at).put(char(0x5a));
    EXPECT_TRUE(readPipelineCache(file).empty()) << at;
    writePipelineCache(file, data_);
    EXPECT_EQ(readPipelineCache(file), data_);
  }
  for (const int size : {4999, 24, 3, 0}) {
    fs::resize_file(file, uintmax_t(size));
    EXPECT_TRUE(readPipelineCache(file).empty()) << size;
  }
  fs::resize_file(file, uintmax_t(1) << 40);  // of holes
  EXPECT_TRUE(readPipelineCache(file).empty());
}

TEST_F(PipelineCacheFile, aHeaderAloneIsNotKept) {
  data_.resize(sizeof(VkPipelineCacheHeaderVersionOne));
  writePipelineCache(folder_ / "cache.bin", data_);
  EXPECT_EQ(count(folder_), 0u);
}

TEST_F(PipelineCacheFile, aLimitOnSizesLeavesNothing) {
  struct rlimit before = {};
  getrlimit(RLIMIT_FSIZE, &before);
  struct rlimit small = before;
  small.rlim_cur = 1000;
  setrlimit(RLIMIT_FSIZE, &small);
  writePipelineCache(folder_ / "cache.bin", data_);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(count(folder_), 0u);
}

TEST_F(PipelineCacheFile, whateverStandsInItsPlaceADeviceIsThereAndItStays) {
  Result<std::unique_ptr<Device>> plain = Device::create({});
  ASSERT_TRUE(plain.ok()) << plain.error().message();
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties((*plain)->physical(), &properties);
  const fs::path file = pipelineCacheFile(folder_, properties);
  const std::pair<const char*, std::function<void()>> kinds[] = {
      {"a folder", [&] { fs::create_directory(file); }},
      {"a pipe", [&] { ASSERT_EQ(mkfifo(file.c_str(), 0600), 0); }},
      {"an endless device", [&] { fs::create_symlink("/dev/zero", file); }},
      {"a circle of links", [&] { fs::create_symlink(file, file); }},
      {"another file", [&] { std::ofstream(file) << std::string(10000, 'x'); }}};
  for (const auto& [name, put] : kinds) {
    put();
    const fs::file_type type = fs::symlink_status(file).type();
    DeviceOptions options;
    options.cacheFolder = folder_;
    const Result<std::unique_ptr<Device>> device = Device::create(options);
    ASSERT_TRUE(device.ok()) << name << ": " << device.error().message();
    writePipelineCache(file, data_);
    EXPECT_EQ(fs::symlink_status(file).type(), type) << name;
    EXPECT_EQ(count(folder_), 1u) << name;
    fs::remove(file);
  }
  // Nor does it matter what stands in the folder's place.
  DeviceOptions options;
  options.cacheFolder = folder_ / "file";
  std::ofstream(folder_ / "file") << "mine";
  ASSERT_TRUE(Device::create(options).ok());
  writePipelineCache(pipelineCacheFile(options.cacheFolder, properties), data_);
  EXPECT_TRUE(fs::is_regular_file(folder_ / "file"));
}

}  // namespace
}  // namespace scumble::gpu
