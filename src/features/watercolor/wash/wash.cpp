// The picture as washes of pigment on paper.
#include <algorithm>
#include <cmath>

#include "features/watercolor/watercolor.h"
#include "features/watercolor/watercolor.shared.h"
#include "features/watercolor/watercolor_knobs.h"
#include "frame/image_step.h"
#include "shaders/wash_blur_image_comp.h"
#include "shaders/wash_blur_image_frag.h"
#include "shaders/wash_density_image_comp.h"
#include "shaders/wash_density_image_frag.h"
#include "shaders/wash_image_comp.h"
#include "shaders/wash_image_frag.h"

namespace scumble::watercolor {

using namespace frame;

namespace {

enum PaperMotion : uint32_t { kWithScreen, kWithTurn, kWithSubject };

// Where the paper's origin lies in a view, pixels: a function of the view alone.
glm::vec2 paperPlace(const FrameInput& input, uint32_t view, uint32_t motion) {
  const shared::FrameUniforms& frame = input.uniforms;
  const shared::ViewUniforms& v = frame.views[view];
  if (motion == kWithTurn) {
    // As far as a thing without end would move when the camera turns.
    const glm::vec3 ahead = -glm::vec3(v.worldToEye[0][2], v.worldToEye[1][2], v.worldToEye[2][2]);
    const float pixelsOfRadian = 0.5f * frame.imageSize.y / std::abs(v.ndcToEyeRay.y);
    return pixelsOfRadian *
           glm::vec2(std::atan2(-ahead.x, -ahead.z), std::asin(glm::clamp(ahead.y, -1.0f, 1.0f)));
  }
  if (motion == kWithSubject) {
    // In both eyes by the view between them: the paper is as far away as the picture's plane.
    const glm::vec4 clip = frame.worldToCyclopean * glm::vec4(frame.sceneCenter, 1);
    if (clip.w > 0) return glm::vec2(clip) / clip.w * 0.5f * frame.imageSize;
  }
  return glm::vec2(0);
}

// Where on the picture the light lies that falls on the paper (section 4.2), so that both come from one side:
// in -1 to 1 over the picture, not farther off than twice that, and in front of it.
glm::vec3 paperLight(const FrameInput& input, uint32_t view) {
  const glm::vec3 inEye = glm::mat3(input.uniforms.views[view].worldToEye) * input.uniforms.toLight;
  constexpr float kFarthest = 2;
  using shared::kPaperLightBefore;
  const glm::vec2 side = kPaperLightBefore * glm::vec2(inEye.x, -inEye.y) / std::max(std::abs(inEye.z), 0.2f);
  return {glm::clamp(side, -kFarthest, kFarthest), kPaperLightBefore};
}

class Wash : public Pass {
 public:
  const char* name() const override { return "watercolor"; }
  uint32_t variant(const scene::SceneData&, const look::LookData& look) const override {
    return mayShow(look);
  }

  void declare(FrameBuilder& frame, uint32_t isShown) override {
    if (!isShown) return;
    const gpu::Handle picture = frame.get(kPicture);
    constexpr gpu::ImageShape kQuarter{
        .format = kHalves, .overX = shared::kPigmentScale, .overY = shared::kPigmentScale};
    constexpr uint64_t kBytesOfBlock = sizeof(shared::WashUniforms);
    const gpu::Handle density = density_.declare(
        frame, {.name = name(),
                .shader = {{shaders::wash_density_image_frag}, {shaders::wash_density_image_comp}},
                .inputs = {{shared::kWashPicture, picture, true}},
                .outputs = {frame.image("density", kQuarter)},
                .fetches = 4 * 4,
                .uniformBytes = kBytesOfBlock})[0];
    const auto blur = [&](ImageStep& step, gpu::Handle from, const char* to) {
      return step.declare(frame,
                          {.name = name(),
                           .shader = {{shaders::wash_blur_image_frag}, {shaders::wash_blur_image_comp}},
                           .inputs = {{shared::kWashBlurred, from}},
                           .outputs = {frame.image(to, kQuarter)},
                           .fetches = 7,
                           .uniformBytes = kBytesOfBlock})[0];
    };
    const gpu::Handle blurred =
        blur(blurY_, blur(blurX_, density, "density blurred along x"), "density blurred");
    frame.give(kPicture,
               wash_.declare(frame, {.name = name(),
                                     .shader = {{shaders::wash_image_frag}, {shaders::wash_image_comp}},
                                     .inputs = {{shared::kWashPicture, picture, true},
                                                {shared::kWashDensity, blurred, true},
                                                {shared::kWashPigment, frame.get(kPigment), true},
                                                {shared::kWashLight, frame.get(kShadow), true}},
                                     .textures = {shared::kWashPaper, shared::kWashBroad},
                                     .outputs = {frame.image(name(), {.format = kHalves})},
                                     .fetches = 4 * 4 + 5 * 4,
                                     .uniformBytes = kBytesOfBlock})[0]);
  }

  void create(FrameBuilder& frame) override {
    frame_ = &frame;
    for (ImageStep* const step : steps_) step->create(frame);
  }
  void bind(const gpu::GraphResources& resources) override {
    for (ImageStep* const step : steps_) step->bind(resources);
  }

  void update(const FrameInput& input) override {
    const WatercolorParams p = input.knobs.scene<WatercolorParams>();
    const float scale = input.uniforms.pixelScale;
    shared::WashUniforms u{};
    u.white = p.white.linear;
    u.paperSize = p.paperSize * scale;
    u.relief = p.relief, u.wobble = p.wobble * scale, u.strength = p.strength;
    u.edges = p.edges, u.edgeWidth = p.edgeWidth * scale, u.granulation = p.granulation;
    u.dryBrush = p.dryBrush, u.bleeding = p.bleeding, u.bare = p.bare, u.bareFrom = p.bareFrom;
    // A sphere ends nowhere.
    const bool onSphere = frame_->configuration().onSphere;
    u.margin = onSphere ? 0 : p.margin, u.turbulence = p.turbulence, u.hue = p.hue, u.glazing = p.glazing;
    for (uint32_t view = 0; view < frame_->configuration().viewCount; ++view) {
      // Around whoever looks, or around the world.
      u.eyeToPaper = p.paperMotion == kWithTurn
                         ? glm::transpose(glm::mat3(input.uniforms.views[0].worldToEye))
                         : input.uniforms.eyeToSphere;
      if (!onSphere) u.paperAt[view] = paperPlace(input, view, uint32_t(p.paperMotion));
      u.paperLight[view] = paperLight(input, view);
    }
    for (ImageStep* const step : steps_) step->update(u);
    // Two and a half deviations, as wash_blur.image.glsl has them.
    const float deviation = std::max(0.5f * u.edgeWidth / float(shared::kPigmentScale), 0.35f);
    const uint32_t reach = uint32_t(std::min(std::ceil(2.5f * deviation), 24.0f));
    blurX_.setJobs({{{0, reach}, {}}});
    blurY_.setJobs({{{1, reach}, {}}});
    const ExampleTexture& paper = frame_->examples().get(input.look, p.paper);
    // The mip level that has about a texel a pixel, since all of the picture has the same.
    const float level = std::round(std::log2(float(paper.width) / std::max(u.paperSize, 1.0f)));
    wash_.setJobs({{{},
                    {{shared::kWashPaper, &paper.image, paperSampler(glm::clamp(level, 0.0f, 8.0f))},
                     {shared::kWashBroad, &paper.image, paperSampler(2)}}}});
  }

 private:
  static gpu::SamplerDesc paperSampler(float level) {
    return {
        VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_REPEAT, true, false, level};
  }

  FrameBuilder* frame_ = nullptr;
  ImageStep density_, blurX_, blurY_, wash_;
  ImageStep* const steps_[4] = {&density_, &blurX_, &blurY_, &wash_};
};

}  // namespace

std::unique_ptr<Pass> makeWash() {
  return std::make_unique<Wash>();
}

}  // namespace scumble::watercolor
