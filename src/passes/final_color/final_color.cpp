#include "passes/final_color/final_color.h"

#include "frame/image_step.h"
#include "frame/metatexture.h"
#include "passes/final_color/final_color.shared.h"
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
  explicit FinalColor(InflationOf inflation) : inflation_(inflation) {}
  const char* name() const override { return "final-color"; }

  void declare(FrameBuilder& frame) override {
    const Configuration& c = frame.configuration();
    // Where there are no layers, anything stands for them.
    const auto layer = [&](Slot behind, Slot other) { return frame.slot(c.layered ? behind : other); };
    glows_ = c.glows;
    step_.declare(frame, "final-color",
                  {{shaders::final_color_image_frag}, {shaders::final_color_image_comp}},
                  {{frame.slot(frame.configuration().colors()), true},
                   {frame.slot(Slot::warp)},
                   {frame.slot(Slot::depth)},
                   {frame.slot(Slot::blur), true},
                   {layer(c.colorsBehind(), c.colors())},
                   {layer(Slot::behindDepth, Slot::depth)},
                   {frame.slot(Slot::finalShadow)},
                   {frame.slot(Slot::lit)},
                   {layer(Slot::behindShadow, Slot::finalShadow)},
                   {layer(Slot::behindLit, Slot::lit)}},
                  frame.slot(Slot::finalColor), sizeof(shared::FinalColorUniforms), {}, 2);
  }
  void create(FrameBuilder& frame, const FrameResources& resources) override {
    step_.create(frame, resources);
    examples_ = &frame.examples();
  }

  void update(const FrameInput& input) override {
    const FinalColorParams params = input.look.get<FinalColorParams>();
    shared::FinalColorUniforms uniforms{};
    uniforms.bloom = params.bloom * glm::vec3(params.bloomTint);
    uniforms.displacement = {inflation_(input.look, input.scene, input.uniforms.imageSize.y)};
    const WarpMetaTextureParams tear = input.look.get<WarpMetaTextureParams>();
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
    step_.setJobs({{{glows_, ripple, backdropFeatures(input.backdrop)},
                    {{picture, kPictureSampler}, {&example.image, ExampleTextures::kSampler}}}});
    step_.update(uniforms);
  }

 private:
  static constexpr gpu::SamplerDesc kPictureSampler{VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                                    VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, true};

  InflationOf inflation_;
  ImageStep step_;
  bool glows_ = false;
  ExampleTextures* examples_ = nullptr;
};

}  // namespace

std::unique_ptr<Pass> makeFinalColor(InflationOf inflation) {
  return std::make_unique<FinalColor>(inflation);
}

}  // namespace scumble::passes
