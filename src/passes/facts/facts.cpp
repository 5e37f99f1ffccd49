#include "passes/facts/facts.h"

#include <array>
#include <limits>

#include "frame/geometry_step.h"
#include "frame/material_params.h"
#include "frame/metatexture.h"
#include "shaders/facts_frag.h"
#include "shaders/facts_vert.h"

namespace scumble::passes {

using namespace frame;

namespace {

constexpr std::array kFacts{Slot::factDepth,  Slot::position,    Slot::normal, Slot::uv,
                            Slot::uvGradient, Slot::metatexture, Slot::motion, Slot::id};

// Mirrors the block of facts.frag.
struct FactsMaterial {
  MetaTextureUniforms meta;
};

class Facts : public Pass {
 public:
  const char* name() const override { return "facts"; }

  void declare(FrameBuilder& frame) override {
    const Configuration& c = frame.configuration();
    depth_ = frame.transient("facts depth", {VK_FORMAT_D32_SFLOAT, c.width, c.height, c.viewCount});
    std::vector<gpu::ResourceUse> uses{{frame.finalVertices(), gpu::Use::vertexBuffer},
                                       {depth_, gpu::Use::depthTarget}};
    for (const Slot fact : kFacts) uses.push_back({frame.slot(fact), gpu::Use::colorTarget});
    for (size_t i = 0; i < kFacts.size(); ++i) targets_[i] = frame.slot(kFacts[i]);
    materials_.declare(frame);
    configuration_ = frame.configuration();
    frame.addStep("facts", std::move(uses), [this](VkCommandBuffer commands) { record(commands); });
  }

  void create(FrameBuilder& frame, const FrameResources& resources) override {
    resources_ = &resources;
    scene_ = &frame.scene();
    layout_ = gpu::SetLayout(frame.device(), {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC,
                                               VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT}});
    sets_ = gpu::DescriptorSets(frame.device(), layout_);
    materials_.bind(sets_, 0);
    examples_ = &frame.examples();
    GeometryStepDesc desc;
    desc.vertex = {shaders::facts_vert};
    desc.fragment = {shaders::facts_frag};
    desc.inputs = kPosition | kNormal | kUv0 | kUv1 | kColor | kDPdu | kDPdv | kPatternUv | kPreviousPosition;
    for (const Slot fact : kFacts) desc.colorFormats.push_back(slotInfo(fact).format);
    desc.viewMask = configuration_.views().mask();
    desc.viewCount = configuration_.viewCount;
    desc.passLayout = &layout_;
    desc.materialStrides = {materials_.kStride};
    step_.create(frame.device(), resources, frame.scene(), desc);
  }

  void update(const FrameInput& input) override {
    std::vector<MaterialVariant> variants;
    for (size_t m = 0; m < input.scene.materialCount(); ++m) {
      const std::string& name = input.scene.materialName(m);
      const auto params = input.look.getForMaterial<WarpMetaTextureParams>(name);
      const MetaTextureUse use =
          metaTextureUse(params, 0b0011, input.look, *examples_, input.uniforms.pixelScale, glm::vec2(0.0f));
      materials_.write(m, {use.meta.uniforms()});
      variants.push_back({.options = use.meta.features() | tangentOptions(params, input.uniforms) << 11});
    }
    step_.specialise(input.scene, 0, std::move(variants));
  }

 private:
  void record(VkCommandBuffer commands) const {
    std::array<gpu::Target, kFacts.size()> colors;
    for (size_t i = 0; i < kFacts.size(); ++i) colors[i].image = &resources_->image(targets_[i]);
    const float infinity = std::numeric_limits<float>::infinity();
    static_assert(kFacts[0] == Slot::factDepth);
    colors[0].clear.color = {{infinity, infinity, infinity, infinity}};
    const gpu::Target depth{&resources_->image(depth_), nullptr, {}};
    gpu::drawViews(commands, configuration_.views(), colors, &depth, [&](uint32_t firstView) {
      step_.draw(commands, *resources_, *scene_, &sets_, firstView);
    });
  }

  std::array<gpu::ResourceId, kFacts.size()> targets_{};
  gpu::ResourceId depth_ = 0;
  Configuration configuration_;
  MaterialBlocks<FactsMaterial> materials_;
  ExampleTextures* examples_ = nullptr;
  const FrameResources* resources_ = nullptr;
  const SceneOnGpu* scene_ = nullptr;
  gpu::SetLayout layout_;
  gpu::DescriptorSets sets_;
  GeometryStep step_;
};

}  // namespace

std::unique_ptr<Pass> makeFacts() {
  return std::make_unique<Facts>();
}

}  // namespace scumble::passes
