#include "passes/ocean/ocean.h"

#include <cmath>
#include <optional>

#include "frame/geometry_step.h"
#include "frame/image_step.h"
#include "frame/metatexture.h"
#include "frame/palette.h"
#include "passes/ocean/ocean.shared.h"
#include "passes/ocean/ocean_maps.h"
#include "shaders/ocean_image_comp.h"
#include "shaders/ocean_image_frag.h"
#include "shaders/ocean_surface_frag.h"
#include "shaders/ocean_surface_vert.h"

namespace scumble::passes {

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

  void declare(FrameBuilder& frame) override {
    const Configuration& c = frame.configuration();
    pattern_ = frame.transient("ocean pattern", {kPatternFormat, c.width, c.height, c.viewCount});
    waves_ = frame.transient("ocean waves", {kWavesFormat, c.width, c.height, c.viewCount});
    depth_ = frame.transient("ocean depth", {VK_FORMAT_D32_SFLOAT, c.width, c.height, c.viewCount});
    frame.addStep("ocean",
                  {{frame.finalVertices(), gpu::Use::vertexBuffer},
                   {pattern_, gpu::Use::colorTarget},
                   {waves_, gpu::Use::colorTarget},
                   {depth_, gpu::Use::depthTarget}},
                  [this](VkCommandBuffer commands) { record(commands); });
    image_.declare(frame, "ocean", {{shaders::ocean_image_frag}, {shaders::ocean_image_comp}},
                   {{pattern_}, {waves_}, {depth_}},
                   {frame.slot(Slot::oceanLit), frame.slot(Slot::oceanShadowed)}, sizeof(PaintUniforms), {},
                   7);
  }

  void create(FrameBuilder& frame, const FrameResources& resources) override {
    resources_ = &resources;
    scene_ = &frame.scene();
    configuration_ = frame.configuration();
    examples_ = &frame.examples();
    maps_.emplace(frame.device());
    layout_ =
        gpu::SetLayout(frame.device(), {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_VERTEX_BIT}});
    sets_ = gpu::DescriptorSets(frame.device(), layout_);
    sets_.writeBuffer(0, 0, scene_->waves()->buffer().handle());

    GeometryStepDesc desc;
    desc.what = GeometryStepDesc::What::ocean;
    desc.vertex = {shaders::ocean_surface_vert};
    desc.fragment = {shaders::ocean_surface_frag};
    desc.inputs = kPosition | kNormal | kDPdu | kDPdv | kPatternUv;
    desc.colorFormats = {kPatternFormat, kWavesFormat};
    desc.viewMask = configuration_.views().mask();
    desc.viewCount = configuration_.viewCount;
    desc.passLayout = &layout_;
    step_.create(frame.device(), resources, frame.scene(), desc);
    image_.create(frame, resources);
  }

  void update(const FrameInput& input) override {
    const OceanPaintParams p = input.look.get<OceanPaintParams>();
    const auto metaParams = sameRows(input.look.get<OceanMetaTextureParams>());
    step_.specialise(input.scene, tangentOptions(metaParams, input.uniforms));
    MetaTextureUse use = metaTextureUse(metaParams, 0b0111, input.look, *examples_, input.uniforms.pixelScale,
                                        patternShift(input.seed));
    use.meta.wrapping = 0;
    constexpr double kTurn = 6.283185307179586;
    const PaletteParams palette =
        input.scene.knobs<PaletteParams>(input.look, size_t(input.scene.oceanMaterial()));
    const glm::vec3 foam(p.foamColor);
    const OceanParams params = input.look.get<OceanParams>();
    const float wind = glm::radians(float(params.windDirection));
    PaintUniforms uniforms{use.meta.uniforms(), {}};
    uniforms.ocean = {.dither = p.dither,
                      .lightDither = p.lightDither,
                      .reflection = p.reflection,
                      .phase = float(std::fmod(double(p.live) * input.time, 1.0) * kTurn),
                      .liveSpread = float(kTurn) * p.liveSpread,
                      .foam = p.foam,
                      .foamStart = p.foamStart,
                      .foamLit = glm::sqrt(foam),
                      .foamShadowed = glm::sqrt(glm::vec3(shadowedColor(palette, glm::dvec3(foam)))),
                      .saturation = p.saturation,
                      .overlayAmount = p.overlayAmount,
                      .skySaturation = p.skySaturation,
                      .skyOverlayAmount = p.skyOverlayAmount,
                      .overlay = p.overlay.linear,
                      .skyOverlay = p.skyOverlay.linear,
                      .next = p.next,
                      .fadeEnd = input.scene.options().ocean.falseHorizon,
                      .wind = {std::cos(wind), std::sin(wind)}};
    image_.update(uniforms);
    const bool goesOver = p.next > 0;
    const gpu::SamplerDesc clamped;
    image_.setJobs({{{goesOver ? uint32_t(shared::kOceanNext) : 0u, use.meta.features()},
                     {{&use.image(), use.sampler()},
                      {&use.inverse(), ExampleTextures::kInverseSampler},
                      {&examples_->get(input.look, look::Picture{kFoamExample}).image, use.sampler()},
                      {&maps_->bathic(input.look, p.colors), clamped},
                      {&maps_->sky(input.look, p.sky), clamped},
                      {&maps_->bathic(input.look, goesOver ? p.nextColors : p.colors), clamped},
                      {&maps_->sky(input.look, goesOver ? p.nextSky : p.sky), clamped}}}});
  }

 private:
  static constexpr VkFormat kPatternFormat = VK_FORMAT_R32G32B32A32_UINT,
                            kWavesFormat = VK_FORMAT_R32G32B32A32_UINT;
  static constexpr int kFoamExample = 4;  // among the built-in ones

  void record(VkCommandBuffer commands) const {
    const gpu::Target colors[] = {{&resources_->image(pattern_)}, {&resources_->image(waves_)}};
    const gpu::Target depth{&resources_->image(depth_), nullptr, {}};
    gpu::drawViews(commands, configuration_.views(), colors, &depth, [&](uint32_t firstView) {
      step_.draw(commands, *resources_, *scene_, &sets_, firstView);
    });
  }

  gpu::ResourceId pattern_ = 0, waves_ = 0, depth_ = 0;
  const FrameResources* resources_ = nullptr;
  const SceneOnGpu* scene_ = nullptr;
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

}  // namespace scumble::passes
