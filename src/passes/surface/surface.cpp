#include "passes/surface/surface.h"

#include <algorithm>
#include <cmath>

#include "frame/geometry_step.h"
#include "frame/light.h"
#include "frame/material_params.h"
#include "frame/metatexture.h"
#include "shaders/surface_frag.h"
#include "shaders/surface_ocean_frag.h"
#include "shaders/surface_painted_frag.h"
#include "shaders/surface_painted_vert.h"
#include "shaders/surface_vert.h"

namespace scumble::passes {

using namespace frame;

namespace {

// Mirrors SurfaceUniforms in surface.glsl.
struct SurfaceUniforms {
  float terminator, terminatorSharpness;
};

// Mirrors PaintedMaterial in surface.glsl.
struct PaintedMaterial {
  MetaTextureUniforms meta;
  float amount;
};

class Surface : public Pass {
 public:
  explicit Surface(SurfaceLayer layer)
      : isBehind_(layer == SurfaceLayer::behind), targets_(isBehind_ ? kBehindTargets : kFirstTargets) {}
  const char* name() const override { return isBehind_ ? "behind" : "surface"; }

  void declare(FrameBuilder& frame) override {
    const Configuration& c = frame.configuration();
    samples_ = isBehind_ ? 1 : c.samples;
    configuration_ = frame.configuration();
    std::vector<gpu::ResourceUse> uses{
        {frame.finalVertices(), gpu::Use::vertexBuffer},
        {shadowMap_ = frame.slot(Slot::shadowMap), gpu::Use::sampledByFragment}};
    if (configuration_.ocean)
      for (size_t i = 0; i < 2; ++i)
        uses.push_back({ocean_[i] = frame.slot(i == 0 ? Slot::oceanLit : Slot::oceanShadowed),
                        gpu::Use::sampledByFragment});
    if (isBehind_) uses.push_back({firstDepth_ = frame.slot(Slot::depth), gpu::Use::sampledByFragment});
    for (size_t i = 0; i < targets_.size(); ++i) {
      const bool isDepth = i == kDepthTarget;
      resolved_[i] = frame.slot(targets_[i]);
      drawn_[i] = samples_ > 1 ? frame.multisampled(targets_[i]) : resolved_[i];
      uses.push_back({drawn_[i], isDepth ? gpu::Use::depthTarget : gpu::Use::colorTarget});
      if (samples_ > 1)
        uses.push_back({resolved_[i], isDepth ? gpu::Use::depthResolveTarget : gpu::Use::resolveTarget});
    }
    uniforms_ = frame.uniform(sizeof(SurfaceUniforms));
    params_.declare(frame);
    painted_.declare(frame);
    frame.addStep(name(), std::move(uses), [this](VkCommandBuffer commands) { record(commands); });
  }

  void create(FrameBuilder& frame, const FrameResources& resources) override {
    resources_ = &resources;
    scene_ = &frame.scene();
    frame_ = &frame;
    constexpr VkShaderStageFlags kBoth = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
    constexpr VkDescriptorType kTexture = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    layout_ = gpu::SetLayout(frame.device(),
                             {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, VK_SHADER_STAGE_FRAGMENT_BIT},
                              {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, kBoth},
                              {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_SHADER_STAGE_FRAGMENT_BIT},
                              {kTexture, VK_SHADER_STAGE_FRAGMENT_BIT},
                              {kTexture, VK_SHADER_STAGE_FRAGMENT_BIT},
                              {kTexture, VK_SHADER_STAGE_FRAGMENT_BIT},
                              {kTexture, VK_SHADER_STAGE_FRAGMENT_BIT},
                              {kTexture, VK_SHADER_STAGE_FRAGMENT_BIT},
                              {kTexture, VK_SHADER_STAGE_FRAGMENT_BIT}});
    // One set for each material, since each may have a texture of its own.
    const size_t materials = frame.scene().materialCount();
    sets_ = gpu::DescriptorSets(frame.device(), layout_, uint32_t(materials));
    gpu::SamplerDesc compare;
    compare.compareLess = true;
    for (size_t m = 0; m < materials; ++m) {
      params_.bind(sets_, 0, m);
      painted_.bind(sets_, 1, m);
      sets_.writeBuffer(m, 2, uniforms_.buffer, uniforms_.offset, uniforms_.size);
      sets_.writeTexture(m, 3, resources.image(shadowMap_).view(), frame.samplers().get(compare));
      // The first layer does not look at it.
      sets_.writeTexture(m, 6, resources.image(isBehind_ ? firstDepth_ : shadowMap_).view(),
                         frame.samplers().get({VK_FILTER_NEAREST}));
      // Nor does anything but the ocean at these.
      for (uint32_t i = 0; i < 2; ++i)
        sets_.writeTexture(m, 7 + i, resources.image(configuration_.ocean ? ocean_[i] : shadowMap_).view(),
                           frame.samplers().get({VK_FILTER_NEAREST}));
    }

    GeometryStepDesc desc;
    desc.vertex = {shaders::surface_vert};
    desc.fragment = {shaders::surface_frag};
    desc.inputs = kPosition | kNormal | kUv0 | kUv1 | kColor;
    desc.paintedVertex = {shaders::surface_painted_vert};
    desc.paintedFragment = {shaders::surface_painted_frag};
    desc.oceanFragment = {shaders::surface_ocean_frag};
    desc.paintedInputs = desc.inputs | kDPdu | kDPdv | kPatternUv;
    for (size_t i = 0; i < kDepthTarget; ++i) desc.colorFormats.push_back(slotInfo(targets_[i]).format);
    desc.samples = samples_;
    desc.viewMask = configuration_.views().mask();
    desc.viewCount = configuration_.viewCount;
    desc.blends = !isBehind_;
    desc.constant = constant(false);
    desc.passLayout = &layout_;
    desc.materialStrides = {params_.kStride, painted_.kStride};
    step_.create(frame.device(), resources, frame.scene(), desc);
  }

  void update(const FrameInput& input) override {
    params_.update(input);
    const LightParams light = input.look.get<LightParams>();
    uniforms_.write(SurfaceUniforms{light.terminator, light.terminatorSharpness});

    std::vector<MaterialVariant> variants;
    for (size_t m = 0; m < input.scene.materialCount(); ++m) {
      const TextureParams texture = input.scene.knobs<TextureParams>(input.look, m);
      auto metaParams = sameRows(input.scene.knobs<TextureMetaTextureParams>(input.look, m));
      // What is not painted needs no texture of its own.
      if (texture.amount <= 0) metaParams = WarpMetaTextureParams();
      const MetaTextureUse use = metaTextureUse(metaParams, 0b0111, input.look, frame_->examples(),
                                                input.uniforms.pixelScale, patternShift(input.seed));
      painted_.write(m, {use.meta.uniforms(), texture.amount});
      MaterialVariant variant;
      if (int(m) == input.scene.oceanMaterial()) {
        variant.isOcean = true;
      } else {
        variant.sets = input.scene.colorSets(m);
        variant.isPainted = texture.amount > 0;
        if (variant.isPainted)
          variant.options = use.meta.features() | tangentOptions(metaParams, input.uniforms) << 11 |
                            uint32_t(texture.blend) << 14;
      }
      variants.push_back(variant);
      sets_.writeTexture(m, 4, use.image().view(), frame_->samplers().get(use.sampler()));
      sets_.writeTexture(m, 5, use.inverse().view(),
                         frame_->samplers().get(ExampleTextures::kInverseSampler));
    }
    step_.specialise(input.scene, constant(input.uniforms.lightCount > 0), std::move(variants));
  }

 private:
  static constexpr std::array kFirstTargets{Slot::shadow, Slot::lit, Slot::shadowed, Slot::depth};
  static constexpr std::array kBehindTargets{Slot::behindShadow, Slot::behindLit, Slot::behindShadowed,
                                             Slot::behindDepth};
  static constexpr size_t kDepthTarget = 3;

  // kOptions in the shaders.
  uint32_t constant(bool lights) const { return (isBehind_ ? 1 : 0) | (lights ? 2 : 0); }

  void record(VkCommandBuffer commands) const {
    const auto target = [&](size_t i) {
      return gpu::Target{
          &resources_->image(drawn_[i]), samples_ > 1 ? &resources_->image(resolved_[i]) : nullptr, {}};
    };
    const gpu::Target colors[] = {target(0), target(1), target(2)}, depth = target(3);
    gpu::drawViews(commands, configuration_.views(), colors, &depth, [&](uint32_t firstView) {
      step_.draw(commands, *resources_, *scene_, &sets_, firstView);
    });
  }

  bool isBehind_;
  std::array<Slot, 4> targets_;
  gpu::ResourceId shadowMap_ = 0, firstDepth_ = 0;
  std::array<gpu::ResourceId, 2> ocean_{};
  std::array<gpu::ResourceId, 4> drawn_{}, resolved_{};
  uint32_t samples_ = 1;
  Configuration configuration_;
  UniformSlice uniforms_;
  MaterialParams<SurfaceParams> params_;
  MaterialBlocks<PaintedMaterial> painted_;
  FrameBuilder* frame_ = nullptr;
  const FrameResources* resources_ = nullptr;
  const SceneOnGpu* scene_ = nullptr;
  gpu::SetLayout layout_;
  gpu::DescriptorSets sets_;
  GeometryStep step_;
};

}  // namespace

std::unique_ptr<Pass> makeSurface(SurfaceLayer layer) {
  return std::make_unique<Surface>(layer);
}

}  // namespace scumble::passes
