// RangeAllocator against a model: the plain list of what is allocated. Tried with thousands of random calls,
// because its mistakes hide in rare neighbourhoods of free and used ranges.
#include "gpu/memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace scumble::gpu {
namespace {

struct Range {
  uint64_t offset, size;
};

// Whether `size` bytes at `alignment` fit anywhere between the used ranges.
bool fits(std::vector<Range> used, uint64_t total, uint64_t size, uint64_t alignment) {
  std::sort(used.begin(), used.end(), [](const Range& a, const Range& b) { return a.offset < b.offset; });
  used.push_back({total, 0});
  uint64_t end = 0;
  for (const Range& range : used) {
    if ((end + alignment - 1) / alignment * alignment + size <= range.offset) return true;
    end = range.offset + range.size;
  }
  return false;
}

TEST(RangeAllocator, randomUseNeverOverlapsAndLosesNothing) {
  for (uint32_t seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    const uint64_t total = 1 + random() % 5000;
    RangeAllocator allocator(total);
    std::vector<Range> used;
    int refusals = 0;
    for (int step = 0; step < 2000; ++step) {
      // Phases of growing and of shrinking, so that both full and nearly empty states are met.
      const bool grow = random() % 100 < (step / 200 % 2 ? 35u : 65u);
      if (grow || used.empty()) {
        const uint64_t size = 1 + random() % (1 + total / 8), alignment = uint64_t(1) << random() % 8;
        const uint64_t offset = allocator.allocate(size, alignment);
        if (offset == RangeAllocator::kNone) {
          ++refusals;
          ASSERT_FALSE(fits(used, total, size, alignment))
              << "refused what fits, seed " << seed << " step " << step;
          continue;
        }
        ASSERT_EQ(offset % alignment, 0u);
        ASSERT_LE(offset + size, total);
        for (const Range& other : used)
          ASSERT_TRUE(offset + size <= other.offset || other.offset + other.size <= offset)
              << "overlap, seed " << seed << " step " << step;
        used.push_back({offset, size});
      } else {
        std::swap(used[random() % used.size()], used.back());
        allocator.release(used.back().offset, used.back().size);
        used.pop_back();
      }
      ASSERT_EQ(allocator.empty(), used.empty());
    }
    EXPECT_GT(refusals, 0) << "this seed never filled the block, so it tested little";
    // All back in random order: one free range of the whole size must be left.
    std::shuffle(used.begin(), used.end(), random);
    for (const Range& range : used) allocator.release(range.offset, range.size);
    EXPECT_TRUE(allocator.empty());
    EXPECT_EQ(allocator.allocate(total, 1), 0u);
  }
}

TEST(RangeAllocator, wholeBlockAndNotOneByteMore) {
  RangeAllocator allocator(256);
  EXPECT_EQ(allocator.allocate(257, 1), RangeAllocator::kNone);
  EXPECT_EQ(allocator.allocate(256, 256), 0u);
  EXPECT_EQ(allocator.allocate(1, 1), RangeAllocator::kNone);
  EXPECT_FALSE(allocator.empty());
  allocator.release(0, 256);
  EXPECT_TRUE(allocator.empty());
}

// What is left out before an aligned range stays usable.
TEST(RangeAllocator, paddingBeforeAnAlignedRangeIsNotLost) {
  RangeAllocator allocator(64);
  EXPECT_EQ(allocator.allocate(1, 1), 0u);
  EXPECT_EQ(allocator.allocate(32, 32), 32u);
  EXPECT_EQ(allocator.allocate(31, 1), 1u);
  EXPECT_EQ(allocator.allocate(1, 1), RangeAllocator::kNone);
}

TEST(RangeAllocator, freeNeighboursMergeOnBothSides) {
  RangeAllocator allocator(30);
  for (const uint64_t offset : {0u, 10u, 20u}) ASSERT_EQ(allocator.allocate(10, 1), offset);
  allocator.release(0, 10);
  allocator.release(20, 10);
  EXPECT_EQ(allocator.allocate(11, 1), RangeAllocator::kNone);
  allocator.release(10, 10);
  EXPECT_EQ(allocator.allocate(30, 1), 0u);
}

// Sizes near 2^64 must not wrap around to something that fits.
TEST(RangeAllocator, absurdSizesAreRefused) {
  RangeAllocator allocator(1024);
  ASSERT_EQ(allocator.allocate(16, 1), 0u);
  EXPECT_EQ(allocator.allocate(~0ull, 1), RangeAllocator::kNone);
  EXPECT_EQ(allocator.allocate(~0ull - 15, 16), RangeAllocator::kNone);
}

TEST(RangeAllocatorDeathTest, givingBackWhatIsFreeIsOurMistake) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // other tests may have left threads of the driver's
  RangeAllocator allocator(64);
  ASSERT_EQ(allocator.allocate(32, 1), 0u);
  allocator.release(0, 32);
  EXPECT_DEATH(allocator.release(0, 32), "release");
}

// The words come first; what was called, for those who report it, has no C++ in it.
TEST(VulkanError, saysWhatIsWrongAndWhatWasCalled) {
  const auto message = [](VkResult result) {
    return VulkanError{"vkAllocateMemory(device_, &info, nullptr, &memory)", result}.message();
  };
  EXPECT_EQ(message(VK_ERROR_OUT_OF_DEVICE_MEMORY),
            "there is not enough memory on the device (vkAllocateMemory, -2)");
  EXPECT_EQ(message(VK_ERROR_OUT_OF_HOST_MEMORY), "there is not enough memory (vkAllocateMemory, -1)");
  EXPECT_EQ(message(VK_ERROR_DEVICE_LOST), "the device was lost (vkAllocateMemory, -4)");
  EXPECT_EQ(message(VK_ERROR_UNKNOWN), "the driver gave an unexpected result (vkAllocateMemory, -13)");
}

}  // namespace
}  // namespace scumble::gpu
