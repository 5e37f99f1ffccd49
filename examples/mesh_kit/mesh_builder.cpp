#include "mesh_kit/mesh_builder.h"

#include <array>
#include <cmath>

namespace meshkit {
namespace {

// Lays a face's own plane out in UVs: no stretch whatever its slope, and continuous over faces that lie
// alike, because the axes come from the mesh's own.
glm::vec2 planarUv(glm::vec3 point, glm::vec3 normal) {
  const glm::vec3 size = glm::abs(normal);
  const glm::vec3 hint = size.y > 0.8f ? glm::vec3(1, 0, 0) : glm::vec3(normal.z, 0, -normal.x);
  const glm::vec3 u = glm::normalize(hint - normal * glm::dot(hint, normal));
  const glm::vec3 v = glm::cross(normal, u);
  return kTexelDensity * glm::vec2(glm::dot(point, u), glm::dot(point, v));
}

bool degenerate(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
  const float area = glm::length(glm::cross(b - a, c - a));
  const float longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
  return area <= 1e-4f * longest * longest || area < 1e-8f;
}

}  // namespace

Primitive& MeshBuilder::primitive(int material) {
  for (Primitive& p : mesh_.primitives)
    if (p.material == material) return p;
  mesh_.primitives.push_back({material, {}, {}});
  return mesh_.primitives.back();
}

void MeshBuilder::addVertex(Primitive& primitive, glm::vec3 place, glm::vec3 normal, glm::vec2 uv) {
  primitive.vertices.push_back({place, normal, uv, binding_ ? binding_(place) : Binding{}});
}

void MeshBuilder::emit(int material, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
  if (degenerate(a, b, c)) return;
  const std::array<glm::vec3, 3> local{a, b, c};
  const glm::vec3 localNormal = glm::normalize(glm::cross(b - a, c - a));
  Primitive& p = primitive(material);
  std::array<glm::vec3, 3> world;
  for (int i = 0; i < 3; ++i) world[i] = glm::vec3(transform_ * glm::vec4(local[i], 1.0f));
  const glm::vec3 normal = glm::normalize(glm::cross(world[1] - world[0], world[2] - world[0]));
  for (int i = 0; i < 3; ++i) {
    p.indices.push_back(uint32_t(p.vertices.size()));
    addVertex(p, world[i], normal, planarUv(local[i], localNormal));
  }
}

void MeshBuilder::triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
  emit(material_, a, b, c);
}

void MeshBuilder::quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
  emit(material_, a, b, c);
  emit(material_, a, c, d);
}

void MeshBuilder::polygon(std::span<const glm::vec3> points) {
  glm::vec3 center(0.0f);
  for (const glm::vec3& p : points) center += p;
  center /= float(points.size());
  for (size_t i = 0; i < points.size(); ++i)
    emit(material_, center, points[i], points[(i + 1) % points.size()]);
}

void MeshBuilder::grid(const Grid& grid, const GridOptions& options) {
  const size_t rows = grid.rows, columns = grid.columns;
  const size_t across = columns + (options.closed ? 1 : 0);
  auto point = [&](size_t r, size_t c) { return grid.at(r, c % columns); };

  // UVs by mean arc length, the seam column counted twice.
  std::vector<float> u(across, 0.0f), v(rows, 0.0f);
  for (size_t c = 1; c < across; ++c) {
    float sum = 0.0f;
    for (size_t r = 0; r < rows; ++r) sum += glm::length(point(r, c) - point(r, c - 1));
    u[c] = u[c - 1] + std::max(sum / float(rows), 1e-4f);
  }
  for (size_t r = 1; r < rows; ++r) {
    float sum = 0.0f;
    for (size_t c = 0; c < across; ++c) sum += glm::length(point(r, c) - point(r - 1, c));
    v[r] = v[r - 1] + std::max(sum / float(across), 1e-4f);
  }

  // Smooth normals by area, over the seam too, so that materials may split the grid without splitting its
  // shade.
  const float side = options.flip ? -1.0f : 1.0f;
  std::vector<glm::vec3> normals(rows * columns, glm::vec3(0.0f));
  for (size_t r = 0; r + 1 < rows; ++r) {
    for (size_t c = 0; c + 1 < across; ++c) {
      const glm::vec3 n =
          side * glm::cross(point(r + 1, c + 1) - point(r, c), point(r + 1, c) - point(r, c + 1));
      for (size_t corner : {r * columns + c, r * columns + (c + 1) % columns, (r + 1) * columns + c,
                            (r + 1) * columns + (c + 1) % columns})
        normals[corner] += n;
    }
  }

  // Vertices, shared by the faces of one material where it is smooth.
  const glm::mat3 turn = glm::mat3(transform_);
  struct Shared {
    int material;
    std::vector<uint32_t> index;
  };
  std::vector<Shared> shared;
  auto vertex = [&](int material, size_t r, size_t c, glm::vec3 flatNormal) -> uint32_t {
    Primitive& p = primitive(material);
    const glm::vec3 world = glm::vec3(transform_ * glm::vec4(point(r, c), 1.0f));
    const glm::vec2 uv = options.projectAlong == glm::vec3(0.0f)
                             ? kTexelDensity * glm::vec2(u[c], v[r])
                             : planarUv(point(r, c), options.projectAlong);
    if (options.shading == Shading::flat) {
      addVertex(p, world, flatNormal, uv);
      return uint32_t(p.vertices.size() - 1);
    }
    Shared* found = nullptr;
    for (Shared& s : shared)
      if (s.material == material) found = &s;
    if (!found) {
      shared.push_back({material, std::vector<uint32_t>(rows * across, UINT32_MAX)});
      found = &shared.back();
    }
    uint32_t& index = found->index[r * across + c];
    if (index == UINT32_MAX) {
      glm::vec3 n = normals[r * columns + c % columns];
      n = glm::length(n) > 0.0f ? glm::normalize(turn * n) : flatNormal;
      index = uint32_t(p.vertices.size());
      addVertex(p, world, n, uv);
    }
    return index;
  };
  // Two triangles a cell.
  auto face = [&](int material, std::array<size_t, 2> a, std::array<size_t, 2> b, std::array<size_t, 2> c) {
    if (options.flip) std::swap(b, c);
    const glm::vec3 pa = point(a[0], a[1]), pb = point(b[0], b[1]), pc = point(c[0], c[1]);
    if (degenerate(pa, pb, pc)) return;
    const glm::vec3 n = glm::normalize(turn * glm::cross(pb - pa, pc - pa));
    const uint32_t ia = vertex(material, a[0], a[1], n), ib = vertex(material, b[0], b[1], n),
                   ic = vertex(material, c[0], c[1], n);
    Primitive& p = primitive(material);
    p.indices.insert(p.indices.end(), {ia, ib, ic});
  };
  for (size_t r = 0; r + 1 < rows; ++r) {
    for (size_t c = 0; c + 1 < across; ++c) {
      const int material = options.cellMaterial ? options.cellMaterial(r, c) : material_;
      if (material < 0) continue;
      face(material, {r, c}, {r, c + 1}, {r + 1, c + 1});
      face(material, {r, c}, {r + 1, c + 1}, {r + 1, c});
    }
  }
}

void MeshBuilder::loft(const std::vector<std::vector<glm::vec3>>& rings, const LoftOptions& options) {
  Grid g(rings.size(), rings.front().size());
  for (size_t r = 0; r < g.rows; ++r)
    for (size_t c = 0; c < g.columns; ++c) g.at(r, c) = rings[r][c];
  grid(g, {.shading = options.shading, .closed = true});
  if (options.capStart) {
    const std::vector<glm::vec3> start(rings.front().rbegin(), rings.front().rend());
    polygon(start);
  }
  if (options.capEnd) polygon(rings.back());
}

void MeshBuilder::tube(const std::vector<glm::vec3>& path, const std::vector<float>& radii, int sides,
                       Shading shading) {
  std::vector<std::vector<glm::vec3>> rings;
  glm::vec3 right(0.0f);
  for (size_t i = 0; i < path.size(); ++i) {
    const glm::vec3 along = glm::normalize(path[std::min(i + 1, path.size() - 1)] - path[i == 0 ? 0 : i - 1]);
    // The frame is carried along the curve, so that the bar does not twist.
    if (i == 0) right = std::abs(along.y) > 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    right = glm::normalize(right - along * glm::dot(right, along));
    const glm::vec3 front = glm::cross(along, right);
    const float radius = radii[std::min(i, radii.size() - 1)];
    rings.push_back(ellipseRing(path[i], right * radius, front * radius, sides));
  }
  loft(rings, {.shading = shading});
}

void MeshBuilder::bar(const std::vector<glm::vec3>& path, float width, float height, glm::vec3 up) {
  std::vector<std::vector<glm::vec3>> rings;
  for (size_t i = 0; i < path.size(); ++i) {
    const glm::vec3 along = glm::normalize(path[std::min(i + 1, path.size() - 1)] - path[i == 0 ? 0 : i - 1]);
    const glm::vec3 right = glm::normalize(glm::cross(along, up)) * (0.5f * width);
    const glm::vec3 top = glm::normalize(glm::cross(right, along)) * (0.5f * height);
    rings.push_back(
        {path[i] - right - top, path[i] + right - top, path[i] + right + top, path[i] - right + top});
    // Counter-clockwise seen from the end it goes to.
    std::swap(rings.back()[1], rings.back()[3]);
  }
  // Four sides with hard edges: a grid each.
  for (int s = 0; s < 4; ++s) {
    Grid g(rings.size(), 2);
    for (size_t r = 0; r < g.rows; ++r) {
      g.at(r, 0) = rings[r][s];
      g.at(r, 1) = rings[r][(s + 1) % 4];
    }
    grid(g, {.shading = Shading::flat});
  }
  const std::vector<glm::vec3>& end = rings.back();
  const std::vector<glm::vec3>& start = rings.front();
  quad(end[0], end[1], end[2], end[3]);
  quad(start[3], start[2], start[1], start[0]);
}

void MeshBuilder::lathe(const std::vector<glm::vec2>& profile, int sides, Shading shading) {
  Grid g(profile.size(), size_t(sides));
  for (size_t r = 0; r < g.rows; ++r) {
    for (size_t c = 0; c < g.columns; ++c) {
      const float angle = 2.0f * kPi * float(c) / float(sides);
      g.at(r, c) = {profile[r].x * std::cos(angle), profile[r].y, -profile[r].x * std::sin(angle)};
    }
  }
  grid(g, {.shading = shading, .closed = true});
}

void MeshBuilder::box(glm::vec3 center, glm::vec3 size, float taper) {
  const glm::vec3 h = 0.5f * size;
  const glm::vec3 t = {h.x * taper, h.y, h.z * taper};
  const glm::vec3 a = center + glm::vec3(-h.x, -h.y, h.z), b = center + glm::vec3(h.x, -h.y, h.z),
                  c = center + glm::vec3(h.x, -h.y, -h.z), d = center + glm::vec3(-h.x, -h.y, -h.z),
                  e = center + glm::vec3(-t.x, t.y, t.z), f = center + glm::vec3(t.x, t.y, t.z),
                  g = center + glm::vec3(t.x, t.y, -t.z), i = center + glm::vec3(-t.x, t.y, -t.z);
  quad(a, b, f, e);
  quad(b, c, g, f);
  quad(c, d, i, g);
  quad(d, a, e, i);
  quad(e, f, g, i);
  quad(d, c, b, a);
}

void MeshBuilder::extrude(std::span<const glm::vec2> outline, float z0, float z1) {
  std::vector<glm::vec3> front, back;
  for (const glm::vec2& p : outline) front.push_back({p, z1});
  for (size_t i = outline.size(); i-- > 0;) back.push_back({outline[i], z0});
  polygon(front);
  polygon(back);
  for (size_t i = 0; i < outline.size(); ++i) {
    const glm::vec2 p = outline[i], q = outline[(i + 1) % outline.size()];
    quad({p, z0}, {q, z0}, {q, z1}, {p, z1});
  }
}

void MeshBuilder::indexed(const std::vector<glm::vec3>& points, const std::vector<glm::uvec3>& faces,
                          Shading shading,
                          const std::function<int(glm::vec3 normal, glm::vec3 center)>& faceMaterial) {
  std::vector<glm::vec3> normals(points.size(), glm::vec3(0.0f));
  for (const glm::uvec3& f : faces) {
    const glm::vec3 n = glm::cross(points[f.y] - points[f.x], points[f.z] - points[f.x]);
    for (int k = 0; k < 3; ++k) normals[f[k]] += n;
  }
  const glm::mat3 turn = glm::mat3(transform_);
  for (const glm::uvec3& f : faces) {
    const glm::vec3 a = points[f.x], b = points[f.y], c = points[f.z];
    if (degenerate(a, b, c)) continue;
    const glm::vec3 n = glm::normalize(glm::cross(b - a, c - a));
    const int material = faceMaterial ? faceMaterial(n, (a + b + c) / 3.0f) : material_;
    if (material < 0) continue;
    emit(material, a, b, c);
    if (shading == Shading::smooth) {
      Primitive& p = primitive(material);
      for (int k = 0; k < 3; ++k)
        if (glm::length(normals[f[k]]) > 0.0f)
          p.vertices[p.vertices.size() - 3 + size_t(k)].normal = glm::normalize(turn * normals[f[k]]);
    }
  }
}

std::vector<glm::vec3> ellipseRing(glm::vec3 center, glm::vec3 right, glm::vec3 front, int sides,
                                   float squareness) {
  std::vector<glm::vec3> ring;
  for (int i = 0; i < sides; ++i) {
    const float angle = 2.0f * kPi * (float(i) + 0.5f) / float(sides);
    auto shaped = [&](float x) { return x < 0 ? -std::pow(-x, squareness) : std::pow(x, squareness); };
    ring.push_back(center + right * shaped(std::cos(angle)) + front * shaped(std::sin(angle)));
  }
  return ring;
}

std::vector<glm::vec3> smoothCurve(const std::vector<glm::vec3>& points, int steps) {
  std::vector<glm::vec3> curve;
  const size_t last = points.size() - 1;
  for (size_t i = 0; i < last; ++i) {
    const glm::vec3 p0 = points[i == 0 ? 0 : i - 1], p1 = points[i], p2 = points[i + 1],
                    p3 = points[std::min(i + 2, last)];
    for (int s = 0; s < steps; ++s) {
      const float t = float(s) / float(steps);
      curve.push_back(0.5f * (2.0f * p1 + (p2 - p0) * t + (2.0f * p0 - 5.0f * p1 + 4.0f * p2 - p3) * t * t +
                              (3.0f * p1 - p0 - 3.0f * p2 + p3) * t * t * t));
    }
  }
  curve.push_back(points.back());
  return curve;
}

std::vector<glm::vec3> hangingRope(glm::vec3 from, glm::vec3 to, float sag, int pieces) {
  std::vector<glm::vec3> rope;
  for (int i = 0; i <= pieces; ++i) {
    const float t = float(i) / float(pieces);
    rope.push_back(glm::mix(from, to, t) - glm::vec3(0, 4.0f * sag * t * (1.0f - t), 0));
  }
  return rope;
}

void icosphere(int levels, std::vector<glm::vec3>& points, std::vector<glm::uvec3>& faces) {
  const float g = 0.5f * (1.0f + std::sqrt(5.0f));
  points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
            {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (glm::vec3& p : points) p = glm::normalize(p);
  faces = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
           {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
           {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::vector<glm::uvec3> finer;
    std::vector<std::vector<std::pair<uint32_t, uint32_t>>> middles(points.size());
    auto middle = [&](uint32_t a, uint32_t b) {
      if (a > b) std::swap(a, b);
      for (const auto& [other, index] : middles[a])
        if (other == b) return index;
      points.push_back(glm::normalize(points[a] + points[b]));
      middles[a].push_back({b, uint32_t(points.size() - 1)});
      return uint32_t(points.size() - 1);
    };
    for (const glm::uvec3& f : faces) {
      const uint32_t a = middle(f.x, f.y), b = middle(f.y, f.z), c = middle(f.z, f.x);
      finer.insert(finer.end(), {{f.x, a, c}, {f.y, b, a}, {f.z, c, b}, {a, b, c}});
    }
    faces = std::move(finer);
  }
}

}  // namespace meshkit
