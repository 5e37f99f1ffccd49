#include "passes/matte/matte.h"

#include "frame/geometry_step.h"
#include "frame/image_step.h"
#include "frame/material_params.h"
#include "passes/matte/matte.shared.h"
#include "shaders/matte_image_comp.h"
#include "shaders/matte_image_frag.h"
#include "shaders/matte_samples_image_comp.h"
#include "shaders/matte_samples_image_frag.h"
#include "shaders/matte_surface_frag.h"
#include "shaders/matte_surface_vert.h"

namespace scumble::passes {

using namespace frame;

namespace {

// Of the first surfaces, or of those behind them.
struct ObjectLayer {
  gpu::ResourceId objects = 0, depth = 0;
  uint32_t samples = 1;
  gpu::DescriptorSets sets;
  GeometryStep step;
};

class Matte : public Pass {
 public:
  explicit Matte(const PictureFacts& picture) : picture_(picture) {}
  const char* name() const override { return "matte"; }

  void declare(FrameBuilder& frame) override {
    configuration_ = frame.configuration();
    const bool layered = configuration_.layered;
    firstDepth_ = frame.slot(Slot::depth);
    materials_.declare(frame);
    declareLayer(frame, first_, configuration_.samples, "matte");
    if (layered) declareLayer(frame, behind_, 1, "matte behind");

    const ImageShader one{{shaders::matte_image_frag}, {shaders::matte_image_comp}},
        four{{shaders::matte_samples_image_frag}, {shaders::matte_samples_image_comp}};
    // Without layers the shader looks at none of what lies behind.
    image_.declare(frame, "matte", configuration_.samples > 1 ? four : one,
                   {{first_.objects},
                    {frame.slot(Slot::warp)},
                    {firstDepth_},
                    {layered ? behind_.objects : firstDepth_},
                    {layered ? frame.slot(Slot::behindDepth) : firstDepth_}},
                   {frame.slot(Slot::matte), frame.slot(Slot::matteRest)}, sizeof(shared::MatteUniforms));
  }

  void create(FrameBuilder& frame, const FrameResources& resources) override {
    resources_ = &resources;
    scene_ = &frame.scene();
    layout_ = gpu::SetLayout(frame.device(),
                             {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, VK_SHADER_STAGE_FRAGMENT_BIT},
                              {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT}});
    createLayer(frame, first_, false);
    if (configuration_.layered) createLayer(frame, behind_, true);
    image_.create(frame, resources);
  }

  void update(const FrameInput& input) override {
    for (size_t m = 0; m < input.scene.materialCount(); ++m)
      materials_.write(m, {picture_.simplify(input.look, input.scene, m)});
    image_.setJobs({{{uint32_t(picture_.ripple(input.look))}, {}}});
    image_.update(
        shared::MatteUniforms{picture_.displacement(input.look, input.scene, input.uniforms.imageSize.y)});
  }

 private:
  void declareLayer(FrameBuilder& frame, ObjectLayer& layer, uint32_t samples, const std::string& name) {
    const Configuration& c = configuration_;
    layer.samples = samples;
    layer.objects = frame.transient(name + " objects", {kFormat, c.width, c.height, c.viewCount, 1, samples});
    layer.depth =
        frame.transient(name + " depth", {VK_FORMAT_D32_SFLOAT, c.width, c.height, c.viewCount, 1, samples});
    frame.addStep("matte",
                  {{frame.finalVertices(), gpu::Use::vertexBuffer},
                   {firstDepth_, gpu::Use::sampledByFragment},
                   {layer.objects, gpu::Use::colorTarget},
                   {layer.depth, gpu::Use::depthTarget}},
                  [this, &layer](VkCommandBuffer commands) { record(commands, layer); });
  }

  void createLayer(FrameBuilder& frame, ObjectLayer& layer, bool isBehind) {
    layer.sets = gpu::DescriptorSets(frame.device(), layout_);
    materials_.bind(layer.sets, 0);
    layer.sets.writeTexture(0, 1, resources_->image(firstDepth_).view(),
                            frame.samplers().get({VK_FILTER_NEAREST}));
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
    layer.step.create(frame.device(), *resources_, frame.scene(), desc);
  }

  void record(VkCommandBuffer commands, const ObjectLayer& layer) const {
    const gpu::Target objects{&resources_->image(layer.objects), nullptr, {}};
    const gpu::Target depth{&resources_->image(layer.depth), nullptr, {}};
    gpu::drawViews(commands, configuration_.views(), {&objects, 1}, &depth, [&](uint32_t firstView) {
      layer.step.draw(commands, *resources_, *scene_, &layer.sets, firstView);
    });
  }

  // Whole numbers up to 2^24; every device has as many samples of it as of colours, which integers lack.
  static constexpr VkFormat kFormat = VK_FORMAT_R32_SFLOAT;

  PictureFacts picture_;
  Configuration configuration_;
  gpu::ResourceId firstDepth_ = 0;
  ObjectLayer first_, behind_;
  MaterialBlocks<shared::MatteMaterial> materials_;
  const FrameResources* resources_ = nullptr;
  const SceneOnGpu* scene_ = nullptr;
  gpu::SetLayout layout_;
  ImageStep image_;
};

}  // namespace

std::unique_ptr<Pass> makeMatte(const PictureFacts& picture) {
  return std::make_unique<Matte>(picture);
}

}  // namespace scumble::passes
