#include "frame/geometry_step.h"

#include <algorithm>
#include <tuple>

#include "shading/geometry_constants.shared.h"

namespace scumble::frame {

void GeometryStep::create(FrameBuilder& frame, const GeometryStepDesc& desc) {
  device_ = &frame.device();
  scene_ = &frame.scene();
  frameSet_ = frame.frameSet();
  desc_ = desc;
  constant_ = desc.constant;
  setLayouts_ = {frame.frameLayout().handle(), scene_->materialLayout().handle()};
  if (desc.passLayout) setLayouts_.push_back(desc.passLayout->handle());
  makePipelines();
}

void GeometryStep::specialise(uint32_t constant, std::vector<MaterialVariant> materials) {
  if (constant_ == constant && materials_ == materials) return refresh();
  constant_ = constant;
  materials_ = std::move(materials);
  makePipelines();
}

bool GeometryStep::includes(const DrawState& state) const {
  const bool isBlended = state.alpha == AlphaMode::blend;
  if (desc_.leavesBlended && isBlended) return false;
  if (desc_.onlyBlended && (!isBlended || scene_->material(state.material).paint)) return false;
  const bool isOfCasters = desc_.what == GeometryStepDesc::What::casters;
  if (state.castsAlone && !isOfCasters) return false;
  if (desc_.onlyMaterial && state.material != *desc_.onlyMaterial) return false;
  return !isOfCasters || state.casts;
}

const gpu::Pipeline& GeometryStep::pipelineFor(const Variant& variant) {
  gpu::Pipeline& made = pipelines_[variant];
  if (made) return made;
  const MaterialVariant& material = variant.material;
  const bool depthOnly = variant.alpha == AlphaMode::opaque && !desc_.depthOnlyVertex.words.empty();
  gpu::GraphicsPipelineDesc pipeline;
  pipeline.vertex = depthOnly            ? desc_.depthOnlyVertex
                    : material.isPainted ? desc_.paintedVertex
                                         : desc_.vertex;
  if (!depthOnly)
    pipeline.fragment = material.isPrepainted ? desc_.prepaintedFragment
                        : material.isPainted  ? desc_.paintedFragment
                                              : desc_.fragment;
  const bool varies = material.isPainted || material.isPrepainted || material.sets != 0;
  const auto specialise = [&](int id, uint32_t value) { pipeline.constants[size_t(id)] = value; };
  pipeline.constants.resize(shared::kGeometryConstants);
  specialise(shared::kAlphaModeId, uint32_t(variant.alpha));
  specialise(shared::kVariedId, variant.varied || varies);
  specialise(shared::kTexturedId, variant.textured || material.sets != 0);
  specialise(shared::kViewCountId, desc_.viewCount);
  specialise(shared::kPassId, constant_);
  specialise(shared::kColorSetsId, material.sets);
  specialise(shared::kFeaturesId, material.features);
  specialise(shared::kTangentsId, material.tangents);
  specialise(shared::kMaterialId, material.options);
  addVertexInput(pipeline, depthOnly            ? uint32_t(kPosition)
                           : material.isPainted ? desc_.paintedInputs
                                                : desc_.inputs);
  pipeline.colorFormats = desc_.colorFormats;
  pipeline.depthFormat = VK_FORMAT_D32_SFLOAT;
  pipeline.depthCompare = desc_.depthCompare;
  pipeline.depthWrite = desc_.depthWrite;
  pipeline.blend = desc_.blend;
  pipeline.samples = desc_.samples;
  pipeline.viewMask = desc_.viewMask;
  pipeline.pushConstantBytes = desc_.viewMask ? 4 : 0;
  pipeline.dynamicCulling = true;
  pipeline.sets = setLayouts_;
  made = gpu::Pipeline(*device_, pipeline);
  return made;
}

void GeometryStep::makePipelines() {
  const DrawList& list = scene_->draws();
  statesVersion_ = list.statesVersion();
  std::vector<std::pair<Variant, Chosen>> chosen;
  for (uint32_t b = 0; b < list.buckets().size(); ++b) {
    const DrawState& state = list.buckets()[b].state;
    if (!includes(state)) continue;
    const Variant of = variant(state);
    chosen.push_back({of, {&pipelineFor(of), b}});
  }
  // By pipeline; of each as buckets lie.
  std::stable_sort(chosen.begin(), chosen.end(), [](const auto& a, const auto& b) {
    return std::tie(a.first.alpha, a.first) < std::tie(b.first.alpha, b.first);
  });
  chosen_.clear();
  for (const auto& [of, choice] : chosen) chosen_.push_back(choice);
}

void GeometryStep::draw(VkCommandBuffer commands, const gpu::DescriptorSets* passSets,
                        uint32_t firstView) const {
  const SceneOnGpu& scene = *scene_;
  // What all draws read. Casters count wherever they are.
  const DrawList& list = scene.draws();
  const VkBuffer draws = desc_.what == GeometryStepDesc::What::casters ? list.casters()
                         : desc_.what == GeometryStepDesc::What::torn  ? list.torn()
                                                                       : list.seen();
  bindVertices(commands, scene);
  vkCmdBindIndexBuffer(commands, scene.geometry().indices().handle(), 0, VK_INDEX_TYPE_UINT32);

  // Buckets, with what changes from one to the next.
  const gpu::Pipeline* bound = nullptr;
  uint32_t boundMaterial = ~0u;
  int cull = -1, front = -1;
  std::vector<uint32_t> offsetsOfMaterial(desc_.materialStrides.size());
  for (const Chosen& chosen : chosen_) {
    const gpu::Pipeline& pipeline = *chosen.pipeline;
    const DrawBucket& bucket = list.buckets()[chosen.bucket];
    const DrawState& state = bucket.state;
    if (bound != &pipeline) {
      pipeline.bind(commands);
      pipeline.bindSet(commands, 0, frameSet_);
      if (desc_.viewMask) pipeline.push(commands, firstView);
      bound = &pipeline;
      boundMaterial = ~0u;
    }
    if (boundMaterial != state.material) {
      pipeline.bindSet(commands, 1, scene.materialSet(state.material));
      for (size_t i = 0; i < desc_.materialStrides.size(); ++i)
        offsetsOfMaterial[i] = state.material * desc_.materialStrides[i];
      if (passSets)
        pipeline.bindSet(commands, 2, (*passSets)[passSets->size() > 1 ? state.material : 0],
                         offsetsOfMaterial);
      boundMaterial = state.material;
    }
    // What is seen casts a shadow, whichever of its sides the light meets.
    const bool cullsBack =
        state.cullsBack && (desc_.what != GeometryStepDesc::What::casters || state.isClosed);
    if (cull != int(cullsBack))
      vkCmdSetCullMode(commands, cullsBack ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE), cull = cullsBack;
    if (front != int(state.mirrored))
      vkCmdSetFrontFace(commands, state.mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE),
          front = state.mirrored;
    constexpr uint32_t kStride = sizeof(shared::DrawCommand);
    const uint32_t most = device_->limits().maxDrawIndirectCount;
    for (uint32_t i = 0; i < bucket.count; i += most)
      vkCmdDrawIndexedIndirect(commands, draws, VkDeviceSize(bucket.first + i) * kStride,
                               std::min(most, bucket.count - i), kStride);
  }
}

}  // namespace scumble::frame
