#include "world/geometry_on_gpu.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "scene/drop_vertices.h"
#include "scene/parallel.h"
#include "world/vertex_codes.h"

namespace scumble::world {

namespace {

constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
constexpr VkBufferUsageFlags kVertex = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;

// Vertices: of any stream so many take a multiple of the largest alignment that a device may ask for.
constexpr uint32_t kPageAlignment = 64;

constexpr shared::VertexTint kNoTint{0xFFFFFFFFu, 1.0f};

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

void writeCore(const scene::Primitive& primitive, shared::VertexCore* core) {
  for (size_t v = 0; v < primitive.vertexCount(); ++v)
    core[v] = {primitive.positions[v], encodeNormal(primitive.normals[v])};
}

void writeFrame(const scene::Primitive& primitive, shared::VertexFrame* frame) {
  for (size_t v = 0; v < primitive.vertexCount(); ++v)
    frame[v] = {primitive.dPdu[v], encodeNormal(primitive.smoothNormals[v]), primitive.dPdv[v]};
}

// All of it, then its levels.
void writeIndices(const scene::Primitive& primitive, uint32_t* to) {
  to = std::copy(primitive.indices.begin(), primitive.indices.end(), to);
  std::copy(primitive.levelIndices.begin(), primitive.levelIndices.end(), to);
}

void writeSkin(const scene::Primitive& primitive, shared::VertexSkin* skin) {
  const size_t groups = primitive.vertexCount() * size_t(primitive.influences / 4);
  for (size_t g = 0; g < groups; ++g) {
    const uint16_t* j = &primitive.joints[4 * g];
    const float* w = &primitive.weights[4 * g];
    skin[g] = {{uint32_t(j[0]) | uint32_t(j[1]) << 16, uint32_t(j[2]) | uint32_t(j[3]) << 16},
               {w[0], w[1], w[2], w[3]}};
  }
}

// Where what never deforms goes; null: no vertex has its own.
struct SurfaceStreams {
  glm::vec2 *uv0 = nullptr, *uv1 = nullptr, *patternUv = nullptr;
  shared::VertexTint* tint = nullptr;
};

void writeSurface(const scene::Primitive& primitive, const glm::vec2& shift, const SurfaceStreams& to) {
  for (size_t v = 0; v < primitive.vertexCount(); ++v) {
    to.uv0[v] = primitive.uv0[v];
    if (to.uv1) to.uv1[v] = primitive.uv1.empty() ? primitive.uv0[v] : primitive.uv1[v];
    if (to.patternUv) to.patternUv[v] = primitive.patternCoordinates()[v] + shift;
    if (!to.tint) continue;
    to.tint[v] = kNoTint;
    if (!primitive.colors.empty()) std::memcpy(&to.tint[v].color, &primitive.colors[v], 4);
    if (!primitive.warpScales.empty()) to.tint[v].warpScale = primitive.warpScales[v];
  }
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

template <class T>
T* placeIn(gpu::Uploader& uploader, gpu::Buffer& buffer, uint64_t first, uint64_t count) {
  return reinterpret_cast<T*>(uploader.rewrite(buffer, first * sizeof(T), count * sizeof(T)));
}

}  // namespace

GeometryOnGpu::Plan GeometryOnGpu::planOf(const std::vector<GeometryItem>& items) {
  Plan plan;
  std::map<const scene::Primitive*, uint32_t> known;
  for (const GeometryItem& item : items) {
    const scene::Primitive& primitive = *item.primitive;
    const auto [rest, isNew] = known.try_emplace(&primitive, uint32_t(plan.rests.size()));
    if (isNew) {
      Rest& added = plan.rests.emplace_back(Rest{&primitive});
      added.vertexCount = uint32_t(primitive.vertexCount());
      added.indexCount = uint32_t(primitive.indices.size() + primitive.levelIndices.size());
      added.influences = primitive.influences;
      if (!primitive.morphTargets.empty()) added.morph = 0;
      added.drops = item.dropsVertices;
    }
    plan.restOf.push_back(rest->second);
    plan.shifts.push_back(item.patternShift);
    plan.streams.uv1 |= !primitive.uv1.empty();
    plan.streams.patternUv |=
        !primitive.patternUv.empty() || item.patternShift != glm::vec2(0.0f) || item.isWrittenByFeature;
    plan.streams.tint |= !primitive.colors.empty() || !primitive.warpScales.empty();
  }
  return plan;
}

uint64_t finalVertexCount(const std::vector<GeometryItem>& items, const std::vector<GeometryPlace>& places) {
  uint64_t count = 0;
  for (size_t i = 0; i < items.size(); ++i)
    count = std::max(count, uint64_t(places[i].firstVertex) + items[i].primitive->vertexCount());
  return count;
}

bool GeometryOnGpu::update(gpu::Device& device, gpu::Uploader& uploader,
                           const std::vector<GeometryItem>& items, const std::function<void()>& settle) {
  rewritten_.clear();
  written_ = 0;
  Plan plan = planOf(items);
  bool fits = vertexCount_ > 0 && plan.restOf == plan_.restOf && plan_.streams.holds(plan.streams);
  for (size_t r = 0; fits && r < plan.rests.size(); ++r)
    fits = plan.rests[r].primitive == plan_.rests[r].primitive || plan.rests[r].isLaidAs(plan_.rests[r]);
  if (fits) {
    rewrite(uploader, plan, settle);
  } else {
    settle();
    build(device, uploader, plan);
  }
  return !fits;
}

void GeometryOnGpu::rewrite(gpu::Uploader& uploader, const Plan& plan, const std::function<void()>& settle) {
  std::vector<bool> isNew(plan.rests.size(), false);
  for (size_t r = 0; r < plan.rests.size(); ++r) {
    Rest& rest = plan_.rests[r];
    if (rest.primitive == plan.rests[r].primitive) continue;
    settle();
    isNew[r] = true;
    rest.primitive = plan.rests[r].primitive;
    ++written_;
    if (rest.vertexCount == 0) continue;
    writeCore(*rest.primitive,
              placeIn<shared::VertexCore>(uploader, restCore_, rest.vertex, rest.vertexCount));
    writeFrame(*rest.primitive,
               placeIn<shared::VertexFrame>(uploader, restFrame_, rest.vertex, rest.vertexCount));
    if (const uint64_t entries = uint64_t(rest.vertexCount) * uint64_t(rest.influences / 4); entries > 0)
      writeSkin(*rest.primitive, placeIn<shared::VertexSkin>(uploader, restSkin_, rest.skin, entries));
    writeIndices(*rest.primitive, placeIn<uint32_t>(uploader, indices_, rest.index, rest.indexCount));
  }
  for (uint32_t i = 0; i < plan.restOf.size(); ++i) {
    const Rest& rest = plan_.rests[plan.restOf[i]];
    if (isNew[plan.restOf[i]]) rewritten_.push_back(i);
    if (!isNew[plan.restOf[i]] && plan.shifts[i] == plan_.shifts[i]) continue;
    settle();
    plan_.shifts[i] = plan.shifts[i];
    if (rest.vertexCount == 0) continue;
    const auto place = [&]<class T>(gpu::Buffer& buffer, T*& to) {
      to = placeIn<T>(uploader, buffer, places_[i].firstVertex, rest.vertexCount);
    };
    SurfaceStreams to;
    place(uv0_, to.uv0);
    if (plan_.streams.uv1) place(uv1_, to.uv1);
    if (plan_.streams.patternUv) place(patternUv_, to.patternUv);
    if (plan_.streams.tint) place(tint_, to.tint);
    writeSurface(*rest.primitive, plan.shifts[i], to);
  }
}

void GeometryOnGpu::build(gpu::Device& device, gpu::Uploader& uploader, Plan& plan) {
  // Lay out: rest data once for each primitive, final and static vertices once for each item.
  uint64_t restVertices = 0, indexCount = 0, skinEntries = 0, finalVertices = 0;
  std::vector<uint32_t> morphStarts;
  std::vector<shared::MorphDisplacement> morphs;
  for (Rest& rest : plan.rests) {
    rest.vertex = uint32_t(restVertices), rest.index = uint32_t(indexCount),
    rest.skin = uint32_t(skinEntries);
    if (rest.morph != shared::kNoMorph) {
      rest.morph = uint32_t(morphStarts.size());
      listDisplacements(*rest.primitive, morphStarts, morphs);
    }
    restVertices += rest.vertexCount;
    indexCount += rest.indexCount;
    skinEntries += uint64_t(rest.vertexCount) * uint64_t(rest.influences / 4);
  }
  for (const uint32_t rest : plan.restOf) finalVertices += plan.rests[rest].vertexCount;
  // Skins and morph targets lie in one piece.
  const uint64_t range = device.limits().maxStorageBufferRange;
  const uint64_t largest =
      std::max({skinEntries * sizeof(shared::VertexSkin), morphs.size() * sizeof(shared::MorphDisplacement),
                morphStarts.size() * sizeof(uint32_t)});
  if (largest > range || std::max({restVertices, finalVertices, indexCount}) > (1ull << 31))
    throw gpu::VulkanError{"the scene's vertices", VK_ERROR_OUT_OF_DEVICE_MEMORY};
  // So many that each stream begins where storage buffers may; a chunk may reach into the next page.
  constexpr uint64_t kLargestVertex = std::max(sizeof(shared::VertexCore), sizeof(shared::VertexFrame));
  pageVertices_ =
      uint32_t(std::min<uint64_t>(range / kLargestVertex, 1u << 31) / kPageAlignment * kPageAlignment);
  const uint32_t step =
      pageVertices_ - kPageAlignment * ((shared::kDeformChunk + kPageAlignment - 1) / kPageAlignment);

  // What was there goes first.
  bytes_ = 0;
  vertexCount_ = 0;
  for (gpu::Buffer* buffer : {&chunks_, &restCore_, &restFrame_, &restSkin_, &morphStarts_, &morphs_,
                              &finalCore_, &finalFrame_, &uv0_, &uv1_, &patternUv_, &tint_, &indices_})
    *buffer = {};
  auto core = reserve<shared::VertexCore>(uploader, restVertices, kStorage, bytes_);
  auto around = reserve<shared::VertexFrame>(uploader, restVertices, kStorage, bytes_);
  auto skins = reserve<shared::VertexSkin>(uploader, skinEntries, kStorage, bytes_);
  auto uv0 = reserve<glm::vec2>(uploader, finalVertices, kStorage | kVertex, bytes_);
  Stream<glm::vec2> uv1, patternUv;
  if (plan.streams.uv1) uv1 = reserve<glm::vec2>(uploader, finalVertices, kVertex, bytes_);
  if (plan.streams.patternUv)
    patternUv = reserve<glm::vec2>(uploader, finalVertices, kStorage | kVertex, bytes_);
  auto tint = reserve<shared::VertexTint>(uploader, plan.streams.tint ? finalVertices : 1, kVertex, bytes_);
  *tint.data = kNoTint;
  auto indices = reserve<uint32_t>(uploader, indexCount, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, bytes_);

  // Items, and deform's work.
  std::vector<shared::DeformChunk> chunks;
  std::map<VertexPage, uint32_t> known;
  pages_.clear();
  pageOfChunk_.clear();
  places_.clear();
  uint32_t finalVertex = 0;
  for (uint32_t i = 0; i < plan.restOf.size(); ++i) {
    const Rest& rest = plan.rests[plan.restOf[i]];
    Place& place = places_.emplace_back();
    place.firstIndex = rest.index;
    place.firstVertex = finalVertex;
    place.firstRest = rest.vertex;
    place.firstChunk = uint32_t(chunks.size());
    place.morphs = rest.morph != shared::kNoMorph;
    for (uint32_t v = 0; v < rest.vertexCount; v += shared::kDeformChunk) {
      const VertexPage page{(rest.vertex + v) / step * step, (finalVertex + v) / step * step};
      const auto [found, isNew] = known.try_emplace(page, uint32_t(pages_.size()));
      if (isNew) pages_.push_back(page);
      pageOfChunk_.push_back(found->second);
      chunks.push_back({i, rest.vertex + v - page.firstRest, finalVertex + v - page.firstFinal,
                        std::min(rest.vertexCount - v, uint32_t(shared::kDeformChunk)),
                        rest.skin + v * uint32_t(rest.influences / 4),
                        place.morphs ? rest.morph + v : shared::kNoMorph});
    }
    finalVertex += rest.vertexCount;
    place.chunkCount = uint32_t(chunks.size()) - place.firstChunk;
  }
  // Vertices.
  std::vector<std::vector<uint32_t>> itemsOf(plan.rests.size());
  for (uint32_t i = 0; i < plan.restOf.size(); ++i) itemsOf[plan.restOf[i]].push_back(i);
  scene::parallelFor(plan.rests.size(), scene::threadCount(0), [&](size_t r) {
    const Rest& rest = plan.rests[r];
    writeCore(*rest.primitive, core.data + rest.vertex);
    writeFrame(*rest.primitive, around.data + rest.vertex);
    writeSkin(*rest.primitive, skins.data + rest.skin);
    writeIndices(*rest.primitive, indices.data + rest.index);
    for (const uint32_t i : itemsOf[r]) {
      const auto from = [&](auto* data) { return data ? data + places_[i].firstVertex : nullptr; };
      writeSurface(*rest.primitive, plan.shifts[i],
                   {from(uv0.data), from(uv1.data), from(patternUv.data),
                    plan.streams.tint ? from(tint.data) : nullptr});
    }
    if (rest.drops) scene::dropVertices(*rest.primitive);
  });
  written_ = uint32_t(plan.rests.size());

  const auto upload = [&](const auto& array) {
    auto stream = reserve<std::remove_cvref_t<decltype(array[0])>>(uploader, array.size(), kStorage, bytes_);
    std::copy(array.begin(), array.end(), stream.data);
    return std::move(stream.buffer);
  };
  chunks_ = upload(chunks);
  morphStarts_ = upload(morphStarts);
  morphs_ = upload(morphs);
  restCore_ = std::move(core.buffer);
  restFrame_ = std::move(around.buffer);
  restSkin_ = std::move(skins.buffer);
  uv0_ = std::move(uv0.buffer);
  uv1_ = std::move(uv1.buffer);
  patternUv_ = std::move(patternUv.buffer);
  tint_ = std::move(tint.buffer);
  indices_ = std::move(indices.buffer);
  vertexCount_ = std::max(1u, finalVertex);
  finalCore_ = gpu::Buffer(device, vertexCount_ * sizeof(shared::VertexCore), kStorage | kVertex,
                           gpu::MemoryKind::device);
  finalFrame_ = gpu::Buffer(device, vertexCount_ * sizeof(shared::VertexFrame), kStorage | kVertex,
                            gpu::MemoryKind::device);
  plan_ = std::move(plan);
}

}  // namespace scumble::world
