// How images share memory: never two that are there at the same time, and never more than without sharing.
#include "gpu/graph_resources.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace scumble::gpu {
namespace {

TEST(Lodge, oneAfterTheOtherShareEverything) {
  const Lodger lodgers[] = {{100, 1, 0, 1}, {60, 1, 2, 3}, {80, 1, 4, 9}};
  const Lodging lodging = lodge(lodgers);
  EXPECT_EQ(lodging.bytes, 100u);
  EXPECT_EQ(lodging.offsets, (std::vector<uint64_t>{0, 0, 0}));
}

// The step that ends one and begins the other uses both.
TEST(Lodge, theSameStepIsAMeeting) {
  const Lodger lodgers[] = {{100, 1, 0, 2}, {60, 1, 2, 3}};
  EXPECT_EQ(lodge(lodgers).bytes, 160u);
}

TEST(Lodge, aGapBetweenTwoIsUsed) {
  // The third one ends before the second begins, and fits where the first one is not.
  const Lodger lodgers[] = {{100, 1, 0, 9}, {50, 1, 5, 9}, {40, 1, 0, 4}};
  const Lodging lodging = lodge(lodgers);
  EXPECT_EQ(lodging.bytes, 150u);
  EXPECT_EQ(lodging.offsets[2], 100u);
}

TEST(Lodge, nobodyNeedsNothing) {
  EXPECT_EQ(lodge({}).bytes, 0u);
}

TEST(Lodge, randomLodgersNeverOverlapWhileTheyMeet) {
  uint64_t apart = 0, together = 0;
  for (uint32_t seed = 0; seed < 500; ++seed) {
    std::mt19937 random(seed);
    std::vector<Lodger> lodgers(1 + random() % 20);
    uint64_t sum = 0;
    for (Lodger& l : lodgers) {
      l.bytes = 1 + random() % 1000;
      l.alignment = 1ull << random() % 9;
      l.first = random() % 16;
      l.last = l.first + random() % 6;
      sum += l.bytes + l.alignment - 1;
    }
    const Lodging lodging = lodge(lodgers);
    ASSERT_EQ(lodging.offsets.size(), lodgers.size());
    EXPECT_LE(lodging.bytes, sum);
    // At no time is there less room than what lives then.
    for (size_t step = 0; step < 22; ++step) {
      uint64_t alive = 0;
      for (const Lodger& l : lodgers) alive += l.first <= step && step <= l.last ? l.bytes : 0;
      EXPECT_GE(lodging.bytes, alive);
    }
    for (size_t a = 0; a < lodgers.size(); ++a) {
      ASSERT_EQ(lodging.offsets[a] % lodgers[a].alignment, 0u);
      ASSERT_LE(lodging.offsets[a] + lodgers[a].bytes, lodging.bytes);
      for (size_t b = 0; b < a; ++b) {
        const bool meet =
            std::max(lodgers[a].first, lodgers[b].first) <= std::min(lodgers[a].last, lodgers[b].last);
        const bool overlap = lodging.offsets[a] < lodging.offsets[b] + lodgers[b].bytes &&
                             lodging.offsets[b] < lodging.offsets[a] + lodgers[a].bytes;
        ASSERT_FALSE(meet && overlap) << "seed " << seed;
      }
    }
    apart += sum, together += lodging.bytes;
  }
  EXPECT_LT(together, apart * 3 / 5);
}

}  // namespace
}  // namespace scumble::gpu
