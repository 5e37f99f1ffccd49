#include "paint/direction_field.h"

#include <algorithm>
#include <cmath>

#include "scene/position_weld.h"

namespace scumble::paint {

namespace {

// How often directions are mixed with those around: far enough that what has none gets one.
constexpr int kRounds = 60;

// The surface as one, whatever vertices files split.
class Welded {
 public:
  explicit Welded(std::span<const scene::Primitive* const> primitives) {
    const scene::PositionGrid grid = scene::gridOf(primitives);
    size_t vertices = 0;
    for (const scene::Primitive* p : primitives) vertices += p->positions.size();
    scene::PositionTable table(vertices);
    for (const scene::Primitive* p : primitives) {
      std::vector<uint32_t>& own = numberOf_.emplace_back();
      for (size_t v = 0; v < p->positions.size(); ++v) {
        const glm::vec3 at = grid(p->positions[v]);
        const uint32_t number = table.findOrAdd(at, uint32_t(positions.size()),
                                                [&](uint32_t stored) { return grid(positions[stored]); });
        if (number == positions.size()) {
          positions.push_back(p->positions[v]);
          normals.push_back(p->smoothNormals.empty() ? p->normals[v] : p->smoothNormals[v]);
        }
        own.push_back(number);
      }
    }
    for (size_t i = 0; i < primitives.size(); ++i)
      for (size_t k = 0; k + 2 < primitives[i]->indices.size(); k += 3)
        for (size_t c = 0; c < 3; ++c) {
          const uint32_t a = numberOf_[i][primitives[i]->indices[k + c]],
                         b = numberOf_[i][primitives[i]->indices[k + (c + 1) % 3]];
          if (a != b) edges.emplace_back(std::min(a, b), std::max(a, b));
        }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  }

  DirectionField fieldOf(const std::vector<glm::vec3>& directions) const {
    DirectionField field;
    for (const std::vector<uint32_t>& own : numberOf_) {
      std::vector<glm::vec3>& of = field.emplace_back();
      for (const uint32_t number : own) of.push_back(directions[number]);
    }
    return field;
  }

  std::vector<glm::vec3> positions, normals;
  std::vector<std::pair<uint32_t, uint32_t>> edges;

 private:
  std::vector<std::vector<uint32_t>> numberOf_;
};

glm::vec3 onto(const glm::vec3& direction, const glm::vec3& normal) {
  return direction - normal * glm::dot(normal, direction);
}

// Any direction across a normal.
glm::vec3 across(const glm::vec3& normal) {
  const glm::vec3 axis = std::abs(normal.x) < 0.6f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  return glm::normalize(glm::cross(normal, axis));
}

// In the plane across `normal`, the direction of which a symmetric matrix has most; weight: by how much.
glm::vec3 strongest(const glm::mat3& m, const glm::vec3& normal, float* weight = nullptr) {
  const glm::vec3 u = across(normal), v = glm::cross(normal, u);
  const float a = glm::dot(u, m * u), b = glm::dot(u, m * v), c = glm::dot(v, m * v);
  if (weight) *weight = std::hypot(a - c, 2 * b);
  const float angle = 0.5f * std::atan2(2 * b, a - c);
  return std::cos(angle) * u + std::sin(angle) * v;
}

// Lines without a side are mixed as products of themselves, over and over, each with what it has of its own.
std::vector<glm::vec3> smoothed(const Welded& mesh, const std::vector<glm::mat3>& own,
                                const glm::vec3& towards) {
  std::vector<glm::mat3> now = own, sum(own.size());
  std::vector<float> count(own.size());
  for (int round = 0; round < kRounds; ++round) {
    std::fill(sum.begin(), sum.end(), glm::mat3(0.0f));
    std::fill(count.begin(), count.end(), 0.0f);
    for (const auto& [a, b] : mesh.edges) {
      sum[a] += now[b], sum[b] += now[a];
      ++count[a], ++count[b];
    }
    for (size_t i = 0; i < now.size(); ++i)
      now[i] = 0.15f * own[i] + 0.85f * (count[i] > 0 ? sum[i] / count[i] : own[i]);
  }
  std::vector<glm::vec3> directions(own.size());
  for (size_t i = 0; i < own.size(); ++i) {
    float weight = 0;
    glm::vec3 d = strongest(now[i], mesh.normals[i], &weight);
    if (!(weight > 1e-12f)) {
      const glm::vec3 laid = onto(towards, mesh.normals[i]);
      d = glm::length(laid) > 1e-3f ? glm::normalize(laid) : across(mesh.normals[i]);
    }
    directions[i] = glm::dot(d, towards) < 0 ? -d : d;
  }
  return directions;
}

}  // namespace

DirectionField alongCurvature(std::span<const scene::Primitive* const> primitives, const glm::vec3& towards) {
  const Welded mesh(primitives);
  // What each edge says of how much the surface bends along it.
  std::vector<glm::mat3> bends(mesh.positions.size(), glm::mat3(0.0f));
  std::vector<float> count(mesh.positions.size());
  for (const auto& [a, b] : mesh.edges) {
    const glm::vec3 along = mesh.positions[b] - mesh.positions[a];
    const float length2 = glm::dot(along, along);
    if (!(length2 > 0)) continue;
    const float bend = std::abs(glm::dot(mesh.normals[b] - mesh.normals[a], along)) / length2;
    const glm::mat3 said = bend * glm::outerProduct(along, along) / length2;
    bends[a] += said, bends[b] += said;
    ++count[a], ++count[b];
  }
  double mean = 0;
  std::vector<glm::mat3> own(mesh.positions.size(), glm::mat3(0.0f));
  for (size_t i = 0; i < own.size(); ++i) {
    float weight = 0;
    const glm::vec3 most = strongest(bends[i] / std::max(count[i], 1.0f), mesh.normals[i], &weight);
    const glm::vec3 least = glm::cross(mesh.normals[i], most);
    own[i] = weight * glm::outerProduct(least, least);
    mean += weight;
  }
  // A little of `towards`, for what bends nowhere.
  const float little = 0.1f * float(mean / double(std::max<size_t>(1, own.size()))) + 1e-6f;
  for (size_t i = 0; i < own.size(); ++i) {
    const glm::vec3 laid = onto(towards, mesh.normals[i]);
    own[i] += little * glm::outerProduct(laid, laid);
  }
  return mesh.fieldOf(smoothed(mesh, own, towards));
}

DirectionField alongDirection(std::span<const scene::Primitive* const> primitives, const glm::vec3& towards) {
  const Welded mesh(primitives);
  std::vector<glm::vec3> directions(mesh.positions.size()), sum(directions.size());
  for (size_t i = 0; i < directions.size(); ++i) directions[i] = onto(towards, mesh.normals[i]);
  const std::vector<glm::vec3> own = directions;
  for (int round = 0; round < kRounds / 4; ++round) {
    std::fill(sum.begin(), sum.end(), glm::vec3(0.0f));
    for (const auto& [a, b] : mesh.edges) sum[a] += directions[b], sum[b] += directions[a];
    for (size_t i = 0; i < directions.size(); ++i) {
      const glm::vec3 mixed = own[i] + 0.2f * onto(sum[i], mesh.normals[i]);
      const float length = glm::length(mixed);
      directions[i] = length > 1e-6f ? mixed / std::max(length, 1.0f) : across(mesh.normals[i]);
    }
  }
  for (glm::vec3& d : directions) d = glm::normalize(d);
  return mesh.fieldOf(directions);
}

}  // namespace scumble::paint
