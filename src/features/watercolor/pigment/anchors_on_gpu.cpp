#include "features/watercolor/pigment/anchors_on_gpu.h"

#include <algorithm>

#include "scene/parallel.h"
#include "world/geometry.h"

namespace scumble::watercolor {

namespace {

// Candidates of all of a scene, and the least and the most of one primitive.
constexpr double kCandidates = 160000;
constexpr double kFewest = 400, kMost = 80000;

bool isPainted(const GeometryItem& item) {
  return item.shown && !item.primitive->indices.empty();
}

}  // namespace

void AnchorsOnGpu::find(const std::vector<GeometryItem>& items) {
  // What part of the whole surface a primitive has at its largest place.
  std::map<const scene::Primitive*, double> areas, largest;
  double total = 0;
  for (const GeometryItem& item : items) {
    if (!isPainted(item)) continue;
    const auto known = anchorsOf_.find(item.primitive);
    const auto [area, isNew] = areas.try_emplace(item.primitive, 0.0);
    if (isNew && (known == anchorsOf_.end() || !item.primitive->positions.empty()))
      area->second = scene::areaOf(*item.primitive);
    const double scale = largestScale(glm::mat3(item.model)), own = area->second * scale * scale;
    // The ground is one loose wash, and not what the scene is.
    if (item.node != GeometryItem::kNoNode) total += own;
    largest[item.primitive] = std::max(largest[item.primitive], own);
  }
  std::erase_if(anchorsOf_, [&](const auto& entry) { return !areas.contains(entry.first); });
  std::vector<std::pair<const scene::Primitive*, uint32_t>> missing;
  for (const auto& [primitive, area] : largest)
    if (!anchorsOf_.contains(primitive))
      missing.push_back(
          {primitive, uint32_t(std::clamp(kCandidates * area / std::max(total, 1e-30), kFewest, kMost))});
  std::vector<std::vector<scene::SurfaceAnchor>> found(missing.size());
  scene::parallelFor(missing.size(), scene::threadCount(0), [&](size_t i) {
    found[i] =
        scene::anchorsOf(*missing[i].first, missing[i].second, uint32_t(missing[i].first->indices.size()));
  });
  for (size_t i = 0; i < missing.size(); ++i) anchorsOf_[missing[i].first] = std::move(found[i]);
}

bool AnchorsOnGpu::update(gpu::Uploader& uploader, const std::vector<GeometryItem>& items,
                          const std::vector<GeometryPlace>& places, const std::function<void()>& settle) {
  std::vector<Known> known;
  for (size_t i = 0; i < items.size(); ++i)
    known.push_back({items[i].primitive, places[i].firstVertex, largestScale(glm::mat3(items[i].model)),
                     isPainted(items[i])});
  if (anchors_.handle() && known == known_) return false;
  known_ = std::move(known);

  std::vector<shared::DrawnAnchor> anchors;
  std::vector<shared::AnchorChunk> chunks;
  std::map<const scene::Primitive*, uint32_t> firstOf;
  for (const Known& item : known_) {
    if (!item.shown) continue;
    const std::vector<scene::SurfaceAnchor>& own = anchorsOf_.at(item.primitive);
    const auto [first, isNew] = firstOf.try_emplace(item.primitive, uint32_t(anchors.size()));
    if (isNew)
      for (const scene::SurfaceAnchor& a : own)
        anchors.push_back({a.a, a.b, a.c, a.toB, a.toC, a.spacing, a.seed});
    for (uint32_t i = 0; i < own.size(); i += shared::kAnchorChunk)
      chunks.push_back({first->second + i, std::min(uint32_t(own.size()) - i, uint32_t(shared::kAnchorChunk)),
                        item.firstVertex, item.scale});
  }
  settle();
  const auto upload = [&]<class T>(const std::vector<T>& array, gpu::Buffer& buffer) {
    std::byte* target = nullptr;
    buffer = {};
    buffer = uploader.reserve(std::max<size_t>(1, array.size()) * sizeof(T),
                              VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, &target);
    std::copy(array.begin(), array.end(), reinterpret_cast<T*>(target));
  };
  upload(anchors, anchors_);
  upload(chunks, chunks_);
  chunkCount_ = uint32_t(chunks.size());
  return true;
}

}  // namespace scumble::watercolor
