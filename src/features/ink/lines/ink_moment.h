// What ink keeps of a scene.
#pragma once

#include "features/ink/lines/edges_on_gpu.h"
#include "world/feature.h"

namespace scumble::ink {

class InkMoment : public world::FeatureMoment {
 public:
  explicit InkMoment(gpu::Device& device) : device_(device) {}
  bool follow(const scene::SceneData&, const world::FeaturePlan&) override { return true; }
  void find(const std::vector<GeometryItem>& items) override { edges_.find(items); }
  bool place(gpu::Uploader& uploader, const std::vector<GeometryItem>& items,
             const std::vector<GeometryPlace>& places, const std::function<void()>& settle) override {
    return edges_.update(device_, uploader, items, places, settle);
  }
  // Lines follow from final vertices.
  void pose(const look::LookData&, const stage::KnobTable&, double, const world::FeatureMoment*) override {}

  const EdgesOnGpu& edges() const { return edges_; }

 private:
  gpu::Device& device_;
  EdgesOnGpu edges_;
};

}  // namespace scumble::ink
