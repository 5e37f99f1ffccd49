#include "frame/geometry_step.h"

#include <algorithm>

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
  if (constant_ == constant && materials_ == materials && drawsVersion_ == scene_->drawsVersion()) return;
  constant_ = constant;
  materials_ = std::move(materials);
  makePipelines();
}

bool GeometryStep::includes(const Draw& draw) const {
  if (desc_.leavesBlended && draw.alpha == AlphaMode::blend) return false;
  switch (desc_.what) {
    case GeometryStepDesc::What::casters:
      return draw.casts;
    case GeometryStepDesc::What::ocean:
      return int(draw.material) == scene_->oceanMaterial();
    default:
      return true;
  }
}

void GeometryStep::makePipelines() {
  const SceneOnGpu& scene = *scene_;
  drawsVersion_ = scene.drawsVersion();
  // A pipeline for each variant that there is.
  for (const Draw& draw : scene.draws()) {
    if (!includes(draw)) continue;
    const Variant of = variant(draw);
    gpu::Pipeline& made = pipelines_[of];
    if (made) continue;
    const MaterialVariant& material = of.material;
    const bool depthOnly = draw.alpha == AlphaMode::opaque && !desc_.depthOnlyVertex.words.empty();
    gpu::GraphicsPipelineDesc pipeline;
    pipeline.vertex = depthOnly            ? desc_.depthOnlyVertex
                      : material.isPainted ? desc_.paintedVertex
                                           : desc_.vertex;
    if (!depthOnly)
      pipeline.fragment = material.isOcean     ? desc_.oceanFragment
                          : material.isPainted ? desc_.paintedFragment
                                               : desc_.fragment;
    const bool varies = material.isPainted || material.isOcean || material.sets != 0;
    const auto specialise = [&](int id, uint32_t value) { pipeline.constants[size_t(id)] = value; };
    pipeline.constants.resize(shared::kGeometryConstants);
    specialise(shared::kAlphaModeId, uint32_t(draw.alpha));
    specialise(shared::kVariedId, draw.varied || varies);
    specialise(shared::kTexturedId, draw.textured || material.sets != 0);
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
    pipeline.samples = desc_.samples;
    pipeline.viewMask = desc_.viewMask;
    pipeline.pushConstantBytes = desc_.viewMask ? 4 : 0;
    pipeline.dynamicCulling = true;
    pipeline.sets = setLayouts_;
    made = gpu::Pipeline(*device_, pipeline);
  }

  // And which of them each draw has.
  std::map<Variant, Chosen> byVariant;
  for (const auto& [of, pipeline] : pipelines_) byVariant[of] = {&pipeline, uint32_t(byVariant.size())};
  chosen_.assign(scene.draws().size(), {});
  for (size_t i = 0; i < chosen_.size(); ++i)
    if (const auto found = byVariant.find(variant(scene.draws()[i])); found != byVariant.end())
      chosen_[i] = found->second;
}

void GeometryStep::draw(VkCommandBuffer commands, const gpu::DescriptorSets* passSets,
                        uint32_t firstView) const {
  const SceneOnGpu& scene = *scene_;
  // What all draws read.
  bindVertices(commands, scene);
  vkCmdBindIndexBuffer(commands, scene.geometry().indices().handle(), 0, VK_INDEX_TYPE_UINT32);

  // In which order.
  std::vector<const Draw*> order;
  for (const Draw& draw : scene.draws())
    if (includes(draw) && (draw.visible || desc_.what == GeometryStepDesc::What::casters))
      order.push_back(&draw);
  const auto chosen = [&](const Draw* draw) { return chosen_[size_t(draw - scene.draws().data())]; };
  std::stable_sort(order.begin(), order.end(), [&](const Draw* a, const Draw* b) {
    if (a->alpha != b->alpha) return a->alpha < b->alpha;
    if (chosen(a).rank != chosen(b).rank) return chosen(a).rank < chosen(b).rank;
    if (a->material != b->material) {
      const float nearA = scene.nearestOf(a->material), nearB = scene.nearestOf(b->material);
      return nearA != nearB ? nearA < nearB : a->material < b->material;
    }
    return a->distance < b->distance;
  });

  // Draws, with what changes from one to the next.
  const gpu::Pipeline* bound = nullptr;
  uint32_t boundMaterial = ~0u;
  int cull = -1, front = -1;
  std::vector<uint32_t> offsetsOfMaterial(desc_.materialStrides.size());
  for (const Draw* draw : order) {
    const gpu::Pipeline& pipeline = *chosen(draw).pipeline;
    if (bound != &pipeline) {
      pipeline.bind(commands);
      pipeline.bindSet(commands, 0, frameSet_);
      if (desc_.viewMask) pipeline.push(commands, firstView);
      bound = &pipeline;
      boundMaterial = ~0u;
    }
    if (boundMaterial != draw->material) {
      pipeline.bindSet(commands, 1, scene.materialSet(draw->material));
      for (size_t i = 0; i < desc_.materialStrides.size(); ++i)
        offsetsOfMaterial[i] = draw->material * desc_.materialStrides[i];
      if (passSets)
        pipeline.bindSet(commands, 2, (*passSets)[passSets->size() > 1 ? draw->material : 0],
                         offsetsOfMaterial);
      boundMaterial = draw->material;
    }
    if (cull != int(draw->cullsBack))
      vkCmdSetCullMode(commands, draw->cullsBack ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE),
          cull = draw->cullsBack;
    if (front != int(draw->mirrored))
      vkCmdSetFrontFace(commands, draw->mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE),
          front = draw->mirrored;
    vkCmdDrawIndexed(commands, draw->indexCount, 1, draw->firstIndex, draw->vertexOffset, draw->object);
  }
}

}  // namespace scumble::frame
