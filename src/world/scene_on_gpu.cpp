#include "world/scene_on_gpu.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <tuple>

#include "scene/drop_vertices.h"
#include "world/geometry.h"
#include "world/ground.h"
#include "world/indirect_light.h"

namespace scumble::world {

namespace {

AlphaMode alphaMode(const scene::Material& material) {
  switch (material.alphaMode) {
    case scene::AlphaMode::mask:
      return AlphaMode::mask;
    case scene::AlphaMode::blend:
      return AlphaMode::blend;
    default:
      return AlphaMode::opaque;
  }
}

VkSamplerAddressMode addressMode(scene::Wrap wrap) {
  switch (wrap) {
    case scene::Wrap::mirroredRepeat:
      return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    case scene::Wrap::clampToEdge:
      return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    default:
      return VK_SAMPLER_ADDRESS_MODE_REPEAT;
  }
}

// Of the sets of colours, in material.glsl.
constexpr uint32_t kLitBinding = 3, kShadowedBinding = 4;

constexpr uint64_t kMaterialStride = gpu::uniformStride(sizeof(shared::MaterialData));

gpu::Buffer positionBuffer(gpu::Device& device, uint64_t count) {
  return gpu::Buffer(device, count * sizeof(glm::vec3),
                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
                     gpu::MemoryKind::device);
}

}  // namespace

SceneOnGpu::Changes SceneOnGpu::update(const scene::SceneData& scene, const GeometryOptions& options,
                                       bool drops, const std::function<void()>& settle) {
  Changes changes;
  ++castersVersion_;
  const auto kindsOfMaterials = [&] {
    return std::tuple(materialNames_.size(), groundMaterials_, featureMaterials_);
  };
  const auto materialsBefore = kindsOfMaterials();
  data_ = &scene;
  options_ = options;

  // What is drawn, and with which materials.
  listMaterials();
  Geometry geometry = collectGeometry(scene, options, groundMaterials_, featureMaterials_, made_);
  bounds_ = geometry.bounds, longestCasterEdge_ = geometry.longestCasterEdge;
  separateMaterials(geometry);
  changes.materials = kindsOfMaterials() != materialsBefore;
  const auto materialOf = [this](size_t index) -> const scene::Material& { return material(index); };
  surfaceColors_.look(geometry.items, materialOf, scene.images);
  // Triangles of blended surfaces are listed later; what is made_ is kept there.
  for (GeometryItem& item : geometry.items)
    item.dropsVertices =
        drops && item.node != GeometryItem::kNoNode && alphaMode(material(item.material)) != AlphaMode::blend;

  // Vertices, where they are others, with what features make of them; then images.
  changes.buffers |= followFeatures(settle);
  for (const auto& feature : features_)
    if (feature) feature->find(geometry.items);
  gpu::Uploader uploader(device_);
  // Before vertices may go.
  const std::vector<std::vector<glm::u8vec4>> indirect =
      indirectLight(geometry.items, materialOf, scene.images, options.indirectReach * bounds_.radius());
  const bool otherPlaces = geometry_.update(device_, uploader, geometry.items, settle);
  placeIndirect(uploader, indirect, settle);
  const bool otherTextures = textures_.update(uploader, scene.images, settle);
  for (const auto& feature : features_)
    if (feature) changes.buffers |= feature->place(uploader, geometry.items, geometry_.places(), settle);
  uploader.flush();
  if (otherTextures) ++texturesVersion_;
  if (otherPlaces) {
    previousPositions_ = positionBuffer(device_, previousMotion_ ? geometry_.vertexCount() : 1);
    changes.buffers = true;
  }

  // What moves.
  changes.buffers |= listDraws(geometry, settle);
  changes.buffers |= followMotion(otherPlaces, settle);

  colors_ = surfaceColors_.colors(geometry.items, materialOf);
  changes.writtenMaterials = writeMaterials(otherTextures, settle);
  changes.writtenPrimitives = geometry_.written();
  changes.writtenTextures = textures_.uploaded();
  made_.sweep();
  if (drops) dropVertices();
  return changes;
}

void SceneOnGpu::placeIndirect(gpu::Uploader& uploader, const std::vector<std::vector<glm::u8vec4>>& indirect,
                               const std::function<void()>& settle) {
  if (options_.indirectReach <= 0 && indirect_.size() == sizeof(glm::u8vec4)) return;
  settle();
  const uint64_t count = options_.indirectReach > 0 ? geometry_.vertexCount() : 1;
  std::byte* target = nullptr;
  indirect_ = {};
  indirect_ = uploader.reserve(count * sizeof(glm::u8vec4), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, &target);
  auto* const vertices = reinterpret_cast<glm::u8vec4*>(target);
  std::fill_n(vertices, count, glm::u8vec4(0));
  if (options_.indirectReach <= 0) return;
  for (size_t i = 0; i < indirect.size(); ++i)
    std::copy(indirect[i].begin(), indirect[i].end(), vertices + geometry_.places()[i].firstVertex);
}

void SceneOnGpu::dropVertices() const {
  for (const scene::Mesh& mesh : data_->meshes)
    for (const scene::Primitive& primitive : mesh.primitives) scene::dropVertices(primitive);
}

void SceneOnGpu::listMaterials() {
  materialNames_.clear();
  materialUses_.clear();
  groundMaterials_.clear();
  for (const scene::Material& material : data_->materials) {
    materialUses_.push_back({int(materialNames_.size())});
    materialNames_.push_back(material.name);
  }
  const auto add = [&](std::string_view name) {
    materialUses_.push_back({-1});
    materialNames_.emplace_back(name);
    return int(materialNames_.size()) - 1;
  };
  // What lies on top is drawn first.
  if (options_.ground) groundMaterials_.resize(options_.groundStrokes ? kGroundTones : 1);
  for (int tone = int(groundMaterials_.size()); tone-- > 0;) {
    groundMaterials_[size_t(tone)] = add("Ground");
    materialUses_.back().groundTone = tone;
  }
  featureMaterials_.clear();
  for (const PlannedFeature& planned : options_.features)
    featureMaterials_.push_back(
        planned.plan && !planned.feature->material().empty() ? add(planned.feature->material()) : -1);
}

void SceneOnGpu::separateMaterials(Geometry& geometry) {
  if (options_.nodes.ofNode.empty()) return;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> known;
  for (GeometryItem& item : geometry.items) {
    const uint32_t settings = item.node == GeometryItem::kNoNode ? 0 : options_.nodes.ofNode[item.node];
    if (settings == 0) continue;
    const auto [entry, isNew] = known.try_emplace({item.material, settings}, uint32_t(materialNames_.size()));
    if (isNew) {
      materialUses_.push_back({int(item.material), settings});
      materialNames_.push_back(data_->materials[item.material].name);
    }
    item.material = entry->second;
  }
}

std::vector<KnobTable::Material> SceneOnGpu::knobSubjects() const {
  std::vector<KnobTable::Material> subjects;
  for (size_t m = 0; m < materialCount(); ++m)
    subjects.push_back({materialNames_[m], options_.nodes.lists[materialUses_[m].settings]});
  return subjects;
}

const scene::Material& SceneOnGpu::material(size_t material) const {
  static const scene::Material kGround{};
  const int base = materialUses_[material].base;
  return base >= 0 ? data_->materials[size_t(base)] : kGround;
}

bool SceneOnGpu::listDraws(const Geometry& geometry, const std::function<void()>& settle) {
  // Objects: all items.
  std::vector<Draw> draws;
  reach_.clear();
  objects_.clear();
  moving_.clear();
  triangleCount_ = 0;
  wraps_ = false;
  std::vector<TransparentTriangles::Part> blended;
  std::vector<shared::DrawLevel> levels;
  std::map<const scene::Primitive*, uint32_t> levelsOf;  // the first one
  warpScaleOf_.assign(materialCount(), 1.0f);
  isVaried_.assign(materialCount(), false);
  // Strokes have colours of their own, which the default material's maps take into light and shadow.
  for (const scene::Mesh& mesh : data_->meshes)
    if (mesh.painting) isVaried_[0] = true;
  for (size_t i = 0; i < geometry.items.size(); ++i) {
    const GeometryItem& item = geometry.items[i];
    const GeometryOnGpu::Place& place = geometry_.places()[i];
    const scene::Primitive& primitive = *item.primitive;
    const scene::Material& material = this->material(item.material);

    shared::ObjectData object{};
    object.material = item.material;
    object.id = item.id;
    object.wraps = uint32_t(primitive.wrapsU) + 2 * uint32_t(primitive.wrapsV);
    object.kind = item.kind;
    object.detail = item.detail;
    object.influences = item.skin >= 0 ? uint32_t(primitive.influences) : 0;
    objects_.push_back(object);

    MovingObject moving;
    moving.node = item.node;
    moving.instanceOfNode = item.instanceOfNode;
    moving.instance = item.instance;
    moving.skin = item.skin;
    moving.mesh = item.node == GeometryItem::kNoNode ? -1 : data_->nodes[item.node].mesh;
    moving.feature = item.feature;
    moving.kind = item.kind;
    moving.detail = item.detail;
    moving.isWrittenByFeature = item.isWrittenByFeature;
    moving.material = item.material;
    moving.extent = item.extent;
    moving.casts = item.casts;
    moving.morphs = place.morphs;
    moving.firstChunk = place.firstChunk;
    moving.chunkCount = place.chunkCount;
    moving_.push_back(moving);

    for (const float scale : primitive.warpScales)
      warpScaleOf_[item.material] = std::max(warpScaleOf_[item.material], scale);
    // Draws: those that are shown.
    if (!item.shown) continue;
    Draw draw;
    draw.firstIndex = place.firstIndex;
    draw.indexCount = uint32_t(primitive.indexCount());
    draw.vertexOffset = int32_t(place.firstVertex);
    draw.object = uint32_t(i);
    const auto [known, isNew] = levelsOf.try_emplace(&primitive, uint32_t(levels.size()));
    draw.firstLevel = known->second, draw.levels = uint32_t(primitive.levels.size());
    for (const scene::DetailLevel& level : primitive.levels)
      if (isNew)
        levels.push_back({draw.firstIndex + draw.indexCount + level.firstIndex, level.indexCount, level.error,
                          level.textureError, level.shadowError, level.longestEdge});
    draw.state.material = item.material;
    draw.state.alpha = alphaMode(material);
    if (item.feature >= 0 && draw.state.alpha == AlphaMode::opaque &&
        features_[size_t(item.feature)]->cutouts())
      draw.state.alpha = AlphaMode::cut;
    draw.state.cullsBack = !material.doubleSided;
    draw.state.textured = material.baseColorTexture.image >= 0 || material.emissiveTexture.image >= 0;
    draw.state.varied = draw.state.textured || !primitive.colors.empty();
    draw.state.casts = item.casts;
    draw.state.isClosed = primitive.isClosed && draw.state.alpha == AlphaMode::opaque;
    draw.state.castsAlone = material.paint.has_value();
    if (draw.state.textured) draw.textures |= shared::kTexturesColor;
    if (draw.state.textured && draw.state.alpha != AlphaMode::opaque) draw.textures |= shared::kTexturesCut;
    wraps_ |= primitive.wrapsU || primitive.wrapsV;
    if (draw.state.varied) isVaried_[item.material] = true;
    if (draw.state.alpha == AlphaMode::blend)
      blended.push_back({&primitive, draw.object, place.firstVertex, item.material, draw.state.varied,
                         material.isFin() ? material.paint->fadeStart : 0.0f,
                         material.paint && !material.doubleSided});
    triangleCount_ += draw.indexCount / 3;
    // Paint is drawn by the passes that blend, and here for its shadow.
    if (material.paint && !item.casts) continue;
    draws.push_back(draw);
    reach_.push_back(item.reach);
  }
  arePlaced_ = false;
  const bool otherTriangles = transparent_.update(device_, std::move(blended), settle);
  return draws_.update(device_, std::move(draws), levels, objects_.size(), settle) || otherTriangles;
}

bool SceneOnGpu::followFeatures(const std::function<void()>& settle) {
  bool renamed = false;
  const auto follow = [&](FeatureMoments& moments) {
    moments.resize(options_.features.size());
    for (size_t f = 0; f < moments.size(); ++f) {
      const FeaturePlan* const plan = options_.features[f].plan.get();
      if (!plan && !moments[f]) continue;
      if (plan && moments[f] && moments[f]->follow(*data_, *plan)) continue;
      settle();
      moments[f] = plan ? plan->makeMoment(device_, *data_) : nullptr;
      renamed = true;
    }
  };
  follow(features_);
  if (previousMotion_) follow(previousFeatures_);
  return renamed;
}

std::optional<SceneOnGpu::FeatureHere> SceneOnGpu::feature(const std::string& name) const {
  for (size_t f = 0; f < options_.features.size(); ++f) {
    const PlannedFeature& planned = options_.features[f];
    if (planned.plan && planned.feature->name() == name)
      return FeatureHere{int(f), uint32_t(featureMaterials_[f]), planned.plan.get(), features_[f].get(),
                         f < previousFeatures_.size() ? previousFeatures_[f].get() : nullptr};
  }
  return std::nullopt;
}

FeatureMoment::CutoutBuffers SceneOnGpu::cutouts() const {
  for (const auto& feature : features_)
    if (feature)
      if (const auto buffers = feature->cutouts()) return *buffers;
  return {motion_->objects(), motion_->objects()};
}

const FeaturePlan* SceneOnGpu::planOf(size_t material) const {
  for (size_t f = 0; f < featureMaterials_.size(); ++f)
    if (featureMaterials_[f] == int(material)) return options_.features[f].plan.get();
  return nullptr;
}

bool SceneOnGpu::followMotion(bool otherPlaces, const std::function<void()>& settle) {
  bool renamed = false;
  for (std::optional<SceneMotion>* motion : {&motion_, &previousMotion_}) {
    if (!*motion && motion == &previousMotion_) continue;
    if (!*motion || !(*motion)->follow(*data_, objects_)) {
      settle();
      motion->emplace(device_, *data_, moving_, objects_, geometry_);
      renamed = true;
    }
    if (otherPlaces) (*motion)->touchAll();
    for (const uint32_t item : geometry_.rewritten()) (*motion)->touch(item);
  }
  return renamed;
}

void SceneOnGpu::pose(const look::LookData& look, const KnobTable& now, double time) {
  for (const auto& feature : features_)
    if (feature) feature->pose(look, now, time, nullptr);
  const bool moves = motion_->pose(*data_, now, time, features_);
  for (const auto& feature : features_)
    if (feature) feature->posed(*motion_);
  if (!moves && arePlaced_) return;
  arePlaced_ = true;
  draws_.place(motion_->bounds(), motion_->mirrored(), motion_->scales());
  casters_.clear();
  for (size_t d = 0; d < draws_.count(); ++d)
    if (const Draw& draw = draws_.draws()[d]; draw.state.casts)
      casters_.emplace_back(reach_[d]).add(motion_->bounds()[draw.object]);
  for (const auto& feature : features_)
    if (feature) feature->addCasters(casters_);
}

void SceneOnGpu::look(const Viewers& viewers) {
  transparent_.look(viewers, motion_->bounds(), motion_->mirrored());
}

void SceneOnGpu::posePrevious(const scene::SceneData& scene, const look::LookData& look,
                              const KnobTable& then, double time) {
  for (size_t f = 0; f < previousFeatures_.size(); ++f)
    if (previousFeatures_[f]) previousFeatures_[f]->pose(look, then, time, features_[f].get());
  previousMotion_->pose(scene, then, time, previousFeatures_, false);
}

void SceneOnGpu::forgetPoses() {
  motion_->touchAll();
  if (previousMotion_) previousMotion_->touchAll();
  std::vector<gpu::PerFrameBuffer*> uploads;
  addUploads(uploads);
  for (gpu::PerFrameBuffer* const buffer : uploads) buffer->markWritten();
}

void SceneOnGpu::keepPrevious() {
  if (previousMotion_) return;
  // All of it or nothing: each may not fit.
  FeatureMoments features;
  for (const PlannedFeature& planned : options_.features)
    features.push_back(planned.plan ? planned.plan->makeMoment(device_, *data_) : nullptr);
  previousPositions_ = positionBuffer(device_, geometry_.vertexCount());
  previousFeatures_ = std::move(features);
  previousMotion_.emplace(device_, *data_, moving_, objects_, geometry_);
}

void SceneOnGpu::addUploads(std::vector<gpu::PerFrameBuffer*>& uploads) {
  motion_->addUploads(uploads);
  draws_.addUploads(uploads);
  if (previousMotion_) previousMotion_->addUploads(uploads);
  transparent_.addUploads(uploads);
  for (const FeatureMoments* const moments : {&features_, &previousFeatures_})
    for (const auto& feature : *moments)
      if (feature) feature->addUploads(uploads);
  uploads.push_back(&materialData_);
}

uint32_t SceneOnGpu::writeMaterials(bool otherTextures, const std::function<void()>& settle) {
  uint32_t written = 0;
  const bool isNew = materialTextures_.size() != materialNames_.size();
  if (isNew) {
    settle();
    constexpr VkDescriptorType kTexture = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
    if (!materialLayout_.handle())
      materialLayout_ = gpu::SetLayout(device_, {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kStages},
                                                 {kTexture, VK_SHADER_STAGE_FRAGMENT_BIT},
                                                 {kTexture, VK_SHADER_STAGE_FRAGMENT_BIT},
                                                 {kTexture, VK_SHADER_STAGE_FRAGMENT_BIT},
                                                 {kTexture, VK_SHADER_STAGE_FRAGMENT_BIT}});
    materialSets_ = gpu::DescriptorSets(device_, materialLayout_, uint32_t(materialNames_.size()));
    materialData_ = gpu::PerFrameBuffer(device_, materialNames_.size() * kMaterialStride,
                                        VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    materialTextures_.assign(materialNames_.size(), {});
    for (size_t m = 0; m < materialNames_.size(); ++m)
      materialSets_.writeBuffer(m, 0, materialData_.handle(), m * kMaterialStride,
                                sizeof(shared::MaterialData));
  }
  for (size_t m = 0; m < materialNames_.size(); ++m) {
    TextureBindings bindings;
    const scene::TextureUse* const uses[] = {&material(m).baseColorTexture, &material(m).emissiveTexture};
    for (size_t i = 0; i < bindings.size(); ++i) bindings[i] = {uses[i]->image, textureOf(*uses[i]).sampler};
    if (!isNew && !otherTextures && bindings == materialTextures_[m]) continue;
    settle();
    materialTextures_[m] = bindings;
    ++written;
    // A new image may have an old one's name.
    const auto write = [&](uint32_t binding, const scene::TextureUse& use) {
      const SetTexture texture = textureOf(use);
      materialSets_.rewriteTexture(m, binding, texture.view, samplers_.get(texture.sampler));
    };
    for (uint32_t i = 0; i < bindings.size(); ++i) write(1 + i, *uses[i]);
    write(kLitBinding, {});
    write(kShadowedBinding, {});
  }
  return written;
}

SetTexture SceneOnGpu::textureOf(const scene::TextureUse& use) const {
  gpu::SamplerDesc desc;
  desc.wrapU = addressMode(use.sampler.wrapU);
  desc.wrapV = addressMode(use.sampler.wrapV);
  desc.mipmaps = use.sampler.mipmaps;
  if (use.sampler.nearest) desc.filter = VK_FILTER_NEAREST;
  return {textures_.view(use.image), desc};
}

void SceneOnGpu::setColorSets(size_t material, const SetTexture* lit, const SetTexture* shadowed) {
  materialUses_[material].lit = lit ? *lit : SetTexture();
  materialUses_[material].shadowed = shadowed ? *shadowed : SetTexture();
  if (lit) materialSets_.writeTexture(material, kLitBinding, lit->view, samplers_.get(lit->sampler));
  if (shadowed)
    materialSets_.writeTexture(material, kShadowedBinding, shadowed->view, samplers_.get(shadowed->sampler));
}

const shared::MaterialData& SceneOnGpu::materialData(size_t material) const {
  return *reinterpret_cast<const shared::MaterialData*>(materialData_.as<std::byte>() +
                                                        material * kMaterialStride);
}

std::array<SetTexture, 4> SceneOnGpu::textures(size_t material) const {
  const scene::Material& of = this->material(material);
  const auto own = [&](const scene::TextureUse& use) {
    return use.image >= 0 ? textureOf(use) : SetTexture();
  };
  return {own(of.baseColorTexture), own(of.emissiveTexture), materialUses_[material].lit,
          materialUses_[material].shadowed};
}

void SceneOnGpu::setMaterial(size_t material, const shared::MaterialData& data) {
  const bool hasHoles = alphaMode(this->material(material)) != AlphaMode::opaque;
  // To the bit, padding and all: it was copied so.
  const auto bytesOf = [](const shared::MaterialData& of) { return std::as_bytes(std::span(&of, 1)); };
  const auto now = bytesOf(data), before = bytesOf(materialData(material));
  if (hasHoles && !std::equal(now.begin(), now.end(), before.begin())) ++castersVersion_;
  std::memcpy(materialData_.contents() + material * kMaterialStride, &data, sizeof(data));
}

}  // namespace scumble::world
