// The picture as washes of pigment on paper.
#include <algorithm>
#include <cmath>

#include "features/watercolor/wash/paper.h"
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

class Wash : public Pass {
 public:
  const char* name() const override { return "watercolor"; }
  uint32_t variant(const scene::SceneData&, const look::LookData& look) const override {
    return mayShow(look);
  }

  void declare(FrameBuilder& frame, uint32_t isShown) override {
    if (!isShown) return;
    isTinted_ = frame.has(kTints);
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
    frame.give(
        kPicture,
        wash_.declare(frame, {.name = name(),
                              .shader = {{shaders::wash_image_frag}, {shaders::wash_image_comp}},
                              .inputs = {{shared::kWashPicture, picture, true},
                                         {shared::kWashDensity, blurred, true},
                                         {shared::kWashPigment, frame.get(kPigment), true},
                                         {shared::kWashLight, frame.get(kShadow), true},
                                         {shared::kWashTint,
                                          frame.has(kTints) ? frame.get(kTints) : frame.get(kPigment), true}},
                              .textures = {shared::kWashPaper, shared::kWashBroad, shared::kWashNormals},
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
    shared::WashUniforms u = paperUniforms(input, frame_->configuration());
    u.white = p.white.linear;
    u.relief = p.relief, u.wobble = p.wobble * scale, u.strength = p.strength;
    u.edges = p.edges, u.edgeWidth = p.edgeWidth * scale, u.granulation = p.granulation;
    u.dryBrush = p.dryBrush, u.bleeding = p.bleeding, u.bare = p.bare, u.bareFrom = p.bareFrom;
    u.turbulence = p.turbulence, u.hue = p.hue, u.glazing = p.glazing;
    for (ImageStep* const step : steps_) step->update(u);
    // Two and a half deviations, as wash_blur.image.glsl has them.
    const float deviation = std::max(0.5f * u.edgeWidth / float(shared::kPigmentScale), 0.35f);
    const uint32_t reach = uint32_t(std::ceil(2.5f * deviation));
    blurX_.setJobs({{{0, reach}, {}}});
    blurY_.setJobs({{{1, reach}, {}}});
    const ExampleTexture& paper = frame_->examples().get(input.look, p.paper);
    const bool hasNormals = p.normals.index < 0;
    const ExampleTexture& normals = hasNormals ? frame_->examples().get(input.look, p.normals) : paper;
    const int slopes = hasNormals ? shared::kSlopesOfNormals : p.normals.index;
    wash_.setJobs({{{uint32_t(slopes), uint32_t(isTinted_)},
                    {{shared::kWashPaper, &paper.image, paperSampler(paper, u.paperSize)},
                     {shared::kWashBroad, &paper.image, kBroadSampler},
                     {shared::kWashNormals, &normals.image, paperSampler(normals, u.paperSize)}}}});
  }

 private:
  FrameBuilder* frame_ = nullptr;
  bool isTinted_ = false;
  ImageStep density_, blurX_, blurY_, wash_;
  ImageStep* const steps_[4] = {&density_, &blurX_, &blurY_, &wash_};
};

}  // namespace

std::unique_ptr<Pass> makeWash() {
  return std::make_unique<Wash>();
}

}  // namespace scumble::watercolor
