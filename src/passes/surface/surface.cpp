#include "passes/surface/surface.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "frame/drawn_image.h"
#include "frame/geometry_step.h"
#include "frame/material_params.h"
#include "frame/metatexture.h"
#include "frame/transparent_step.h"
#include "look/anywhere.h"
#include "passes/colorize/colorize_knobs.h"
#include "passes/surface/surface.shared.h"
#include "shaders/surface_frag.h"
#include "shaders/surface_painted_frag.h"
#include "shaders/surface_painted_vert.h"
#include "shaders/surface_prepainted_frag.h"
#include "shaders/surface_transparent_apart_frag.h"
#include "shaders/surface_transparent_apart_painted_frag.h"
#include "shaders/surface_transparent_frag.h"
#include "shaders/surface_transparent_painted_frag.h"
#include "shaders/surface_transparent_painted_vert.h"
#include "shaders/surface_transparent_vert.h"
#include "shaders/surface_vert.h"

namespace scumble::passes {

using namespace frame;

namespace {

// Mirrors PaintedMaterial in surface.glsl.
struct PaintedMaterial {
  MetaTextureUniforms meta;
  float amount;
};

class Surface : public Pass {
 public:
  explicit Surface(Layer layer) : layer_(layer), isBehind_(layer == Layer::behind) {}
  const char* name() const override { return isBehind_ ? "behind" : "surface"; }
  std::span<const Aov> aovs() const override { return kAovs; }

  uint32_t variant(const scene::SceneData& scene, const look::LookData& look) const override {
    return !isBehind_ && changesOverlays(look, scene);
  }

  void declare(FrameBuilder& frame, uint32_t gradesByDistance) override {
    configuration_ = frame.configuration();
    samples_ = isBehind_ ? 1 : configuration_.samples;
    frame.step(name(), [this](VkCommandBuffer commands) { record(commands); });
    GeometryStep::use(frame);
    frame.use(frame.get(kDrawnObjects), gpu::Use::storageBufferReadByVertex);
    shadowMap_ = frame.use(frame.get(kShadowMap), gpu::Use::sampledByFragment);
    if (frame.has(kVeils)) veils_ = frame.use(frame.get(kVeils), gpu::Use::sampledByFragment);
    for (size_t i = 0; i < prepainted_.size(); ++i) {
      const Role& role = i == 0 ? kPrepaintedLit : kPrepaintedShadowed;
      if (frame.has(role)) prepainted_[i] = frame.use(frame.get(role), gpu::Use::sampledByFragment);
    }
    hasBlended_ = !isBehind_ && frame.has(kTransparentOrder);
    if (hasBlended_) frame.use(frame.get(kTransparentOrder), gpu::Use::indexBuffer);
    if (isBehind_) firstDepth_ = frame.use(frame.get(kDepth), gpu::Use::sampledByFragment);
    const std::string before = isBehind_ ? "behind-" : "";
    for (size_t i = 0; i < colors_.size(); ++i)
      colors_[i].declare(frame, before + kAovs[i].name, kBytes, samples_);
    depth_.declare(frame, before + kDepth.name, kDepthFormat, samples_);

    frame.give(kShadow, colors_[0].image(), layer_);
    frame.give(kLit, colors_[1].image(), layer_);
    frame.give(kShadowed, colors_[2].image(), layer_);
    frame.give(kDepth, depth_.image(), layer_);
    if (samples_ > 1) {
      const Role* const samples[] = {&kShadowSamples, &kLitSamples, &kShadowedSamples};
      for (size_t i = 0; i < colors_.size(); ++i) frame.give(*samples[i], colors_[i].samples());
      frame.give(kDepthSamples, depth_.samples());
    }
    // It is thresholded as it is.
    if (isBehind_) frame.give(kLight, colors_[0].image(), layer_);
    for (size_t i = 0; i < colors_.size() && !isBehind_; ++i) frame.offer(kAovs[i], {colors_[i].image()});
    drawsApart_ = hasBlended_ && gradesByDistance;
    if (drawsApart_) declareApart(frame);
  }

  void create(FrameBuilder& frame) override {
    frame_ = &frame;
    light_ = frame.uniform(sizeof(LightParams));
    params_.create(frame, hasBlended_);
    painted_.create(frame, hasBlended_);
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
                              {kTexture, VK_SHADER_STAGE_FRAGMENT_BIT},
                              {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_VERTEX_BIT},
                              {kTexture, VK_SHADER_STAGE_FRAGMENT_BIT}});
    // One set for each material, since each may have a texture of its own.
    const size_t materials = frame.scene().materialCount();
    sets_ = gpu::DescriptorSets(frame.device(), layout_, uint32_t(materials));
    for (size_t m = 0; m < materials; ++m) {
      params_.bind(sets_, shared::kSurfaceKnobs, m);
      painted_.bind(sets_, shared::kSurfacePainted, m);
      sets_.writeBuffer(m, shared::kSurfaceLight, light_.buffer, light_.offset, light_.size);
    }

    GeometryStepDesc desc;
    desc.vertex = {shaders::surface_vert};
    desc.fragment = {shaders::surface_frag};
    desc.inputs = kPosition | kNormal | kUv0 | kUv1 | kColor | kSmoothNormal | kIndirect;
    desc.paintedVertex = {shaders::surface_painted_vert};
    desc.paintedFragment = {shaders::surface_painted_frag};
    desc.prepaintedFragment = {shaders::surface_prepainted_frag};
    desc.paintedInputs = desc.inputs | kDPdu | kDPdv | kPatternUv;
    desc.colorFormats.assign(colors_.size(), kBytes);
    desc.samples = samples_;
    desc.viewMask = configuration_.views().mask();
    desc.viewCount = configuration_.viewCount;
    desc.leavesBlended = hasBlended_;
    desc.constant = constant(false, false);
    desc.passLayout = &layout_;
    desc.materialStrides = {params_.kStride, painted_.kStride};
    step_.create(frame, desc);
    if (hasBlended_) createBlended(desc);
  }

  void bind(const gpu::GraphResources& resources) override {
    resources_ = &resources;
    gpu::SamplerDesc compare;
    compare.compareLess = true;
    const VkSampler exact = frame_->samplers().get({VK_FILTER_NEAREST});
    // The first layer does not look at what is before it, nor does anything but what is prepainted at those
    // colours.
    const auto orAny = [&](gpu::Handle image) { return resources.image(image ? image : shadowMap_).view(); };
    for (size_t m = 0; m < sets_.size(); ++m) {
      sets_.writeBuffer(m, shared::kSurfaceObjects, frame_->scene().draws().drawn());
      sets_.rewriteTexture(m, shared::kSurfaceShadowMap, resources.image(shadowMap_).view(),
                           frame_->samplers().get(compare));
      sets_.rewriteTexture(m, shared::kSurfaceFirstDepth, orAny(firstDepth_), exact);
      for (uint32_t i = 0; i < prepainted_.size(); ++i)
        sets_.rewriteTexture(m, shared::kSurfacePrepaintedLit + i, orAny(prepainted_[i]), exact);
      sets_.rewriteTexture(m, shared::kSurfaceVeils, orAny(veils_), exact);
      if (!hasBlended_) continue;
      blendedSets_.rewriteTexture(m, shared::kSurfaceShadowMap, resources.image(shadowMap_).view(),
                                  frame_->samplers().get(compare));
      blendedSets_.rewriteTexture(m, shared::kBlendedVeils, orAny(veils_), exact);
    }
    if (hasBlended_) blended_.bind();
    if (drawsApart_) blendedApart_.bind();
  }

  void update(const FrameInput& input) override {
    light_.write(input.knobs.scene<LightParams>());

    bool indirect = false;
    std::vector<MaterialVariant> variants;
    std::vector<std::tuple<const gpu::Image*, const gpu::Image*, VkSampler>> paintings;  // each once
    std::vector<uint32_t> paintingOf;
    bool highlights = false;
    for (size_t m = 0; m < input.scene.materialCount(); ++m) {
      SurfaceParams params = input.knobs.of<SurfaceParams>(m);
      params.simplify = mipBias(params.simplify, input.uniforms.pixelScale);
      const float roughness = input.scene.material(m).roughness;
      params.highlight *= (1 - roughness) * (1 - roughness);  // what is rougher spreads what it mirrors
      // The tangent of the angle to the shape's edge.
      params.highlightSize *= std::max(0.5f * roughness * roughness, 0.06f);
      params_.write(m, params);
      highlights |= params.highlight > 0;
      indirect |= params.occlusion > 0 || params.bounce > 0;
      const TextureParams texture = input.knobs.of<TextureParams>(m);
      auto metaParams = sameRows(input.knobs.of<TextureMetaTextureParams>(m));
      // What is not painted needs no texture of its own.
      if (texture.amount <= 0) metaParams = WarpMetaTextureParams();
      const MetaTextureUse use = metaTextureUse(metaParams, 0b0111, input.look, frame_->examples(),
                                                input.uniforms.pixelScale, patternShift(input.seed));
      painted_.write(m, {use.meta.uniforms(), texture.amount});
      MaterialVariant variant;
      if (const FeaturePlan* const plan = input.scene.planOf(m); plan && plan->isPrepainted) {
        variant.isPrepainted = true;
      } else {
        variant.sets = input.scene.colorSets(m);
        variant.isPainted = texture.amount > 0;
        if (variant.isPainted) {
          variant.features = use.meta.features();
          variant.tangents = tangentOptions(metaParams, input.uniforms);
          variant.options = uint32_t(texture.blend);
        }
      }
      variants.push_back(variant);
      for (gpu::DescriptorSets* const sets : {&sets_, &blendedSets_}) {
        if (sets->size() == 0) continue;
        sets->writeTexture(m, shared::kSurfaceExample, use.image().view(),
                           frame_->samplers().get(use.sampler()));
        sets->writeTexture(m, shared::kSurfaceInverse, use.inverse().view(),
                           frame_->samplers().get(ExampleTextures::kInverseSampler));
      }
      const std::tuple painting{&use.image(), &use.inverse(), frame_->samplers().get(use.sampler())};
      const auto known = std::find(paintings.begin(), paintings.end(), painting);
      paintingOf.push_back(uint32_t(known - paintings.begin()));
      if (known == paintings.end()) paintings.push_back(painting);
    }
    uint32_t constantNow = constant(input.uniforms.lightCount > 0, highlights);
    if (indirect) {
      const IndirectParams params = input.knobs.scene<IndirectParams>();
      constantNow |= (params.source == 0 ? shared::kSurfaceIndirect : shared::kSurfaceIndirectColors) |
                     uint32_t(params.steps) << shared::kSurfaceStepsBit;
    }
    if (hasBlended_) blended_.update(constantNow, variants, paintingOf);
    if (drawsApart_) blendedApart_.update(constantNow, variants, paintingOf);
    step_.specialise(constantNow, std::move(variants));
  }

 private:
  static constexpr Aov kAovs[] = {
      {.name = "shadow", .premultiplied = 3},
      {.name = "lit", .isColor = true, .premultiplied = 3, .isSquareRoot = true},
      {.name = "shadowed", .isColor = true, .premultiplied = 3, .isSquareRoot = true}};

  // Blended surfaces by themselves, and how far away they are.
  void declareApart(FrameBuilder& frame) {
    frame.step("blended", [this](VkCommandBuffer commands) { recordApart(commands); });
    GeometryStep::use(frame);
    frame.use(frame.get(kTransparentOrder), gpu::Use::indexBuffer);
    frame.use(shadowMap_, gpu::Use::sampledByFragment);
    if (veils_) frame.use(veils_, gpu::Use::sampledByFragment);
    testedDepth_ = frame.use(depth_.samples(), gpu::Use::depthTest);
    apart_[0].declare(frame, kBlended.name, kHalves, samples_);
    apart_[1].declare(frame, kBlendedDistance.name, kHalves, samples_);
    frame.give(kBlended, apart_[0].image());
    frame.give(kBlendedDistance, apart_[1].image());
  }

  // Blended surfaces are drawn after the others, as those are but for the materials, which are rows there.
  void createBlended(GeometryStepDesc desc) {
    FrameBuilder& frame = *frame_;
    constexpr VkShaderStageFlags kFragment = VK_SHADER_STAGE_FRAGMENT_BIT;
    blendedLayout_ = gpu::SetLayout(frame.device(), {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kFragment},
                                                     {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kFragment},
                                                     {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kFragment},
                                                     {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kFragment},
                                                     {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kFragment},
                                                     {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kFragment},
                                                     {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kFragment}});
    blendedSets_ = gpu::DescriptorSets(frame.device(), blendedLayout_, uint32_t(sets_.size()));
    for (size_t m = 0; m < sets_.size(); ++m) {
      params_.bindRows(blendedSets_, shared::kSurfaceKnobs, m);
      painted_.bindRows(blendedSets_, shared::kSurfacePainted, m);
      blendedSets_.writeBuffer(m, shared::kSurfaceLight, light_.buffer, light_.offset, light_.size);
    }
    desc.vertex = {shaders::surface_transparent_vert};
    desc.fragment = {shaders::surface_transparent_frag};
    desc.paintedVertex = {shaders::surface_transparent_painted_vert};
    desc.paintedFragment = {shaders::surface_transparent_painted_frag};
    desc.passLayout = &blendedLayout_;
    blended_.create(frame, desc, TransparentStep::What::surfaces);
    if (!drawsApart_) return;
    desc.fragment = {shaders::surface_transparent_apart_frag};
    desc.paintedFragment = {shaders::surface_transparent_apart_painted_frag};
    desc.colorFormats.assign(apart_.size(), kHalves);
    blendedApart_.create(frame, desc, TransparentStep::What::surfaces);
  }

  // kOptions in the shaders.
  uint32_t constant(bool lights, bool highlights) const {
    return (isBehind_ ? 1 : 0) | (lights ? 2 : 0) | (highlights ? 4 : 0) | (veils_ ? 8 : 0);
  }

  void record(VkCommandBuffer commands) const {
    std::array<gpu::Target, std::size(kAovs)> colors;
    for (size_t i = 0; i < colors.size(); ++i) colors[i] = colors_[i].target(*resources_);
    gpu::Target depth = depth_.target(*resources_);
    for (gpu::Target& color : colors) color.keepsSamples = true;
    depth.keepsSamples = true;
    gpu::drawViews(commands, configuration_.views(), colors, &depth, [&](uint32_t firstView) {
      step_.draw(commands, &sets_, firstView);
      if (hasBlended_) blended_.draw(commands, &blendedSets_, firstView);
    });
  }

  void recordApart(VkCommandBuffer commands) const {
    const std::array<gpu::Target, 2> targets{apart_[0].target(*resources_), apart_[1].target(*resources_)};
    const gpu::Target depth{&resources_->image(testedDepth_), nullptr, {}, gpu::Target::Before::tested};
    gpu::drawViews(commands, configuration_.views(), targets, &depth,
                   [&](uint32_t firstView) { blendedApart_.draw(commands, &blendedSets_, firstView); });
  }

  Layer layer_;
  bool isBehind_;
  gpu::Handle shadowMap_, firstDepth_, veils_;
  std::array<gpu::Handle, 2> prepainted_;
  std::array<DrawnImage, std::size(kAovs)> colors_;
  DrawnImage depth_;
  uint32_t samples_ = 1;
  Configuration configuration_;
  UniformSlice light_;
  MaterialBlocks<SurfaceParams> params_;
  MaterialBlocks<PaintedMaterial> painted_;
  FrameBuilder* frame_ = nullptr;
  const gpu::GraphResources* resources_ = nullptr;
  gpu::SetLayout layout_;
  gpu::DescriptorSets sets_;
  GeometryStep step_;
  bool hasBlended_ = false;
  gpu::SetLayout blendedLayout_;
  gpu::DescriptorSets blendedSets_;
  TransparentStep blended_;
  bool drawsApart_ = false;
  gpu::Handle testedDepth_;
  std::array<DrawnImage, 2> apart_;
  TransparentStep blendedApart_;
};

}  // namespace

float mipBias(float simplify, float pixelScale) {
  return std::max(simplify + std::log2(pixelScale), 0.0f);
}

bool mayTakeIndirect(const look::LookData& look) {
  return look::mayBeAboveZero(look, &SurfaceParams::occlusion) ||
         look::mayBeAboveZero(look, &SurfaceParams::bounce);
}

bool mayGlow(const look::LookData& look, const scene::SceneData& scene) {
  const auto sets = [](const look::Assignment& a) {
    const std::string_view name = a.row->name;
    return a.block == &SurfaceParams::block() && (name == "glow" || name == "highlight");
  };
  return std::any_of(look.assignments.begin(), look.assignments.end(), sets) ||
         std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const scene::Material& material) { return material.emissive != glm::vec3(0.0f); });
}

std::unique_ptr<Pass> makeSurface(Layer layer) {
  return std::make_unique<Surface>(layer);
}

}  // namespace scumble::passes
