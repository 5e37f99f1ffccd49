#include "features/ocean/paint/ocean.h"

#include <cmath>
#include <optional>

#include "features/ocean/ocean.h"
#include "features/ocean/paint/ocean.shared.h"
#include "features/ocean/paint/ocean_knobs.h"
#include "features/ocean/paint/ocean_maps.h"
#include "frame/drawn_image.h"
#include "frame/geometry_step.h"
#include "frame/image_step.h"
#include "frame/metatexture.h"
#include "shaders/ocean_image_comp.h"
#include "shaders/ocean_image_frag.h"
#include "shaders/ocean_surface_frag.h"
#include "shaders/ocean_surface_vert.h"
#include "stage/palette.h"

namespace scumble::ocean {

using namespace frame;

namespace {

// Mirrors the block of ocean.image.glsl.
struct PaintUniforms {
  MetaTextureUniforms meta;
  shared::OceanPaint ocean;
};

class Ocean : public Pass {
 public:
  const char* name() const override { return "ocean"; }

  void declare(FrameBuilder& frame, uint32_t) override {
    const auto here = frame.scene().feature(kName);
    if (!here) return;
    material_ = here->material;
    frame.step("ocean", [this](VkCommandBuffer commands) { record(commands); });
    GeometryStep::use(frame);
    pattern_.declare(frame, "ocean pattern", kPatternFormat);
    waves_.declare(frame, "ocean waves", kWavesFormat);
    depth_.declare(frame, "ocean depth", kDepthFormat);
    const std::vector<gpu::Handle> colors = image_.declare(
        frame, {.name = name(),
                .shader = {{shaders::ocean_image_frag}, {shaders::ocean_image_comp}},
                .inputs = {{shared::kOceanPatternBinding, pattern_.image()},
                           {shared::kOceanWavesBinding, waves_.image()},
                           {shared::kOceanDepthBinding, depth_.image()}},
                .textures = {shared::kOceanExampleBinding, shared::kOceanInverseBinding,
                             shared::kOceanFoamBinding, shared::kOceanBathicBinding, shared::kOceanSkyBinding,
                             shared::kOceanNextBathicBinding, shared::kOceanNextSkyBinding},
                .outputs = {frame.image("ocean-lit", {.format = kHalves}),
                            frame.image("ocean-shadowed", {.format = kHalves})},
                // The example's eight copies, turned two ways, foam, and colours of water and sky.
                .fetches = 3 + 2 * 8 * 4 + 3 * 4,
                .uniformBytes = sizeof(PaintUniforms)});
    frame.give(kPrepaintedLit, colors[0]);
    frame.give(kPrepaintedShadowed, colors[1]);
  }

  void create(FrameBuilder& frame) override {
    configuration_ = frame.configuration();
    examples_ = &frame.examples();
    maps_.emplace(frame.device());
    layout_ =
        gpu::SetLayout(frame.device(), {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_VERTEX_BIT}});
    sets_ = gpu::DescriptorSets(frame.device(), layout_);
    scene_ = &frame.scene();

    GeometryStepDesc desc;
    desc.onlyMaterial = material_;
    desc.vertex = {shaders::ocean_surface_vert};
    desc.fragment = {shaders::ocean_surface_frag};
    desc.inputs = kPosition | kNormal | kDPdu | kDPdv | kPatternUv;
    desc.colorFormats = {kPatternFormat, kWavesFormat};
    desc.viewMask = configuration_.views().mask();
    desc.viewCount = configuration_.viewCount;
    desc.passLayout = &layout_;
    step_.create(frame, desc);
    image_.create(frame);
  }
  void bind(const gpu::GraphResources& resources) override {
    resources_ = &resources;
    sets_.writeBuffer(0, 0,
                      static_cast<const OceanWaves*>(scene_->feature(kName)->moment)->buffer().handle());
    image_.bind(resources);
  }

  void update(const FrameInput& input) override {
    const OceanPaintParams p = input.knobs.scene<OceanPaintParams>();
    const auto metaParams = sameRows(input.knobs.scene<OceanMetaTextureParams>());
    step_.specialise(tangentOptions(metaParams, input.uniforms));
    MetaTextureUse use = metaTextureUse(metaParams, 0b0111, input.look, *examples_, input.uniforms.pixelScale,
                                        patternShift(input.seed));
    use.meta.wrapping = 0;
    constexpr double kTurn = 6.283185307179586;
    const PaletteParams palette = input.knobs.of<PaletteParams>(material_);
    const glm::vec3 foam(p.foamColor);
    const OceanParams params = input.knobs.scene<OceanParams>();
    const float wind = glm::radians(float(params.windDirection));
    PaintUniforms uniforms{use.meta.uniforms(), {}};
    uniforms.ocean = {
        .knobs = p,
        .phase = float(std::fmod(double(p.live) * input.time, 1.0) * kTurn),
        .liveSpread = float(kTurn) * p.liveSpread,
        .foamLit = glm::sqrt(foam),
        .foamShadowed = glm::sqrt(glm::vec3(shadowedColor(palette, glm::dvec3(foam)))),
        .fadeEnd = static_cast<const OceanPlan*>(scene_->feature(kName)->plan)->shape().falseHorizon,
        .wind = {std::cos(wind), std::sin(wind)}};
    image_.update(uniforms);
    const bool goesOver = p.next > 0;
    const gpu::SamplerDesc clamped;
    image_.setJobs(
        {{{(goesOver ? uint32_t(shared::kOceanNext) : 0u) | (p.follow ? uint32_t(shared::kOceanFollows) : 0u),
           use.meta.features()},
          {{shared::kOceanExampleBinding, &use.image(), use.sampler()},
           {shared::kOceanInverseBinding, &use.inverse(), ExampleTextures::kInverseSampler},
           {shared::kOceanFoamBinding, &examples_->get(input.look, p.foamTexture).image, use.sampler()},
           {shared::kOceanBathicBinding, &maps_->bathic(input.look, p.colors), clamped},
           {shared::kOceanSkyBinding, &maps_->sky(input.look, p.sky), clamped},
           {shared::kOceanNextBathicBinding, &maps_->bathic(input.look, goesOver ? p.nextColors : p.colors),
            clamped},
           {shared::kOceanNextSkyBinding, &maps_->sky(input.look, goesOver ? p.nextSky : p.sky), clamped}}}});
  }

 private:
  static constexpr VkFormat kPatternFormat = VK_FORMAT_R32G32B32A32_UINT,
                            kWavesFormat = VK_FORMAT_R32G32B32A32_UINT;

  void record(VkCommandBuffer commands) const {
    const gpu::Target colors[] = {pattern_.target(*resources_), waves_.target(*resources_)};
    const gpu::Target depth = depth_.target(*resources_);
    gpu::drawViews(commands, configuration_.views(), colors, &depth,
                   [&](uint32_t firstView) { step_.draw(commands, &sets_, firstView); });
  }

  DrawnImage pattern_, waves_, depth_;
  const SceneOnGpu* scene_ = nullptr;
  uint32_t material_ = 0;
  const gpu::GraphResources* resources_ = nullptr;
  Configuration configuration_;
  ExampleTextures* examples_ = nullptr;
  std::optional<OceanMaps> maps_;
  gpu::SetLayout layout_;
  gpu::DescriptorSets sets_;
  GeometryStep step_;
  ImageStep image_;
};

}  // namespace

std::unique_ptr<Pass> makeOcean() {
  return std::make_unique<Ocean>();
}

}  // namespace scumble::ocean
