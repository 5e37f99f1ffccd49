#include "frame/scene_on_gpu.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "frame/geometry.h"
#include "frame/mipmaps.h"
#include "frame/ocean_travel.h"
#include "frame/visibility.h"
#include "scene/parallel.h"

namespace scumble::frame {

namespace {

uint32_t encodeNormal(glm::vec3 n) {
  n /= std::max(std::abs(n.x) + std::abs(n.y) + std::abs(n.z), 1e-20f);
  glm::vec2 oct(n.x, n.y);
  if (n.z < 0)
    oct = {(1 - std::abs(n.y)) * (n.x >= 0 ? 1.0f : -1.0f), (1 - std::abs(n.x)) * (n.y >= 0 ? 1.0f : -1.0f)};
  const auto snorm = [](float v) {
    return uint32_t(uint16_t(int16_t(std::lround(std::clamp(v, -1.0f, 1.0f) * 32767))));
  };
  return snorm(oct.x) | snorm(oct.y) << 16;
}

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

// From one material's data to the next: no device wants uniforms at larger steps than 256.
constexpr uint64_t kMaterialStride = (sizeof(shared::MaterialData) + 255) / 256 * 256;

// Where a primitive's data lies in the rest buffers.
struct RestRange {
  uint32_t vertex = 0, index = 0, skin = 0;
  uint32_t morph = shared::kNoMorph;  // first entry in the list of where displacements begin
};

// The displacements of all targets, vertex by vertex; `starts` has one more entry than vertices.
void listDisplacements(const scene::Primitive& primitive, std::vector<uint32_t>& starts,
                       std::vector<shared::MorphDisplacement>& list) {
  const auto at = [](const std::vector<glm::vec3>& values, size_t v) {
    return values.empty() ? glm::vec3(0.0f) : values[v];
  };
  for (size_t v = 0; v < primitive.vertexCount(); ++v) {
    starts.push_back(uint32_t(list.size()));
    for (size_t t = 0; t < primitive.morphTargets.size(); ++t) {
      const scene::MorphTarget& target = primitive.morphTargets[t];
      const shared::MorphDisplacement d{uint32_t(t),           at(target.positions, v),
                                        at(target.normals, v), at(target.smoothNormals, v),
                                        at(target.dPdu, v),    at(target.dPdv, v)};
      const glm::vec3 zero(0.0f);
      if (d.position != zero || d.normal != zero || d.smoothNormal != zero || d.dPdu != zero ||
          d.dPdv != zero)
        list.push_back(d);
    }
  }
  starts.push_back(uint32_t(list.size()));
}

// A buffer that is filled in place: in device memory where the CPU sees it, else by way of staging.
template <class T>
struct Stream {
  gpu::Buffer buffer;
  T* data = nullptr;
};

template <class T>
Stream<T> reserve(gpu::Uploader& uploader, uint64_t count, VkBufferUsageFlags usage, uint64_t& bytes) {
  Stream<T> stream;
  const uint64_t size = std::max<uint64_t>(1, count) * sizeof(T);
  std::byte* target = nullptr;
  stream.buffer = uploader.reserve(size, usage, &target);
  stream.data = reinterpret_cast<T*>(target);
  bytes += size;
  return stream;
}

gpu::Buffer positionBuffer(gpu::Device& device, uint64_t count) {
  return gpu::Buffer(device, count * sizeof(glm::vec3),
                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
                     gpu::MemoryKind::device);
}

}  // namespace

SceneOnGpu::SceneOnGpu(gpu::Device& device, gpu::Samplers& samplers, const scene::SceneData& scene,
                       const GeometryOptions& options)
    : device_(&device), samplers_(&samplers), data_(&scene), options_(options) {
  for (const scene::Material& material : scene.materials) {
    materialUses_.push_back({int(materialNames_.size())});
    materialNames_.push_back(material.name);
  }
  if (options.ground) {
    groundMaterial_ = int(materialNames_.size());
    materialNames_.push_back("Ground");
    materialUses_.push_back({-1});
  }
  if (options.ocean.isThere) {
    oceanMaterial_ = int(materialNames_.size());
    materialNames_.push_back("Ocean");
    materialUses_.push_back({-1});
    waves_.emplace(device, scene, options.ocean);
  }
  gpu::Uploader uploader(device);
  Geometry geometry = collectGeometry(scene, options, groundMaterial_, oceanMaterial_);
  bounds_ = geometry.bounds;
  separateMaterials(geometry);
  buildGeometry(device, uploader, geometry);
  measureColors(geometry);
  extents_ = std::move(geometry.extents);
  buildMaterials(device, samplers, uploader);
  uploader.flush();
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

const scene::Material& SceneOnGpu::material(size_t material) const {
  static const scene::Material kGround{};
  const int base = materialUses_[material].base;
  return base >= 0 ? data_->materials[size_t(base)] : kGround;
}

void SceneOnGpu::buildGeometry(gpu::Device& device, gpu::Uploader& uploader, const Geometry& geometry) {
  // Lay out: rest data once for each primitive, final and static vertices once for each item.
  std::map<const scene::Primitive*, RestRange> ranges;
  std::vector<const scene::Primitive*> primitives;
  uint64_t restVertices = 0, indexCount = 0, skinEntries = 0, finalVertices = 0;
  std::vector<uint32_t> morphStarts;
  std::vector<shared::MorphDisplacement> morphs;
  for (const GeometryItem& item : geometry.items) {
    const scene::Primitive& primitive = *item.primitive;
    const auto [range, isNew] = ranges.try_emplace(
        &primitive, RestRange{uint32_t(restVertices), uint32_t(indexCount), uint32_t(skinEntries)});
    if (isNew) {
      primitives.push_back(&primitive);
      if (!primitive.morphTargets.empty()) {
        range->second.morph = uint32_t(morphStarts.size());
        listDisplacements(primitive, morphStarts, morphs);
      }
      restVertices += primitive.vertexCount();
      indexCount += primitive.indices.size();
      skinEntries += primitive.vertexCount() * size_t(primitive.influences / 4);
    }
    finalVertices += primitive.vertexCount();
  }
  const uint64_t largest = std::max(std::max(restVertices, finalVertices) * sizeof(shared::VertexFrame),
                                    morphs.size() * sizeof(shared::MorphDisplacement));
  if (largest > device.limits().maxStorageBufferRange || indexCount > (1ull << 31))
    throw gpu::VulkanError{"the scene's vertices", VK_ERROR_OUT_OF_DEVICE_MEMORY};

  constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  constexpr VkBufferUsageFlags kVertex = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;
  auto core = reserve<shared::VertexCore>(uploader, restVertices, kStorage, uploadedBytes_);
  auto around = reserve<shared::VertexFrame>(uploader, restVertices, kStorage, uploadedBytes_);
  auto skins = reserve<shared::VertexSkin>(uploader, skinEntries, kStorage, uploadedBytes_);
  auto surface = reserve<shared::VertexSurface>(uploader, finalVertices, kStorage | kVertex, uploadedBytes_);
  auto indices = reserve<uint32_t>(uploader, indexCount, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, uploadedBytes_);

  scene::parallelFor(primitives.size(), scene::threadCount(0), [&](size_t p) {
    const scene::Primitive& primitive = *primitives[p];
    const RestRange range = ranges.at(&primitive);
    for (size_t v = 0; v < primitive.vertexCount(); ++v) {
      core.data[range.vertex + v] = {primitive.positions[v], encodeNormal(primitive.normals[v])};
      around.data[range.vertex + v] = {primitive.dPdu[v], encodeNormal(primitive.smoothNormals[v]),
                                       primitive.dPdv[v]};
    }
    std::copy(primitive.indices.begin(), primitive.indices.end(), indices.data + range.index);
    const size_t groups = size_t(primitive.influences / 4);
    for (size_t g = 0; g < primitive.vertexCount() * groups; ++g) {
      const uint16_t* j = &primitive.joints[4 * g];
      const float* w = &primitive.weights[4 * g];
      skins.data[range.skin + g] = {
          {uint32_t(j[0]) | uint32_t(j[1]) << 16, uint32_t(j[2]) | uint32_t(j[3]) << 16},
          {w[0], w[1], w[2], w[3]}};
    }
  });

  // Objects, draws and deform's work.
  std::vector<shared::DeformChunk> chunks;
  uint32_t finalVertex = 0;
  for (const GeometryItem& item : geometry.items) {
    const scene::Primitive& primitive = *item.primitive;
    const RestRange range = ranges.at(&primitive);
    const scene::Material& material = this->material(item.material);

    Draw draw;
    draw.firstIndex = range.index;
    draw.indexCount = uint32_t(primitive.indices.size());
    draw.vertexOffset = int32_t(finalVertex);
    draw.object = uint32_t(objects_.size());
    draw.material = item.material;
    draw.alpha = alphaMode(material);
    draw.cullsBack = !material.doubleSided;
    draw.textured = material.baseColorTexture.image >= 0 || material.emissiveTexture.image >= 0;
    draw.varied = draw.textured || !primitive.colors.empty();
    draw.wraps = primitive.wrapsU || primitive.wrapsV;
    draw.casts = item.casts;
    draw.reach = item.reach;
    if (draw.alpha == AlphaMode::blend)
      draw.firstIndex = transparent_.add(primitive, draw.object, item.skin >= 0);
    draws_.push_back(draw);
    triangleCount_ += draw.indexCount / 3;

    shared::ObjectData object{};
    object.material = item.material;
    object.id = item.id;
    object.wraps = uint32_t(primitive.wrapsU) + 2 * uint32_t(primitive.wrapsV);
    object.water = uint32_t(item.water);
    object.decoration = item.decoration;
    object.influences = item.skin >= 0 ? uint32_t(primitive.influences) : 0;
    objects_.push_back(object);

    MovingObject moving;
    moving.node = item.node;
    moving.instance = item.instance;
    moving.skin = item.skin;
    moving.mesh = item.node == GeometryItem::kNoNode ? -1 : data_->nodes[item.node].mesh;
    moving.water = item.water;
    moving.decoration = item.decoration;
    moving.material = item.material;
    moving.extent = item.extent;
    moving.morphs = range.morph != shared::kNoMorph;
    moving.firstChunk = uint32_t(chunks.size());

    const uint32_t count = uint32_t(primitive.vertexCount());
    for (uint32_t v = 0; v < count; v += shared::kDeformChunk)
      chunks.push_back({draw.object, range.vertex + v, finalVertex + v,
                        std::min(count - v, uint32_t(shared::kDeformChunk)),
                        range.skin + v * uint32_t(primitive.influences / 4),
                        moving.morphs ? range.morph + v : shared::kNoMorph});
    finalVertex += count;
    moving.chunkCount = uint32_t(chunks.size()) - moving.firstChunk;
    moving_.push_back(moving);
  }
  scene::parallelFor(geometry.items.size(), scene::threadCount(0), [&](size_t i) {
    const scene::Primitive& primitive = *geometry.items[i].primitive;
    shared::VertexSurface* out = surface.data + draws_[i].vertexOffset;
    for (size_t v = 0; v < primitive.vertexCount(); ++v) {
      uint32_t color = 0xFFFFFFFFu;
      if (!primitive.colors.empty()) std::memcpy(&color, &primitive.colors[v], 4);
      out[v] = {primitive.uv0[v], primitive.uv1.empty() ? primitive.uv0[v] : primitive.uv1[v],
                primitive.patternCoordinates()[v] + geometry.items[i].patternShift, color,
                primitive.warpScales.empty() ? 1.0f : primitive.warpScales[v]};
    }
  });

  warpScaleOf_.assign(materialCount(), 1.0f);
  for (size_t i = 0; i < geometry.items.size(); ++i)
    for (const float scale : geometry.items[i].primitive->warpScales)
      warpScaleOf_[draws_[i].material] = std::max(warpScaleOf_[draws_[i].material], scale);

  restCore_ = std::move(core.buffer);
  restFrame_ = std::move(around.buffer);
  restSkin_ = std::move(skins.buffer);
  surface_ = std::move(surface.buffer);
  indices_ = std::move(indices.buffer);
  chunkCount_ = uint32_t(chunks.size());
  finalVertexCount_ = std::max(1u, finalVertex);
  const auto upload = [&](const auto& array) {
    auto stream =
        reserve<std::remove_cvref_t<decltype(array[0])>>(uploader, array.size(), kStorage, uploadedBytes_);
    std::copy(array.begin(), array.end(), stream.data);
    return std::move(stream.buffer);
  };
  chunks_ = upload(chunks);
  morphStarts_ = upload(morphStarts);
  morphs_ = upload(morphs);
  const uint64_t finals = finalVertexCount_;
  finalCore_ =
      gpu::Buffer(device, finals * sizeof(shared::VertexCore), kStorage | kVertex, gpu::MemoryKind::device);
  finalFrame_ =
      gpu::Buffer(device, finals * sizeof(shared::VertexFrame), kStorage | kVertex, gpu::MemoryKind::device);
  previousPositions_ = positionBuffer(device, 1);
  transparent_.create(device);
  motion_.emplace(device, *data_, materialNames_, moving_, objects_, chunkCount_);
}

void SceneOnGpu::pose(const look::LookData& look, const look::LookData& now, double time) {
  if (waves_) waves_->pose(now, time, travelledBy(look));
  motion_->pose(now, time, waves());
  for (size_t i = 0; i < draws_.size(); ++i) {
    draws_[i].bounds = motion_->bounds()[i];
    draws_[i].mirrored = motion_->mirrored()[i];
  }
}

void SceneOnGpu::look(const Viewers& viewers) {
  nearestOf_.assign(materialCount(), std::numeric_limits<float>::infinity());
  for (Draw& draw : draws_) {
    draw.visible =
        std::any_of(viewers.windows.begin(), viewers.windows.end(), [&](const Viewers::Window& window) {
          return mayBeSeen(draw.bounds, window.worldToClip, window.margin);
        });
    draw.distance = viewers.distanceTo(draw.bounds.center());
    if (draw.visible) nearestOf_[draw.material] = std::min(nearestOf_[draw.material], draw.distance);
    if (draw.alpha == AlphaMode::blend && (draw.visible || draw.casts))
      transparent_.sort(draw.object, *motion_, viewers);
  }
}

void SceneOnGpu::posePrevious(const look::LookData& look, const look::LookData& then, double time) {
  if (previousWaves_) previousWaves_->pose(then, time, travelledBy(look), waves());
  previousMotion_->pose(then, time, previousWaves());
}

void SceneOnGpu::forgetPoses() {
  motion_->touchAll();
  if (previousMotion_) previousMotion_->touchAll();
}

void SceneOnGpu::keepPrevious() {
  if (previousMotion_) return;
  previousPositions_ = positionBuffer(*device_, finalVertexCount_);
  if (waves_) previousWaves_.emplace(*device_, *data_, options_.ocean);
  previousMotion_.emplace(*device_, *data_, materialNames_, moving_, objects_, chunkCount_);
}

void SceneOnGpu::addUploads(std::vector<gpu::PerFrameBuffer*>& uploads) {
  motion_->addUploads(uploads);
  if (previousMotion_) previousMotion_->addUploads(uploads);
  transparent_.addUploads(uploads);
  if (waves_) waves_->addUploads(uploads);
  if (previousWaves_) previousWaves_->addUploads(uploads);
  uploads.push_back(&materialData_);
}

void SceneOnGpu::buildMaterials(gpu::Device& device, gpu::Samplers& samplers, gpu::Uploader& uploader) {
  const std::byte white[4] = {std::byte(255), std::byte(255), std::byte(255), std::byte(255)};
  const std::span<const std::byte> whiteLevel(white);
  images_.push_back(uploader.texture({&whiteLevel, 1}, VK_FORMAT_R8G8B8A8_SRGB, 1, 1));
  std::vector<std::vector<std::vector<uint8_t>>> mipmaps(data_->images.size());
  scene::parallelFor(mipmaps.size(), scene::threadCount(0), [&](size_t i) {
    mipmaps[i] = makeMipmaps(data_->images[i].rgba, data_->images[i].width, data_->images[i].height);
  });
  for (size_t i = 0; i < mipmaps.size(); ++i) {
    const scene::Image& image = data_->images[i];
    if (image.width > device.limits().maxImageDimension2D ||
        image.height > device.limits().maxImageDimension2D)
      throw gpu::VulkanError{"a texture's size", VK_ERROR_OUT_OF_DEVICE_MEMORY};
    std::vector<std::span<const std::byte>> levels{std::as_bytes(std::span(image.rgba))};
    for (const auto& level : mipmaps[i]) levels.push_back(std::as_bytes(std::span(level)));
    images_.push_back(uploader.texture(levels, VK_FORMAT_R8G8B8A8_SRGB, image.width, image.height));
    for (const auto& level : levels) uploadedBytes_ += level.size();
    mipmaps[i].clear();
  }

  constexpr VkDescriptorType kTexture = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
  constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
  materialLayout_ = gpu::SetLayout(device, {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kStages},
                                            {kTexture, VK_SHADER_STAGE_FRAGMENT_BIT},
                                            {kTexture, VK_SHADER_STAGE_FRAGMENT_BIT},
                                            {kTexture, VK_SHADER_STAGE_FRAGMENT_BIT},
                                            {kTexture, VK_SHADER_STAGE_FRAGMENT_BIT}});
  materialSets_ = gpu::DescriptorSets(device, materialLayout_, uint32_t(materialNames_.size()));
  materialData_ = gpu::PerFrameBuffer(device, materialNames_.size() * kMaterialStride,
                                      VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
  const auto write = [&](size_t set, uint32_t binding, const scene::TextureUse& use) {
    const SetTexture texture = textureOf(use);
    materialSets_.writeTexture(set, binding, texture.view, samplers.get(texture.sampler));
  };
  for (size_t m = 0; m < materialNames_.size(); ++m) {
    materialSets_.writeBuffer(m, 0, materialData_.handle(), m * kMaterialStride,
                              sizeof(shared::MaterialData));
    write(m, 1, material(m).baseColorTexture);
    write(m, 2, material(m).emissiveTexture);
    write(m, kLitBinding, {});
    write(m, kShadowedBinding, {});
  }
}

SetTexture SceneOnGpu::textureOf(const scene::TextureUse& use) const {
  gpu::SamplerDesc desc;
  desc.wrapU = addressMode(use.sampler.wrapU);
  desc.wrapV = addressMode(use.sampler.wrapV);
  desc.mipmaps = use.sampler.mipmaps;
  if (use.sampler.nearest) desc.filter = VK_FILTER_NEAREST;
  return {images_[size_t(use.image + 1)].view(), desc};
}

void SceneOnGpu::setColorSets(size_t material, const SetTexture* lit, const SetTexture* shadowed) {
  materialUses_[material].colorSets = uint8_t((lit ? kLitSet : 0) | (shadowed ? kShadowedSet : 0));
  if (lit) materialSets_.writeTexture(material, kLitBinding, lit->view, samplers_->get(lit->sampler));
  if (shadowed)
    materialSets_.writeTexture(material, kShadowedBinding, shadowed->view, samplers_->get(shadowed->sampler));
}

bool SceneOnGpu::isVaried(size_t material) const {
  return std::any_of(draws_.begin(), draws_.end(),
                     [&](const Draw& draw) { return draw.material == material && draw.varied; });
}

void SceneOnGpu::setMaterial(size_t material, const shared::MaterialData& data) {
  std::memcpy(materialData_.contents() + material * kMaterialStride, &data, sizeof(data));
}

void SceneOnGpu::measureColors(const Geometry& geometry) {
  // Mean of each image, from a grid of its pixels.
  constexpr uint32_t kGrid = 16;
  std::vector<glm::vec3> imageMeans;
  for (const scene::Image& image : data_->images) {
    glm::vec3 sum(0.0f);
    float weight = 1e-6f;
    for (uint32_t i = 0; i < kGrid * kGrid; ++i) {
      const uint32_t x = (2 * (i % kGrid) + 1) * image.width / (2 * kGrid);
      const uint32_t y = (2 * (i / kGrid) + 1) * image.height / (2 * kGrid);
      const uint8_t* p = &image.rgba[4 * (size_t(y) * image.width + x)];
      sum += glm::vec3(p[0], p[1], p[2]) / 255.0f * float(p[3]);  // sRGB is close to a square root
      weight += float(p[3]);
    }
    imageMeans.push_back(sum / weight);
  }

  // Mean over the scene's surface, by the area of up to so many triangles of each item.
  constexpr size_t kTriangles = 64;
  glm::dvec3 sum(0.0);
  double total = 0;
  for (const GeometryItem& item : geometry.items) {
    if (item.node == GeometryItem::kNoNode) continue;
    const scene::Primitive& primitive = *item.primitive;
    const scene::Material& material = this->material(item.material);
    glm::vec3 root = glm::sqrt(glm::clamp(glm::vec3(material.baseColor), 0.0f, 1.0f));
    if (material.baseColorTexture.image >= 0) root *= imageMeans[size_t(material.baseColorTexture.image)];
    const size_t triangles = primitive.indices.size() / 3, step = std::max<size_t>(1, triangles / kTriangles);
    for (size_t t = 0; t < triangles; t += step) {
      const uint32_t* v = &primitive.indices[3 * t];
      const glm::mat3 m(item.model);
      const glm::dvec3 normal =
          glm::cross(glm::dvec3(m * (primitive.positions[v[1]] - primitive.positions[v[0]])),
                     glm::dvec3(m * (primitive.positions[v[2]] - primitive.positions[v[0]])));
      const double area = glm::length(normal) * double(step);
      if (!std::isfinite(area)) continue;
      glm::vec3 c = root;
      if (!primitive.colors.empty()) c *= glm::sqrt(glm::vec3(primitive.colors[v[0]]) / 255.0f);
      sum += area * glm::dvec3(c);
      total += area;
    }
  }
  if (total > 0) colors_.meanRootRgb = glm::vec3(sum / total);
}

}  // namespace scumble::frame
