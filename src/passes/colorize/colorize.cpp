#include "passes/colorize/colorize.h"

#include "frame/image_step.h"
#include "passes/colorize/strips.h"
#include "shaders/colorize_blended_image_comp.h"
#include "shaders/colorize_blended_image_frag.h"
#include "shaders/colorize_image_comp.h"
#include "shaders/colorize_image_frag.h"

namespace scumble::passes {

using namespace frame;

namespace {

class Colorize : public Pass {
 public:
  explicit Colorize(Layer layer) : layer_(layer) {}
  const char* name() const override { return layer_ == Layer::first ? "colorize" : "behind-colorize"; }
  std::span<const Aov> aovs() const override { return kAovs; }
  uint32_t variant(const scene::SceneData&, const look::LookData& look) const override {
    return !look.declared(look::kColorizers).empty();
  }

  void declare(FrameBuilder& frame, uint32_t hasColorizers) override {
    viewCount_ = frame.configuration().viewCount;
    gpu::Handle picture = frame.get(kPicture, layer_);
    if (hasColorizers) {
      ImageStepDesc desc{
          .name = name(),
          .shader = {{shaders::colorize_image_frag}, {shaders::colorize_image_comp}},
          .inputs = {{shared::kColorizeColor, picture}, {shared::kColorizeDepth, frame.get(kDepth, layer_)}},
          .outputs = {frame.image(name(), {.format = kHalves})},
          .fetches = 2,
          .uniformBytes = sizeof(shared::ColorizeUniforms)};
      if (layer_ == Layer::first && frame.has(kBlended)) {
        desc.shader = {{shaders::colorize_blended_image_frag}, {shaders::colorize_blended_image_comp}};
        desc.inputs.push_back({shared::kColorizeBlended, frame.get(kBlended)});
        desc.inputs.push_back({shared::kColorizeBlendedDistance, frame.get(kBlendedDistance)});
        desc.fetches += 2;
      }
      picture = step_.declare(frame, std::move(desc))[0];
    }
    frame.give(kPicture, picture, layer_);
    if (layer_ != Layer::first) return;
    frame.give(kGradedColors, picture);
    frame.offer(kAovs[0], {picture});
  }
  void create(FrameBuilder& frame) override { step_.create(frame); }
  void bind(const gpu::GraphResources& resources) override { step_.bind(resources); }

  void update(const FrameInput& input) override {
    shared::ColorizeUniforms uniforms{};
    const uint32_t features = fillUniforms(input, viewCount_, uniforms);
    step_.setJobs({{{features}, {}}});
    step_.update(uniforms);
  }

 private:
  static constexpr Aov kAovs[] = {{.name = "colorize", .isColor = true, .premultiplied = 3}};

  Layer layer_;
  ImageStep step_;
  uint32_t viewCount_ = 1;
};

}  // namespace

std::unique_ptr<Pass> makeColorize(Layer layer) {
  return std::make_unique<Colorize>(layer);
}

}  // namespace scumble::passes
