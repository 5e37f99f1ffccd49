// The third part of prepare_mesh.h: what morph targets displace besides positions.
#include <algorithm>
#include <cmath>

#include "scene/position_weld.h"
#include "scene/prepare_mesh.h"

namespace scumble::scene {

namespace {

glm::vec3 unitOr(const glm::vec3& v, const glm::vec3& instead) {
  const float length = glm::length(v);
  return length > 1e-12f && std::isfinite(length) ? v / length : instead;
}

// Flat faces turn with their corners (glTF 2.0, section 3.7.2.2: computed normals follow the targets).
std::vector<glm::vec3> flatNormals(const Primitive& p, const Primitive& morphed) {
  std::vector<glm::vec3> change(p.vertexCount(), glm::vec3(0.0f));
  for (size_t i = 0; i + 2 < p.indices.size(); i += 3) {
    const uint32_t a = p.indices[i], b = p.indices[i + 1], c = p.indices[i + 2];
    const glm::vec3 normal =
        glm::cross(morphed.positions[b] - morphed.positions[a], morphed.positions[c] - morphed.positions[b]);
    for (const uint32_t v : {a, b, c}) change[v] = unitOr(normal, p.normals[v]) - p.normals[v];
  }
  return change;
}

// The smooth normal of a place turns as the mean of the normals there does.
std::vector<glm::vec3> smoothChange(const Primitive& p, const std::vector<glm::vec3>& normals,
                                    const std::vector<uint32_t>& first) {
  std::vector<glm::vec3> before(p.vertexCount(), glm::vec3(0.0f)), after = before;
  for (size_t v = 0; v < p.vertexCount(); ++v) {
    before[first[v]] += p.normals[v];
    after[first[v]] += p.normals[v] + normals[v];
  }
  std::vector<glm::vec3> change(p.vertexCount());
  for (size_t v = 0; v < p.vertexCount(); ++v) {
    const glm::vec3 rest = unitOr(before[first[v]], p.smoothNormals[v]);
    change[v] = unitOr(p.smoothNormals[v] + unitOr(after[first[v]], rest) - rest, p.smoothNormals[v]) -
                p.smoothNormals[v];
  }
  return change;
}

std::vector<uint32_t> firstAtPosition(const Primitive& p) {
  const PositionGrid grid(1.0f /
                          std::max(glm::length(boxOf(p.positions).max - boxOf(p.positions).min), 1e-30f));
  return firstAtPlaces(p.positions, grid);
}

}  // namespace

void finishMorphTargets(Primitive& p, const std::function<void(Primitive&)>& makeTangents) {
  if (p.morphTargets.empty()) return;
  const std::vector<uint32_t> first = firstAtPosition(p);
  std::vector<MorphTarget> targets = std::move(p.morphTargets);
  p.morphTargets.clear();
  for (MorphTarget& target : targets) {
    if (!target.positions.empty()) {
      Primitive morphed = p;
      for (size_t v = 0; v < p.vertexCount(); ++v) morphed.positions[v] += target.positions[v];
      if (p.generatedNormals) target.normals = flatNormals(p, morphed);
      makeTangents(morphed);
      target.dPdu = std::move(morphed.dPdu), target.dPdv = std::move(morphed.dPdv);
      for (size_t v = 0; v < p.vertexCount(); ++v) target.dPdu[v] -= p.dPdu[v], target.dPdv[v] -= p.dPdv[v];
    }
    if (!target.normals.empty()) target.smoothNormals = smoothChange(p, target.normals, first);
  }
  p.morphTargets = std::move(targets);
}

}  // namespace scumble::scene
