// The frame graph's plan, without a device: which barriers stand before each step. Beside the single cases
// stands a model that replays random graphs and knows nothing of how the plan is made, only what Vulkan asks
// for.
#include "gpu/frame_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace scumble::gpu {
namespace {

constexpr VkPipelineStageFlags2 kFragment = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 kColor = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
constexpr VkPipelineStageFlags2 kVertexInput = VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT;
constexpr ImageDesc kImage{VK_FORMAT_R8G8B8A8_UNORM, 64, 64, 2};

const Barrier* find(const std::vector<Barrier>& barriers, ResourceId resource) {
  const auto it = std::find_if(barriers.begin(), barriers.end(),
                               [&](const Barrier& barrier) { return barrier.resource == resource; });
  return it == barriers.end() ? nullptr : &*it;
}

TEST(FrameGraph, readAfterWriteWaitsForTheWriteAndChangesTheLayout) {
  FrameGraph graph;
  const ResourceId image = graph.addImage("a", kImage);
  graph.addStep("draw", {{image, Use::colorTarget}});
  graph.addStep("read", {{image, Use::sampledByFragment}});
  const auto plan = graph.planBarriers();
  ASSERT_EQ(plan.size(), 2u);
  ASSERT_EQ(plan[1].size(), 1u);
  const Barrier& barrier = plan[1][0];
  EXPECT_EQ(barrier.resource, image);
  EXPECT_EQ(barrier.sourceStages, kColor);
  EXPECT_TRUE(barrier.sourceAccess & VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
  EXPECT_EQ(barrier.targetStages, kFragment);
  EXPECT_EQ(barrier.targetAccess, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT);
  EXPECT_EQ(barrier.oldLayout, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
  EXPECT_EQ(barrier.newLayout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

TEST(FrameGraph, writeAfterReadWaitsForTheReader) {
  FrameGraph graph;
  const ResourceId image = graph.addImage("a", kImage);
  graph.addStep("draw", {{image, Use::colorTarget}});
  graph.addStep("read", {{image, Use::sampledByFragment}});
  graph.addStep("draw again", {{image, Use::colorTarget}});
  const auto plan = graph.planBarriers();
  ASSERT_EQ(plan[2].size(), 1u);
  EXPECT_TRUE(plan[2][0].sourceStages & kFragment);
  EXPECT_EQ(plan[2][0].targetStages, kColor);
  EXPECT_EQ(plan[2][0].oldLayout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);  // kept, not discarded
  EXPECT_EQ(plan[2][0].newLayout, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
}

TEST(FrameGraph, writeAfterWriteWaitsThoughTheLayoutStays) {
  FrameGraph graph;
  const ResourceId image = graph.addImage("a", kImage), buffer = graph.addBuffer("b");
  graph.addStep("first", {{image, Use::colorTarget}, {buffer, Use::storageBufferWrite}});
  graph.addStep("second", {{image, Use::colorTarget}, {buffer, Use::storageBufferWrite}});
  const auto plan = graph.planBarriers();
  ASSERT_EQ(plan[1].size(), 2u);
  const Barrier& color = *find(plan[1], image);
  EXPECT_EQ(color.oldLayout, color.newLayout);
  EXPECT_EQ(color.sourceStages, kColor);
  EXPECT_TRUE(color.sourceAccess & VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
  const Barrier& storage = *find(plan[1], buffer);
  EXPECT_EQ(storage.sourceAccess, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
  EXPECT_TRUE(storage.targetAccess & VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
}

TEST(FrameGraph, aSecondReaderInTheSameStageNeedsNothing) {
  FrameGraph graph;
  const ResourceId image = graph.addImage("a", kImage), buffer = graph.addBuffer("b");
  graph.addStep("write", {{image, Use::storageImageWrite}, {buffer, Use::storageBufferWrite}});
  graph.addStep("read", {{image, Use::sampledByFragment}, {buffer, Use::vertexBuffer}});
  graph.addStep("read again", {{image, Use::sampledByFragment}, {buffer, Use::vertexBuffer}});
  const auto plan = graph.planBarriers();
  EXPECT_EQ(plan[1].size(), 2u);
  EXPECT_TRUE(plan[2].empty());
}

// A reader in another stage must wait for the write as well, and the write after them for both.
TEST(FrameGraph, readersInSeveralStages) {
  FrameGraph graph;
  const ResourceId image = graph.addImage("a", kImage), buffer = graph.addBuffer("b");
  graph.addStep("write", {{image, Use::colorTarget}, {buffer, Use::storageBufferWrite}});
  graph.addStep("compute", {{image, Use::sampledByCompute}, {buffer, Use::storageBufferRead}});
  graph.addStep("draw", {{image, Use::sampledByFragment}, {buffer, Use::vertexBuffer}});
  graph.addStep("compute", {{image, Use::sampledByCompute}, {buffer, Use::storageBufferRead}});
  graph.addStep("write", {{image, Use::colorTarget}, {buffer, Use::storageBufferWrite}});
  const auto plan = graph.planBarriers();
  ASSERT_NE(find(plan[2], image), nullptr);
  EXPECT_EQ(find(plan[2], image)->targetStages, kFragment);
  ASSERT_NE(find(plan[2], buffer), nullptr);
  EXPECT_EQ(find(plan[2], buffer)->sourceAccess, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
  EXPECT_EQ(find(plan[2], buffer)->targetStages, kVertexInput);
  EXPECT_TRUE(plan[3].empty());
  ASSERT_EQ(plan[4].size(), 2u);
  EXPECT_EQ(find(plan[4], image)->sourceStages & (kFragment | kCompute), kFragment | kCompute);
  EXPECT_EQ(find(plan[4], buffer)->sourceStages & (kVertexInput | kCompute), kVertexInput | kCompute);
}

TEST(FrameGraph, readingInAnotherLayoutIsATransition) {
  FrameGraph graph;
  const ResourceId image = graph.addImage("a", kImage);
  graph.addStep("draw", {{image, Use::colorTarget}});
  graph.addStep("read", {{image, Use::sampledByFragment}});
  graph.addStep("save", {{image, Use::copySource}});
  const auto plan = graph.planBarriers();
  ASSERT_EQ(plan[2].size(), 1u);
  EXPECT_TRUE(plan[2][0].sourceStages &
              kFragment);  // the transition rewrites what the reader may still be reading
  EXPECT_EQ(plan[2][0].oldLayout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  EXPECT_EQ(plan[2][0].newLayout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
  EXPECT_EQ(plan[2][0].targetStages, VK_PIPELINE_STAGE_2_COPY_BIT);
}

TEST(FrameGraph, resolveTargetsAreWrittenBesideTheirSources) {
  FrameGraph graph;
  const ResourceId many = graph.addImage("many", {VK_FORMAT_R8G8B8A8_UNORM, 64, 64, 1, 1, 4});
  const ResourceId one = graph.addImage("one", kImage);
  const ResourceId manyDepth = graph.addImage("many depth", {VK_FORMAT_D32_SFLOAT, 64, 64, 1, 1, 4});
  const ResourceId depth = graph.addImage("depth", {VK_FORMAT_D32_SFLOAT, 64, 64});
  graph.addStep("draw", {{many, Use::colorTarget},
                         {one, Use::resolveTarget},
                         {manyDepth, Use::depthTarget},
                         {depth, Use::depthResolveTarget}});
  graph.addStep("read", {{one, Use::sampledByFragment}, {depth, Use::sampledByFragment}});
  const auto plan = graph.planBarriers();
  ASSERT_EQ(plan[0].size(), 4u);
  EXPECT_EQ(find(plan[0], one)->newLayout, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
  EXPECT_EQ(find(plan[0], depth)->newLayout, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
  ASSERT_EQ(plan[1].size(), 2u);
  EXPECT_TRUE(find(plan[1], one)->sourceStages & kColor);
  // A depth resolve is done in the colour output stage, whatever its name suggests (Vulkan 1.3,
  // section 8.3.4).
  EXPECT_TRUE(find(plan[1], depth)->sourceStages & kColor);
  EXPECT_TRUE(find(plan[1], depth)->sourceAccess & VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
}

TEST(FrameGraph, depthIsWaitedForInBothTestingStages) {
  FrameGraph graph;
  const ResourceId depth = graph.addImage("depth", {VK_FORMAT_D32_SFLOAT, 64, 64});
  graph.addStep("draw", {{depth, Use::depthTarget}});
  graph.addStep("read", {{depth, Use::sampledByFragment}});
  const auto plan = graph.planBarriers();
  constexpr VkPipelineStageFlags2 kBoth =
      VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
  EXPECT_EQ(plan[0][0].targetStages & kBoth, kBoth);
  EXPECT_EQ(plan[1][0].sourceStages & kBoth, kBoth);
  EXPECT_TRUE(plan[1][0].sourceAccess & VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT);
}

// Frames overlap on the device, so the first use waits for the last one of the frame before; and a frame is a
// pure function, so it discards what that left.
TEST(FrameGraph, theFirstUseDiscardsAndWaitsForTheFrameBefore) {
  FrameGraph graph;
  const ResourceId image = graph.addImage("a", kImage), buffer = graph.addBuffer("b");
  graph.addStep("write", {{image, Use::colorTarget}, {buffer, Use::storageBufferWrite}});
  graph.addStep("read", {{image, Use::sampledByCompute}, {buffer, Use::vertexBuffer}});
  const auto plan = graph.planBarriers();
  ASSERT_EQ(plan[0].size(), 2u);
  EXPECT_EQ(find(plan[0], image)->oldLayout, VK_IMAGE_LAYOUT_UNDEFINED);
  EXPECT_TRUE(find(plan[0], image)->sourceStages & kCompute);
  EXPECT_TRUE(find(plan[0], buffer)->sourceStages & kVertexInput);
}

TEST(FrameGraph, buffersHaveNoLayouts) {
  FrameGraph graph;
  const ResourceId buffer = graph.addBuffer("b");
  graph.addStep("write", {{buffer, Use::storageBufferWrite}});
  graph.addStep("read", {{buffer, Use::vertexBuffer}});
  for (const std::vector<Barrier>& barriers : graph.planBarriers())
    for (const Barrier& barrier : barriers) {
      EXPECT_EQ(barrier.oldLayout, VK_IMAGE_LAYOUT_UNDEFINED);
      EXPECT_EQ(barrier.newLayout, VK_IMAGE_LAYOUT_UNDEFINED);
    }
}

TEST(FrameGraph, whatIsNotUsedHasNoBarriers) {
  FrameGraph graph;
  const ResourceId used = graph.addImage("a", kImage), unused = graph.addImage("b", kImage);
  graph.addStep("write", {{used, Use::colorTarget}});
  graph.addStep("nothing", {});
  const auto plan = graph.planBarriers();
  EXPECT_EQ(find(plan[0], unused), nullptr);
  EXPECT_TRUE(plan[1].empty());
  EXPECT_EQ(graph.resources()[unused].usage, 0u);
  EXPECT_TRUE(FrameGraph().planBarriers().empty());
}

TEST(FrameGraph, usageFlagsAreThoseOfAllUses) {
  FrameGraph graph;
  const ResourceId image = graph.addImage("a", kImage),
                   depth = graph.addImage("d", {VK_FORMAT_D32_SFLOAT, 8, 8});
  EXPECT_EQ(graph.addStep("draw", {{image, Use::colorTarget}, {depth, Use::depthTarget}}), 0u);
  EXPECT_EQ(graph.addStep("compute", {{image, Use::storageImageWrite}, {depth, Use::sampledByCompute}}), 1u);
  EXPECT_EQ(graph.addStep("save", {{image, Use::copySource}}), 2u);
  EXPECT_EQ(graph.resources()[image].usage,
            VkImageUsageFlags(VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_STORAGE_BIT |
                              VK_IMAGE_USAGE_TRANSFER_SRC_BIT));
  EXPECT_EQ(graph.resources()[depth].usage,
            VkImageUsageFlags(VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT));
  EXPECT_EQ(graph.steps()[1].name, "compute");
  EXPECT_EQ(graph.resources()[image].desc, kImage);
}

// -- The model

// What has happened to a resource since its last write: which stages know of it, and who has read it since.
struct Memory {
  bool written = false;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  std::map<VkPipelineStageFlags2, bool> sees;     // single stage -> whether the last write is visible there
  VkPipelineStageFlags2 writer = 0, readers = 0;  // whose work has not been waited for
};

// Random graphs of images and buffers, replayed for two frames; every use must find its resource in the right
// layout, see the last write, and write only when nobody is at it any more.
TEST(FrameGraph, randomGraphsKeepVulkansRules) {
  constexpr Use kImageUses[] = {Use::sampledByFragment, Use::sampledByCompute, Use::colorTarget,
                                Use::resolveTarget,     Use::copySource,       Use::storageImageWrite};
  constexpr Use kBufferUses[] = {Use::storageBufferRead, Use::storageBufferWrite, Use::vertexBuffer};
  for (uint32_t seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    FrameGraph graph;
    constexpr size_t kImages = 3, kResources = 5;
    for (size_t r = 0; r < kResources; ++r) r < kImages ? graph.addImage("i", kImage) : graph.addBuffer("b");
    std::vector<bool> written(kResources, false);
    const size_t stepCount = 1 + random() % 10;
    for (size_t s = 0; s < stepCount; ++s) {
      std::vector<ResourceUse> uses;
      for (ResourceId r = 0; r < kResources; ++r) {
        if (random() % 2) continue;
        Use use = r < kImages ? kImageUses[random() % std::size(kImageUses)] : kBufferUses[random() % 3];
        if (!useInfo(use).writes && !written[r])
          use = r < kImages ? Use::colorTarget : Use::storageBufferWrite;
        written[r] = true;
        uses.push_back({r, use});
      }
      graph.addStep("s", uses);
    }
    const auto plan = graph.planBarriers();
    ASSERT_EQ(plan.size(), stepCount);
    std::vector<Memory> state(kResources);
    for (int frame = 0; frame < 2; ++frame) {
      std::vector<bool> usedThisFrame(kResources, false);
      for (size_t s = 0; s < stepCount; ++s) {
        for (const Barrier& barrier : plan[s]) {
          Memory& memory = state[barrier.resource];
          const auto& uses = graph.steps()[s].uses;
          ASSERT_TRUE(std::any_of(uses.begin(), uses.end(),
                                  [&](const ResourceUse& use) { return use.resource == barrier.resource; }))
              << "a barrier for nothing, seed " << seed;
          if (barrier.resource < kImages) {
            // From the right layout, or discarding; and only the first use of a frame may discard.
            if (barrier.oldLayout == VK_IMAGE_LAYOUT_UNDEFINED) {
              ASSERT_FALSE(usedThisFrame[barrier.resource])
                  << "contents are lost, seed " << seed << " step " << s;
            } else {
              ASSERT_EQ(barrier.oldLayout, memory.layout) << "seed " << seed << " step " << s;
            }
            if (barrier.oldLayout != barrier.newLayout) {
              // A transition writes: whoever is at it must be waited for, and only the barrier's target sees
              // it.
              ASSERT_EQ((memory.writer | memory.readers) & ~barrier.sourceStages, 0u)
                  << "a transition under somebody's hands, seed " << seed << " step " << s;
              memory.sees.clear();
              memory.writer = barrier.targetStages, memory.readers = 0;
            }
            memory.layout = barrier.newLayout;
          }
          if ((memory.writer & ~barrier.sourceStages) == 0 || barrier.oldLayout != barrier.newLayout)
            for (int bit = 0; bit < 64; ++bit)
              if (barrier.targetStages >> bit & 1) memory.sees[1ull << bit] = true;
        }
        for (const ResourceUse& use : graph.steps()[s].uses) {
          const UseInfo info = useInfo(use.use);
          Memory& memory = state[use.resource];
          const Barrier* barrier = find(plan[s], use.resource);
          if (use.resource < kImages) {
            ASSERT_EQ(memory.layout, info.layout) << "seed " << seed << " step " << s;
          }
          if (info.writes) {
            const VkPipelineStageFlags2 atIt = memory.writer | memory.readers;
            const bool transitioned = barrier && barrier->oldLayout != barrier->newLayout;
            ASSERT_TRUE(atIt == 0 || transitioned || (barrier && (atIt & ~barrier->sourceStages) == 0))
                << "a write under somebody's hands, seed " << seed << " step " << s;
            memory.sees.clear();
            memory.writer = info.stages, memory.readers = 0, memory.written = true;
          } else {
            ASSERT_TRUE(memory.sees[info.stages])
                << "a read that sees nothing, seed " << seed << " step " << s;
            memory.readers |= info.stages;
          }
          usedThisFrame[use.resource] = true;
        }
      }
    }
  }
}

// -- Mistakes of ours

class FrameGraphDeathTest : public testing::Test {
 protected:
  void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
  FrameGraph graph;
  ResourceId image = graph.addImage("a", kImage), buffer = graph.addBuffer("b");
};

TEST_F(FrameGraphDeathTest, readingBeforeWriting) {
  EXPECT_DEATH(graph.addStep("read", {{image, Use::sampledByFragment}}), "read before it was written");
  EXPECT_DEATH(graph.addStep("read", {{buffer, Use::vertexBuffer}}), "read before it was written");
}

TEST_F(FrameGraphDeathTest, usingOneResourceTwiceInAStep) {
  EXPECT_DEATH(graph.addStep("both", {{image, Use::colorTarget}, {image, Use::sampledByFragment}}),
               "used twice");
}

TEST_F(FrameGraphDeathTest, buffersAsImagesAndUnknownResources) {
  EXPECT_DEATH(graph.addStep("draw", {{buffer, Use::colorTarget}}), "isImage");
  EXPECT_DEATH(graph.addStep("write", {{image, Use::storageBufferWrite}}), "isImage");
  EXPECT_DEATH(graph.addStep("draw", {{ResourceId(7), Use::colorTarget}}), "resources_.size");
}

}  // namespace
}  // namespace scumble::gpu
