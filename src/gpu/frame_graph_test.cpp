// The frame graph's plan, without a device: which barriers stand before each step. Beside the single cases
// stands a model that replays random graphs and knows nothing of how the plan is made, only what Vulkan asks
// for.
#include "gpu/frame_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <string>

namespace scumble::gpu {
namespace {

constexpr VkPipelineStageFlags2 kFragment = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 kColor = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
constexpr VkPipelineStageFlags2 kVertexInput = VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT;
constexpr ImageShape kImage{.format = VK_FORMAT_R8G8B8A8_UNORM};
constexpr ImageShape kDepth{.format = VK_FORMAT_D32_SFLOAT};

const Barrier* find(const std::vector<Barrier>& barriers, Handle handle) {
  const auto it = std::find_if(barriers.begin(), barriers.end(),
                               [&](const Barrier& barrier) { return barrier.resource == handle.resource; });
  return it == barriers.end() ? nullptr : &*it;
}

struct StepUse {
  Handle& handle;  // goes on to the version that is written
  Use use;
};
void addStep(FrameGraph& graph, const std::string& name, const std::vector<StepUse>& uses) {
  graph.addStep(name);
  for (const StepUse& use : uses) use.handle = graph.use(use.handle, use.use);
}

// Barriers where every step is needed.
std::vector<std::vector<Barrier>> planAll(const FrameGraph& graph) {
  FrameGraph::Needs needs;
  needs.steps.assign(graph.steps().size(), true);
  needs.lives.assign(graph.resources().size(), {.isUsed = true});
  return graph.planBarriers(needs);
}

TEST(FrameGraph, readAfterWriteWaitsForTheWriteAndChangesTheLayout) {
  FrameGraph graph;
  Handle image = graph.addImage("a", kImage);
  addStep(graph, "draw", {{image, Use::colorTarget}});
  addStep(graph, "read", {{image, Use::sampledByFragment}});
  const auto plan = planAll(graph);
  ASSERT_EQ(plan.size(), 3u);  // the last ones come after all steps
  ASSERT_EQ(plan[1].size(), 1u);
  const Barrier& barrier = plan[1][0];
  EXPECT_EQ(barrier.resource, image.resource);
  EXPECT_EQ(barrier.sourceStages, kColor);
  EXPECT_TRUE(barrier.sourceAccess & VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
  EXPECT_EQ(barrier.targetStages, kFragment);
  EXPECT_EQ(barrier.targetAccess, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT);
  EXPECT_EQ(barrier.oldLayout, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
  EXPECT_EQ(barrier.newLayout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

TEST(FrameGraph, writeAfterReadWaitsForTheReader) {
  FrameGraph graph;
  Handle image = graph.addImage("a", kImage);
  addStep(graph, "draw", {{image, Use::colorTarget}});
  addStep(graph, "read", {{image, Use::sampledByFragment}});
  addStep(graph, "draw again", {{image, Use::colorTarget}});
  const auto plan = planAll(graph);
  ASSERT_EQ(plan[2].size(), 1u);
  EXPECT_TRUE(plan[2][0].sourceStages & kFragment);
  EXPECT_EQ(plan[2][0].targetStages, kColor);
  EXPECT_EQ(plan[2][0].oldLayout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);  // kept, not discarded
  EXPECT_EQ(plan[2][0].newLayout, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
}

TEST(FrameGraph, writeAfterWriteWaitsThoughTheLayoutStays) {
  FrameGraph graph;
  Handle image = graph.addImage("a", kImage), buffer = graph.addBuffer("b", 64);
  addStep(graph, "first", {{image, Use::colorTarget}, {buffer, Use::storageBufferWrite}});
  addStep(graph, "second", {{image, Use::colorTarget}, {buffer, Use::storageBufferWrite}});
  const auto plan = planAll(graph);
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
  Handle image = graph.addImage("a", kImage), buffer = graph.addBuffer("b", 64);
  addStep(graph, "write", {{image, Use::storageImageWrite}, {buffer, Use::storageBufferWrite}});
  addStep(graph, "read", {{image, Use::sampledByFragment}, {buffer, Use::vertexBuffer}});
  addStep(graph, "read again", {{image, Use::sampledByFragment}, {buffer, Use::vertexBuffer}});
  const auto plan = planAll(graph);
  EXPECT_EQ(plan[1].size(), 2u);
  EXPECT_TRUE(plan[2].empty());
}

// A reader in another stage must wait for the write as well, and the write after them for both.
TEST(FrameGraph, readersInSeveralStages) {
  FrameGraph graph;
  Handle image = graph.addImage("a", kImage), buffer = graph.addBuffer("b", 64);
  addStep(graph, "write", {{image, Use::colorTarget}, {buffer, Use::storageBufferWrite}});
  addStep(graph, "compute", {{image, Use::sampledByCompute}, {buffer, Use::storageBufferRead}});
  addStep(graph, "draw", {{image, Use::sampledByFragment}, {buffer, Use::vertexBuffer}});
  addStep(graph, "compute", {{image, Use::sampledByCompute}, {buffer, Use::storageBufferRead}});
  addStep(graph, "write", {{image, Use::colorTarget}, {buffer, Use::storageBufferWrite}});
  const auto plan = planAll(graph);
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
  Handle image = graph.addImage("a", kImage);
  addStep(graph, "draw", {{image, Use::colorTarget}});
  addStep(graph, "read", {{image, Use::sampledByFragment}});
  addStep(graph, "save", {{image, Use::copySource}});
  const auto plan = planAll(graph);
  ASSERT_EQ(plan[2].size(), 1u);
  EXPECT_TRUE(plan[2][0].sourceStages &
              kFragment);  // the transition rewrites what the reader may still be reading
  EXPECT_EQ(plan[2][0].oldLayout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  EXPECT_EQ(plan[2][0].newLayout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
  EXPECT_EQ(plan[2][0].targetStages, VK_PIPELINE_STAGE_2_COPY_BIT);
}

TEST(FrameGraph, resolveTargetsAreWrittenBesideTheirSources) {
  FrameGraph graph;
  Handle many = graph.addImage("many", {.format = kImage.format, .samples = 4});
  Handle one = graph.addImage("one", kImage);
  Handle manyDepth = graph.addImage("many depth", {.format = kDepth.format, .samples = 4});
  Handle depth = graph.addImage("depth", kDepth);
  addStep(graph, "draw",
          {{many, Use::colorTarget},
           {one, Use::resolveTarget},
           {manyDepth, Use::depthTarget},
           {depth, Use::depthResolveTarget}});
  addStep(graph, "read", {{one, Use::sampledByFragment}, {depth, Use::sampledByFragment}});
  const auto plan = planAll(graph);
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
  Handle depth = graph.addImage("depth", kDepth);
  addStep(graph, "draw", {{depth, Use::depthTarget}});
  addStep(graph, "read", {{depth, Use::sampledByFragment}});
  const auto plan = planAll(graph);
  constexpr VkPipelineStageFlags2 kBoth =
      VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
  EXPECT_EQ(plan[0][0].targetStages & kBoth, kBoth);
  EXPECT_EQ(plan[1][0].sourceStages & kBoth, kBoth);
  EXPECT_TRUE(plan[1][0].sourceAccess & VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT);
}

// What is tested against stays as it is: it is read, after all writes and before what comes next, in a layout
// of its own.
TEST(FrameGraph, depthThatIsTestedAgainstIsRead) {
  FrameGraph graph;
  Handle depth = graph.addImage("depth", kDepth);
  addStep(graph, "draw", {{depth, Use::depthTarget}});
  const uint32_t version = depth.version;
  addStep(graph, "test", {{depth, Use::depthTest}});
  EXPECT_EQ(depth.version, version);
  addStep(graph, "read", {{depth, Use::sampledByFragment}});
  const auto plan = planAll(graph);
  ASSERT_EQ(plan[1].size(), 1u);
  EXPECT_EQ(plan[1][0].newLayout, VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL);
  EXPECT_TRUE(plan[1][0].sourceAccess & VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT);
  EXPECT_EQ(plan[1][0].targetAccess, VkAccessFlags2(VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT));
  ASSERT_EQ(plan[2].size(), 1u);
  EXPECT_TRUE(plan[2][0].sourceStages & VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT);
  EXPECT_EQ(plan[2][0].oldLayout, VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL);
}

// Frames overlap on the device, so the first use waits for the last one of the frame before; and a frame is a
// pure function, so it discards what that left.
TEST(FrameGraph, theFirstUseDiscardsAndWaitsForTheFrameBefore) {
  FrameGraph graph;
  Handle image = graph.addImage("a", kImage), buffer = graph.addBuffer("b", 64);
  addStep(graph, "write", {{image, Use::colorTarget}, {buffer, Use::storageBufferWrite}});
  addStep(graph, "read", {{image, Use::sampledByCompute}, {buffer, Use::vertexBuffer}});
  const auto plan = planAll(graph);
  ASSERT_EQ(plan[0].size(), 2u);
  EXPECT_EQ(find(plan[0], image)->oldLayout, VK_IMAGE_LAYOUT_UNDEFINED);
  EXPECT_TRUE(find(plan[0], image)->sourceStages & kCompute);
  EXPECT_TRUE(find(plan[0], buffer)->sourceStages & kVertexInput);
}

TEST(FrameGraph, buffersHaveNoLayouts) {
  FrameGraph graph;
  Handle buffer = graph.addBuffer("b", 64);
  addStep(graph, "write", {{buffer, Use::storageBufferWrite}});
  addStep(graph, "read", {{buffer, Use::vertexBuffer}});
  for (const std::vector<Barrier>& barriers : planAll(graph))
    for (const Barrier& barrier : barriers) {
      EXPECT_EQ(barrier.oldLayout, VK_IMAGE_LAYOUT_UNDEFINED);
      EXPECT_EQ(barrier.newLayout, VK_IMAGE_LAYOUT_UNDEFINED);
    }
}

TEST(FrameGraph, whatIsNotUsedHasNoBarriers) {
  FrameGraph graph;
  Handle used = graph.addImage("a", kImage), unused = graph.addImage("b", kImage);
  addStep(graph, "write", {{used, Use::colorTarget}});
  addStep(graph, "nothing", {});
  const auto plan = planAll(graph);
  EXPECT_EQ(find(plan[0], unused), nullptr);
  EXPECT_TRUE(plan[1].empty());
  EXPECT_TRUE(plan[2].empty());
  EXPECT_EQ(FrameGraph().planBarriers({}).size(), 1u);
}

TEST(FrameGraph, usageFlagsAreThoseOfAllUsesThatAreNeeded) {
  FrameGraph graph;
  Handle image = graph.addImage("a", kImage), depth = graph.addImage("d", kDepth),
         buffer = graph.addBuffer("b", 64), saved = graph.importBuffer("saved", Outside{}, Outside{});
  addStep(graph, "draw", {{image, Use::colorTarget}, {depth, Use::depthTarget}});
  addStep(
      graph, "compute",
      {{image, Use::storageImageWrite}, {depth, Use::sampledByCompute}, {buffer, Use::storageBufferWrite}});
  addStep(graph, "save", {{image, Use::copySource}, {buffer, Use::indirectBuffer}, {saved, Use::copyTarget}});
  addStep(graph, "in vain", {{image, Use::sampledByVertex}, {buffer, Use::copySource}});
  const FrameGraph::Needs needs = graph.needsOf({});
  EXPECT_EQ(needs.steps, (std::vector<bool>{true, true, true, false}));
  EXPECT_EQ(needs.lives[image.resource].imageUsage,
            VkImageUsageFlags(VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_STORAGE_BIT |
                              VK_IMAGE_USAGE_TRANSFER_SRC_BIT));
  EXPECT_EQ(needs.lives[depth.resource].imageUsage,
            VkImageUsageFlags(VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT));
  EXPECT_EQ(needs.lives[buffer.resource].bufferUsage,
            VkBufferUsageFlags(VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT));
  EXPECT_EQ(needs.lives[depth.resource].first, 0u);
  EXPECT_EQ(needs.lives[depth.resource].last, 1u);
}

// -- What is needed

TEST(FrameGraph, onlyWhatSomebodyWantsIsNeeded) {
  FrameGraph graph;
  Handle a = graph.addImage("a", kImage), b = graph.addImage("b", kImage), c = graph.addImage("c", kImage),
         d = graph.addImage("d", kImage);
  addStep(graph, "a", {{a, Use::colorTarget}});
  addStep(graph, "b", {{a, Use::sampledByFragment}, {b, Use::colorTarget}});
  addStep(graph, "c", {{a, Use::sampledByFragment}, {c, Use::colorTarget}});
  addStep(graph, "d", {{c, Use::sampledByFragment}, {d, Use::colorTarget}});
  EXPECT_EQ(graph.needsOf({}).steps, (std::vector<bool>{false, false, false, false}));
  EXPECT_EQ(graph.needsOf(std::vector{b}).steps, (std::vector<bool>{true, true, false, false}));
  EXPECT_EQ(graph.needsOf(std::vector{d}).steps, (std::vector<bool>{true, false, true, true}));
  const FrameGraph::Needs both = graph.needsOf(std::vector{b, c});
  EXPECT_EQ(both.steps, (std::vector<bool>{true, true, true, false}));
  EXPECT_FALSE(both.lives[d.resource].isUsed);
  const auto plan = graph.planBarriers(both);
  EXPECT_TRUE(plan[3].empty());
  EXPECT_EQ(find(plan[0], a)->sourceStages, kFragment);  // "c" of the frame before, not "d"
}

// What goes on from an earlier version needs it; an earlier version alone does not need what comes after.
TEST(FrameGraph, versionsAreWantedOneByOne) {
  FrameGraph graph;
  Handle image = graph.addImage("a", kImage);
  addStep(graph, "first", {{image, Use::colorTarget}});
  const Handle first = image;
  addStep(graph, "second", {{image, Use::colorTarget}});
  EXPECT_EQ(image.version, 2u);
  EXPECT_EQ(graph.needsOf(std::vector{first}).steps, (std::vector<bool>{true, false}));
  EXPECT_EQ(graph.needsOf(std::vector{image}).steps, (std::vector<bool>{true, true}));
}

// -- What is not the graph's

TEST(FrameGraph, importsComeAndGoInTheirLayouts) {
  FrameGraph graph;
  const Outside before{kColor, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
                       VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  const Outside after{VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                      VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
  Handle in = graph.importImage("in", kImage, before),
         out = graph.importImage("out", kImage, Outside{}, after);
  addStep(graph, "draw", {{in, Use::sampledByFragment}, {out, Use::colorTarget}});
  const FrameGraph::Needs needs = graph.needsOf({});  // what is handed on is wanted
  ASSERT_TRUE(needs.steps[0]);
  const auto plan = graph.planBarriers(needs);
  const Barrier& read = *find(plan[0], in);
  EXPECT_EQ(read.sourceStages, kColor);
  EXPECT_EQ(read.sourceAccess, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
  EXPECT_EQ(read.oldLayout, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
  EXPECT_EQ(read.newLayout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  EXPECT_EQ(find(plan[0], out)->oldLayout, VK_IMAGE_LAYOUT_UNDEFINED);
  EXPECT_EQ(find(plan[0], out)->sourceStages, VK_PIPELINE_STAGE_2_NONE);
  const Barrier& handed = *find(plan[1], out);
  EXPECT_EQ(handed.sourceStages, kColor);
  EXPECT_TRUE(handed.sourceAccess & VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
  EXPECT_EQ(handed.targetStages, after.stages);
  EXPECT_EQ(handed.targetAccess, after.access);
  EXPECT_EQ(handed.oldLayout, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
  EXPECT_EQ(handed.newLayout, after.layout);
  EXPECT_EQ(find(plan[1], in), nullptr);
}

// Without a word on outside they are as the frame before has left them, contents and layout.
TEST(FrameGraph, whatLivesLongerKeepsItsContents) {
  FrameGraph graph;
  Handle image = graph.importImage("kept", kImage), result = graph.addImage("result", kImage);
  addStep(graph, "draw", {{image, Use::sampledByFragment}, {result, Use::colorTarget}});
  addStep(graph, "write", {{image, Use::copyTarget}});
  const FrameGraph::Needs needs = graph.needsOf(std::vector{image, result});
  const auto plan = graph.planBarriers(needs);
  EXPECT_EQ(find(plan[0], image)->oldLayout, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  EXPECT_EQ(find(plan[0], image)->sourceAccess, VK_ACCESS_2_TRANSFER_WRITE_BIT);
}

// Of the graph's own, one that is kept alone.
TEST(FrameGraph, whatIsKeptIsAsTheFrameBeforeHasLeftIt) {
  FrameGraph graph;
  Handle kept = graph.addKeptImage("kept", kImage), other = graph.addImage("other", kImage),
         result = graph.addImage("result", kImage);
  addStep(graph, "draw", {{kept, Use::colorTarget}, {other, Use::copyTarget}});
  addStep(graph, "use",
          {{kept, Use::sampledByFragment}, {other, Use::sampledByFragment}, {result, Use::colorTarget}});
  const FrameGraph::Needs needs = graph.needsOf(std::vector{result});
  ASSERT_TRUE(needs.steps[0]);
  const auto plan = graph.planBarriers(needs);
  EXPECT_EQ(find(plan[0], kept)->oldLayout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  EXPECT_EQ(find(plan[0], kept)->newLayout, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
  EXPECT_EQ(find(plan[0], other)->oldLayout, VK_IMAGE_LAYOUT_UNDEFINED);
}

TEST(FrameGraph, sizesFollowTheFrame) {
  const ImageShape::Frame frame{1281, 721, 2};
  ImageDesc desc = ImageShape{.format = kImage.format}.at(frame);
  EXPECT_EQ(desc.width, 1281u);
  EXPECT_EQ(desc.height, 721u);
  EXPECT_EQ(desc.layers, 2u);
  desc = ImageShape{.format = kImage.format, .overX = 4, .overY = 4}.at(frame);
  EXPECT_EQ(desc.width, 321u);
  EXPECT_EQ(desc.height, 181u);
  desc =
      ImageShape{.format = kImage.format, .width = 2048, .height = 1024, .perView = false, .samples = 4}.at(
          frame);
  EXPECT_EQ(desc.width, 2048u);
  EXPECT_EQ(desc.height, 1024u);
  EXPECT_EQ(desc.layers, 1u);
  EXPECT_EQ(desc.samples, 4u);
}

TEST(FrameGraph, trafficIsOfWholeImages) {
  FrameGraph graph;
  // 10 x 6 pixels, two views: 120 of the frame's size, 15 a view at a half.
  Handle color = graph.addImage("color", {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .samples = 4}),
         resolved = graph.addImage("resolved", {.format = VK_FORMAT_R16G16B16A16_SFLOAT}),
         half = graph.addImage("half", {.format = VK_FORMAT_R8G8B8A8_UNORM, .overX = 2, .overY = 2}),
         map = graph.addImage("map",
                              {.format = VK_FORMAT_D32_SFLOAT, .width = 7, .height = 3, .perView = false}),
         buffer = graph.addBuffer("buffer", 1000);
  const ImageShape::Frame frame{10, 6, 2};
  addStep(graph, "map", {{map, Use::depthTarget}});
  addStep(graph, "draw",
          {{map, Use::sampledByFragment},
           {color, Use::colorTarget},
           {resolved, Use::resolveTarget},
           {buffer, Use::storageBufferWrite}});
  addStep(graph, "shrink", {{resolved, Use::sampledByFragment}, {half, Use::colorTarget}});
  addStep(graph, "over", {{half, Use::colorTarget}});
  const FrameGraph::Traffic expected[] = {{0, 84}, {84, 120 * 8 * 4 + 120 * 8}, {960, 120}, {120, 120}};
  for (size_t step = 0; step < 4; ++step) EXPECT_EQ(graph.trafficOf(step, frame), expected[step]) << step;
}

TEST(FrameGraph, theDumpShowsEveryStepAndVersion) {
  FrameGraph graph;
  Handle image = graph.addImage("a \"name\"", {.format = kImage.format, .overX = 2, .overY = 2}),
         buffer = graph.addBuffer("numbers", 64), vain = graph.addImage("vain", kImage);
  addStep(graph, "first", {{image, Use::colorTarget}, {buffer, Use::storageBufferWrite}});
  addStep(graph, "second", {{image, Use::colorTarget}, {buffer, Use::indirectBuffer}});
  addStep(graph, "in vain", {{vain, Use::colorTarget}});
  const std::string dot = graph.toDot(graph.needsOf(std::vector{image}), {100, 50, 2});
  for (const char* const part :
       {"digraph", "first", "second", "in vain", "a \\\"name\\\", version 1\\n50 x 25 x 2 rgba8",
        "a \\\"name\\\", version 2", "numbers\\n64 bytes", "s0 -> r0v1;", "r0v1 -> s1;", "s1 -> r0v2;",
        "r1v1 -> s1;", "s2 -> r2v1 [color=gray70];"})
    EXPECT_NE(dot.find(part), std::string::npos) << part << "\n" << dot;
  EXPECT_EQ(dot.find("r0v0"), std::string::npos) << dot;
}

// -- The model

// What has happened to a resource since its last write: which stages know of it, and who has read it since.
struct Memory {
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  std::map<VkPipelineStageFlags2, bool> sees;     // single stage -> whether the last write is visible there
  VkPipelineStageFlags2 writer = 0, readers = 0;  // whose work has not been waited for
};

// Random graphs of images and buffers, of which some results are wanted and which share memory, replayed for
// two frames: every use must find its resource in the right layout, see the last write, and write only when
// nobody is at it any more, nor at what else lies in its memory.
TEST(FrameGraph, randomGraphsKeepVulkansRules) {
  constexpr Use kImageUses[] = {Use::sampledByVertex,   Use::sampledByFragment, Use::sampledByCompute,
                                Use::colorTarget,       Use::resolveTarget,     Use::copySource,
                                Use::storageImageWrite, Use::copyTarget,        Use::storageImageReadWrite};
  constexpr Use kBufferUses[] = {
      Use::storageBufferRead, Use::storageBufferWrite,     Use::vertexBuffer,
      Use::indexBuffer,       Use::indirectBuffer,         Use::copySource,
      Use::copyTarget,        Use::storageBufferReadWrite, Use::storageBufferReadByVertex};
  size_t shared = 0, skipped = 0, checked = 0;
  for (uint32_t seed = 0; seed < 600; ++seed) {
    std::mt19937 random(seed);
    FrameGraph graph;
    constexpr size_t kImages = 5, kResources = 7;
    std::vector<Handle> handles;
    for (size_t r = 0; r < kResources; ++r)
      handles.push_back(r < kImages ? graph.addImage("i", kImage) : graph.addBuffer("b", 64));
    const size_t stepCount = 1 + random() % 12;
    for (size_t s = 0; s < stepCount; ++s) {
      graph.addStep("s");
      for (size_t r = 0; r < kResources; ++r) {
        if (random() % 3) continue;
        Use use = r < kImages ? kImageUses[random() % std::size(kImageUses)]
                              : kBufferUses[random() % std::size(kBufferUses)];
        if (!useInfo(use).writes && handles[r].version == 0)
          use = r < kImages ? Use::colorTarget : Use::storageBufferWrite;
        handles[r] = graph.use(handles[r], use);
      }
    }
    std::vector<Handle> wanted;
    for (const Handle& handle : handles)
      if (handle.version > 0 && random() % 2) wanted.push_back(handle);
    const FrameGraph::Needs needs = graph.needsOf(wanted);
    std::vector<std::vector<uint32_t>> sharing(kResources);
    for (uint32_t a = 0; a < kImages; ++a)
      for (uint32_t b = 0; b < kImages; ++b) {
        const FrameGraph::Needs::Life &one = needs.lives[a], &other = needs.lives[b];
        if (a != b && one.isUsed && other.isUsed && (one.last < other.first || other.last < one.first))
          sharing[a].push_back(b), ++shared;
      }
    const auto plan = graph.planBarriers(needs, sharing);
    ASSERT_EQ(plan.size(), stepCount + 1);
    std::vector<Memory> state(kResources);
    for (int frame = 0; frame < 2; ++frame) {
      std::vector<bool> usedThisFrame(kResources, false);
      for (size_t s = 0; s < stepCount; ++s) {
        const std::string where = "seed " + std::to_string(seed) + " step " + std::to_string(s);
        if (!needs.steps[s]) {
          ASSERT_TRUE(plan[s].empty()) << where;
          ++skipped;
          continue;
        }
        const auto& uses = graph.steps()[s].uses;
        for (const FrameGraph::StepUse& use : uses) {
          const uint32_t r = use.handle.resource;
          const Barrier* const barrier = find(plan[s], use.handle);
          for (const uint32_t other : sharing[r]) {
            if (usedThisFrame[r]) continue;
            const VkPipelineStageFlags2 atIt = state[other].writer | state[other].readers;
            ASSERT_TRUE(atIt == 0 || (barrier && barrier->takesOver && (atIt & ~barrier->sourceStages) == 0))
                << "memory taken from under somebody's hands, " << where;
          }
        }
        for (const Barrier& barrier : plan[s]) {
          Memory& memory = state[barrier.resource];
          ASSERT_TRUE(std::any_of(
              uses.begin(), uses.end(),
              [&](const FrameGraph::StepUse& use) { return use.handle.resource == barrier.resource; }))
              << "a barrier for nothing, " << where;
          if (barrier.resource < kImages) {
            // From the right layout, or discarding; and only the first use of a frame may discard.
            if (barrier.oldLayout == VK_IMAGE_LAYOUT_UNDEFINED) {
              ASSERT_FALSE(usedThisFrame[barrier.resource]) << "contents are lost, " << where;
            } else {
              ASSERT_EQ(barrier.oldLayout, memory.layout) << where;
            }
            if (barrier.oldLayout != barrier.newLayout) {
              // A transition writes: whoever is at it must be waited for, and only the barrier's target sees
              // it.
              ASSERT_EQ((memory.writer | memory.readers) & ~barrier.sourceStages, 0u)
                  << "a transition under somebody's hands, " << where;
              memory.sees.clear();
              memory.writer = barrier.targetStages, memory.readers = 0;
            }
            memory.layout = barrier.newLayout;
          }
          if ((memory.writer & ~barrier.sourceStages) == 0 || barrier.oldLayout != barrier.newLayout)
            for (int bit = 0; bit < 64; ++bit)
              if (barrier.targetStages >> bit & 1) memory.sees[1ull << bit] = true;
        }
        for (const FrameGraph::StepUse& use : uses) {
          const UseInfo info = useInfo(use.use);
          const uint32_t r = use.handle.resource;
          Memory& memory = state[r];
          const Barrier* const barrier = find(plan[s], use.handle);
          if (r < kImages) {
            ASSERT_EQ(memory.layout, info.layout) << where;
          }
          if (info.writes) {
            const VkPipelineStageFlags2 atIt = memory.writer | memory.readers;
            const bool transitioned = barrier && barrier->oldLayout != barrier->newLayout;
            ASSERT_TRUE(atIt == 0 || transitioned || (barrier && (atIt & ~barrier->sourceStages) == 0))
                << "a write under somebody's hands, " << where;
            memory.sees.clear();
            memory.writer = info.stages, memory.readers = 0;
          } else {
            ASSERT_TRUE(memory.sees[info.stages]) << "a read that sees nothing, " << where;
            memory.readers |= info.stages;
          }
          usedThisFrame[r] = true;
          ++checked;
        }
      }
    }
  }
  EXPECT_GT(shared, 200u);
  EXPECT_GT(skipped, 200u);
  EXPECT_GT(checked, 2000u);
}

// -- Mistakes of ours

class FrameGraphDeathTest : public testing::Test {
 protected:
  void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
  FrameGraph graph;
  Handle image = graph.addImage("a", kImage), buffer = graph.addBuffer("b", 64);
};

TEST_F(FrameGraphDeathTest, readingBeforeWriting) {
  EXPECT_DEATH(addStep(graph, "read", {{image, Use::sampledByFragment}}), "read before it was written");
  EXPECT_DEATH(addStep(graph, "read", {{buffer, Use::vertexBuffer}}), "read before it was written");
}

TEST_F(FrameGraphDeathTest, usingOneResourceTwiceInAStep) {
  EXPECT_DEATH(addStep(graph, "both", {{image, Use::colorTarget}, {image, Use::sampledByFragment}}),
               "used twice");
}

TEST_F(FrameGraphDeathTest, buffersAsImagesAndUnknownResources) {
  EXPECT_DEATH(addStep(graph, "draw", {{buffer, Use::colorTarget}}), "an image used as a buffer");
  EXPECT_DEATH(addStep(graph, "write", {{image, Use::storageBufferWrite}}), "an image used as a buffer");
  Handle unknown{7}, none;
  EXPECT_DEATH(addStep(graph, "draw", {{unknown, Use::colorTarget}}), "an unknown resource");
  EXPECT_DEATH(addStep(graph, "draw", {{none, Use::colorTarget}}), "an unknown resource");
}

TEST_F(FrameGraphDeathTest, versionsThatAreNoLonger) {
  Handle old = image;
  addStep(graph, "draw", {{image, Use::colorTarget}});
  EXPECT_DEATH(addStep(graph, "draw", {{old, Use::colorTarget}}), "written over");
  EXPECT_DEATH(graph.use(image, Use::copySource), "used twice");
}

}  // namespace
}  // namespace scumble::gpu
