#include "passes/facts/facts.h"

#include <array>
#include <limits>
#include <string_view>

#include "frame/drawn_image.h"
#include "frame/geometry_step.h"
#include "frame/material_params.h"
#include "frame/metatexture.h"
#include "shaders/facts_frag.h"
#include "shaders/facts_vert.h"

namespace scumble::passes {

using namespace frame;

namespace {

constexpr Aov kFacts[] = {
    {.name = "depth", .channels = {"R"}, .needsFloat = true},
    {.name = "position", .channels = {"R", "G", "B"}, .needsFloat = true},
    {.name = "normal", .channels = {"R", "G", "B"}, .needsFloat = true},
    {.name = "uv", .channels = {"R", "G"}, .needsFloat = true},
    {.name = "uv-gradient", .needsFloat = true},
    {.name = "metatexture", .needsFloat = true},
    {.name = "motion", .channels = {"R", "G"}, .needsFloat = true},
    {.name = "id", .channels = {"R", "G"}, .needsFloat = true, .namesObjects = true},
};
constexpr size_t kFactCount = std::size(kFacts);

// Mirrors the block of facts.frag.
struct FactsMaterial {
  MetaTextureUniforms meta;
  float number;
};

class Facts : public Pass {
 public:
  const char* name() const override { return "facts"; }
  std::span<const Aov> aovs() const override { return kFacts; }

  void declare(FrameBuilder& frame, uint32_t) override {
    configuration_ = frame.configuration();
    frame.step("facts", [this](VkCommandBuffer commands) { record(commands); });
    GeometryStep::use(frame);
    frame.use(frame.get(kPreviousVertices), gpu::Use::vertexBuffer);
    depth_.declare(frame, "facts depth", kDepthFormat);
    frame.give(kDepthOfFacts, depth_.image());
    for (size_t i = 0; i < kFactCount; ++i) {
      facts_[i].declare(frame, kFacts[i].name, kFloats);
      frame.offer(kFacts[i], {facts_[i].image()});
    }
  }

  void create(FrameBuilder& frame) override {
    materials_.create(frame);
    layout_ = gpu::SetLayout(frame.device(), {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC,
                                               VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT}});
    sets_ = gpu::DescriptorSets(frame.device(), layout_);
    materials_.bind(sets_, 0);
    examples_ = &frame.examples();
    GeometryStepDesc desc;
    desc.vertex = {shaders::facts_vert};
    desc.fragment = {shaders::facts_frag};
    desc.inputs = kPosition | kNormal | kUv0 | kUv1 | kColor | kDPdu | kDPdv | kPatternUv | kPreviousPosition;
    desc.colorFormats.assign(kFactCount, kFloats);
    desc.viewMask = configuration_.views().mask();
    desc.viewCount = configuration_.viewCount;
    desc.passLayout = &layout_;
    desc.materialStrides = {materials_.kStride};
    step_.create(frame, desc);
  }
  void bind(const gpu::GraphResources& resources) override { resources_ = &resources; }

  void update(const FrameInput& input) override {
    std::vector<MaterialVariant> variants;
    for (size_t m = 0; m < input.scene.materialCount(); ++m) {
      const auto params = input.knobs.of<WarpMetaTextureParams>(m);
      const MetaTextureUse use =
          metaTextureUse(params, 0b0011, input.look, *examples_, input.uniforms.pixelScale, glm::vec2(0.0f));
      materials_.write(m, {use.meta.uniforms(), float(input.scene.materialNumber(m))});
      variants.push_back(
          {.features = use.meta.features(), .tangents = tangentOptions(params, input.uniforms)});
    }
    step_.specialise(0, std::move(variants));
  }

 private:
  void record(VkCommandBuffer commands) const {
    // What is not there is infinitely far.
    constexpr float kFar = std::numeric_limits<float>::infinity();
    static_assert(std::string_view(kFacts[0].name) == "depth");
    std::array<gpu::Target, kFactCount> colors;
    for (size_t i = 0; i < kFactCount; ++i) {
      colors[i] = facts_[i].target(*resources_);
      if (i == 0) colors[i].clear.color = {{kFar, kFar, kFar, kFar}};
    }
    const gpu::Target depth = depth_.target(*resources_);
    gpu::drawViews(commands, configuration_.views(), colors, &depth,
                   [&](uint32_t firstView) { step_.draw(commands, &sets_, firstView); });
  }

  std::array<DrawnImage, kFactCount> facts_;
  DrawnImage depth_;
  Configuration configuration_;
  MaterialBlocks<FactsMaterial> materials_;
  ExampleTextures* examples_ = nullptr;
  const gpu::GraphResources* resources_ = nullptr;
  gpu::SetLayout layout_;
  gpu::DescriptorSets sets_;
  GeometryStep step_;
};

}  // namespace

std::unique_ptr<Pass> makeFacts() {
  return std::make_unique<Facts>();
}

}  // namespace scumble::passes
