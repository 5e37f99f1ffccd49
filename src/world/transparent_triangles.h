// The triangles of blended surfaces, in the order in which they are to be composited: the farthest first. One
// order serves both eyes.
#pragma once

#include <functional>
#include <map>

#include "stage/viewers.h"
#include "world/scene_motion.h"

namespace scumble::world {

using namespace stage;

class TransparentTriangles {
 public:
  // `object`: whose matrix, or whose joints, place the primitive.
  struct Part {
    const scene::Primitive* primitive;
    uint32_t object;
    bool isSkinned;
    bool operator==(const Part&) const = default;
  };
  // All that there is. Primitives that are the same objects as before have the same triangles; where there
  // are others, `settle` is called before indices() go that frames under way may read.
  void update(gpu::Device& device, std::vector<Part> parts, const std::function<void()>& settle);

  // At which an object's triangles begin in indices().
  uint32_t firstIndex(uint32_t object) const { return 3 * objects_.at(object).first; }

  // Sorts the triangles of an object by their centroids. Morph targets do not move the centroids, and a
  // skinned one goes with the joint that pulls it most.
  void sort(uint32_t object, const SceneMotion& motion, const Viewers& viewers);

  VkBuffer indices() const { return sorted_.handle(); }
  void addUploads(std::vector<gpu::PerFrameBuffer*>& uploads) {
    if (!objects_.empty()) uploads.push_back(&sorted_);
  }

 private:
  struct Triangle {
    glm::vec3 centroid;  // at rest, in the object's space
    uint32_t joint;
  };
  struct Range {
    uint32_t first, count;  // triangles
    bool isSkinned;
  };
  void add(const Part& part);

  std::vector<Part> parts_;
  std::vector<Triangle> triangles_;
  std::vector<uint32_t> indices_;  // as the primitives have them
  std::map<uint32_t, Range> objects_;
  std::vector<std::pair<float, uint32_t>> order_;
  gpu::PerFrameBuffer sorted_;
};

}  // namespace scumble::world
