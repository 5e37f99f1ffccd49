#include "passes/warp/warp.h"

#include <algorithm>
#include <cmath>

#include "base/tileable_noise.h"
#include "frame/geometry_step.h"
#include "frame/material_params.h"
#include "shaders/warp_frag.h"
#include "shaders/warp_vert.h"
#include "shading/metatexture_params.h"

namespace scumble::passes {

using namespace frame;

namespace {

constexpr uint32_t kNoiseSize = 256;  // texels; one texel a pixel at the default size

// The example texture: two independent fields in red and green. Rough at every scale down to the texel, so that edges
// are torn and not wavy.
std::vector<uint8_t> makeNoise() {
  const std::vector<float> x = selfSimilarNoise(kNoiseSize, 14, 3, 0.62f, 11);
  const std::vector<float> y = selfSimilarNoise(kNoiseSize, 14, 3, 0.62f, 23);
  std::vector<uint8_t> texels(size_t(kNoiseSize) * kNoiseSize * 4, 255);
  const auto byte = [](float v) { return uint8_t(std::lround(std::clamp(0.5f + v / 4.0f, 0.0f, 1.0f) * 255)); };
  for (size_t i = 0; i < x.size(); ++i) {
    texels[4 * i] = byte(x[i]);
    texels[4 * i + 1] = byte(y[i]);
  }
  return texels;
}

class Warp : public Pass {
 public:
  const char* name() const override { return "warp"; }

  void declare(FrameBuilder& frame) override {
    const Configuration& c = frame.configuration();
    warp_ = frame.slot(Slot::warp);
    depth_ = frame.transient("warp depth", {VK_FORMAT_D32_SFLOAT, c.width, c.height, c.viewCount});
    params_.declare(frame);
    metaTextureParams_.declare(frame);
    frame.addStep("warp",
                  {{frame.finalVertices(), gpu::Use::vertexBuffer},
                   {warp_, gpu::Use::colorTarget},
                   {depth_, gpu::Use::depthTarget}},
                  [this](VkCommandBuffer commands) { record(commands); });
  }

  void create(FrameBuilder& frame, const FrameResources& resources) override {
    resources_ = &resources;
    scene_ = &frame.scene();
    viewMask_ = frame.configuration().viewMask();
    gpu::Uploader uploader(frame.device());
    noise_ = uploader.texture(makeNoise().data(), VK_FORMAT_R8G8B8A8_UNORM, kNoiseSize, kNoiseSize, false);
    uploader.flush();

    constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
    layout_ = gpu::SetLayout(frame.device(),
                             {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, kStages},
                              {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, kStages},
                              {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT}});
    set_ = gpu::DescriptorSets(frame.device(), layout_);
    params_.bind(set_, 0);
    metaTextureParams_.bind(set_, 1);
    set_.writeTexture(0, 2, noise_.view(), frame.samplers().get(kRepeating));

    GeometryStepDesc desc;
    desc.vertex = {shaders::warp_vert};
    desc.fragment = {shaders::warp_frag};
    desc.inputs = kPosition | kUv0 | kUv1 | kColor | kDPdu | kSmoothNormal | kDPdv | kPatternUv;
    desc.colorFormats = {slotInfo(Slot::warp).format};
    desc.viewMask = viewMask_;
    desc.passLayout = &layout_;
    desc.materialStrides = {params_.kStride, metaTextureParams_.kStride};
    step_.create(frame.device(), resources, frame.scene(), desc);
  }

  void update(const FrameInput& input) override {
    params_.update(input);
    metaTextureParams_.update(input);
    eye_ = input.uniforms.views[0].eye;
  }

 private:
  static constexpr gpu::SamplerDesc kRepeating{VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT,
                                               VK_SAMPLER_ADDRESS_MODE_REPEAT};

  void record(VkCommandBuffer commands) const {
    const gpu::Image& image = resources_->image(warp_);
    const Target color{&image, nullptr, {}};
    const Target depth{&resources_->image(depth_), nullptr, {}};
    const RenderingScope scope(commands, image.desc().width, image.desc().height, viewMask_, {&color, 1}, &depth);
    step_.draw(commands, *resources_, *scene_, set_[0], eye_);
  }

  gpu::ResourceId warp_ = 0, depth_ = 0;
  const FrameResources* resources_ = nullptr;
  const SceneOnGpu* scene_ = nullptr;
  uint32_t viewMask_ = 1;
  glm::vec3 eye_{0.0f};
  MaterialParams<WarpParams> params_;
  MaterialParams<shading::WarpMetaTextureParams> metaTextureParams_;
  gpu::Image noise_;
  gpu::SetLayout layout_;
  gpu::DescriptorSets set_;
  GeometryStep step_;
};

}  // namespace

std::unique_ptr<Pass> makeWarp() { return std::make_unique<Warp>(); }

}  // namespace scumble::passes
