// The triangles of blended surfaces, in the order in which they are to be composited: the farthest first. One
// order serves both eyes.
#pragma once

#include <map>

#include "frame/scene_motion.h"
#include "frame/viewers.h"

namespace scumble::frame {

class TransparentTriangles {
 public:
  // Before create(). `object`: whose matrix, or whose joints, place the primitive. Returns the index at which
  // its triangles begin in indices().
  uint32_t add(const scene::Primitive& primitive, uint32_t object, bool isSkinned);
  void create(gpu::Device& device);

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
  std::vector<Triangle> triangles_;
  std::vector<uint32_t> indices_;  // as the primitives have them
  std::map<uint32_t, Range> objects_;
  std::vector<std::pair<float, uint32_t>> order_;
  gpu::PerFrameBuffer sorted_;
};

}  // namespace scumble::frame
