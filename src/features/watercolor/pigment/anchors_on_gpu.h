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
  // Spreads anchors over primitives while their vertices are there, as densely over each mesh as its own size
  // asks for; those that have as many as they should keep them.
  void find(const scene::SceneData& scene, const std::vector<GeometryItem>& items);
  // True where the buffers have other names.
  bool update(gpu::Device& device, gpu::Uploader& uploader, const std::vector<GeometryItem>& items,
              const std::vector<GeometryPlace>& places, const std::function<void()>& settle);

  // What is painted, in the order of PaintedObject in their buffer.
  struct Painted {
    uint32_t object, material;
    const std::vector<scene::SurfaceAnchor>* anchors;  // the widest spacing first; until the next update()
  };
  const std::vector<Painted>& painted() const { return painted_; }
  // shared::DrawnAnchor, and shared::PaintedObject.
  VkBuffer anchors() const { return anchors_.handle(); }
  VkBuffer objects() const { return objects_.handle(); }

 private:
  struct Spread {
    double area = 0;          // in mesh space
    bool isClosed = false;    // known of double-sided ones alone
    uint32_t candidates = 0;  // that the anchors were chosen from
    std::vector<scene::SurfaceAnchor> anchors;
  };
  std::map<const scene::Primitive*, Spread> spreads_;
  std::vector<uint32_t> seeds_;  // by item
  std::vector<bool> isSided_;    // by item
  struct Known {
    const scene::Primitive* primitive;
    uint32_t firstVertex, anchors, seed, material;
    bool shown, isSided;
    bool operator==(const Known&) const = default;
  };
  std::vector<Known> known_;
  std::vector<Painted> painted_;
  gpu::Buffer anchors_, objects_;
};

class WatercolorMoment : public FeatureMoment {
 public:
  WatercolorMoment(gpu::Device& device, const scene::SceneData& scene) : device_(device), scene_(&scene) {}
  bool follow(const scene::SceneData& scene, const FeaturePlan&) override {
    scene_ = &scene;
    return true;
  }
  void find(const std::vector<GeometryItem>& items) override { anchors_.find(*scene_, items); }
  bool place(gpu::Uploader& uploader, const std::vector<GeometryItem>& items,
             const std::vector<GeometryPlace>& places, const std::function<void()>& settle) override {
    return anchors_.update(device_, uploader, items, places, settle);
  }
  // Anchors follow from final vertices.
  void pose(const look::LookData&, const stage::KnobTable&, double, const FeatureMoment*) override {}

  const AnchorsOnGpu& anchors() const { return anchors_; }

 private:
  gpu::Device& device_;
  const scene::SceneData* scene_ = nullptr;
  AnchorsOnGpu anchors_;
};

}  // namespace scumble::watercolor
