// Lays pigment down around anchors, each object's on that object.
#include <algorithm>
#include <cmath>

#include "features/watercolor/pigment/anchors_on_gpu.h"
#include "features/watercolor/watercolor.h"
#include "features/watercolor/watercolor_knobs.h"
#include "frame/geometry_step.h"
#include "frame/pass.h"
#include "shaders/pigment_places_frag.h"
#include "shaders/pigment_places_vert.h"
#include "shaders/pigment_stamp_cells_frag.h"
#include "shaders/pigment_stamp_colored_cells_frag.h"
#include "shaders/pigment_stamp_colored_frag.h"
#include "shaders/pigment_stamp_colored_shapes_frag.h"
#include "shaders/pigment_stamp_frag.h"
#include "shaders/pigment_stamp_shapes_frag.h"
#include "shaders/pigment_stamp_vert.h"
#include "shading/geometry_constants.shared.h"

namespace scumble::watercolor {

using namespace frame;

namespace {

enum Generator : uint32_t { kStamps, kShapes, kCells };

class Pigment : public Pass {
 public:
  const char* name() const override { return "pigment"; }
  std::span<const Aov> aovs() const override { return kAovs; }
  uint32_t variant(const scene::SceneData&, const look::LookData& look) const override {
    if (!mayShow(look)) return 0;
    return 1 + uint32_t(look.get<WatercolorParams>().generator) + (mayColorStamps(look) ? kColored : 0);
  }

  void declare(FrameBuilder& frame, uint32_t variant) override {
    isShown_ = variant > 0;
    isColored_ = (variant & kColored) != 0;
    generator_ = isShown_ ? (variant & ~kColored) - 1 : kStamps;
    configuration_ = frame.configuration();
    gpu::ImageShape shape{.overX = shared::kPigmentScale, .overY = shared::kPigmentScale};
    if (isShown_) {
      frame.step("pigment places", [this](VkCommandBuffer commands) { recordPlaces(commands); });
      GeometryStep::use(frame);
      shape.format = kPlaces;
      places_ = frame.use(frame.image("pigment places", shape), gpu::Use::colorTarget);
      shape.format = kDepthFormat;
      placesDepth_ = frame.use(frame.image("pigment places depth", shape), gpu::Use::depthTarget);
    }
    frame.step(name(), [this](VkCommandBuffer commands) { record(commands); });
    if (isShown_) {
      frame.use(frame.get(kVertices), gpu::Use::storageBufferReadByVertex);
      depth_ = frame.use(frame.get(kDepth), gpu::Use::sampledByVertex);
      places_ = frame.use(places_, gpu::Use::sampledByFragment);
    }
    shape.format = kBytes;
    image_ = frame.use(frame.image("pigment", shape), gpu::Use::colorTarget);
    if (isColored_) {
      tints_ = frame.use(frame.image(kTints.name, shape), gpu::Use::colorTarget);
      frame.give(kTints, tints_);
    }
    shape.format = kDepthFormat;
    if (generator_ == kCells) cells_ = frame.use(frame.image("pigment cells", shape), gpu::Use::depthTarget);
    frame.give(kPigment, image_);
    frame.offer(kAovs[0], {image_});
  }

  void create(FrameBuilder& frame) override {
    frame_ = &frame;
    if (!isShown_) return;  // whoever asks for it gets none
    uniforms_ = frame.uniform(sizeof(shared::PigmentUniforms));
    constexpr VkShaderStageFlags kVertex = VK_SHADER_STAGE_VERTEX_BIT,
                                 kFragment = VK_SHADER_STAGE_FRAGMENT_BIT;
    materials_ = frame.uniform(frame.scene().materialCount() * sizeof(shared::PigmentMaterial));
    constexpr VkDescriptorType kBuffer = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                               kImage = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    layout_ = gpu::SetLayout(frame.device(), {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kVertex | kFragment},
                                              {kBuffer, kVertex},
                                              {kBuffer, kVertex},
                                              {kBuffer, kVertex},
                                              {kImage, kVertex},
                                              {kImage, kFragment},
                                              {kBuffer, kVertex},
                                              {kImage, kFragment},
                                              {kImage, kFragment},
                                              {kImage, kFragment},
                                              {kImage, kFragment}});
    set_ = gpu::DescriptorSets(frame.device(), layout_);
    set_.writeBuffer(0, shared::kPigmentBlock, uniforms_.buffer, uniforms_.offset, uniforms_.size);
    set_.writeBuffer(0, shared::kPigmentMaterials, materials_.buffer, materials_.offset, materials_.size);
    gpu::GraphicsPipelineDesc desc;
    desc.vertex = {shaders::pigment_stamp_vert};
    desc.fragment = stampShader();
    if (generator_ == kCells) {
      desc.depthFormat = kDepthFormat;
      desc.depthCompare = VK_COMPARE_OP_GREATER;
    } else {
      desc.blend = gpu::Blend::over;
    }
    desc.constants.resize(size_t(shared::kViewCountId) + 1);
    desc.constants.back() = configuration_.viewCount;
    desc.colorFormats.assign(isColored_ ? 2 : 1, kBytes);
    desc.viewMask = configuration_.views().mask();
    desc.sets = {frame.frameLayout().handle(), layout_.handle()};
    desc.pushConstantBytes = 4;
    pipeline_ = gpu::Pipeline(frame.device(), desc);
    GeometryStepDesc places;
    places.vertex = {shaders::pigment_places_vert};
    places.fragment = {shaders::pigment_places_frag};
    places.inputs = kPosition | kUv0 | kUv1 | kColor;
    places.colorFormats = {kPlaces};
    places.viewMask = configuration_.views().mask();
    places.viewCount = configuration_.viewCount;
    places.leavesBlended = true;  // depths are those of what is behind them
    placesStep_.create(frame, places);
  }

  void bind(const gpu::GraphResources& resources) override {
    resources_ = &resources;
    if (!isShown_) return;
    set_.rewriteTexture(0, shared::kPigmentDepth, resources.image(depth_).view(),
                        frame_->samplers().get({VK_FILTER_NEAREST}));
    set_.rewriteTexture(0, shared::kPigmentPlaces, resources.image(places_).view(),
                        frame_->samplers().get({VK_FILTER_NEAREST}));
    if (!anchors() || anchors()->painted().empty()) return;
    set_.writeBuffer(0, shared::kPigmentAnchors, anchors()->anchors());
    set_.writeBuffer(0, shared::kPigmentObjects, anchors()->objects());
    set_.writeBuffer(0, shared::kPigmentVertices, frame_->scene().geometry().finalCore().handle());
  }

  void update(const FrameInput& input) override {
    if (!isShown_) return;
    const WatercolorParams params = input.knobs.scene<WatercolorParams>();
    const float spacing = params.spacing * input.uniforms.pixelScale;
    shared::PigmentUniforms uniforms{spacing, params.stampSize, params.backruns, input.seed};
    auto* const materials = reinterpret_cast<shared::PigmentMaterial*>(materials_.mapped);
    int used = params.brushes;
    for (size_t m = 0; m < input.scene.materialCount(); ++m) {
      const StampParams stamps = input.knobs.of<StampParams>(m);
      used = std::max(used, int(stamps.brush));
      materials[m] = {stamps.strength, stamps.density, uint32_t(stamps.brush), stamps.color.linear,
                      stamps.colorAmount};
    }
    // Those that nobody takes are not even loaded.
    const look::Picture brushes[] = {params.brush, params.brush2, params.brush3, params.brush4};
    static_assert(std::size(brushes) == shared::kPigmentBrushes);
    for (int i = 0; i < shared::kPigmentBrushes; ++i) {
      const ExampleTexture& brush = frame_->examples().get(input.look, brushes[i < used ? i : 0]);
      uniforms.byOpacity[i] = float(brush.isClear);
      set_.writeTexture(0, uint32_t(shared::kPigmentBrush + i), brush.image.view(),
                        frame_->samplers().get(kBrushSampler));
    }
    uniforms.brushes = uint32_t(params.brushes), uniforms.sizes = params.sizes, uniforms.turns = params.turns;
    uniforms_.write(uniforms);
    placesStep_.refresh();
    countAnchors(input, spacing);
  }

 private:
  static constexpr Aov kAovs[] = {{.name = "pigment"}};
  static constexpr uint32_t kColored = 8;  // of variants, beside the generator's number from 1 on
  static constexpr VkFormat kPlaces = VK_FORMAT_R32G32_SFLOAT;
  static constexpr gpu::SamplerDesc kBrushSampler{
      VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_REPEAT, true, false, 1};

  // Null where the scene, as it is now, is no watercolour.
  const AnchorsOnGpu* anchors() const {
    const auto here = frame_->scene().feature(kName);
    return here ? &static_cast<const WatercolorMoment*>(here->moment)->anchors() : nullptr;
  }

  // How many anchors of each object may be sparse enough for any place of it, wherever it is seen from.
  void countAnchors(const FrameInput& input, float spacing) {
    counts_.clear();
    if (!anchors()) return;
    const SceneMotion& motion = input.scene.motion();
    for (const AnchorsOnGpu::Painted& painted : anchors()->painted()) {
      const scene::Bounds& bounds = motion.bounds()[painted.object];
      counts_.push_back(0);
      if (bounds.empty || painted.anchors->empty()) continue;
      const glm::vec3 viewer = input.uniforms.viewer;
      const float distance = glm::distance(viewer, glm::clamp(viewer, bounds.min, bounds.max));
      float pixel = INFINITY;  // metres
      for (uint32_t v = 0; v < configuration_.viewCount; ++v) {
        const shared::ViewUniforms& view = input.uniforms.views[v];
        pixel = std::min(pixel, 2 * std::abs(view.ndcToEyeRay.y) / input.uniforms.imageSize.y *
                                    glm::mix(distance, 1.0f, view.orthographic));
      }
      // The vertex shader fades them in from 0.8 of this on; stretched triangles have wider ones.
      constexpr float kStretched = 3;
      const StampParams stamps = input.knobs.of<StampParams>(painted.material);
      const float least = 0.8f * spacing / std::sqrt(stamps.density) * pixel /
                          (kStretched * std::max(motion.scales()[painted.object], 1e-20f));
      counts_.back() = uint32_t(
          std::partition_point(painted.anchors->begin(), painted.anchors->end(),
                               [&](const scene::SurfaceAnchor& anchor) { return anchor.spacing >= least; }) -
          painted.anchors->begin());
    }
  }

  void recordPlaces(VkCommandBuffer commands) const {
    const gpu::Target places{&resources_->image(places_), nullptr, {}},
        depth{&resources_->image(placesDepth_), nullptr, {}};
    gpu::drawViews(commands, configuration_.views(), {&places, 1}, &depth,
                   [&](uint32_t firstView) { placesStep_.draw(commands, nullptr, firstView); });
  }

  void record(VkCommandBuffer commands) const {
    std::vector<gpu::Target> targets{{&resources_->image(image_), nullptr, {}}};
    targets[0].clear.color = {{0.5f, 0.5f, 0.5f, 0.0f}};
    if (isColored_) targets.push_back({&resources_->image(tints_), nullptr, {}});
    gpu::Target cells;
    if (generator_ == kCells) cells = {&resources_->image(cells_), nullptr, {}};
    gpu::drawViews(commands, configuration_.views(), targets, generator_ == kCells ? &cells : nullptr,
                   [&](uint32_t firstView) {
                     if (!isShown_ || counts_.empty()) return;
                     pipeline_.bind(commands);
                     pipeline_.bindSet(commands, 0, frame_->frameSet());
                     pipeline_.bindSet(commands, 1, set_[0]);
                     pipeline_.push(commands, firstView);
                     for (uint32_t i = 0; i < counts_.size(); ++i)
                       if (counts_[i] > 0) vkCmdDraw(commands, 6 * counts_[i], 1, 0, i);
                   });
  }

  gpu::Shader stampShader() const {
    const gpu::Shader all[][2] = {
        {{shaders::pigment_stamp_frag}, {shaders::pigment_stamp_colored_frag}},
        {{shaders::pigment_stamp_shapes_frag}, {shaders::pigment_stamp_colored_shapes_frag}},
        {{shaders::pigment_stamp_cells_frag}, {shaders::pigment_stamp_colored_cells_frag}}};
    return all[generator_][isColored_];
  }

  FrameBuilder* frame_ = nullptr;
  Configuration configuration_;
  bool isShown_ = false, isColored_ = false;
  uint32_t generator_ = kStamps;
  UniformSlice uniforms_, materials_;
  gpu::Handle depth_, image_, tints_, cells_, places_, placesDepth_;
  GeometryStep placesStep_;
  std::vector<uint32_t> counts_;  // of anchors that are drawn, by painted object
  const gpu::GraphResources* resources_ = nullptr;
  gpu::SetLayout layout_;
  gpu::DescriptorSets set_;
  gpu::Pipeline pipeline_;
};

}  // namespace

std::unique_ptr<Pass> makePigment() {
  return std::make_unique<Pigment>();
}

}  // namespace scumble::watercolor
