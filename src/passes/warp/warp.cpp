#include "passes/warp/warp.h"

#include <algorithm>
#include <cmath>

#include "base/tileable_noise.h"
#include "frame/geometry_step.h"
#include "frame/image_step.h"
#include "frame/material_params.h"
#include "frame/metatexture_params.h"
#include "shaders/warp_image_comp.h"
#include "shaders/warp_image_frag.h"
#include "shaders/warp_surface_frag.h"
#include "shaders/warp_surface_vert.h"

namespace scumble::passes {

using namespace frame;

namespace {

constexpr uint32_t kNoiseSize = 256;  // texels; one texel a pixel at the default size

// The example texture: two independent fields in red and green, rough at every scale down to a few texels, so
// that edges are torn and not wavy; in blue the breakup map: palette-knife marks, longer than wide, with flat
// tops and sharp sides.
std::vector<uint8_t> makeExample() {
  const std::vector<float> x = selfSimilarNoise(kNoiseSize, 14, 3, 0.62f, 11);
  const std::vector<float> y = selfSimilarNoise(kNoiseSize, 14, 3, 0.62f, 23);
  std::vector<uint8_t> texels(size_t(kNoiseSize) * kNoiseSize * 4, 255);
  const auto byte = [](float v) {
    return uint8_t(std::lround(std::clamp(0.5f + v / 4.0f, 0.0f, 1.0f) * 255));
  };
  const std::vector<float> marks = selfSimilarNoise(kNoiseSize, 32, 3, 0.6f, 5, 4.0f);
  for (size_t i = 0; i < x.size(); ++i) {
    texels[4 * i] = byte(x[i]);
    texels[4 * i + 1] = byte(y[i]);
    texels[4 * i + 2] = uint8_t(std::lround((0.5f + 0.5f * std::tanh(1.6f * marks[i])) * 255));
  }
  return texels;
}

class Warp : public Pass {
 public:
  const char* name() const override { return "warp"; }

  void declare(FrameBuilder& frame) override {
    const Configuration& c = frame.configuration();
    pattern_ = frame.transient("warp pattern", {kPatternFormat, c.width, c.height, c.viewCount});
    knobs_ = frame.transient("warp knobs", {kKnobsFormat, c.width, c.height, c.viewCount});
    depth_ = frame.transient("warp depth", {VK_FORMAT_D32_SFLOAT, c.width, c.height, c.viewCount});
    params_.declare(frame);
    metaTextureParams_.declare(frame);
    frame.addStep("warp",
                  {{frame.finalVertices(), gpu::Use::vertexBuffer},
                   {pattern_, gpu::Use::colorTarget},
                   {knobs_, gpu::Use::colorTarget},
                   {depth_, gpu::Use::depthTarget}},
                  [this](VkCommandBuffer commands) { record(commands); });

    gpu::Uploader uploader(frame.device());
    const std::vector<uint8_t> example = makeExample();
    const std::span<const std::byte> level = std::as_bytes(std::span(example));
    example_ = uploader.texture({&level, 1}, VK_FORMAT_R8G8B8A8_UNORM, kNoiseSize, kNoiseSize);
    uploader.flush();
    image_.declare(frame, "warp", {{shaders::warp_image_frag}, {shaders::warp_image_comp}},
                   {{pattern_}, {knobs_}, {depth_}}, frame.slot(Slot::warp), 0, {{&example_, kRepeating}});
  }

  void create(FrameBuilder& frame, const FrameResources& resources) override {
    resources_ = &resources;
    scene_ = &frame.scene();
    configuration_ = frame.configuration();
    constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
    layout_ = gpu::SetLayout(frame.device(), {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, kStages},
                                              {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, kStages}});
    set_ = gpu::DescriptorSets(frame.device(), layout_);
    params_.bind(set_, 0);
    metaTextureParams_.bind(set_, 1);

    GeometryStepDesc desc;
    desc.vertex = {shaders::warp_surface_vert};
    desc.fragment = {shaders::warp_surface_frag};
    desc.inputs = kPosition | kUv0 | kUv1 | kColor | kDPdu | kSmoothNormal | kDPdv | kPatternUv;
    desc.colorFormats = {kPatternFormat, kKnobsFormat};
    desc.viewMask = viewMask(configuration_);
    desc.viewCount = configuration_.viewCount;
    desc.passLayout = &layout_;
    desc.materialStrides = {params_.kStride, metaTextureParams_.kStride};
    step_.create(frame.device(), resources, frame.scene(), desc);
    image_.create(frame, resources);
  }

  void update(const FrameInput& input) override {
    params_.update(input);
    metaTextureParams_.update(input);
    eye_ = input.uniforms.views[0].eye;
  }

 private:
  static constexpr VkFormat kPatternFormat = VK_FORMAT_R32G32B32A32_UINT,
                            kKnobsFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
  static constexpr gpu::SamplerDesc kRepeating{VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT,
                                               VK_SAMPLER_ADDRESS_MODE_REPEAT};

  void record(VkCommandBuffer commands) const {
    const Target colors[] = {{&resources_->image(pattern_)}, {&resources_->image(knobs_)}};
    const Target depth{&resources_->image(depth_), nullptr, {}};
    drawViews(commands, configuration_, colors, &depth, [&](uint32_t firstView) {
      step_.draw(commands, *resources_, *scene_, set_[0], firstView, eye_);
    });
  }

  gpu::ResourceId pattern_ = 0, knobs_ = 0, depth_ = 0;
  const FrameResources* resources_ = nullptr;
  const SceneOnGpu* scene_ = nullptr;
  Configuration configuration_;
  glm::vec3 eye_{0.0f};
  MaterialParams<WarpParams> params_;
  MaterialParams<frame::WarpMetaTextureParams> metaTextureParams_;
  gpu::Image example_;
  gpu::SetLayout layout_;
  gpu::DescriptorSets set_;
  GeometryStep step_;
  ImageStep image_;
};

}  // namespace

std::unique_ptr<Pass> makeWarp() {
  return std::make_unique<Warp>();
}

}  // namespace scumble::passes
