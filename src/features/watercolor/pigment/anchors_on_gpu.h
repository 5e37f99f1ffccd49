// Anchors on all that is drawn, in device memory, and what a watercolour keeps of a scene.
#pragma once

#include <map>
#include <vector>

#include "features/watercolor/watercolor.shared.h"
#include "gpu/resources.h"
#include "scene/surface_anchors.h"
#include "world/feature.h"
#include "world/geometry_on_gpu.h"

namespace scumble::watercolor {

using namespace world;

class AnchorsOnGpu {
 public:
  // Spreads anchors over primitives while their vertices are there, so many over all of them, by area; those
  // that have as many as they should keep them.
  void find(const std::vector<GeometryItem>& items);
  // True where the buffers have other names.
  bool update(gpu::Device& device, gpu::Uploader& uploader, const std::vector<GeometryItem>& items,
              const std::vector<GeometryPlace>& places, const std::function<void()>& settle);

  uint32_t chunkCount() const { return chunkCount_; }
  // shared::DrawnAnchor, and shared::AnchorChunk.
  VkBuffer anchors() const { return anchors_.handle(); }
  VkBuffer chunks() const { return chunks_.handle(); }

 private:
  struct Spread {
    double area = 0;          // in mesh space
    uint32_t candidates = 0;  // that the anchors were chosen from
    std::vector<scene::SurfaceAnchor> anchors;
  };
  std::map<const scene::Primitive*, Spread> spreads_;
  struct Known {
    const scene::Primitive* primitive;
    uint32_t firstVertex, anchors;
    bool shown;
    bool operator==(const Known&) const = default;
  };
  std::vector<Known> known_;
  uint32_t chunkCount_ = 0;
  gpu::Buffer anchors_, chunks_;
};

class WatercolorMoment : public FeatureMoment {
 public:
  explicit WatercolorMoment(gpu::Device& device) : device_(device) {}
  bool follow(const scene::SceneData&, const FeaturePlan&) override { return true; }
  void find(const std::vector<GeometryItem>& items) override { anchors_.find(items); }
  bool place(gpu::Uploader& uploader, const std::vector<GeometryItem>& items,
             const std::vector<GeometryPlace>& places, const std::function<void()>& settle) override {
    return anchors_.update(device_, uploader, items, places, settle);
  }
  // Anchors follow from final vertices.
  void pose(const look::LookData&, const stage::KnobTable&, double, const FeatureMoment*) override {}

  const AnchorsOnGpu& anchors() const { return anchors_; }

 private:
  gpu::Device& device_;
  AnchorsOnGpu anchors_;
};

}  // namespace scumble::watercolor
