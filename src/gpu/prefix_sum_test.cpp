#include "gpu/prefix_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <random>

#include "tests/support/test_device.h"

namespace scumble::gpu {
namespace {

constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;

class OnDevice : public ::testing::Test {
 protected:
  void SetUp() override {
    DeviceOptions options;
    options.choice = test::testDevice();
    options.validation = true;
    auto made = Device::create(options);
    ASSERT_TRUE(made) << made.error().message();
    device_ = std::move(*made);
  }
  void TearDown() override {
    if (device_) {
      EXPECT_EQ(device_->validationMessages(), 0);
    }
  }

  // What `record` makes of numbers in buffers of the device: copied there before it, and back after it.
  using Numbers = std::vector<uint32_t>;
  void run(std::span<const std::pair<const Buffer*, Numbers*>> copies,
           const std::function<void(VkCommandBuffer)>& record) {
    uint64_t bytes = 0;
    for (const auto& [buffer, numbers] : copies) bytes += numbers->size() * sizeof(uint32_t);
    Buffer staging(*device_, std::max<uint64_t>(4, bytes),
                   VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::readback);
    const auto forEach = [&](auto&& visit) {
      uint64_t at = 0;
      for (const auto& [buffer, numbers] : copies) {
        const uint64_t size = numbers->size() * sizeof(uint32_t);
        if (size > 0) visit(*buffer, *numbers, at, size);
        at += size;
      }
    };
    forEach([&](const Buffer&, const Numbers& numbers, uint64_t at, uint64_t size) {
      std::memcpy(staging.mapped() + at, numbers.data(), size);
    });
    constexpr VkAccessFlags2 kStorageAccess =
        VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    device_->runOnce([&](VkCommandBuffer commands) {
      forEach([&](const Buffer& buffer, const Numbers&, uint64_t at, uint64_t size) {
        const VkBufferCopy copy{at, 0, size};
        vkCmdCopyBuffer(commands, staging.handle(), buffer.handle(), 1, &copy);
      });
      memoryBarrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, kStorageAccess);
      record(commands);
      memoryBarrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, kStorageAccess,
                    VK_PIPELINE_STAGE_2_COPY_BIT,
                    VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT);
      forEach([&](const Buffer& buffer, const Numbers&, uint64_t at, uint64_t size) {
        const VkBufferCopy copy{0, at, size};
        vkCmdCopyBuffer(commands, buffer.handle(), staging.handle(), 1, &copy);
      });
      memoryBarrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                    VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    });
    forEach([&](const Buffer&, Numbers& numbers, uint64_t at, uint64_t size) {
      std::memcpy(numbers.data(), staging.mapped() + at, size);
    });
  }

  std::unique_ptr<Device> device_;
};

using PrefixSums = OnDevice;
using RadixSorts = OnDevice;

// Around the sizes of blocks, and of blocks of blocks.
TEST_F(PrefixSums, areThoseOfTheCpu) {
  for (const uint32_t count : {1u, 2u, 7u, 8u, 9u, 2047u, 2048u, 2049u, 100'000u, 2048u * 2048u - 1,
                               2048u * 2048u, 2048u * 2048u + 1}) {
    std::mt19937 random(count);
    // One number more than is asked for: it must stay.
    std::vector<uint32_t> numbers(count + 1);
    for (uint32_t& number : numbers) number = random() % 900;
    std::vector<uint32_t> expected = numbers;
    std::exclusive_scan(expected.begin(), expected.end() - 1, expected.begin(), 0u);
    const Buffer buffer(*device_, numbers.size() * sizeof(uint32_t),
                        kStorage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                        MemoryKind::device);
    const PrefixSum sum(*device_, buffer, count + 5000);
    const std::pair<const Buffer*, std::vector<uint32_t>*> copies[] = {{&buffer, &numbers}};
    run(copies, [&](VkCommandBuffer commands) { sum.record(commands, count); });
    ASSERT_TRUE(numbers == expected) << count;
  }
}

// Index for index, which also says that equal keys keep their order.
TEST_F(RadixSorts, equalStdStableSort) {
  struct Case {
    const char* name;
    uint32_t count;
    std::function<uint32_t(uint32_t, std::mt19937&)> key;
    uint32_t keyBits = 32;
  };
  const auto any = [](uint32_t, std::mt19937& random) { return uint32_t(random()); };
  std::vector<Case> cases;
  for (const uint32_t count : {0u, 1u, 2u, 255u, 256u, 2047u, 2048u, 2049u, 4097u, 70'000u})
    cases.push_back({"random", count, any});
  cases.push_back({"all alike", 5000, [](uint32_t, std::mt19937&) { return 0xFFFFFFFFu; }});
  cases.push_back(
      {"few kinds", 50'000, [](uint32_t, std::mt19937& random) { return uint32_t(random() % 3) << 30; }});
  cases.push_back({"sorted", 30'000, [](uint32_t i, std::mt19937&) { return i * 7; }});
  cases.push_back({"backwards", 30'000, [](uint32_t i, std::mt19937&) { return ~i; }});
  cases.push_back({"low bits only", 30'000, any, 12});
  cases.push_back({"low bits of few", 1000, any, 12});
  cases.push_back({"four million", 4'000'000,
                   [](uint32_t, std::mt19937& random) { return uint32_t(random() % 1'000'000); }});
  for (const Case& one : cases) {
    std::mt19937 random(one.count);
    std::vector<uint32_t> keys(one.count), values(one.count);
    for (uint32_t i = 0; i < one.count; ++i) keys[i] = one.key(i, random);
    for (uint32_t i = 0; i < one.count; ++i) values[i] = i ^ 0x5A5A5A5Au;
    // By as many bits as are sorted by: a multiple of 8.
    const uint32_t mask = one.keyBits == 32 ? ~0u : (1u << (one.keyBits + 7) / 8 * 8) - 1;
    std::vector<uint32_t> order(one.count), expectedKeys, expectedValues;
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return (keys[a] & mask) < (keys[b] & mask); });
    for (const uint32_t i : order) expectedKeys.push_back(keys[i]), expectedValues.push_back(values[i]);

    const RadixSort sort(*device_, std::max(one.count, 3000u), one.keyBits);
    const std::pair<const Buffer*, std::vector<uint32_t>*> copies[] = {{&sort.keys(), &keys},
                                                                       {&sort.values(), &values}};
    run(copies, [&](VkCommandBuffer commands) { sort.record(commands, one.count); });
    ASSERT_TRUE(keys == expectedKeys) << one.name << " " << one.count;
    ASSERT_TRUE(values == expectedValues) << one.name << " " << one.count;
  }
}

}  // namespace
}  // namespace scumble::gpu
