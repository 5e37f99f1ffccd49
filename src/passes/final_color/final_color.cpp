#include "passes/final_color/final_color.h"

#include "frame/image_step.h"
#include "frame/metatexture.h"
#include "passes/color/color_knobs.h"
#include "passes/final_color/final_color.shared.h"
#include "passes/final_color/final_color_knobs.h"
#include "passes/limit/limit_knobs.h"
#include "passes/surface/surface_knobs.h"
#include "passes/warp/warp_knobs.h"
#include "shaders/final_color_image_comp.h"
#include "shaders/final_color_image_frag.h"
#include "shaders/final_color_samples_image_comp.h"
#include "shaders/final_color_samples_image_frag.h"

namespace scumble::passes {

using namespace frame;

namespace {

// What the shader decides by.
uint32_t backdropFeatures(const shared::Backdrop& b) {
  return shared::kBackdropIsThere | (b.minified > 0 ? shared::kBackdropMinified : 0) |
         (b.radius > 0 ? shared::kBackdropSimplified : 0) |
         (b.radius > 0 && b.radius < 1 ? shared::kBackdropMixed : 0) |
         (b.style > 0 ? shared::kBackdropStyled : 0) | (b.steps > 0 ? shared::kBackdropStepped : 0) |
         (b.limited > 0 ? shared::kBackdropLimited : 0) | (b.warp == 1 ? shared::kBackdropTornNear : 0) |
         (b.warp == 2 ? shared::kBackdropTorn : 0);
}

class FinalColor : public Pass {
 public:
  const char* name() const override { return "final-color"; }
  std::span<const Aov> aovs() const override { return kAovs; }
  uint32_t variant(const scene::SceneData& scene, const look::LookData& look) const override {
    const FinalColorParams params = look.get<FinalColorParams>();
    const bool tears = mayTear(look);
    return (tears ? kTears : 0) | (tears && params.ripple == shared::kRippleLayered ? kLayered : 0) |
           (params.bloom > 0 && mayGlow(look, scene) ? kBlooms : 0);
  }

  void declare(FrameBuilder& frame, uint32_t variant) override {
    variant_ = variant;
    samples_ = frame.configuration().samples;
    onSphere_ = frame.configuration().onSphere;
    // Where nothing but grades was done to the colours of surfaces, single samples of those can be taken.
    isGraded_ = frame.get(kPicture) != frame.get(kSurfaceColors);
    isSampled_ = samples_ > 1 && !frame.configuration().hasBackdrop &&
                 (!isGraded_ || frame.get(kPicture) == frame.get(kGradedColors));
    const gpu::Handle picture = isSampled_ ? declareSampled(frame) : declareTaken(frame);
    frame.give(kPicture, picture);
    if (isSampled_) frame.give(kSampledPicture, picture);
    frame.offer(kAovs[0], {picture});
  }
  void create(FrameBuilder& frame) override {
    step_.create(frame);
    examples_ = &frame.examples();
  }
  void bind(const gpu::GraphResources& resources) override { step_.bind(resources); }

  void update(const FrameInput& input) override {
    if (isSampled_)
      updateSampled(input);
    else
      updateTaken(input);
  }

 private:
  // Anything stands for what is not looked at.
  gpu::Handle only(const FrameBuilder& frame, uint32_t part, const Role& role,
                   Layer layer = Layer::first) const {
    return variant_ & part ? frame.get(role, layer) : frame.get(kLit);
  }

  // Of single samples.
  gpu::Handle declareSampled(FrameBuilder& frame) {
    using namespace shared;
    hasBlended_ = frame.has(kBlended);
    return step_.declare(
        frame,
        {.name = name(),
         .shader = {{shaders::final_color_samples_image_frag}, {shaders::final_color_samples_image_comp}},
         .inputs = {{kFinalColorColor, frame.get(kDepth)},
                    {kFinalColorWarp, only(frame, kTears, kWarp), true},
                    {kFinalColorDepth, frame.get(kDepthSamples)},
                    {kFinalColorBloom, only(frame, kBlooms, kBloom), true},
                    {kFinalColorBehind, only(frame, kLayered, kPicture, Layer::behind)},
                    {kFinalColorBehindDepth, only(frame, kLayered, kDepth, Layer::behind)},
                    {kFinalColorLight, frame.get(kLight)},
                    {kFinalColorLit, frame.get(kLit)},
                    {kFinalColorInflated, only(frame, kTears, kInflatedDepth)},
                    {kFinalColorShadowed, frame.get(kShadowed)},
                    {kFinalColorSampleLight, frame.get(kSampleLight)},
                    {kFinalColorLitSamples, frame.get(kLitSamples)},
                    {kFinalColorShadowedSamples, frame.get(kShadowedSamples)},
                    {kFinalColorGraded, frame.get(isGraded_ ? kGradedColors : kLit)},
                    {kFinalColorUngraded, frame.get(isGraded_ ? kSurfaceColors : kLit)},
                    {kFinalColorBlended, frame.get(hasBlended_ ? kBlended : kLit)},
                    {kFinalColorBlendedDistance, frame.get(hasBlended_ ? kBlendedDistance : kLit)}},
         .tiles = frame.get(kTiles),
         .outputs = {frame.image(name(), {.format = kHalves})},
         // Of a pixel: the inflated surface and depths around it, the warp; of each place: two depths, both
         // colours, light.
         .fetches = 8 + 8 + 17 + 4 * (hasBlended_ ? 7u : 5u),
         .uniformBytes = sizeof(SampledColorUniforms),
         .maxJobs = 6})[0];
  }

  void updateSampled(const FrameInput& input) {
    const FinalColorParams params = input.knobs.scene<FinalColorParams>();
    const shared::SurfaceColors colors = surfaceColors(input, Layer::first);
    const uint32_t glows = (variant_ & kBlooms ? shared::kFinalColorGlows : 0) |
                           (colors.glowColorAmount > 0 ? shared::kFinalColorGlowColor : 0) |
                           (isGraded_ ? shared::kFinalColorIsGraded : 0) |
                           (hasBlended_ ? shared::kFinalColorHasBlended : 0);
    const uint32_t ripple = uint32_t(params.ripple);
    const uint32_t torn = variant_ & kTears ? shared::kTileTorn : 0;
    std::vector<ImageStep::Job> jobs;
    if (isGraded_) {
      jobs.push_back({{glows, ripple, 0}, {}, {torn, 0}});
    } else {
      for (const auto& [part, where] : colorParts(input, true))
        jobs.push_back({{glows, ripple, uint32_t(part)}, {}, {where.mask | torn, where.value}});
    }
    if (torn) jobs.push_back({{glows | shared::kFinalColorTorn, ripple, 0}, {}, {torn, torn}});
    step_.setJobs(jobs);
    const shared::SampledColorUniforms uniforms{
        params.bloom * glm::vec3(params.bloomTint), {input.inflation}, colors};
    for (size_t job = 0; job < jobs.size(); ++job) step_.update(uniforms, job);
  }

  // Of the picture as it is.
  gpu::Handle declareTaken(FrameBuilder& frame) {
    const auto behind = [&](const Role& role) { return only(frame, kLayered, role, Layer::behind); };
    return step_.declare(frame,
                         {.name = name(),
                          .shader = {{shaders::final_color_image_frag}, {shaders::final_color_image_comp}},
                          .inputs = {{shared::kFinalColorColor, frame.get(kPicture), true},
                                     {shared::kFinalColorWarp, only(frame, kTears, kWarp), true},
                                     {shared::kFinalColorDepth, frame.get(kDepth)},
                                     {shared::kFinalColorBloom, only(frame, kBlooms, kBloom), true},
                                     {shared::kFinalColorBehind, behind(kPicture)},
                                     {shared::kFinalColorBehindDepth, behind(kDepth)},
                                     {shared::kFinalColorLight, frame.get(kLight)},
                                     {shared::kFinalColorLit, frame.get(kLit)},
                                     {shared::kFinalColorBehindLight, behind(kLight)},
                                     {shared::kFinalColorBehindLit, behind(kLit)},
                                     {shared::kFinalColorInflated, only(frame, kTears, kInflatedDepth)}},
                          .textures = {shared::kFinalColorBackdrop, shared::kFinalColorTear},
                          .tiles = frame.get(kTiles),
                          .outputs = {frame.image(name(), {.format = kHalves})},
                          // Of a pixel: the inflated surface and depths around it, the warp; of each place:
                          // depths and colours around it.
                          .fetches = 8 + (samples_ > 1 ? 9u : 1u) + 17 + 4 * 8,
                          .uniformBytes = sizeof(shared::FinalColorUniforms),
                          .maxJobs = 2})[0];
  }

  void updateTaken(const FrameInput& input) {
    const FinalColorParams params = input.knobs.scene<FinalColorParams>();
    shared::FinalColorUniforms uniforms{};
    uniforms.bloom = params.bloom * glm::vec3(params.bloomTint);
    uniforms.displacement = {input.inflation};
    const WarpMetaTextureParams tear = input.knobs.scene<WarpMetaTextureParams>();
    const ExampleTexture& example = examples_->get(input.look, tear.example);
    const gpu::Image* picture = &example.image;
    if (input.backdrop) {
      uniforms.backdrop = input.backdrop->uniforms;
      uniforms.tearMean = glm::vec2(example.statistics.mean);
      const float width = tear.size * input.uniforms.pixelScale;
      uniforms.backdrop.tearSize = {width, width * float(example.height) / float(example.width)};
      uniforms.backdrop.tearShift = patternShift(input.seed);
      picture = input.backdrop->image;
      const LimitParams limit = input.knobs.scene<LimitParams>();
      uniforms.backdrop.lightness = limit.lightness;
      const bool isLimited = writePalette(limit, uniforms.backdrop.palette) > 0;
      uniforms.backdrop.limited = isLimited ? limit.amount * limit.backdrop : 0.0f;
    }
    const uint32_t ripple = uint32_t(params.ripple);
    const uint32_t glows = variant_ & kBlooms ? shared::kFinalColorGlows : 0;
    const uint32_t torn = shared::kFinalColorTorn | (samples_ > 1 ? shared::kFinalColorMixes : 0);
    const std::vector<ImageStep::Texture> textures{
        {shared::kFinalColorBackdrop, picture, onSphere_ ? kSphereSampler : kPictureSampler},
        {shared::kFinalColorTear, &example.image, ExampleTextures::kSampler}};
    const uint32_t backdrop = input.backdrop ? backdropFeatures(uniforms.backdrop) : 0;
    std::vector<ImageStep::Job> jobs{{{glows, ripple, backdrop}, textures}};
    if (variant_ & kTears) {
      jobs[0].where = {shared::kTileTorn, 0};
      jobs.push_back({{glows | torn, ripple, backdrop}, textures, {shared::kTileTorn, shared::kTileTorn}});
    }
    step_.setJobs(jobs);
    step_.update(uniforms);
    step_.update(uniforms, 1);
  }

  static constexpr uint32_t kTears = 1, kLayered = 2, kBlooms = 4;  // variants
  static constexpr gpu::SamplerDesc kPictureSampler{VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                                    VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, true};
  static constexpr gpu::SamplerDesc kSphereSampler{VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT,
                                                   VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, true};

  static constexpr Aov kAovs[] = {{.name = "final-color", .isColor = true, .premultiplied = 3}};

  uint32_t variant_ = 0, samples_ = 1;
  bool isSampled_ = false, isGraded_ = false, hasBlended_ = false, onSphere_ = false;
  ImageStep step_;
  ExampleTextures* examples_ = nullptr;
};

}  // namespace

std::unique_ptr<Pass> makeFinalColor() {
  return std::make_unique<FinalColor>();
}

}  // namespace scumble::passes
