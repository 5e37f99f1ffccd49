#include "scene/mapping_faults.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/position_weld.h"

namespace scumble::scene {

namespace {

constexpr float kSmooth = 0.8f;   // cosine of the angle between faces over which the surface goes on
constexpr float kSameUv = 1e-3f;  // of one side of the texture

struct Face {
  glm::vec3 normal{0.0f};  // unit
  float area = 0;
  float texels = 0;  // area in uv; negative where it is mirrored; 0: a line
};

Face faceOf(const Primitive& p, size_t triangle, float scale) {
  const uint32_t *v = &p.indices[3 * triangle], a = v[0], b = v[1], c = v[2];
  const glm::vec3 across =
      glm::cross((p.positions[b] - p.positions[a]) * scale, (p.positions[c] - p.positions[a]) * scale);
  Face face;
  const float length = glm::length(across);
  if (!(length > 0) || !std::isfinite(length)) return face;
  face.normal = across / length, face.area = 0.5f * length;
  const glm::vec2 d1 = p.uv0[b] - p.uv0[a], d2 = p.uv0[c] - p.uv0[a];
  const float det = d1.x * d2.y - d1.y * d2.x;
  // A triangle whose corners lie on a line says nothing about one direction.
  if (std::abs(det) > 1e-6f * (glm::dot(d1, d1) + glm::dot(d2, d2))) face.texels = 0.5f * det;
  return face;
}

// The part of the area whose density is more than two octaves (along a side) off the median.
float unevenShare(const std::vector<Face>& faces) {
  constexpr int kBins = 512, kOfAnOctave = 8;
  std::array<double, kBins> areas{};
  const auto binOf = [](const Face& face) {
    const float octaves = 0.5f * std::log2(std::abs(face.texels) / face.area);
    return int(std::clamp(octaves * kOfAnOctave + kBins / 2, 0.0f, float(kBins - 1)));
  };
  double all = 0;
  for (const Face& face : faces)
    if (face.texels != 0) areas[size_t(binOf(face))] += double(face.area), all += double(face.area);
  if (!(all > 0)) return 0;
  int median = 0;
  for (double sum = 0; median < kBins; ++median)
    if ((sum += areas[size_t(median)]) >= 0.5 * all) break;
  double off = 0;
  for (int bin = 0; bin < kBins; ++bin)
    if (std::abs(bin - median) > 2 * kOfAnOctave) off += areas[size_t(bin)];
  return float(off / all);
}

// One side of an edge at which a mapping might break off.
struct Side {
  uint64_t edge;  // both places, the lower number first
  uint32_t triangle;
  uint32_t low, high;  // vertices
  bool operator<(const Side& other) const {
    return edge != other.edge ? edge < other.edge : triangle < other.triangle;
  }
};

double seamLength(const Primitive& p, const std::vector<Face>& faces, float scale) {
  // Mappings break off where vertices were split, and turn back where triangles of both kinds meet.
  const std::vector<uint32_t> place = firstAtPlaces(p.positions, PositionGrid(0.5f * scale));
  std::vector<bool> isSplit(p.vertexCount()), hasPlain(p.vertexCount()), hasMirrored(p.vertexCount());
  for (uint32_t v = 0; v < place.size(); ++v)
    if (place[v] != v) isSplit[place[v]] = true;
  for (size_t i = 0; i < p.indices.size(); ++i)
    if (const Face& face = faces[i / 3]; face.texels != 0)
      (face.texels < 0 ? hasMirrored : hasPlain)[place[p.indices[i]]] = true;
  const auto mayBreak = [&](uint32_t at) { return isSplit[at] || (hasPlain[at] && hasMirrored[at]); };
  std::vector<Side> sides;
  for (size_t i = 0; i < p.indices.size(); ++i) {
    uint32_t a = p.indices[i], b = p.indices[i - i % 3 + (i + 1) % 3];
    if (place[a] > place[b]) std::swap(a, b);
    const uint32_t from = place[a], to = place[b];
    if (from != to && mayBreak(from) && mayBreak(to))
      sides.push_back({uint64_t(from) << 32 | to, uint32_t(i / 3), a, b});
  }
  std::sort(sides.begin(), sides.end());
  const auto isSame = [&](uint32_t v, uint32_t w) {
    const glm::vec2 d = p.uv0[v] - p.uv0[w],
                    whole(p.wrapsU ? std::round(d.x) : 0.0f, p.wrapsV ? std::round(d.y) : 0.0f);
    return glm::length(d - whole) < kSameUv;
  };
  double length = 0;
  for (size_t i = 0; i + 1 < sides.size(); ++i) {
    const Side &one = sides[i], &other = sides[i + 1];
    const Face &a = faces[one.triangle], &b = faces[other.triangle];
    if (one.edge != other.edge || a.texels == 0 || b.texels == 0) continue;
    if (glm::dot(a.normal, b.normal) < kSmooth) continue;
    // Not where one end alone has two coordinates: around a pole each triangle has its own.
    const bool runsOn = isSame(one.low, other.low) || isSame(one.high, other.high);
    if (runsOn && (a.texels < 0) == (b.texels < 0)) continue;
    length += double(glm::distance(p.positions[one.low], p.positions[one.high]) * scale);
  }
  return length;
}

}  // namespace

MappingFaults mappingFaults(const Primitive& p, float scale) {
  std::vector<Face> faces;
  faces.reserve(p.indices.size() / 3);
  double area = 0, unmapped = 0;
  for (size_t t = 0; t < p.indices.size() / 3; ++t) {
    const Face& face = faces.emplace_back(faceOf(p, t, scale));
    area += double(face.area);
    if (face.texels == 0) unmapped += double(face.area);
  }
  MappingFaults faults;
  if (!(area > 0)) return faults;
  faults.unmapped = float(unmapped / area);
  faults.uneven = unevenShare(faces);
  faults.seams = float(seamLength(p, faces, scale) / std::sqrt(area));
  return faults;
}

}  // namespace scumble::scene
