// The second half of prepare_mesh.h: texture coordinates and their tangent vectors.
#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>

#include "scene/mapping_faults.h"
#include "scene/posed_bounds.h"
#include "scene/position_weld.h"
#include "scene/prepare_mesh.h"
#include "scene/unfolding.h"

namespace scumble::scene {

namespace {

// Mappings by themselves: one seam around a ball is 0.89, and one along each limb is usual. What is denser or
// coarser in all of a mesh's half is as bad as twice that.
constexpr float kUsualCost = 1, kUnevenCost = 4;
constexpr float kWorthLeaving = 0.75f;  // of the file's cost: less is no reason to leave it

bool isFinite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// One triangle's mapping. With e1 = du1 P_u + dv1 P_v and e2 = du2 P_u + dv2 P_v, Cramer's rule gives
// P_u = (dv2 e1 - dv1 e2) / det and P_v = (du1 e2 - du2 e1) / det.
struct Mapping {
  glm::vec3 dPdu, dPdv;
  float area = 0.0f;  // 0: no usable mapping
  bool mirrored = false;
};

// `scale` brings the mesh to size one, so that areas neither overflow nor vanish.
Mapping mappingOf(const Primitive& p, size_t i, float scale) {
  const uint32_t a = p.indices[i], b = p.indices[i + 1], c = p.indices[i + 2];
  const std::vector<glm::vec2>& uv = p.patternCoordinates();
  const glm::vec2 d1 = uv[b] - uv[a], d2 = uv[c] - uv[a];
  const float det = d1.x * d2.y - d1.y * d2.x;
  Mapping mapping;
  // A triangle whose corners lie on a line in uv says nothing about one direction, and huge things by
  // rounding.
  if (!(std::abs(det) > 1e-6f * (glm::dot(d1, d1) + glm::dot(d2, d2)))) return mapping;
  const glm::vec3 e1 = p.positions[b] - p.positions[a], e2 = p.positions[c] - p.positions[a];
  const float area = 0.5f * glm::length(glm::cross(e1 * scale, e2 * scale));
  mapping.dPdu = (d2.y * e1 - d1.y * e2) / det;
  mapping.dPdv = (d1.x * e2 - d2.x * e1) / det;
  mapping.mirrored = det < 0.0f;
  if (std::isfinite(area) && isFinite(mapping.dPdu) && isFinite(mapping.dPdv)) mapping.area = area;
  return mapping;
}

// The surface's own coordinates take the place of the file's, or stand beside them for patterns alone.
void takeUnfolding(Primitive& p, Unfolding&& u) {
  p.addedFrom.assign(u.source.begin() + std::ptrdiff_t(p.vertexCount()), u.source.end());
  gatherVertices(p, u.source);
  p.indices = std::move(u.indices);
  (p.uv0.empty() ? p.uv0 : p.patternUv) = std::move(u.uvs);
}

// What is wrong with a mapping, in lengths of seams.
float costOf(const MappingFaults& faults) {
  return faults.seams + kUnevenCost * (faults.uneven + faults.unmapped);
}

// The same triangles on the same coordinates of a file, before vertices were added.
bool isMadeFrom(const Primitive& p, const Primitive& before) {
  const size_t count = before.positions.size() - before.addedFrom.size();
  if (p.vertexCount() != count || before.indices.size() != p.indices.size()) return false;
  for (size_t i = 0; i < p.indices.size(); ++i) {
    const uint32_t v = before.indices[i];
    if ((v < count ? v : before.addedFrom[v - count]) != p.indices[i]) return false;
  }
  return p.uv0.empty() ? before.generatedUvs
                       : !before.generatedUvs && std::equal(p.uv0.begin(), p.uv0.end(), before.uv0.begin());
}

std::optional<Unfolding> ownMappingOf(const Primitive& before) {
  if (!before.generatedUvs && !before.ownPattern) return std::nullopt;
  Unfolding u{{}, before.indices, before.patternCoordinates()};
  u.source.resize(before.positions.size() - before.addedFrom.size());
  std::iota(u.source.begin(), u.source.end(), 0u);
  u.source.insert(u.source.end(), before.addedFrom.begin(), before.addedFrom.end());
  return u;
}

std::optional<Unfolding> ownMapping(const Primitive& p, float scale, PatternCoordinates which) {
  if (which == PatternCoordinates::own || p.uv0.empty()) return unfold(p, scale);
  const MappingFaults faults = mappingFaults(p, scale);
  // Where there is no mapping nothing can follow it.
  if (faults.isMissing()) return unfold(p, scale);
  if (which == PatternCoordinates::file || costOf(faults) <= kUsualCost) return std::nullopt;
  Unfolding own = unfold(p, scale);
  Primitive laid;
  for (const uint32_t v : own.source) laid.positions.push_back(p.positions[v]);
  laid.indices = own.indices, laid.uv0 = own.uvs;
  if (costOf(mappingFaults(laid, scale)) >= kWorthLeaving * costOf(faults)) return std::nullopt;
  return own;
}

// For each vertex the first one at its place on the surface: files split vertices where faces meet, or all of
// them, also where surface and mapping go on. Their tangents must be the same there, or the pattern breaks
// along every edge. At a crease, and where a mapping is mirrored, each side keeps its own, since a mean would
// lie in neither. `balance`: by vertex, the area of the plain triangles at it less that of the mirrored ones.
std::vector<uint32_t> samePlaces(const Primitive& p, float scale, const std::vector<float>& balance) {
  constexpr float kCrease = 0.8f;  // cosine of the angle between normals
  const std::vector<glm::vec2>& uv = p.patternCoordinates();
  // Where a mapping closes on itself the place is the same one unit further on.
  const auto sameUv = [&](uint32_t a, uint32_t b) {
    const glm::vec2 d = uv[a] - uv[b],
                    whole(p.wrapsU ? std::round(d.x) : 0.0f, p.wrapsV ? std::round(d.y) : 0.0f);
    return glm::length(d - whole) < 1e-5f;
  };
  // Of coordinates that are the same but for rounding: no borders of cells lie where coordinates like to be.
  const auto cellOf = [](float t, bool wraps) {
    constexpr float kCells = 4096, kShift = 0.377f;
    const float cell = std::floor((wraps ? t - std::floor(t) : t) * kCells + kShift);
    return std::bit_cast<uint32_t>((wraps && cell >= kCells ? 0.0f : cell) + 0.0f);
  };
  const auto cells = [&](uint32_t v) {
    return uint64_t(cellOf(uv[v].x, p.wrapsU)) << 32 | cellOf(uv[v].y, p.wrapsV);
  };
  const PositionGrid grid(0.5f * scale);
  PositionTable table(p.vertexCount());
  std::vector<uint32_t> first(p.vertexCount());
  for (uint32_t v = 0; v < first.size(); ++v)
    first[v] = table.findOrAddIf(grid(p.positions[v]), cells(v), v, [&](uint32_t stored) {
      return grid(p.positions[stored]) == grid(p.positions[v]) && sameUv(stored, v) &&
             (balance[stored] < 0.0f) == (balance[v] < 0.0f) &&
             glm::dot(p.normals[stored], p.normals[v]) > kCrease;
    });
  return first;
}

// `first`: as samePlaces() has it; made here where it is empty.
void makeTangents(Primitive& p, float scale, std::vector<uint32_t>& first) {
  // How each triangle is mapped, and which way around its corners are on the whole.
  const size_t count = p.vertexCount();
  std::vector<Mapping> mappings;
  mappings.reserve(p.indices.size() / 3);
  std::vector<float> balance(count, 0.0f);
  for (size_t i = 0; i + 2 < p.indices.size(); i += 3) {
    const Mapping& mapping = mappings.emplace_back(mappingOf(p, i, scale));
    for (size_t k = 0; k < 3; ++k)
      balance[p.indices[i + k]] += mapping.mirrored ? -mapping.area : mapping.area;
  }
  if (first.empty()) first = samePlaces(p, scale, balance);
  // Sums over the triangles at a place, by their areas.
  p.dPdu.assign(count, glm::vec3(0.0f));
  p.dPdv.assign(count, glm::vec3(0.0f));
  std::vector<float> areas(count, 0.0f);
  bool anyPlain = false, anyMirrored = false;
  for (size_t i = 0; i + 2 < p.indices.size(); i += 3) {
    const Mapping& mapping = mappings[i / 3];
    if (mapping.area <= 0.0f) continue;
    (mapping.mirrored ? anyMirrored : anyPlain) = true;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t v = first[p.indices[i + k]];
      p.dPdu[v] += mapping.area * mapping.dPdu;
      p.dPdv[v] += mapping.area * mapping.dPdv;
      areas[v] += mapping.area;
    }
  }

  // On the seam of a mirrored mapping the two sides point against each other and would cancel: there the
  // larger side alone decides.
  if (anyPlain && anyMirrored) {
    // Of all vertices at a place together.
    for (size_t v = 0; v < count; ++v)
      if (first[v] != v) balance[first[v]] += balance[v];
    const auto isSeam = [&](uint32_t v) { return std::abs(balance[v]) < 0.999f * areas[v]; };
    std::vector<float> seamAreas(count, 0.0f);
    for (size_t i = 0; i + 2 < p.indices.size(); i += 3) {
      const Mapping& mapping = mappings[i / 3];
      if (mapping.area <= 0.0f) continue;
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t v = first[p.indices[i + k]];
        if (!isSeam(v) || mapping.mirrored != (balance[v] < 0.0f)) continue;
        if (seamAreas[v] == 0.0f) p.dPdu[v] = p.dPdv[v] = glm::vec3(0.0f);
        p.dPdu[v] += mapping.area * mapping.dPdu;
        p.dPdv[v] += mapping.area * mapping.dPdv;
        seamAreas[v] += mapping.area;
      }
    }
    for (size_t v = 0; v < count; ++v)
      if (seamAreas[v] > 0.0f) areas[v] = seamAreas[v];
  }

  // Means.
  for (size_t v = 0; v < count; ++v) {
    const float share = areas[v] > 0.0f ? 1.0f / areas[v] : 0.0f;
    p.dPdu[v] *= share;
    p.dPdv[v] *= share;
    if (!isFinite(p.dPdu[v]) || !isFinite(p.dPdv[v])) p.dPdu[v] = p.dPdv[v] = glm::vec3(0.0f);
  }
  for (size_t v = 0; v < count; ++v) p.dPdu[v] = p.dPdu[first[v]], p.dPdv[v] = p.dPdv[first[v]];
}

}  // namespace

namespace {

// Whether every edge is gone along both ways equally often. What is summed is another random number for each
// edge and its opposite for the way back: the sum is 0 where all of them cancel out, and nowhere else but by
// chance (one in 2^64).
bool closes(const Primitive& p, float scale) {
  const PositionGrid grid(0.5f * scale);
  const auto mixed = [](uint64_t x) {
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u, x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return x ^ x >> 31;
  };
  // By place and not by vertex: seams open nothing. Adding 0 makes both zeros one.
  const auto placeOf = [&](uint32_t v) {
    const glm::vec3 place = grid(p.positions[v]);
    uint64_t hash = 0;
    for (int c = 0; c < 3; ++c)
      hash = mixed(hash + 0x9e3779b97f4a7c15u + std::bit_cast<uint32_t>(place[c] + 0.0f));
    return hash;
  };
  std::vector<uint64_t> places(p.positions.size());
  for (uint32_t v = 0; v < places.size(); ++v) places[v] = placeOf(v);
  uint64_t sum = 0;
  for (size_t i = 0; i + 2 < p.indices.size(); i += 3)
    for (int k = 0; k < 3; ++k) {
      const uint64_t a = places[p.indices[i + size_t(k)]], b = places[p.indices[i + size_t((k + 1) % 3)]];
      sum += mixed(a + 3 * b) - mixed(b + 3 * a);
    }
  return sum == 0 && !p.indices.empty();
}

}  // namespace

void finishPrimitive(Primitive& p, float radius, PatternCoordinates which, const Primitive* before) {
  for (size_t i = 0; i < p.vertexCount(); ++i) {
    glm::vec3& normal = p.smoothNormals[i];
    const float length = glm::length(normal);
    normal = length > 1e-12f ? normal / length : p.normals[i];
  }
  const float scale = 1.0f / std::max(radius, 1e-20f);
  if (p.vertexCount() > 0)
    if (std::optional<Unfolding> own =
            before && isMadeFrom(p, *before) ? ownMappingOf(*before) : ownMapping(p, scale, which)) {
      (p.uv0.empty() ? p.generatedUvs : p.ownPattern) = true;
      takeUnfolding(p, std::move(*own));
      p.wrapsU = p.wrapsV = false;
    }
  std::vector<uint32_t> places;
  makeTangents(p, scale, places);
  finishMorphTargets(p, [&](Primitive& morphed) { makeTangents(morphed, scale, places); });
  p.extent = extentOf(p);
  p.isClosed = closes(p, scale);
}

}  // namespace scumble::scene
