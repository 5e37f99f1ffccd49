#include "world/tessellate.h"

#include <algorithm>
#include <unordered_map>

namespace scumble::world {

namespace {

class Splitter {
 public:
  Splitter(const scene::Primitive& primitive, float maxEdge)
      : out_(primitive), maxEdge2_(maxEdge * maxEdge) {}

  // One round: every edge that is too long gets a vertex in its middle. False when there was none.
  bool split() {
    std::vector<uint32_t> result;
    result.reserve(out_.indices.size());
    middles_.clear();
    for (size_t i = 0; i < out_.indices.size(); i += 3) {
      const uint32_t v[3] = {out_.indices[i], out_.indices[i + 1], out_.indices[i + 2]};
      uint32_t m[3];
      int count = 0;
      for (int k = 0; k < 3; ++k) count += (m[k] = middle(v[k], v[(k + 1) % 3])) != kNone;
      const auto emit = [&](uint32_t a, uint32_t b, uint32_t c) { result.insert(result.end(), {a, b, c}); };
      if (count == 0) {
        emit(v[0], v[1], v[2]);
      } else if (count == 3) {
        emit(v[0], m[0], m[2]), emit(m[0], v[1], m[1]), emit(m[2], m[1], v[2]), emit(m[0], m[1], m[2]);
      } else {
        // Turn the triangle until the first edge is split (and, of two, the second).
        int k = 0;
        while (m[k] == kNone || (count == 2 && m[(k + 1) % 3] == kNone)) ++k;
        const uint32_t a = v[k], b = v[(k + 1) % 3], c = v[(k + 2) % 3], ab = m[k], bc = m[(k + 1) % 3];
        if (count == 1)
          emit(a, ab, c), emit(ab, b, c);
        else
          emit(a, ab, c), emit(ab, bc, c), emit(ab, b, bc);
      }
    }
    const bool changed = result.size() != out_.indices.size();
    out_.indices = std::move(result);
    return changed;
  }

  scene::Primitive take() {
    out_.levels.clear(), out_.levelIndices.clear();  // their triangles are as long
    return std::move(out_);
  }
  size_t triangles() const { return out_.indices.size() / 3; }

 private:
  static constexpr uint32_t kNone = ~0u;

  uint32_t middle(uint32_t a, uint32_t b) {
    if (a > b) std::swap(a, b);
    const glm::vec3 edge = out_.positions[b] - out_.positions[a];
    if (glm::dot(edge, edge) <= maxEdge2_) return kNone;
    const auto [it, isNew] = middles_.try_emplace(uint64_t(a) << 32 | b, uint32_t(out_.positions.size()));
    if (isNew) {
      const auto mean = [&](auto& array) {
        if (!array.empty()) array.push_back(0.5f * (array[a] + array[b]));
      };
      const auto meanDirection = [&](std::vector<glm::vec3>& array) {
        if (array.empty()) return;
        const glm::vec3 sum = array[a] + array[b];
        const float length = glm::length(sum);
        array.push_back(length > 1e-6f ? sum / length : array[a]);
      };
      mean(out_.positions), mean(out_.uv0), mean(out_.uv1), mean(out_.patternUv), mean(out_.warpScales),
          mean(out_.roundness), mean(out_.outlineWidths), mean(out_.dPdu), mean(out_.dPdv);
      meanDirection(out_.normals), meanDirection(out_.smoothNormals);
      if (!out_.colors.empty())
        out_.colors.push_back(
            glm::u8vec4((glm::uvec4(out_.colors[a]) + glm::uvec4(out_.colors[b]) + 1u) / 2u));
    }
    return it->second;
  }

  scene::Primitive out_;
  float maxEdge2_;
  std::unordered_map<uint64_t, uint32_t> middles_;
};

}  // namespace

std::optional<scene::Primitive> tessellate(const scene::Primitive& primitive, float maxEdge,
                                           size_t maxNewTriangles) {
  if (primitive.influences > 0 || !primitive.morphTargets.empty()) return std::nullopt;
  if (!(primitive.extent.longestEdge2 > maxEdge * maxEdge)) return std::nullopt;

  Splitter splitter(primitive, maxEdge);
  const size_t most = primitive.indices.size() / 3 + maxNewTriangles;
  // A round can at most quadruple the triangles.
  while (splitter.triangles() * 4 <= most && splitter.split()) {
  }
  return splitter.take();
}

}  // namespace scumble::world
