#include "passes/limit/limit.h"

#include <algorithm>
#include <cmath>

#include "base/oklab.h"
#include "frame/image_step.h"
#include "frame/metatexture.h"
#include "passes/limit/limit.shared.h"
#include "passes/limit/limit_knobs.h"
#include "shaders/limit_image_comp.h"
#include "shaders/limit_image_frag.h"
#include "shaders/limit_mend_image_comp.h"
#include "shaders/limit_mend_image_frag.h"

namespace scumble::passes {

using namespace frame;

std::vector<glm::vec3> paletteColors(const LimitParams& params) {
  std::vector<glm::vec3> colors;
  if (params.palette == kLimitOff || params.amount <= 0) return colors;
  if (params.palette == kLimitLook) {
    const look::Color* const own[] = {&params.color1,  &params.color2,  &params.color3,  &params.color4,
                                      &params.color5,  &params.color6,  &params.color7,  &params.color8,
                                      &params.color9,  &params.color10, &params.color11, &params.color12,
                                      &params.color13, &params.color14, &params.color15, &params.color16};
    for (int i = 0; i < params.colors; ++i) colors.push_back(*own[i]);
  } else {
    for (const uint32_t srgb : builtInPalette(params.palette)) colors.push_back(look::linearFromSrgb(srgb));
  }
  return colors;
}

uint32_t writePalette(const LimitParams& params, std::span<glm::vec3> to) {
  const std::vector<glm::vec3> colors = paletteColors(params);
  for (size_t i = 0; i < to.size() && !colors.empty(); ++i)
    to[i] = glm::vec3(oklabFromLinear(glm::dvec3(colors[std::min(i, colors.size() - 1)]))) *
            glm::vec3(params.lightness, 1, 1);
  // A loop of constant length is unrolled, which CPU drivers want.
  return uint32_t(colors.size() + 3) / 4 * 4;
}

bool limitsByMarks(const LimitParams& params) {
  return std::max(params.dither, params.skyDither) > 0 && !paletteColors(params).empty();
}

namespace {

class Limit : public Pass {
 public:
  explicit Limit(Layer layer) : layer_(layer) {}
  const char* name() const override { return "limit"; }
  std::span<const Aov> aovs() const override { return kAovs; }
  uint32_t variant(const scene::SceneData&, const look::LookData& look) const override {
    const LimitParams params = look.get<LimitParams>();
    return paletteColors(params).empty() ? 0 : limitsByMarks(params) ? 2 : 1;
  }

  // 1: colours are limited; 2: by marks as well.
  void declare(FrameBuilder& frame, uint32_t isLimited) override {
    gpu::Handle picture = frame.get(kPicture, layer_);
    if (isLimited) {
      const std::string of = layer_ == Layer::first ? "" : "behind-";
      const gpu::Handle limited =
          limit_.declare(frame, {.name = name(),
                                 .shader = {{shaders::limit_image_frag}, {shaders::limit_image_comp}},
                                 .inputs = {{shared::kLimitColor, picture},
                                            {shared::kLimitWarp, frame.get(isLimited == 2 ? kWarp : kDepth)},
                                            {shared::kLimitDepth, frame.get(kDepth)}},
                                 .textures = {shared::kLimitStrokes},
                                 .outputs = {frame.image(of + "limited", {.format = kHalves})},
                                 .fetches = 7 + 3 + 1 + 4,  // colours, warp, depth, strokes
                                 .uniformBytes = sizeof(shared::LimitUniforms)})[0];
      // What lies behind is not seen as it is, and needs no mending.
      if (layer_ == Layer::first)
        picture = mend_.declare(
            frame, {.name = name(),
                    .shader = {{shaders::limit_mend_image_frag}, {shaders::limit_mend_image_comp}},
                    .inputs = {{shared::kMendColor, picture}, {shared::kMendLimited, limited}},
                    .outputs = {frame.image(name(), {.format = kHalves})},
                    .fetches = 8})[0];
      else
        picture = limited;
    }
    frame.give(kPicture, picture, layer_);
    if (layer_ == Layer::first) frame.offer(kAovs[0], {picture});
  }

  void create(FrameBuilder& frame) override {
    limit_.create(frame);
    if (layer_ == Layer::first) mend_.create(frame);
    examples_ = &frame.examples();
  }
  void bind(const gpu::GraphResources& resources) override {
    limit_.bind(resources);
    if (layer_ == Layer::first) mend_.bind(resources);
  }

  void update(const FrameInput& input) override {
    const LimitParams params = input.knobs.scene<LimitParams>();
    shared::LimitUniforms uniforms{};
    uniforms.knobs = params;
    // The rest of the way is left to edges, so that marks and edges leave the palette's own colours alone.
    constexpr float kReach = 0.8f;
    uniforms.dither = kReach * params.dither;
    uniforms.driftReach = std::max(int(std::lround(12 * input.uniforms.pixelScale)), 2);
    const uint32_t count = writePalette(params, uniforms.colors);

    // The pattern in the sky closes around the horizon, and is as coarse as the picture shows it.
    const ExampleTexture& strokes = examples_->get(input.look, kStrokes);
    const bool sky = params.skyDither > 0 && !input.transparent;
    if (sky) {
      const float around = std::round(360 / params.skySize);
      uniforms.skyShift = patternShift(input.seed);
      uniforms.skyTiles = glm::vec2(around, 360 / params.skySize) / glm::radians(360.0f);
      const float radiansAPixel =
          2 * std::abs(input.uniforms.cyclopeanNdcToEyeRay.y) / input.uniforms.imageSize.y;
      const float texelsAPixel = uniforms.skyTiles.y * radiansAPixel * float(strokes.height);
      uniforms.skyLod = std::max(std::log2(texelsAPixel + 1e-6f), 0.0f);
      uniforms.skyDither = kReach * params.skyDither;
      // Strokes go from dark to light over about 12 texels.
      uniforms.skySlope = uniforms.skyDither * std::min(texelsAPixel, 1.0f) / 12;
    }
    // The marks at a pixel are those of what stands before it.
    const uint32_t marks = layer_ != Layer::first ? 0 : sky ? 2 : params.dither > 0 ? 1 : 0;
    const ImageStep::Texture texture{shared::kLimitStrokes, &strokes.image, ExampleTextures::kSampler};
    limit_.update(uniforms);
    limit_.setJobs({{{count, marks}, {texture}}});
    if (layer_ == Layer::first) mend_.setJobs({{{uint32_t(count > 0 && params.softness > 0)}, {}}});
  }

 private:
  static constexpr Aov kAovs[] = {{.name = "limit", .isColor = true, .premultiplied = 3}};
  static constexpr double kStrokes = 1;  // of the example textures that are built in

  Layer layer_;
  ImageStep limit_, mend_;
  ExampleTextures* examples_ = nullptr;
};

}  // namespace

std::unique_ptr<Pass> makeLimit(Layer layer) {
  return std::make_unique<Limit>(layer);
}

}  // namespace scumble::passes
