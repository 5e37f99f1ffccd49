// What ink keeps of a scene.
#pragma once

#include "features/ink/lines/edges_on_gpu.h"
#include "features/ink/parts/parts_on_gpu.h"
#include "world/feature.h"

namespace scumble::ink {

// The edges of all that is drawn, whatever lines are shown; and which pieces it is of, for some of them.
struct InkPlan : world::FeaturePlan {
  explicit InkPlan(bool withParts) : needsParts(withParts) {}
  bool equals(const world::FeaturePlan& other) const override {
    return static_cast<const InkPlan&>(other).needsParts == needsParts;
  }
  std::unique_ptr<world::FeatureMoment> makeMoment(gpu::Device& device,
                                                   const scene::SceneData&) const override;
  const bool needsParts;
};

class InkMoment : public world::FeatureMoment {
 public:
  InkMoment(gpu::Device& device, const scene::SceneData& scene, bool hasParts)
      : device_(device), scene_(&scene), hasParts_(hasParts) {}
  bool follow(const scene::SceneData& scene, const world::FeaturePlan& plan) override {
    scene_ = &scene;
    return static_cast<const InkPlan&>(plan).needsParts == hasParts_;
  }
  void find(const std::vector<GeometryItem>& items) override {
    edges_.find(*scene_, items);
    if (hasParts_) parts_.find(items);
  }
  bool place(gpu::Uploader& uploader, const std::vector<GeometryItem>& items,
             const std::vector<GeometryPlace>& places, const std::function<void()>& settle) override {
    const bool hasOtherParts = hasParts_ && parts_.update(device_, uploader, items, places, settle);
    return edges_.update(device_, uploader, items, places, settle) || hasOtherParts;
  }
  // Lines follow from final vertices.
  void pose(const look::LookData&, const stage::KnobTable&, double, const world::FeatureMoment*) override {}

  const EdgesOnGpu& edges() const { return edges_; }
  const PartsOnGpu& parts() const { return parts_; }  // empty where the look needs none

 private:
  gpu::Device& device_;
  const scene::SceneData* scene_;
  bool hasParts_;
  EdgesOnGpu edges_;
  PartsOnGpu parts_;
};

}  // namespace scumble::ink
