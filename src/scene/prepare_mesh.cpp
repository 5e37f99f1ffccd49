#include "scene/prepare_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "scene/position_weld.h"

namespace scumble::scene {

namespace {

// Abramowitz and Stegun 4.4.45, within 7e-5: the angles are only weights.
float fastAcos(float x) {
  const float a = std::min(std::abs(x), 1.0f);
  const float r = std::sqrt(1.0f - a) * (1.5707288f + a * (-0.2121144f + a * (0.0742610f - a * 0.0187293f)));
  return x < 0.0f ? glm::pi<float>() - r : r;
}

// Triangles thinner than this, measured where the mesh is of size one, have no direction that means anything.
constexpr float kMinCrossSquared = 1e-30f;

template <class T>
void gather(std::vector<T>& values, const std::vector<uint32_t>& source, size_t perVertex = 1) {
  if (values.empty()) return;
  std::vector<T> kept(source.size() * perVertex);
  for (size_t i = 0; i < source.size(); ++i)
    for (size_t k = 0; k < perVertex; ++k) kept[i * perVertex + k] = values[source[i] * perVertex + k];
  values = std::move(kept);
}

void dropUnusedVertices(Primitive& p) {
  constexpr uint32_t kUnused = 0xffffffffu;
  std::vector<uint32_t> target(p.vertexCount(), kUnused), source;
  for (uint32_t& index : p.indices) {
    if (target[index] == kUnused) {
      target[index] = static_cast<uint32_t>(source.size());
      source.push_back(index);
    }
    index = target[index];
  }
  gatherVertices(p, source);
}

// Removes the triangles that touch a vertex outside of the drawable range.
size_t dropUndrawable(Primitive& p) {
  std::vector<uint8_t> bad(p.vertexCount(), 0);
  bool any = false;
  for (size_t i = 0; i < p.vertexCount(); ++i)
    if (!isDrawable(p.positions[i])) bad[i] = 1, any = true;
  if (!any) return 0;
  size_t out = 0;
  for (size_t i = 0; i + 2 < p.indices.size(); i += 3) {
    if (bad[p.indices[i]] || bad[p.indices[i + 1]] || bad[p.indices[i + 2]]) continue;
    for (size_t k = 0; k < 3; ++k) p.indices[out++] = p.indices[i + k];
  }
  const size_t dropped = (p.indices.size() - out) / 3;
  p.indices.resize(out);
  dropUnusedVertices(p);
  return dropped;
}

float inverseExtent(const std::vector<glm::vec3>& positions) {
  const Bounds box = boxOf(positions);
  const glm::vec3 size = box.max - box.min;
  const float extent = std::max({size.x, size.y, size.z});
  return extent > 1e-30f ? 1.0f / extent : 0.0f;
}

// representatives[v]: the first vertex at v's position. Empty when all positions differ.
std::vector<uint32_t> findRepresentatives(const std::vector<glm::vec3>& positions) {
  std::vector<uint32_t> representatives = firstAtPlaces(positions, PositionGrid(inverseExtent(positions)));
  bool anyShared = false;
  for (uint32_t i = 0; i < positions.size(); ++i) anyShared |= representatives[i] != i;
  if (!anyShared) representatives.clear();
  return representatives;
}

// Adds every face's normal to the sums at its corners, and drops triangles without area.
size_t sumFaces(Primitive& p, const std::vector<uint32_t>& representatives) {
  const float scale = inverseExtent(p.positions);
  p.smoothNormals.assign(p.vertexCount(), glm::vec3(0.0f));
  size_t out = 0;
  for (size_t i = 0; i + 2 < p.indices.size(); i += 3) {
    const uint32_t a = p.indices[i], b = p.indices[i + 1], c = p.indices[i + 2];
    const glm::vec3 ab = (p.positions[b] - p.positions[a]) * scale,
                    bc = (p.positions[c] - p.positions[b]) * scale,
                    ca = (p.positions[a] - p.positions[c]) * scale;
    const glm::vec3 cross = glm::cross(ab, bc);
    const float crossSquared = glm::dot(cross, cross);
    const float abab = glm::dot(ab, ab), bcbc = glm::dot(bc, bc), caca = glm::dot(ca, ca);
    if (!(crossSquared > kMinCrossSquared)) continue;
    const glm::vec3 normal = cross / std::sqrt(crossSquared);
    const float angleA = fastAcos(-glm::dot(ab, ca) / std::sqrt(abab * caca));
    const float angleB = fastAcos(-glm::dot(ab, bc) / std::sqrt(abab * bcbc));
    const float angleC = std::max(0.0f, glm::pi<float>() - angleA - angleB);
    const bool welded = !representatives.empty();
    p.smoothNormals[welded ? representatives[a] : a] += normal * angleA;
    p.smoothNormals[welded ? representatives[b] : b] += normal * angleB;
    p.smoothNormals[welded ? representatives[c] : c] += normal * angleC;
    p.indices[out] = a;
    p.indices[out + 1] = b;
    p.indices[out + 2] = c;
    out += 3;
  }
  const size_t dropped = (p.indices.size() - out) / 3;
  p.indices.resize(out);
  return dropped;
}

// Normals of unit length; those that have none get the sum of the faces around them. Returns how many.
size_t mendNormals(Primitive& p, const std::vector<uint32_t>& representatives) {
  size_t mended = 0;
  for (size_t i = 0; i < p.vertexCount(); ++i) {
    glm::vec3& normal = p.normals[i];
    float squared = glm::dot(normal, normal);
    if (std::abs(squared - 1.0f) < 1e-5f) continue;
    if (!(squared > 1e-12f && squared < 1e12f)) {
      ++mended;
      normal = p.smoothNormals[representatives.empty() ? i : representatives[i]];
      squared = glm::dot(normal, normal);
      if (!(squared > 1e-12f)) {
        normal = glm::vec3(0.0f, 1.0f, 0.0f);
        continue;
      }
    }
    normal /= std::sqrt(squared);
  }
  return mended;
}

// glTF: without normals, faces are flat. Every corner becomes a vertex of its own.
void makeFlat(Primitive& p) {
  const std::vector<uint32_t> source = p.indices;
  gatherVertices(p, source);
  const float scale = inverseExtent(p.positions);
  p.normals.resize(source.size());
  for (uint32_t i = 0; i + 2 < source.size(); i += 3) {
    const glm::vec3 ab = (p.positions[i + 1] - p.positions[i]) * scale,
                    bc = (p.positions[i + 2] - p.positions[i + 1]) * scale;
    const glm::vec3 cross = glm::cross(ab, bc);
    const float squared = glm::dot(cross, cross);
    const glm::vec3 normal = squared > 0.0f ? cross / std::sqrt(squared) : glm::vec3(0.0f, 1.0f, 0.0f);
    for (uint32_t k = 0; k < 3; ++k) {
      p.normals[i + k] = normal;
      p.indices[i + k] = i + k;
    }
  }
  p.generatedNormals = true;
}

// A mapping that closes on itself has vertices at one place whose coordinates differ by whole numbers. Where
// other seams prevail it is an atlas, and such pairs are chance.
void findWraps(Primitive& p, const std::vector<uint32_t>& representatives) {
  if (p.uv0.empty() || representatives.empty()) return;
  const auto isWhole = [](float d) { return std::abs(d - std::round(d)) < 1e-4f; };
  std::vector<uint32_t> met(p.vertexCount(), 0);
  for (const uint32_t first : representatives) ++met[first];
  size_t seams = 0, wraps[2] = {};
  for (size_t i = 0; i < p.vertexCount(); ++i) {
    const glm::vec2 d = p.uv0[i] - p.uv0[representatives[i]];
    // Where many meet there is a pole, which tells nothing.
    if (std::max(std::abs(d.x), std::abs(d.y)) < 1e-4f || met[representatives[i]] > 8) continue;
    ++seams;
    if (!isWhole(d.x) || !isWhole(d.y)) continue;
    for (int axis = 0; axis < 2; ++axis) wraps[axis] += std::abs(d[axis]) > 0.5f;
  }
  p.wrapsU = wraps[0] > 0 && 4 * wraps[0] >= seams;
  p.wrapsV = wraps[1] > 0 && 4 * wraps[1] >= seams;
}

}  // namespace

bool isDrawable(const glm::vec3& p) {
  // Written so that NaN fails.
  return std::abs(p.x) <= kMaxCoordinate && std::abs(p.y) <= kMaxCoordinate &&
         std::abs(p.z) <= kMaxCoordinate;
}

bool isDrawable(const glm::dmat4& m) {
  for (int i = 0; i < 16; ++i)
    if (!(std::abs(m[i / 4][i % 4]) <= double(kMaxCoordinate))) return false;
  return true;
}

void gatherVertices(Primitive& p, const std::vector<uint32_t>& source) {
  gather(p.positions, source);
  gather(p.normals, source);
  gather(p.smoothNormals, source);
  gather(p.uv0, source);
  gather(p.patternUv, source);
  gather(p.uv1, source);
  gather(p.colors, source);
  gather(p.warpScales, source);
  gather(p.roundness, source);
  gather(p.dPdu, source);
  gather(p.dPdv, source);
  gather(p.joints, source, static_cast<size_t>(p.influences));
  gather(p.weights, source, static_cast<size_t>(p.influences));
  for (MorphTarget& target : p.morphTargets) {
    for (auto list : {&MorphTarget::positions, &MorphTarget::normals, &MorphTarget::smoothNormals,
                      &MorphTarget::dPdu, &MorphTarget::dPdv})
      gather(target.*list, source);
  }
}

void cleanPrimitive(Primitive& p, const std::string& path, ImportWarnings& warnings) {
  if (dropUndrawable(p) > 0)
    warnings.add(path, "triangles with positions that are not finite or absurdly far away are left out");

  const std::vector<uint32_t> representatives = findRepresentatives(p.positions);
  findWraps(p, representatives);
  const size_t degenerate = sumFaces(p, representatives);
  if (p.indices.empty()) {
    p = Primitive{.material = p.material};
    return;
  }
  if (!p.normals.empty() && mendNormals(p, representatives) > 0)
    warnings.add(path, "normals that are zero or not finite are replaced");

  // Where the faces around a position cancel out (both sides of a sheet), any direction is as good: that of
  // the first vertex. It is short, so that it yields to other primitives at the same place.
  for (size_t i = 0; i < p.vertexCount(); ++i) {
    const size_t first = representatives.empty() ? i : representatives[i];
    glm::vec3& sum = p.smoothNormals[first];
    if (glm::dot(sum, sum) < 1e-8f) sum = 1e-3f * (p.normals.empty() ? glm::vec3(0, 1, 0) : p.normals[first]);
    p.smoothNormals[i] = sum;
  }
  if (p.normals.empty())
    makeFlat(p);
  else if (degenerate > 0)
    dropUnusedVertices(p);
}

void weldSmoothNormals(Mesh& mesh) {
  if (mesh.primitives.size() < 2) return;
  size_t count = 0;
  for (const Primitive& p : mesh.primitives) count += p.vertexCount();
  const PositionGrid grid(0.5f / std::max(boundingRadius(mesh), 1e-30f));

  // One entry a position; a primitive's sum is the same at all its vertices there, and counts once.
  struct Entry {
    glm::vec3 position, sum;
    size_t lastPrimitive;
  };
  std::vector<Entry> entries;
  entries.reserve(count);
  PositionTable table(count);
  const auto positionOf = [&](uint32_t i) { return entries[i].position; };
  std::vector<uint32_t> entryOf;
  entryOf.reserve(count);
  for (size_t k = 0; k < mesh.primitives.size(); ++k) {
    const Primitive& p = mesh.primitives[k];
    if (p.isPaint) continue;  // what it lies on stays as it is
    for (size_t i = 0; i < p.vertexCount(); ++i) {
      const uint32_t fresh = static_cast<uint32_t>(entries.size());
      const glm::vec3 position = grid(p.positions[i]);
      const uint32_t found = table.findOrAdd(position, fresh, positionOf);
      if (found == fresh) {
        entries.push_back({position, p.smoothNormals[i], k});
      } else if (entries[found].lastPrimitive != k) {
        entries[found].lastPrimitive = k;
        const glm::vec3 sum = entries[found].sum + p.smoothNormals[i];
        if (glm::dot(sum, sum) > 1e-8f) entries[found].sum = sum;
      }
      entryOf.push_back(found);
    }
  }
  size_t at = 0;
  for (Primitive& p : mesh.primitives)
    if (!p.isPaint)
      for (glm::vec3& sum : p.smoothNormals) sum = entries[entryOf[at++]].sum;
}

Bounds boxOf(const std::vector<glm::vec3>& points) {
  Bounds box;
  if (points.empty()) return box;
  box.min = box.max = points[0];
  box.empty = false;
  for (const glm::vec3& p : points) {
    box.min = glm::min(box.min, p);
    box.max = glm::max(box.max, p);
  }
  return box;
}

float boundingRadius(const Mesh& mesh) {
  Bounds bounds;
  for (const Primitive& p : mesh.primitives) {
    const Bounds box = boxOf(p.positions);
    if (box.empty) continue;
    bounds.add(box.min);
    bounds.add(box.max);
  }
  return bounds.radius();
}

}  // namespace scumble::scene
