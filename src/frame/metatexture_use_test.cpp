// What a use of MetaTexture counts by, and how its copies lie.
#include <gtest/gtest.h>

#include <set>

#include "frame/metatexture.h"
#include "frame/vertex_input.h"

namespace scumble::frame {
namespace {

using namespace shared;

// One eye, of a projection whose sides are so far from its axis, as tangents.
FrameUniforms lookingThrough(float aside, float above) {
  FrameUniforms frame{};
  frame.cyclopeanNdcToEyeRay = {aside, above, 0, 0};
  frame.worldToCyclopean = glm::mat4(1);
  for (ViewUniforms& view : frame.views) view.worldToClip = frame.worldToCyclopean;
  return frame;
}

// `auto` (docs/metatexture.md): not for narrow views, wholly for wide ones and in part between them, by the
// farther side; and never without perspective.
TEST(MetaTextureUse, countsByAnglesWhereAViewIsWide) {
  WarpMetaTextureParams params;
  struct {
    float aside, above;
    uint32_t options;
  } const views[] = {{0.3f, 0.3f, 0},
                     {0.69f, 0.2f, 0},
                     {0.8f, 0.2f, kRadial | kRadialInPart},
                     {0.2f, 0.99f, kRadial | kRadialInPart},
                     {1.01f, 0.2f, kRadial},
                     {0.2f, 3, kRadial}};
  for (const auto& [aside, above, options] : views) {
    FrameUniforms frame = lookingThrough(aside, above);
    params.radial = 2;
    EXPECT_EQ(tangentOptions(params, frame), options) << aside << ", " << above;
    // A view to one side counts by its farther edge.
    frame.cyclopeanNdcToEyeRay = {0.5f * aside, 0.5f * above, -0.5f * aside, 0.5f * above};
    EXPECT_EQ(tangentOptions(params, frame), options) << aside << ", " << above;
    params.radial = 0;
    EXPECT_EQ(tangentOptions(params, frame), 0u);
    params.radial = 1;
    EXPECT_EQ(tangentOptions(params, frame), uint32_t(kRadial)) << "whoever says so has all of it";
    params.radial = 2;
    for (ViewUniforms& view : frame.views) view.orthographic = 1;
    EXPECT_EQ(tangentOptions(params, frame), 0u) << "parallel";
  }
}

TEST(MetaTextureUse, countsByTheViewBetweenTheEyesWhereThereAreTwo) {
  WarpMetaTextureParams params;
  params.radial = 0;
  FrameUniforms frame = lookingThrough(0.3f, 0.3f);
  EXPECT_EQ(tangentOptions(params, frame), 0u) << "both stand in one place";
  for (const int eye : {0, 1}) {
    FrameUniforms two = frame;
    two.views[eye].worldToClip[3].x = 0.1f;
    EXPECT_EQ(tangentOptions(params, two), uint32_t(kCyclopean));
    params.cyclopean = false;
    EXPECT_EQ(tangentOptions(params, two), 0u);
    params.cyclopean = true;
  }
  params.gradients = 1;
  EXPECT_EQ(tangentOptions(params, frame), uint32_t(kFragmentGradients));
  frame.eyeToSphere = glm::mat3(1);
  EXPECT_EQ(tangentOptions(params, frame), uint32_t(kFragmentGradients | kByAngle)) << "part of a sphere";
}

// No two sets of choices are one word: shaders are specialised to it.
TEST(MetaTextureUse, everyChoiceHasABitOfItsOwn) {
  std::set<uint32_t> words;
  size_t count = 0;
  for (const int mode : {0, 1, 2, 3})
    for (const int skew : {0, 1, 2})
      for (const int contrast : {0, 1, 2})
        for (int flags = 0; flags < 64; ++flags) {
          MetaTexture m;
          m.mode = mode, m.skew = skew, m.contrast = contrast;
          m.orient = flags & 1, m.wrapping = flags >> 1 & 1, m.skip = flags & 4 ? 0.1f : 0.0f;
          m.levelRotation = flags & 8 ? -0.5f : 0.0f, m.base = flags & 16 ? 3.0f : 2.0f;
          m.nested = flags >> 5 & 1;
          words.insert(m.features());
          EXPECT_EQ(m.uniforms().features, m.features());
          ++count;
        }
  EXPECT_EQ(words.size(), count);
}

// A seed moves patterns to anywhere in a copy; seed 0 leaves them.
TEST(MetaTextureUse, seedsMovePatterns) {
  EXPECT_EQ(patternShift(0), glm::vec2(0));
  std::set<std::pair<float, float>> places;
  glm::vec2 sum(0);
  constexpr int kSeeds = 1000;
  for (uint32_t seed = 1; seed <= kSeeds; ++seed) {
    const glm::vec2 shift = patternShift(seed);
    EXPECT_TRUE(shift.x >= 0 && shift.x < 1 && shift.y >= 0 && shift.y < 1) << seed;
    places.emplace(shift.x, shift.y);
    sum += shift / float(kSeeds);
  }
  EXPECT_GT(places.size(), size_t(kSeeds - 3));
  EXPECT_NEAR(sum.x, 0.5, 0.05);
  EXPECT_NEAR(sum.y, 0.5, 0.05);
  EXPECT_EQ(patternShift(7), patternShift(7));
}

// Attributes of vertices come at their locations, and only those that are asked for.
TEST(VertexInput, hasWhatIsAskedFor) {
  for (uint32_t inputs : {0u, 1u, 0x1FFFu, uint32_t(kPosition | kUv0 | kPatternUv)}) {
    gpu::GraphicsPipelineDesc desc;
    addVertexInput(desc, inputs);
    uint32_t found = 0;
    for (const VkVertexInputAttributeDescription& attribute : desc.vertexAttributes) {
      EXPECT_EQ(found & 1u << attribute.location, 0u);
      found |= 1u << attribute.location;
    }
    EXPECT_EQ(found, inputs);
  }
  // What lies in one buffer does not overlap in it.
  gpu::GraphicsPipelineDesc desc;
  addVertexInput(desc, kPosition | kNormal);
  ASSERT_EQ(desc.vertexAttributes.size(), 2u);
  EXPECT_EQ(desc.vertexAttributes[0].binding, desc.vertexAttributes[1].binding);
  EXPECT_NE(desc.vertexAttributes[0].offset, desc.vertexAttributes[1].offset);
}

}  // namespace
}  // namespace scumble::frame
