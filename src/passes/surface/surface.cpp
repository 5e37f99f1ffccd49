#include "passes/surface/surface.h"

#include <algorithm>
#include <cmath>

#include "frame/geometry_step.h"
#include "frame/light.h"
#include "frame/material_params.h"
#include "frame/metatexture.h"
#include "frame/ocean_maps.h"
#include "frame/palette.h"
#include "passes/surface/ocean.shared.h"
#include "shaders/surface_frag.h"
#include "shaders/surface_ocean_frag.h"
#include "shaders/surface_ocean_vert.h"
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
  MetaTexture meta;
  TangentOptions tangents;
  float amount;
  int32_t blend;
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
    ocean_ = frame.uniform(sizeof(shared::OceanPaint));
    frame.addStep(name(), std::move(uses), [this](VkCommandBuffer commands) { record(commands); });
  }

  void create(FrameBuilder& frame, const FrameResources& resources) override {
    resources_ = &resources;
    scene_ = &frame.scene();
    frame_ = &frame;
    if (frame.scene().oceanMaterial() >= 0) maps_.emplace(frame.device());
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
                              {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_SHADER_STAGE_FRAGMENT_BIT},
                              {kTexture, VK_SHADER_STAGE_FRAGMENT_BIT},
                              {kTexture, VK_SHADER_STAGE_FRAGMENT_BIT},
                              {kTexture, VK_SHADER_STAGE_FRAGMENT_BIT},
                              {kTexture, VK_SHADER_STAGE_FRAGMENT_BIT},
                              {kTexture, VK_SHADER_STAGE_FRAGMENT_BIT},
                              {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_VERTEX_BIT}});
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
      // What only the ocean reads: for others, anything.
      sets_.writeBuffer(m, 7, ocean_.buffer, ocean_.offset, ocean_.size);
      for (uint32_t binding = 8; binding <= 12; ++binding)
        sets_.writeTexture(m, binding, resources.image(shadowMap_).view(), frame.samplers().get({}));
      sets_.writeBuffer(m, 13,
                        frame.scene().waves() ? frame.scene().waves()->buffer().handle()
                                              : frame.scene().motion().objects());
    }

    GeometryStepDesc desc;
    desc.vertex = {shaders::surface_vert};
    desc.fragment = {shaders::surface_frag};
    desc.inputs = kPosition | kNormal | kUv0 | kUv1 | kColor;
    desc.paintedVertex = {shaders::surface_painted_vert};
    desc.paintedFragment = {shaders::surface_painted_frag};
    desc.oceanVertex = {shaders::surface_ocean_vert};
    desc.oceanFragment = {shaders::surface_ocean_frag};
    desc.paintedInputs = desc.inputs | kDPdu | kDPdv | kPatternUv;
    for (size_t i = 0; i < kDepthTarget; ++i) desc.colorFormats.push_back(slotInfo(targets_[i]).format);
    desc.samples = samples_;
    desc.viewMask = viewMask(configuration_);
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

    std::vector<uint8_t> extras;
    for (size_t m = 0; m < input.scene.materialCount(); ++m) {
      const TextureParams texture = input.scene.knobs<TextureParams>(input.look, m);
      auto metaParams = sameRows(input.scene.knobs<TextureMetaTextureParams>(input.look, m));
      // What is not painted needs no texture of its own.
      if (texture.amount <= 0) metaParams = WarpMetaTextureParams();
      const bool isOcean = int(m) == input.scene.oceanMaterial();
      if (isOcean) metaParams = sameRows(input.look.get<OceanMetaTextureParams>());
      const MetaTextureUse use = metaTextureUse(metaParams, 0b0111, input.look, frame_->examples(),
                                                input.uniforms.pixelScale, patternShift(input.seed));
      painted_.write(m, {use.meta, tangentOptions(metaParams), texture.amount, texture.blend});
      extras.push_back(uint8_t((texture.amount > 0 ? GeometryStep::kPainted : 0) |
                               input.scene.colorSets(m) * 2 | (isOcean ? GeometryStep::kOcean : 0)));
      sets_.writeTexture(m, 4, use.image().view(), frame_->samplers().get(use.sampler()));
      sets_.writeTexture(m, 5, use.inverse().view(),
                         frame_->samplers().get(ExampleTextures::kInverseSampler));
    }
    if (input.scene.oceanMaterial() >= 0) paintOcean(input, size_t(input.scene.oceanMaterial()));
    step_.specialise(input.scene, constant(input.uniforms.lightCount > 0), std::move(extras));
  }

 private:
  static constexpr std::array kFirstTargets{Slot::shadow, Slot::lit, Slot::shadowed, Slot::depth};
  static constexpr std::array kBehindTargets{Slot::behindShadow, Slot::behindLit, Slot::behindShadowed,
                                             Slot::behindDepth};
  static constexpr size_t kDepthTarget = 3;

  // kOptions in the shaders.
  uint32_t constant(bool lights) const { return (isBehind_ ? 1 : 0) | (lights ? 2 : 0); }

  void paintOcean(const FrameInput& input, size_t material) {
    const OceanPaintParams p = input.look.get<OceanPaintParams>();
    const PaletteParams palette = input.scene.knobs<PaletteParams>(input.look, material);
    constexpr double kTurn = 6.283185307179586;
    const double phase = std::fmod(double(p.live) * input.time, 1.0) * kTurn;
    const glm::vec3 foam(p.foamColor);
    ocean_.write(shared::OceanPaint{
        p.dither, p.lightDither, p.reflection, float(phase), float(kTurn) * p.liveSpread, p.foam, p.foamStart,
        glm::sqrt(foam), glm::sqrt(glm::vec3(shadowedColor(palette, glm::dvec3(foam)))), p.saturation,
        p.overlayAmount, p.skySaturation, p.skyOverlayAmount, p.overlay.linear, p.skyOverlay.linear, p.next});
    gpu::SamplerDesc clamped;
    const auto write = [&](uint32_t binding, const gpu::Image& image, const gpu::SamplerDesc& sampler) {
      sets_.writeTexture(material, binding, image.view(), frame_->samplers().get(sampler));
    };
    write(8, maps_->bathic(input.look, p.colors), clamped);
    write(9, maps_->sky(input.look, p.sky), clamped);
    write(10, maps_->bathic(input.look, p.next > 0 ? p.nextColors : p.colors), clamped);
    write(11, maps_->sky(input.look, p.next > 0 ? p.nextSky : p.sky), clamped);
    write(12, frame_->examples().get(input.look, look::Picture{4}).image, ExampleTextures::kSampler);
  }

  void record(VkCommandBuffer commands) const {
    const auto target = [&](size_t i) {
      return Target{
          &resources_->image(drawn_[i]), samples_ > 1 ? &resources_->image(resolved_[i]) : nullptr, {}};
    };
    const Target colors[] = {target(0), target(1), target(2)}, depth = target(3);
    drawViews(commands, configuration_, colors, &depth,
              [&](uint32_t firstView) { step_.draw(commands, *resources_, *scene_, &sets_, firstView); });
  }

  bool isBehind_;
  std::array<Slot, 4> targets_;
  gpu::ResourceId shadowMap_ = 0, firstDepth_ = 0;
  std::array<gpu::ResourceId, 4> drawn_{}, resolved_{};
  uint32_t samples_ = 1;
  Configuration configuration_;
  UniformSlice uniforms_;
  MaterialParams<SurfaceParams> params_;
  MaterialBlocks<PaintedMaterial> painted_;
  UniformSlice ocean_;
  std::optional<OceanMaps> maps_;
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
