// The strokes of all paintings of a scene, in device memory, with all places where splats may lie.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "features/painting/bindings.h"
#include "features/painting/painting.shared.h"
#include "frame/pass.h"
#include "gpu/resources.h"
#include "scene/painting.h"
#include "world/feature.h"
#include "world/geometry_on_gpu.h"

namespace scumble::painting {

using namespace world;

// A painting at one of its places.
struct DrawnPainting {
  size_t node = 0, instance = 0;
  glm::mat4 toNode{1.0f};
  std::shared_ptr<const scene::Painting> painting;
  bool operator==(const DrawnPainting&) const = default;
};

// All that are shown.
std::vector<DrawnPainting> paintingsOf(const scene::SceneData& scene);

class StrokesOnGpu {
 public:
  StrokesOnGpu(const scene::SceneData& scene, std::vector<DrawnPainting> paintings);
  const std::vector<DrawnPainting>& paintings() const { return paintings_; }

  // Hangs strokes on the meshes of their own nodes, while their vertices are there.
  void find(const std::vector<GeometryItem>& items);
  // True where the buffers are others.
  bool update(gpu::Device& device, gpu::Uploader& uploader, const std::vector<GeometryItem>& items,
              const std::vector<GeometryPlace>& places, const std::function<void()>& settle);

  uint32_t pointCount() const { return pointCount_; }
  uint32_t splatCount() const { return splatCount_; }
  // shared::StrokePoint, and shared::Splat.
  VkBuffer points() const { return points_.handle(); }
  VkBuffer splats() const { return splats_.handle(); }
  // Room for a shared::PlacedPoint of each point.
  VkBuffer placed() const { return placed_.handle(); }
  // Boxes that the strokes stay within at any time, world, as far as is known before.
  const std::vector<scene::Bounds>& reach() const { return reach_; }

 private:
  // What carries a painting's points: by painting, the items of its node and instance that have triangles.
  std::vector<std::vector<size_t>> carriers(const std::vector<GeometryItem>& items) const;

  using Carrier = std::vector<const scene::Primitive*>;
  std::vector<DrawnPainting> paintings_;
  std::map<std::pair<const scene::Painting*, Carrier>, std::vector<PointBinding>> bindings_;
  std::vector<std::pair<const scene::Primitive*, uint32_t>> known_;  // by item: where its vertices are
  uint32_t pointCount_ = 0, splatCount_ = 0;
  gpu::Buffer points_, splats_, placed_;
  std::vector<scene::Bounds> reach_, reachAlone_;  // by painting; of those that no mesh carries, else empty
};

// Strokes of the frame's scene; null where it has none any more: passes that draw them are about to go then.
const StrokesOnGpu* strokesOf(const frame::FrameBuilder& frame);

class PaintingMoment : public FeatureMoment {
 public:
  PaintingMoment(gpu::Device& device, const scene::SceneData& scene, std::vector<DrawnPainting> paintings)
      : device_(device), strokes_(scene, std::move(paintings)) {}
  bool follow(const scene::SceneData&, const FeaturePlan& plan) override;
  void find(const std::vector<GeometryItem>& items) override { strokes_.find(items); }
  bool place(gpu::Uploader& uploader, const std::vector<GeometryItem>& items,
             const std::vector<GeometryPlace>& places, const std::function<void()>& settle) override {
    return strokes_.update(device_, uploader, items, places, settle);
  }
  // Strokes follow from final vertices, and from where nodes are.
  void pose(const look::LookData&, const stage::KnobTable&, double, const FeatureMoment*) override {}

  void addCasters(std::vector<scene::Bounds>& boxes) const override {
    boxes.insert(boxes.end(), strokes_.reach().begin(), strokes_.reach().end());
  }

  const StrokesOnGpu& strokes() const { return strokes_; }

 private:
  gpu::Device& device_;
  StrokesOnGpu strokes_;
};

struct PaintingPlan : public FeaturePlan {
  explicit PaintingPlan(std::vector<DrawnPainting> all) : paintings(std::move(all)) {}
  bool equals(const FeaturePlan& other) const override {
    return paintings == static_cast<const PaintingPlan&>(other).paintings;
  }
  std::unique_ptr<FeatureMoment> makeMoment(gpu::Device& device,
                                            const scene::SceneData& scene) const override {
    return std::make_unique<PaintingMoment>(device, scene, paintings);
  }
  std::vector<DrawnPainting> paintings;
};

inline bool PaintingMoment::follow(const scene::SceneData&, const FeaturePlan& plan) {
  return strokes_.paintings() == static_cast<const PaintingPlan&>(plan).paintings;
}

}  // namespace scumble::painting
