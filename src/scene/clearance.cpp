#include "scene/clearance.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "scene/animation.h"
#include "scene/landing.h"
#include "scene/parallel.h"
#include "scene/posed_bounds.h"
#include "scene/seen.h"
#include "scene/surface_points.h"

namespace scumble::scene {

namespace {

constexpr size_t kPoints = 256;      // of a primitive
constexpr double kParallel = 0.8;    // cosine of the angle between surfaces that lie along each other
constexpr double kShareAlong = 0.3;  // of either surface that has to
constexpr double kMargin = 0.25;     // of what is between them: both may be off
constexpr double kStraight = 1.4;    // the way to a surface may be so much longer than straight off it
constexpr double kTouching = 0.02;   // of the spacing of points: a way so short has no direction

// A primitive in the world.
struct Part {
  size_t mesh, primitive;
  const Primitive* shape;
  glm::mat4 model;
  std::vector<glm::mat4> joints;  // instead, of its skin; none where it is stiff

  glm::vec3 vertex(uint32_t v) const {
    const glm::vec4 at(shape->positions[v], 1);
    if (joints.empty()) return model * at;
    glm::vec3 sum(0.0f);
    const auto influences = size_t(shape->influences);
    for (size_t k = v * influences; k < (v + 1) * influences; ++k)
      sum += shape->weights[k] * glm::vec3(joints[shape->joints[k]] * at);
    return sum;
  }
  // Metres of the world by one of the mesh.
  double scale() const {
    float most = 0;
    for (const glm::mat4& matrix : joints.empty() ? std::span(&model, 1) : std::span(joints))
      for (int k = 0; k < 3; ++k) most = std::max(most, glm::length(glm::vec3(matrix[k])));
    return double(most);
  }
};

// What is known of it.
struct Placed {
  explicit Placed(const Part& of) : part(of) {
    const auto positionOf = [&](uint32_t v) { return part.vertex(v); };
    forEachSurfacePoint(part.shape->indices, positionOf, kPoints, [&](const SurfacePoint& point) {
      const glm::dvec3 at = point([&](uint32_t v) { return glm::dvec3(part.vertex(v)); });
      const double pointArea = glm::length(point.normal);
      points.push_back({at, point.normal / pointArea, pointArea, point.corners[0]});
      area += pointArea;
      low = glm::min(low, at), high = glm::max(high, at);
    });
    spacing = std::sqrt(area / double(kPoints));
  }

  const Part& part;
  double spacing = 0;  // between points, metres
  struct Point {
    glm::dvec3 at, normal;
    double area;
    uint32_t vertex;  // beside it
  };
  std::vector<Point> points;
  glm::dvec3 low{1e300}, high{-1e300};
  double area = 0;
  // Made when it is asked for.
  struct Search {
    std::vector<glm::vec3> vertices;
    LandingSearch landingOf;
  };
  std::unique_ptr<Search> search;
};

Placed::Search& searchOf(Placed& placed) {
  if (!placed.search) {
    const Primitive& p = *placed.part.shape;
    std::vector<glm::vec3> vertices(p.positions.size());
    for (uint32_t v = 0; v < vertices.size(); ++v) vertices[v] = placed.part.vertex(v);
    const std::span<const glm::vec3> there = vertices;  // moving it leaves them where they are
    placed.search.reset(new Placed::Search{std::move(vertices), LandingSearch(there, p.indices)});
  }
  return *placed.search;
}

// From a point to the surface, straight off it; nothing where the surface ends beside the point, as the next
// material of a thing does. `near`: one of the surface's points.
std::optional<double> heightOver(Placed& surface, const glm::dvec3& point, const Placed::Point& near) {
  Placed::Search& search = searchOf(surface);
  const Landing landing = search.landingOf(glm::vec3(point), near.vertex);
  glm::dvec3 corners[3], there(0.0);
  for (uint32_t k = 0; k < 3; ++k) {
    corners[k] = search.vertices[surface.part.shape->indices[3 * landing.triangle + k]];
    there += double(landing.weights[int(k)]) * corners[k];
  }
  const glm::dvec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]),
                   away = point - there;
  if (!(glm::length(across) > 0)) return {};
  const double height = std::abs(glm::dot(away, glm::normalize(across)));
  if (glm::length(away) > kStraight * height + kTouching * surface.spacing) return {};
  return height;
}

// What is between two surfaces where they lie along each other; infinite where they do not.
double clearance(Placed& a, Placed& b) {
  constexpr double kFar = 1e300;
  const double reach = 2 * std::max(a.spacing, b.spacing);
  if (glm::any(glm::greaterThan(a.low, b.high + reach)) || glm::any(glm::greaterThan(b.low, a.high + reach)))
    return kFar;
  const auto between = [&](const Placed& from, Placed& to) {
    struct Pair {
      const Placed::Point *point, *nearest;
    };
    std::vector<Pair> pairs;
    double area = 0;
    for (const Placed::Point& point : from.points) {
      if (glm::any(glm::lessThan(point.at, to.low - reach)) ||
          glm::any(glm::greaterThan(point.at, to.high + reach)))
        continue;
      const Placed::Point* nearest = nullptr;
      double nearest2 = reach * reach;
      for (const Placed::Point& other : to.points) {
        const glm::dvec3 d = point.at - other.at;
        if (const double d2 = glm::dot(d, d);
            d2 < nearest2 && std::abs(glm::dot(point.normal, other.normal)) > kParallel)
          nearest2 = d2, nearest = &other;
      }
      if (!nearest) continue;
      area += point.area;
      pairs.push_back({&point, nearest});
    }
    if (!(area > kShareAlong * from.area)) return kFar;
    std::vector<double> heights;
    area = 0;
    for (const Pair& pair : pairs)
      if (const std::optional<double> height = heightOver(to, pair.point->at, *pair.nearest)) {
        area += pair.point->area;
        heights.push_back(*height);
      }
    if (!(area > kShareAlong * from.area)) return kFar;
    // Where they are near each other, but for some points that are not like the others.
    const auto low = heights.begin() + std::ptrdiff_t(heights.size() / 10);
    std::nth_element(heights.begin(), low, heights.end());
    return *low;
  };
  return std::min(between(a, b), between(b, a));
}

}  // namespace

void keepLevelsApart(SceneData& scene) {
  // Each mesh where it stands first.
  const Pose rest = poseAt(scene, {}, 0);
  const std::vector<bool> shown = everShownNodes(scene);
  std::vector<Part> parts;
  std::vector<bool> seen(scene.meshes.size());
  bool anyLevels = false;
  for (size_t n = 0; n < scene.nodes.size(); ++n) {
    const Node& node = scene.nodes[n];
    if (node.mesh < 0 || !shown[n] || seen[size_t(node.mesh)]) continue;
    seen[size_t(node.mesh)] = true;
    const glm::mat4 model = instanceToWorld(node, rest.world[n], 0);
    const Mesh& mesh = scene.meshes[size_t(node.mesh)];
    for (size_t k = 0; k < mesh.primitives.size(); ++k) {
      const Primitive& p = mesh.primitives[k];
      Part part{size_t(node.mesh), k, &p, model, {}};
      if (node.skin >= 0 && p.influences > 0)
        part.joints = jointMatrices(scene.skins[size_t(node.skin)], rest.world);
      parts.push_back(std::move(part));
      anyLevels |= !p.levels.empty();
    }
  }
  if (!anyLevels) return;
  std::vector<std::optional<Placed>> made(parts.size());
  parallelFor(parts.size(), threadCount(0), [&](size_t i) { made[i].emplace(parts[i]); });
  std::vector<Placed> placed;
  for (std::optional<Placed>& part : made) placed.push_back(std::move(*part));

  // Pairs, by a sweep along x.
  std::vector<size_t> order(placed.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto start = [&](size_t i) { return placed[i].low.x - 2 * placed[i].spacing; };
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return start(a) < start(b); });
  std::vector<double> free(placed.size(), 1e300);  // metres in the world
  const auto hasLevels = [&](size_t i) { return !parts[i].shape->levels.empty(); };
  for (size_t i = 0; i < order.size(); ++i) {
    for (size_t j = i + 1; j < order.size(); ++j) {
      const size_t a = order[i], b = order[j];
      if (start(b) > placed[a].high.x + 2 * placed[a].spacing) break;
      if (!hasLevels(a) && !hasLevels(b)) continue;
      const double metres = clearance(placed[a], placed[b]);
      free[a] = std::min(free[a], metres), free[b] = std::min(free[b], metres);
    }
    placed[order[i]].search.reset();
  }
  std::vector<double> scales;
  for (const Part& part : parts) scales.push_back(part.scale());
  // Meshes may be others than `shape` from here on.
  for (size_t i = 0; i < parts.size(); ++i) {
    const Part& part = parts[i];
    if (free[i] == 1e300) continue;
    const double scale = scales[i];
    Primitive& p = scene.meshes[part.mesh].own().primitives[part.primitive];
    while (!p.levels.empty() && p.levels.back().shadowError * scale > kMargin * free[i]) p.levels.pop_back();
    p.levelIndices.resize(p.levels.empty() ? 0 : p.levels.back().firstIndex + p.levels.back().indexCount);
    p.levelIndices.shrink_to_fit();
  }
}

}  // namespace scumble::scene
