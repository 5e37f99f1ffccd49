#include "frame/transparent_step.h"

#include <algorithm>
#include <numeric>

#include "shading/geometry_constants.shared.h"

namespace scumble::frame {

namespace {

constexpr size_t kMostTextures = size_t(shared::kTransparentTextures);
constexpr uint32_t kFirstTexture = 2;  // its binding

// Index in a list, which it is added to where it is new; -1 for none.
int slotOf(const SetTexture& texture, std::vector<SetTexture>& list) {
  if (!texture.view) return -1;
  const auto found = std::find(list.begin(), list.end(), texture);
  if (found != list.end()) return int(found - list.begin());
  list.push_back(texture);
  return int(list.size()) - 1;
}

// What does not fade is there from all sides.
glm::vec2 fadeOf(const scene::Material& material) {
  return material.isFin() ? glm::vec2(material.paint->fadeStart, material.paint->fadeEnd) : glm::vec2(3, 2);
}

// Of so many textures a pipeline is made for: a few numbers, so that one more texture compiles nothing. What
// is too many is white.
uint32_t slotsFor(size_t textures) {
  for (const uint32_t slots : {0u, 1u, 2u, 4u, 8u})
    if (textures <= slots) return slots;
  return uint32_t(kMostTextures);
}

}  // namespace

void TransparentStep::create(FrameBuilder& frame, const GeometryStepDesc& desc, What what) {
  frame_ = &frame;
  what_ = what;
  desc_ = desc;
  const size_t materials = frame.scene().materialCount();
  constexpr VkShaderStageFlags kBoth = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
  std::vector<gpu::Binding> bindings(kFirstTexture, {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kBoth});
  bindings.resize(kFirstTexture + kMostTextures,
                  {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_SHADER_STAGE_FRAGMENT_BIT});
  layout_ = gpu::SetLayout(frame.device(), std::move(bindings));
  sets_ = gpu::DescriptorSets(frame.device(), layout_, uint32_t(materials));
  rows_ = frame.uniform(materials * sizeof(shared::TransparentMaterial));
  for (size_t set = 0; set < sets_.size(); ++set)
    sets_.writeBuffer(set, 0, rows_.buffer, rows_.offset, rows_.size);
}

void TransparentStep::bind() {
  for (size_t set = 0; set < sets_.size(); ++set)
    sets_.writeBuffer(set, 1, frame_->scene().transparent().parts());
}

TransparentStep::Group& TransparentStep::groupFor(const MaterialVariant& variant, uint32_t painting,
                                                  const std::array<SetTexture, 4>& textures) {
  // Their colours are looked up.
  const MaterialVariant painted = variant.isPainted ? MaterialVariant{.isPainted = true,
                                                                      .features = variant.features,
                                                                      .tangents = variant.tangents,
                                                                      .options = variant.options}
                                                    : MaterialVariant();
  for (Group& group : groups_) {
    if (painted.isPainted && (group.painted != painted || group.painting != painting)) continue;
    std::vector<SetTexture> all = group.textures;
    for (const SetTexture& texture : textures) slotOf(texture, all);
    if (all.size() <= kMostTextures) return group;
  }
  return groups_.emplace_back(Group{.painted = painted, .painting = painting});
}

const gpu::Pipeline& TransparentStep::pipelineFor(const Group& group, uint32_t index) {
  gpu::GraphicsPipelineDesc desc;
  const bool isTextured = !group.textures.empty();
  const auto specialise = [&](int id, uint32_t value) { desc.constants[size_t(id)] = value; };
  desc.constants.resize(shared::kGeometryConstants);
  specialise(shared::kAlphaModeId, uint32_t(AlphaMode::blend));
  specialise(shared::kVariedId, group.isVaried || isTextured || group.painted.isPainted);
  specialise(shared::kTexturedId, isTextured);
  specialise(shared::kViewCountId, desc_.viewCount);
  specialise(shared::kPassId, constant_);
  specialise(shared::kFeaturesId, group.painted.features);
  specialise(shared::kTangentsId, group.painted.tangents);
  specialise(shared::kMaterialId, group.painted.options);
  specialise(shared::kGroupId, index);
  specialise(shared::kFadesId, group.fades);
  specialise(shared::kSlotsId, slotsFor(group.textures.size()));
  std::vector<uint32_t> key = desc.constants;
  key.push_back(group.painted.isPainted);
  gpu::Pipeline& made = pipelines_[key];
  if (made) return made;
  desc.vertex = group.painted.isPainted ? desc_.paintedVertex : desc_.vertex;
  desc.fragment = group.painted.isPainted ? desc_.paintedFragment : desc_.fragment;
  addVertexInput(desc, kPart | (group.painted.isPainted ? desc_.paintedInputs : desc_.inputs));
  desc.colorFormats = desc_.colorFormats;
  desc.blend = what_ == What::all ? gpu::Blend::over : gpu::Blend::premultiplied;
  desc.depthFormat = kDepthFormat;
  desc.depthWrite = false;
  // The depth of a pixel is that of some place in it, and a coat lies close to what it covers.
  if (what_ == What::paint) desc.depthSlack = 2;
  desc.samples = desc_.samples;
  desc.viewMask = desc_.viewMask;
  desc.pushConstantBytes = desc_.viewMask ? 4 : 0;
  desc.dynamicCulling = true;
  desc.sets = {frame_->frameLayout().handle(), layout_.handle()};
  if (desc_.passLayout) desc.sets.push_back(desc_.passLayout->handle());
  made = gpu::Pipeline(frame_->device(), desc);
  return made;
}

void TransparentStep::update(uint32_t constant, std::span<const MaterialVariant> variants,
                             std::span<const uint32_t> paintings) {
  constant_ = constant;
  const SceneOnGpu& scene = frame_->scene();
  const std::map<uint32_t, float>& farthestOf = scene.transparent().farthest();
  std::vector<uint32_t> blended;
  // What is left to others is of no group.
  auto* const rows = reinterpret_cast<shared::TransparentMaterial*>(rows_.mapped);
  bool isPart = false;
  for (const auto& [material, farthest] : farthestOf) {
    if (includes(scene.material(material))) {
      blended.push_back(material);
    } else {
      rows[material].group = ~0u;
      isPart = true;
    }
  }
  const auto variantOf = [&](uint32_t m) { return m < variants.size() ? variants[m] : MaterialVariant(); };
  // What is painted chooses a group, and the others join any.
  std::stable_sort(blended.begin(), blended.end(),
                   [&](uint32_t a, uint32_t b) { return variantOf(a).isPainted > variantOf(b).isPainted; });

  const auto group = [&] {
    groups_.clear();
    for (const uint32_t m : blended) {
      const std::array<SetTexture, 4> textures = scene.textures(m);
      const size_t before = groups_.size();
      Group& own = groupFor(variantOf(m), m < paintings.size() ? paintings[m] : 0, textures);
      if (groups_.size() > before) own.leader = m;
      glm::ivec4 slots;
      for (int i = 0; i < 4; ++i) slots[i] = slotOf(textures[size_t(i)], own.textures);
      own.isVaried |= scene.isVaried(m);
      own.fades |= scene.material(m).isFin();
      own.farthest = std::max(own.farthest, farthestOf.at(m));
      const bool varies = variantOf(m).isPainted || variantOf(m).sets != 0;
      rows[m] = {scene.materialData(m),           slots,
                 uint32_t(&own - groups_.data()), scene.material(m).doubleSided ? 0u : 1u,
                 fadeOf(scene.material(m)),       varies ? 1u : 0u};
    }
  };
  group();
  // Where one group is not enough, those belong together that lie together.
  if (groups_.size() > 1) {
    std::stable_sort(blended.begin(), blended.end(),
                     [&](uint32_t a, uint32_t b) { return farthestOf.at(a) > farthestOf.at(b); });
    group();
  }

  const SetTexture white = scene.textureOf({});
  const bool isRenamed = texturesVersion_ != scene.texturesVersion();
  texturesVersion_ = scene.texturesVersion();
  for (uint32_t g = 0; g < groups_.size(); ++g)
    groups_[g].pipeline = &pipelineFor(groups_[g], isPart || groups_.size() > 1 ? g : ~0u);
  // Of sets that no group has now as well: one may have them later.
  for (uint32_t set = 0; set < (isRenamed ? sets_.size() : groups_.size()); ++set)
    for (size_t t = 0; t < kMostTextures; ++t) {
      const bool isThere = set < groups_.size() && t < groups_[set].textures.size();
      const SetTexture& texture = isThere ? groups_[set].textures[t] : white;
      const VkSampler sampler = frame_->samplers().get(texture.sampler);
      if (isRenamed)
        sets_.rewriteTexture(set, kFirstTexture + uint32_t(t), texture.view, sampler);
      else
        sets_.writeTexture(set, kFirstTexture + uint32_t(t), texture.view, sampler);
    }

  // Groups come after each other, the one that reaches farthest first.
  order_.resize(groups_.size());
  std::iota(order_.begin(), order_.end(), 0u);
  std::stable_sort(order_.begin(), order_.end(),
                   [&](uint32_t a, uint32_t b) { return groups_[a].farthest > groups_[b].farthest; });
}

void TransparentStep::draw(VkCommandBuffer commands, const gpu::DescriptorSets* passSets,
                           uint32_t firstView) const {
  const TransparentTriangles& triangles = frame_->scene().transparent();
  if (!triangles.isVisible()) return;
  bindVertices(commands, frame_->scene());
  vkCmdBindIndexBuffer(commands, triangles.indices(), 0, VK_INDEX_TYPE_UINT32);
  for (const uint32_t g : order_) {
    const gpu::Pipeline& pipeline = *groups_[g].pipeline;
    pipeline.bind(commands);
    pipeline.bindSet(commands, 0, frame_->frameSet());
    pipeline.bindSet(commands, 1, sets_[g]);
    if (passSets) pipeline.bindSet(commands, 2, (*passSets)[passSets->size() > 1 ? groups_[g].leader : 0]);
    if (desc_.viewMask) pipeline.push(commands, firstView);
    vkCmdSetCullMode(commands, VK_CULL_MODE_NONE);
    vkCmdSetFrontFace(commands, VK_FRONT_FACE_COUNTER_CLOCKWISE);
    vkCmdDrawIndexed(commands, 3 * triangles.count(), 1, 0, 0, 0);
  }
}

}  // namespace scumble::frame
