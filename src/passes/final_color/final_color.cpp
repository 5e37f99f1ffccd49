#include "passes/final_color/final_color.h"

#include "frame/image_step.h"
#include "frame/metatexture.h"
#include "passes/final_color/final_color.shared.h"
#include "passes/final_color/final_color_knobs.h"
#include "passes/surface/surface_knobs.h"
#include "shaders/final_color_image_comp.h"
#include "shaders/final_color_image_frag.h"

namespace scumble::passes {

using namespace frame;

namespace {

// What the shader decides by.
uint32_t backdropFeatures(const BackdropInput* backdrop) {
  if (!backdrop) return 0;
  const shared::Backdrop& b = backdrop->uniforms;
  return shared::kBackdropIsThere | (b.minified > 0 ? shared::kBackdropMinified : 0) |
         (b.radius > 0 ? shared::kBackdropSimplified : 0) |
         (b.radius > 0 && b.radius < 1 ? shared::kBackdropMixed : 0) |
         (b.style > 0 ? shared::kBackdropStyled : 0) | (b.warp == 1 ? shared::kBackdropTornNear : 0) |
         (b.warp == 2 ? shared::kBackdropTorn : 0);
}

class FinalColor : public Pass {
 public:
  const char* name() const override { return "final-color"; }
  std::span<const Aov> aovs() const override { return kAovs; }
  uint32_t variant(const scene::SceneData&, const look::LookData& look) const override {
    return look.get<FinalColorParams>().ripple == shared::kRippleLayered;
  }

  void declare(FrameBuilder& frame, uint32_t isLayered) override {
    // Where there are no layers, anything stands for them.
    const auto behind = [&](const Role& role) {
      return frame.get(role, isLayered ? Layer::behind : Layer::first);
    };
    const gpu::Handle picture = step_.declare(
        frame, {.name = name(),
                .shader = {{shaders::final_color_image_frag}, {shaders::final_color_image_comp}},
                .inputs = {{shared::kFinalColorColor, frame.get(kPicture), true},
                           {shared::kFinalColorWarp, frame.get(kWarp)},
                           {shared::kFinalColorDepth, frame.get(kDepth)},
                           {shared::kFinalColorBlurred, frame.get(kBlur), true},
                           {shared::kFinalColorBehind, behind(kPicture)},
                           {shared::kFinalColorBehindDepth, behind(kDepth)},
                           {shared::kFinalColorLight, frame.get(kLight)},
                           {shared::kFinalColorLit, frame.get(kLit)},
                           {shared::kFinalColorBehindLight, behind(kLight)},
                           {shared::kFinalColorBehindLit, behind(kLit)}},
                .textures = {shared::kFinalColorBackdrop, shared::kFinalColorTear},
                .outputs = {frame.image(name(), {.format = kHalves})},
                .uniformBytes = sizeof(shared::FinalColorUniforms)})[0];
    frame.give(kPicture, picture);
    frame.offer(kAovs[0], {picture});
  }
  void create(FrameBuilder& frame) override {
    step_.create(frame);
    examples_ = &frame.examples();
  }
  void bind(const gpu::GraphResources& resources) override { step_.bind(resources); }

  void update(const FrameInput& input) override {
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
    }
    const uint32_t ripple = uint32_t(params.ripple);
    step_.setJobs({{{mayGlow(input.look, input.scene.data()), ripple, backdropFeatures(input.backdrop)},
                    {{shared::kFinalColorBackdrop, picture, kPictureSampler},
                     {shared::kFinalColorTear, &example.image, ExampleTextures::kSampler}}}});
    step_.update(uniforms);
  }

 private:
  static constexpr gpu::SamplerDesc kPictureSampler{VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                                    VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, true};

  static constexpr Aov kAovs[] = {{.name = "final-color", .isColor = true, .premultiplied = 3}};

  ImageStep step_;
  ExampleTextures* examples_ = nullptr;
};

}  // namespace

std::unique_ptr<Pass> makeFinalColor() {
  return std::make_unique<FinalColor>();
}

}  // namespace scumble::passes
