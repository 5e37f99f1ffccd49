#include "world/transparent_triangles.h"

#include <algorithm>
#include <limits>

namespace scumble::world {

void TransparentTriangles::update(gpu::Device& device, std::vector<Part> parts,
                                  const std::function<void()>& settle) {
  if (parts == parts_ && sorted_.handle()) return;
  settle();
  parts_ = std::move(parts);
  triangles_.clear();
  indices_.clear();
  objects_.clear();
  for (const Part& part : parts_) add(part);
  sorted_ = gpu::PerFrameBuffer(device, std::max<size_t>(1, indices_.size()) * sizeof(uint32_t),
                                VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
}

void TransparentTriangles::add(const Part& part) {
  const auto& [source, object, isSkinned] = part;
  const scene::Primitive& primitive = *source;
  const uint32_t first = uint32_t(triangles_.size()), count = uint32_t(primitive.indices.size() / 3);
  indices_.insert(indices_.end(), primitive.indices.begin(), primitive.indices.begin() + count * 3);
  for (uint32_t t = 0; t < count; ++t) {
    const uint32_t* v = &primitive.indices[3 * t];
    Triangle triangle{
        (primitive.positions[v[0]] + primitive.positions[v[1]] + primitive.positions[v[2]]) / 3.0f, 0};
    if (isSkinned) {
      const size_t influences = size_t(primitive.influences), start = v[0] * influences;
      const auto weights = primitive.weights.begin() + long(start);
      const auto most = std::max_element(weights, weights + long(influences));
      triangle.joint = primitive.joints[start + size_t(most - weights)];
    }
    triangles_.push_back(triangle);
  }
  objects_[object] = {first, count, isSkinned};
}

void TransparentTriangles::sort(uint32_t object, const SceneMotion& motion, const Viewers& viewers) {
  const auto& [first, count, isSkinned] = objects_.at(object);
  const glm::mat4& model = motion.model(object);
  const glm::mat4* joints = isSkinned ? motion.joints(object) : nullptr;

  order_.resize(count);
  for (uint32_t t = 0; t < count; ++t) {
    const Triangle& triangle = triangles_[first + t];
    const glm::vec3 from =
        glm::vec3((joints ? joints[triangle.joint] : model) * glm::vec4(triangle.centroid, 1.0f)) -
        viewers.middle;
    const float distance = viewers.isParallel ? glm::dot(from, viewers.ahead) : glm::dot(from, from);
    // What is not finite has no order; it is drawn last.
    order_[t] = {std::isfinite(distance) ? -distance : std::numeric_limits<float>::infinity(), t};
  }
  std::sort(order_.begin(), order_.end());
  uint32_t* out = sorted_.as<uint32_t>() + 3 * first;
  for (const auto& [distance, t] : order_) out = std::copy_n(&indices_[3 * (first + t)], 3, out);
}

}  // namespace scumble::world
