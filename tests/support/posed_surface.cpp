#include "tests/support/posed_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "tests/support/ray_cast.h"

namespace scumble::test {

namespace {

using Vectors = std::vector<glm::dvec3>;

// Vertices at one place, to a hundred thousandth of a metre.
using Place = std::tuple<long, long, long>;
Place placeOf(const glm::vec3& p) {
  const auto round = [](float x) { return std::lround(double(x) * 1e5); };
  return {round(p.x), round(p.y), round(p.z)};
}

glm::dvec3 unit(const glm::dvec3& v) {
  return glm::normalize(v);
}

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
  return std::acos(std::clamp(glm::dot(unit(a), unit(b)), -1.0, 1.0));
}

// The sum of the normals of all faces of a mesh around each place, weighted by their angles there.
std::map<Place, glm::dvec3> faceSums(const scene::Mesh& mesh) {
  std::map<Place, glm::dvec3> sums;
  for (const scene::Primitive& p : mesh.primitives)
    for (size_t i = 0; i < p.indices.size(); i += 3)
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t at = p.indices[i + k];
        const glm::dvec3 here(p.positions[at]), next = glm::dvec3(p.positions[p.indices[i + (k + 1) % 3]]),
                                                other = glm::dvec3(p.positions[p.indices[i + (k + 2) % 3]]);
        sums.try_emplace(placeOf(p.positions[at]), 0.0).first->second +=
            angleBetween(next - here, other - here) * unit(glm::cross(next - here, other - here));
      }
  return sums;
}

// Tangents of a mapping with such positions: means over the triangles at a vertex, weighted by area. A vertex
// is one also where it is split: at one place, with uv that are the same or whole numbers apart, on one side
// of a crease.
struct Tangents {
  Vectors dPdu, dPdv;
};
Tangents tangentsOf(const scene::Primitive& p, const Vectors& positions) {
  const size_t count = p.vertexCount();
  Tangents sums{Vectors(count, glm::dvec3(0.0)), Vectors(count, glm::dvec3(0.0))};
  std::vector<double> areas(count, 0.0);
  for (size_t i = 0; i < p.indices.size(); i += 3) {
    const uint32_t a = p.indices[i], b = p.indices[i + 1], c = p.indices[i + 2];
    const glm::dvec3 ab = positions[b] - positions[a], ac = positions[c] - positions[a];
    // ab and ac are uv's differences times the tangents: two equations for two unknowns.
    const glm::dmat2 uvs(glm::dvec2(p.uv0[b] - p.uv0[a]), glm::dvec2(p.uv0[c] - p.uv0[a]));
    const glm::dmat2 back = glm::inverse(uvs);
    const glm::dvec3 u = ab * back[0][0] + ac * back[0][1], v = ab * back[1][0] + ac * back[1][1];
    const double area = 0.5 * glm::length(glm::cross(ab, ac));
    for (const uint32_t vertex : {a, b, c})
      sums.dPdu[vertex] += area * u, sums.dPdv[vertex] += area * v, areas[vertex] += area;
  }
  std::map<Place, std::vector<size_t>> places;
  for (size_t v = 0; v < count; ++v) places[placeOf(p.positions[v])].push_back(v);
  Tangents means = sums;
  for (size_t v = 0; v < count; ++v) {
    glm::dvec3 u(0.0), w(0.0);
    double area = 0;
    for (const size_t other : places[placeOf(p.positions[v])]) {
      const glm::dvec2 apart(p.uv0[other] - p.uv0[v]);
      if (glm::length(apart - glm::round(apart)) > 1e-5 || glm::dot(p.normals[other], p.normals[v]) < 0.8f)
        continue;
      u += sums.dPdu[other], w += sums.dPdv[other], area += areas[other];
    }
    means.dPdu[v] = u / area, means.dPdv[v] = w / area;
  }
  return means;
}

Vectors doubles(const std::vector<glm::vec3>& v) {
  return {v.begin(), v.end()};
}

// A primitive's corners before its vertices go to the world.
std::vector<SurfaceCorner> morphedCorners(const PosedPrimitive& posed) {
  const scene::Primitive& p = *posed.primitive;
  const Vectors rest = doubles(p.positions);
  const Tangents tangents = tangentsOf(p, rest);
  const std::map<Place, glm::dvec3> sums = faceSums(*posed.mesh);
  std::vector<SurfaceCorner> corners(p.vertexCount());
  for (size_t v = 0; v < corners.size(); ++v)
    corners[v] = {rest[v],
                  unit(sums.at(placeOf(p.positions[v]))),
                  tangents.dPdu[v],
                  tangents.dPdv[v],
                  glm::dvec2(p.uv0[v]),
                  p.warpScales.empty() ? 1.0 : double(p.warpScales[v])};
  // Targets are exact at weight 1 and linear in between (scene_data.h). A smooth normal turns as the mean of
  // the normals at its place does.
  const std::vector<SurfaceCorner> before = corners;
  for (size_t t = 0; t < p.morphTargets.size(); ++t) {
    const scene::MorphTarget& target = p.morphTargets[t];
    const double weight = posed.morphWeights[t];
    if (!target.positions.empty()) {
      Vectors moved = rest;
      for (size_t v = 0; v < moved.size(); ++v) moved[v] += glm::dvec3(target.positions[v]);
      const Tangents then = tangentsOf(p, moved);
      for (size_t v = 0; v < moved.size(); ++v) {
        corners[v].position += weight * (moved[v] - rest[v]);
        corners[v].dPdu += weight * (then.dPdu[v] - before[v].dPdu);
        corners[v].dPdv += weight * (then.dPdv[v] - before[v].dPdv);
      }
    }
    if (target.normals.empty()) continue;
    std::map<Place, glm::dvec3> old, turned;
    for (size_t v = 0; v < rest.size(); ++v) {
      const Place place = placeOf(p.positions[v]);
      old.try_emplace(place, 0.0).first->second += glm::dvec3(p.normals[v]);
      turned.try_emplace(place, 0.0).first->second += glm::dvec3(p.normals[v] + target.normals[v]);
    }
    for (size_t v = 0; v < rest.size(); ++v) {
      const Place place = placeOf(p.positions[v]);
      const glm::dvec3& smooth = before[v].smoothNormal;
      corners[v].smoothNormal += weight * (unit(smooth + unit(turned[place]) - unit(old[place])) - smooth);
    }
  }
  return corners;
}

}  // namespace

std::vector<SurfaceTriangle> posedSurface(const scene::SceneData& scene, const Moments& moments) {
  std::vector<SurfaceTriangle> triangles;
  for (const PosedPrimitive& posed : posedPrimitives(scene, moments)) {
    const scene::Primitive& p = *posed.primitive;
    std::vector<SurfaceCorner> corners = morphedCorners(posed);
    for (size_t v = 0; v < corners.size(); ++v) {
      SurfaceCorner& c = corners[v];
      const glm::dmat3 linear(posed.toWorld[v]);
      c.position = glm::dvec3(posed.toWorld[v] * glm::dvec4(c.position, 1));
      c.dPdu = linear * c.dPdu, c.dPdv = linear * c.dPdv;
      c.smoothNormal = unit(glm::inverse(glm::transpose(linear)) * c.smoothNormal);
    }
    for (size_t i = 0; i < p.indices.size(); i += 3)
      triangles.push_back({{corners[p.indices[i]], corners[p.indices[i + 1]], corners[p.indices[i + 2]]},
                           posed.id,
                           posed.mirror,
                           scene.materials[size_t(p.material)].doubleSided});
  }
  return triangles;
}

std::optional<ScreenTriangle> screenTriangle(const SurfaceTriangle& triangle, const View& view, int width,
                                             int height, const std::array<glm::dvec2, 3>& moves) {
  ScreenTriangle result;
  for (size_t k = 0; k < 3; ++k) {
    const glm::dvec3& point = triangle.corners[k].position;
    const double depth = depthOf(view, point);
    if (depth <= 0) return std::nullopt;
    result.corners[k] = depth * glm::dvec3(pixelOf(view, point, width, height) + moves[k], 1);
  }
  // Counterclockwise is the outside, and y points down here.
  const double turn = glm::determinant(glm::dmat3(result.corners[0], result.corners[1], result.corners[2]));
  if (!triangle.doubleSided && triangle.mirror * turn >= 0) return std::nullopt;
  return result;
}

glm::dvec3 sharesAt(const ScreenTriangle& triangle, const glm::dvec2& at) {
  const glm::dvec3 shares =
      glm::inverse(glm::dmat3(triangle.corners[0], triangle.corners[1], triangle.corners[2])) *
      glm::dvec3(at, 1);
  return shares / (shares.x + shares.y + shares.z);
}

std::vector<std::optional<ScreenHit>> rasterised(const std::vector<ScreenTriangle>& triangles, int width,
                                                 int height, const glm::dvec2& offset) {
  std::vector<std::optional<ScreenHit>> hits(size_t(width) * size_t(height));
  for (const ScreenTriangle& triangle : triangles) {
    const glm::dmat3 corners(triangle.corners[0], triangle.corners[1], triangle.corners[2]);
    if (glm::determinant(corners) == 0) continue;
    const glm::dmat3 back = glm::inverse(corners);
    glm::dvec2 low(1e9), high(-1e9);
    for (const glm::dvec3& corner : triangle.corners) {
      low = glm::min(low, glm::dvec2(corner) / corner.z),
      high = glm::max(high, glm::dvec2(corner) / corner.z);
    }
    const int left = std::max(0, int(low.x) - 1), right = std::min(width - 1, int(high.x) + 1),
              top = std::max(0, int(low.y) - 1), bottom = std::min(height - 1, int(high.y) + 1);
    for (int y = top; y <= bottom; ++y)
      for (int x = left; x <= right; ++x) {
        const glm::dvec3 shares = back * glm::dvec3(glm::dvec2(x, y) + 0.5 + offset, 1);
        if (shares.x < 0 || shares.y < 0 || shares.z < 0) continue;
        const double nearness = shares.x + shares.y + shares.z;
        std::optional<ScreenHit>& hit = hits[size_t(y) * size_t(width) + size_t(x)];
        if (!hit || 1 / nearness < hit->depth) hit = {triangle.surface, shares / nearness, 1 / nearness};
      }
  }
  return hits;
}

glm::dvec2 pixelsAlong(const View& view, const glm::dvec3& point, const glm::dvec3& direction, int width,
                       int height) {
  const double step = 1e-5 * glm::length(point - glm::dvec3(glm::inverse(glm::dmat4(view.worldToEye))[3])) /
                      glm::length(direction);
  return (pixelOf(view, point + step * direction, width, height) -
          pixelOf(view, point - step * direction, width, height)) /
         (2 * step);
}

double depthOf(const View& view, const glm::dvec3& point) {
  return -(glm::dmat4(view.worldToEye) * glm::dvec4(point, 1)).z;
}

}  // namespace scumble::test
