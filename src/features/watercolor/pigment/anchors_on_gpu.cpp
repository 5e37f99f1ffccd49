#include "features/watercolor/pigment/anchors_on_gpu.h"

#include <algorithm>
#include <bit>

#include "scene/parallel.h"
#include "shading/frame.shared.h"
#include "world/geometry.h"

namespace scumble::watercolor {

namespace {

// Candidates of all of a scene, and the least and the most of one primitive.
constexpr double kCandidates = 131072;
constexpr double kFewest = 512, kMost = 131072;

bool isPainted(const GeometryItem& item) {
  return item.shown && item.primitive->indexCount() > 0 && !item.primitive->isPaint;
}

}  // namespace

void AnchorsOnGpu::find(const std::vector<GeometryItem>& items) {
  // What part of the whole surface each primitive is, at its largest place.
  std::map<const scene::Primitive*, double> areas;
  for (const GeometryItem& item : items) {
    if (!isPainted(item)) continue;
    const auto [spread, isNew] = spreads_.try_emplace(item.primitive);
    if (isNew) spread->second.area = scene::areaOf(*item.primitive);
    // Skins ignore where their nodes stand. The ground is one loose wash, and not what the scene is.
    const double scale = item.skin >= 0 ? 1 : largestScale(glm::mat3(item.model));
    double& area = areas[item.primitive];
    if (item.node != GeometryItem::kNoNode) area = std::max(area, spread->second.area * scale * scale);
  }
  std::erase_if(spreads_, [&](const auto& entry) { return !areas.contains(entry.first); });
  double total = 0;
  for (const auto& [primitive, area] : areas) total += area;

  std::vector<std::pair<const scene::Primitive*, Spread*>> changed;
  for (const auto& [primitive, area] : areas) {
    // In powers of two, so that small changes change nothing.
    const double share = kCandidates * area / std::max(total, 1e-30);
    const uint32_t candidates = std::bit_ceil(uint32_t(std::clamp(share, kFewest, kMost)));
    Spread& spread = spreads_.at(primitive);
    if (spread.candidates == candidates) continue;
    spread.candidates = candidates;
    changed.push_back({primitive, &spread});
  }
  scene::parallelFor(changed.size(), scene::threadCount(0), [&](size_t i) {
    const auto& [primitive, spread] = changed[i];
    spread->anchors = scene::anchorsOf(*primitive, spread->candidates, uint32_t(primitive->indices.size()));
  });
}

bool AnchorsOnGpu::update(gpu::Device& device, gpu::Uploader& uploader,
                          const std::vector<GeometryItem>& items, const std::vector<GeometryPlace>& places,
                          const std::function<void()>& settle) {
  std::vector<Known> known;
  for (size_t i = 0; i < items.size(); ++i) {
    const bool isShown = isPainted(items[i]);
    known.push_back({items[i].primitive, places[i].firstVertex,
                     isShown ? spreads_.at(items[i].primitive).candidates : 0, isShown});
  }
  if (anchors_.handle() && known == known_) return false;
  device.requireBindable(finalVertexCount(items, places) * sizeof(shared::VertexCore),
                         "a watercolour of so large a scene");
  known_ = std::move(known);

  std::vector<shared::DrawnAnchor> anchors;
  std::vector<shared::AnchorChunk> chunks;
  std::map<const scene::Primitive*, uint32_t> firstOf;
  for (const Known& item : known_) {
    if (!item.shown) continue;
    const std::vector<scene::SurfaceAnchor>& own = spreads_.at(item.primitive).anchors;
    const auto [first, isNew] = firstOf.try_emplace(item.primitive, uint32_t(anchors.size()));
    if (isNew)
      for (const scene::SurfaceAnchor& a : own)
        anchors.push_back({a.a, a.b, a.c, a.toB, a.toC, a.spacing, a.area, a.seed});
    for (uint32_t i = 0; i < own.size(); i += shared::kAnchorChunk)
      chunks.push_back({first->second + i, std::min(uint32_t(own.size()) - i, uint32_t(shared::kAnchorChunk)),
                        item.firstVertex});
  }
  settle();
  // What was there goes first.
  anchors_ = {}, chunks_ = {};
  anchors_ = uploader.storage<shared::DrawnAnchor>(anchors);
  chunks_ = uploader.storage<shared::AnchorChunk>(chunks);
  chunkCount_ = uint32_t(chunks.size());
  return true;
}

}  // namespace scumble::watercolor
