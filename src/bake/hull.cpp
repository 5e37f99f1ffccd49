#include "bake/hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <unordered_set>

#include "scene/splat_places.h"

namespace scumble::bake {

namespace {

constexpr float kAway =
    1.6f;  // cells from the strokes, where the surface is found before it is laid onto them
constexpr float kLaidOn = 0.95f;  // how much of that way it goes back
constexpr int kBorder = 4;        // cells around everything

// Distances from strokes on a grid, in cells, and the surface that is found in them (Gibson 1998, naive
// surface nets).
class Grid {
 public:
  Grid(const scene::Bounds& box, uint32_t cells) {
    const glm::vec3 size = box.max - box.min;
    cell_ = std::max(std::max({size.x, size.y, size.z}) / float(cells), 1e-9f);
    origin_ = box.min - float(kBorder) * cell_;
    count_ = glm::ivec3(glm::ceil(size / cell_)) + 2 * kBorder + 1;
    distances_.assign(size_t(count_.x) * size_t(count_.y) * size_t(count_.z), kFar);
  }

  // A place that paint covers.
  void cover(const glm::vec3& place) {
    const glm::vec3 p = (place - origin_) / cell_;
    // Twice at one place changes nothing.
    const glm::ivec3 half(glm::floor(2.0f * p));
    if (!covered_
             .insert((uint64_t(uint32_t(half.x)) << 42) ^ (uint64_t(uint32_t(half.y)) << 21) ^
                     uint32_t(half.z))
             .second)
      return;
    const glm::ivec3 low = glm::max(glm::ivec3(glm::floor(p - kFar)), glm::ivec3(0)),
                     high = glm::min(glm::ivec3(glm::ceil(p + kFar)), count_ - 1);
    for (int z = low.z; z <= high.z; ++z)
      for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) {
          float& d = distances_[at({x, y, z})];
          d = std::min(d, glm::distance(p, glm::vec3(x, y, z)));
        }
  }

  scene::Primitive surface() {
    fillInside();
    scene::Primitive primitive;
    std::vector<int> vertexOf(distances_.size(), -1);
    std::vector<glm::vec3> found;  // in cells
    for (int z = 0; z + 1 < count_.z; ++z)
      for (int y = 0; y + 1 < count_.y; ++y)
        for (int x = 0; x + 1 < count_.x; ++x) {
          glm::vec3 sum(0);
          int crossings = 0;
          for (const auto& [from, axis] : kEdges) {
            const glm::ivec3 a = glm::ivec3(x, y, z) + from;
            glm::ivec3 b = a;
            ++b[axis];
            const float fa = value(a), fb = value(b);
            if ((fa < 0) == (fb < 0)) continue;
            glm::vec3 crossing(a);
            crossing[axis] += fa / (fa - fb);
            sum += crossing;
            ++crossings;
          }
          if (crossings == 0) continue;
          vertexOf[at({x, y, z})] = int(found.size());
          found.push_back(sum / float(crossings));
        }
    for (int z = 1; z + 1 < count_.z; ++z)
      for (int y = 1; y + 1 < count_.y; ++y)
        for (int x = 1; x + 1 < count_.x; ++x)
          for (int axis = 0; axis < 3; ++axis) {
            const glm::ivec3 a(x, y, z);
            glm::ivec3 b = a;
            ++b[axis];
            const bool isInside = value(a) < 0;
            if (isInside == (value(b) < 0)) continue;
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            std::array<int, 4> quad{};
            for (int i = 0; i < 4; ++i) {
              glm::ivec3 c = a;
              c[u] -= i == 1 || i == 2 ? 0 : 1;
              c[v] -= i >= 2 ? 0 : 1;
              quad[size_t(i)] = vertexOf[at(c)];
            }
            if (!isInside) std::swap(quad[1], quad[3]);
            addQuad(found, quad, primitive.indices);
          }
    for (const glm::vec3& p : found) {
      const glm::vec3 slope = gradientAt(p);
      const float steep = glm::length(slope);
      const glm::vec3 laid = steep > 1e-6f ? p - slope / steep * (kLaidOn * kAway) : p;
      primitive.positions.push_back(origin_ + laid * cell_);
      primitive.normals.push_back(steep > 1e-6f ? slope / steep : glm::vec3(0, 1, 0));
    }
    primitive.uv0.resize(primitive.positions.size());
    return primitive;
  }

 private:
  static constexpr float kFar = kAway + 1.5f;  // cells: farther is as far
  struct Edge {
    glm::ivec3 from;
    int axis;
  };
  static const std::array<Edge, 12> kEdges;

  size_t at(const glm::ivec3& p) const {
    return (size_t(p.z) * size_t(count_.y) + size_t(p.y)) * size_t(count_.x) + size_t(p.x);
  }
  float value(const glm::ivec3& p) const { return distances_[at(p)] - kAway; }

  // What cannot be come to from outside is inside, however far from strokes.
  void fillInside() {
    std::vector<uint8_t> isOutside(distances_.size());
    std::deque<glm::ivec3> next{glm::ivec3(0)};
    isOutside[0] = 1;
    for (; !next.empty(); next.pop_front())
      for (int axis = 0; axis < 3; ++axis)
        for (const int step : {-1, 1}) {
          glm::ivec3 p = next.front();
          p[axis] += step;
          if (p[axis] < 0 || p[axis] >= count_[axis]) continue;
          uint8_t& here = isOutside[at(p)];
          if (here || value(p) < 0) continue;
          here = 1;
          next.push_back(p);
        }
    for (size_t i = 0; i < distances_.size(); ++i)
      if (!isOutside[i]) distances_[i] = std::min(distances_[i], kAway - 0.5f);
  }

  float valueAt(const glm::vec3& p) const {
    const glm::ivec3 cell = glm::clamp(glm::ivec3(glm::floor(p)), glm::ivec3(0), count_ - 2);
    const glm::vec3 t = p - glm::vec3(cell);
    float sum = 0;
    for (int i = 0; i < 8; ++i) {
      const glm::ivec3 corner(i & 1, i >> 1 & 1, i >> 2);
      float weight = 1;
      for (int axis = 0; axis < 3; ++axis) weight *= corner[axis] ? t[axis] : 1 - t[axis];
      sum += weight * value(cell + corner);
    }
    return sum;
  }
  glm::vec3 gradientAt(const glm::vec3& p) const {
    glm::vec3 slope;
    for (int axis = 0; axis < 3; ++axis) {
      glm::vec3 step(0);
      step[axis] = 0.7f;
      slope[axis] = valueAt(p + step) - valueAt(p - step);
    }
    return slope;
  }

  static void addQuad(const std::vector<glm::vec3>& places, const std::array<int, 4>& quad,
                      std::vector<uint32_t>& indices) {
    const auto place = [&](size_t i) { return places[size_t(quad[i])]; };
    // Along the shorter diagonal.
    const size_t first = glm::distance(place(0), place(2)) <= glm::distance(place(1), place(3)) ? 0 : 1;
    for (const size_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
      indices.push_back(uint32_t(quad[(first + corner) % 4]));
  }

  glm::vec3 origin_{0};
  float cell_ = 1;
  glm::ivec3 count_{0};
  std::vector<float> distances_;
  std::unordered_set<uint64_t> covered_;
};

const std::array<Grid::Edge, 12> Grid::kEdges = {{{{0, 0, 0}, 0},
                                                  {{0, 1, 0}, 0},
                                                  {{0, 0, 1}, 0},
                                                  {{0, 1, 1}, 0},
                                                  {{0, 0, 0}, 1},
                                                  {{1, 0, 0}, 1},
                                                  {{0, 0, 1}, 1},
                                                  {{1, 0, 1}, 1},
                                                  {{0, 0, 0}, 2},
                                                  {{1, 0, 0}, 2},
                                                  {{0, 1, 0}, 2},
                                                  {{1, 1, 0}, 2}}};

}  // namespace

scene::Primitive hullOf(const scene::Painting& painting, uint32_t cells) {
  if (painting.points.empty()) return {};
  scene::Bounds box;
  for (const scene::StrokePoint& p : painting.points) {
    box.add(p.position - p.radius);
    box.add(p.position + p.radius);
  }
  Grid grid(box, cells);
  const glm::vec3 size = box.max - box.min;
  const float step = 0.5f * std::max({size.x, size.y, size.z}) / float(cells);
  std::vector<float> along;
  for (const scene::SplatPlace& place : scene::splatPlaces(painting, along)) {
    const scene::StrokePoint& a = painting.points[place.point];
    const scene::StrokePoint& b = painting.points[place.point + (place.toNext > 0 ? 1 : 0)];
    const glm::vec3 middle = glm::mix(a.position, b.position, place.toNext);
    const float radius = glm::mix(a.radius, b.radius, place.toNext);
    // A brush leaves a band as wide as it is, across the way it goes.
    const glm::vec3 way = b.position - a.position,
                    across = glm::cross(a.orientation * glm::vec3(0, 0, 1), way);
    const float length = glm::length(across);
    const glm::vec3 side = length > 1e-12f ? across / length : a.orientation * glm::vec3(1, 0, 0);
    const int steps = std::min(int(radius / step), 64);
    for (int i = -steps; i <= steps; ++i)
      grid.cover(middle + side * (steps > 0 ? radius * float(i) / float(steps + 1) : 0.0f));
  }
  return grid.surface();
}

}  // namespace scumble::bake
