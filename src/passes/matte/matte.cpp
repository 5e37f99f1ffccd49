#include "passes/matte/matte.h"

#include "frame/geometry_step.h"
#include "frame/image_step.h"
#include "frame/material_params.h"
#include "passes/final_color/final_color_knobs.h"
#include "passes/matte/matte.shared.h"
#include "passes/surface/surface_knobs.h"
#include "passes/warp/warp_knobs.h"
#include "shaders/matte_image_comp.h"
#include "shaders/matte_image_frag.h"
#include "shaders/matte_sampled_image_comp.h"
#include "shaders/matte_sampled_image_frag.h"
#include "shaders/matte_samples_image_comp.h"
#include "shaders/matte_samples_image_frag.h"
#include "shaders/matte_surface_frag.h"
#include "shaders/matte_surface_vert.h"

namespace scumble::passes {

using namespace frame;

namespace {

// Of the first surfaces, or of those behind them.
struct ObjectLayer {
  gpu::Handle objects, depth;
  uint32_t samples = 1;
  gpu::DescriptorSets sets;
  GeometryStep step;
};

class Matte : public Pass {
 public:
  const char* name() const override { return "matte"; }
  std::span<const Aov> aovs() const override { return kAovs; }
  uint32_t variant(const scene::SceneData&, const look::LookData& look) const override {
    const bool tears = mayTear(look);
    return tears + (tears && look.get<FinalColorParams>().ripple == shared::kRippleLayered);
  }

  // 1: something may be torn; 2: and shows what lies behind.
  void declare(FrameBuilder& frame, uint32_t variant) override {
    configuration_ = frame.configuration();
    isLayered_ = variant == 2;
    firstDepth_ = frame.get(kDepth);
    declareLayer(frame, first_, configuration_.samples, "matte");
    if (isLayered_) declareLayer(frame, behind_, 1, "matte behind");

    const ImageShader one{{shaders::matte_image_frag}, {shaders::matte_image_comp}},
        four{{shaders::matte_samples_image_frag}, {shaders::matte_samples_image_comp}};
    // Without layers the shader looks at none of what lies behind.
    ImageStepDesc desc{
        .name = name(),
        .shader = configuration_.samples > 1 ? four : one,
        .inputs = {{shared::kMatteObjects, first_.objects},
                   {shared::kMatteWarp, frame.get(variant ? kWarp : kLit), true},
                   {shared::kMatteDepth, firstDepth_},
                   {shared::kMatteInflated, variant ? frame.get(kInflatedDepth) : firstDepth_},
                   {shared::kMatteTiles, frame.get(kTiles)},
                   {shared::kMatteBehind, isLayered_ ? behind_.objects : firstDepth_},
                   {shared::kMatteBehindDepth, isLayered_ ? frame.get(kDepth, Layer::behind) : firstDepth_}},
        .outputs = {frame.image("cryptomatte", {.format = kFloats}),
                    frame.image("cryptomatte rest", {.format = kFloats})},
        .fetches = 1 + 8 + 9 + 17 + 4 * (configuration_.samples > 1 ? 20u : 8u),
        .uniformBytes = sizeof(shared::MatteUniforms)};
    if (frame.has(kSampledPicture)) {
      desc.shader = {{shaders::matte_sampled_image_frag}, {shaders::matte_sampled_image_comp}};
      desc.fetches = 1 + 8 + 8 + 17 + 4 * 3;
      desc.inputs.push_back({shared::kMatteDepthSamples, frame.get(kDepthSamples)});
    }
    frame.offer(kAovs[0], image_.declare(frame, std::move(desc)));
  }

  void create(FrameBuilder& frame) override {
    frame_ = &frame;
    materials_.create(frame);
    layout_ = gpu::SetLayout(frame.device(),
                             {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, VK_SHADER_STAGE_FRAGMENT_BIT},
                              {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT}});
    createLayer(first_, false);
    if (isLayered_) createLayer(behind_, true);
    image_.create(frame);
  }

  void bind(const gpu::GraphResources& resources) override {
    resources_ = &resources;
    for (ObjectLayer* layer : {&first_, &behind_})
      for (size_t set = 0; set < layer->sets.size(); ++set)
        layer->sets.rewriteTexture(set, 1, resources.image(firstDepth_).view(),
                                   frame_->samplers().get({VK_FILTER_NEAREST}));
    image_.bind(resources);
  }

  void update(const FrameInput& input) override {
    first_.step.refresh();
    if (isLayered_) behind_.step.refresh();
    for (size_t m = 0; m < input.scene.materialCount(); ++m)
      materials_.write(m, {mipBias(input.knobs.of<SurfaceParams>(m).simplify, input.uniforms.pixelScale)});
    image_.setJobs({{{uint32_t(input.knobs.scene<FinalColorParams>().ripple)}, {}}});
    image_.update(shared::MatteUniforms{{input.inflation}});
  }

 private:
  void declareLayer(FrameBuilder& frame, ObjectLayer& layer, uint32_t samples, const std::string& name) {
    layer.samples = samples;
    frame.step("matte", [this, &layer](VkCommandBuffer commands) { record(commands, layer); });
    GeometryStep::use(frame);
    frame.use(firstDepth_, gpu::Use::sampledByFragment);
    layer.objects = frame.use(frame.image(name + " objects", {.format = kFormat, .samples = samples}),
                              gpu::Use::colorTarget);
    layer.depth = frame.use(frame.image(name + " depth", {.format = kDepthFormat, .samples = samples}),
                            gpu::Use::depthTarget);
  }

  void createLayer(ObjectLayer& layer, bool isBehind) {
    layer.sets = gpu::DescriptorSets(frame_->device(), layout_);
    materials_.bind(layer.sets, 0);
    GeometryStepDesc desc;
    desc.vertex = {shaders::matte_surface_vert};
    desc.fragment = {shaders::matte_surface_frag};
    desc.inputs = kPosition | kUv0 | kUv1 | kColor;
    desc.colorFormats = {kFormat};
    desc.samples = layer.samples;
    desc.viewMask = configuration_.views().mask();
    desc.viewCount = configuration_.viewCount;
    desc.constant = isBehind;
    desc.passLayout = &layout_;
    desc.materialStrides = {materials_.kStride};
    layer.step.create(*frame_, desc);
  }

  void record(VkCommandBuffer commands, const ObjectLayer& layer) const {
    const gpu::Target objects{&resources_->image(layer.objects), nullptr, {}};
    const gpu::Target depth{&resources_->image(layer.depth), nullptr, {}};
    gpu::drawViews(commands, configuration_.views(), {&objects, 1}, &depth,
                   [&](uint32_t firstView) { layer.step.draw(commands, &layer.sets, firstView); });
  }

  // Whole numbers up to 2^24; every device has as many samples of it as of colours, which integers lack.
  static constexpr VkFormat kFormat = VK_FORMAT_R32_SFLOAT;

  // Object's number and coverage of two ranks an image, the greatest coverage first.
  static constexpr Aov kAovs[] = {
      {.name = "cryptomatte",
       .channels = {"id0", "coverage0", "id1", "coverage1", "id2", "coverage2", "id3", "coverage3"},
       .needsFloat = true,
       .namesObjects = true}};

  FrameBuilder* frame_ = nullptr;
  Configuration configuration_;
  bool isLayered_ = false;
  gpu::Handle firstDepth_;
  ObjectLayer first_, behind_;
  MaterialBlocks<shared::MatteMaterial> materials_;
  const gpu::GraphResources* resources_ = nullptr;
  gpu::SetLayout layout_;
  ImageStep image_;
};

}  // namespace

std::unique_ptr<Pass> makeMatte() {
  return std::make_unique<Matte>();
}

}  // namespace scumble::passes
