#include "bake/proxy.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

#include "scene/position_weld.h"

namespace scumble::bake {

namespace {

// Two triangles make a rectangle if they lie as flat as this, and its corners differ from right angles by no
// more than that in all (radians).
constexpr float kNearlyFlat = 0.9f, kMostSkew = 2.2f;
// What any field must begin with; no axis, since models have edges along those.
const glm::vec3 kFieldDirection = glm::normalize(glm::vec3(0.21f, -0.94f, 0.27f));
// Of a unit vector laid onto a plane: less, and it says nothing.
constexpr float kFieldVanishes = 0.2f;

// The move that takes the edge p-q onto the edge p2-q2.
FlatMove moveBetween(const glm::vec2& p, const glm::vec2& q, const glm::vec2& p2, const glm::vec2& q2) {
  const glm::vec2 from = q - p, to = q2 - p2;
  const float size = glm::length(from) * glm::length(to);
  FlatMove move;
  if (size > 0) move.turn = glm::vec2(from.x * to.x + from.y * to.y, from.x * to.y - from.y * to.x) / size;
  move.shift = p2 - move.turned(p);
  return move;
}

float angleAt(const glm::vec3& corner, const glm::vec3& a, const glm::vec3& b) {
  const glm::vec3 u = unitOr({1, 0, 0}, a - corner), v = unitOr({1, 0, 0}, b - corner);
  return std::acos(glm::clamp(glm::dot(u, v), -1.0f, 1.0f));
}

class Maker {
 public:
  explicit Maker(const scene::Mesh& mesh) {
    for (const scene::Primitive& p : mesh.primitives) proxy_.primitives.push_back(&p);
  }

  Proxy make() {
    weld();
    findNormals();
    findEdges();
    findCharts();
    findMoves();
    findField();
    return std::move(proxy_);
  }

 private:
  const glm::vec3& corner(const ProxyTriangle& t, int i) const { return proxy_.places[t.places[i]]; }

  void weld() {
    const scene::PositionGrid grid = scene::gridOf(proxy_.primitives);
    size_t count = 0;
    for (const scene::Primitive* p : proxy_.primitives) count += p->positions.size();
    scene::PositionTable table(count);
    for (uint32_t p = 0; p < proxy_.primitives.size(); ++p) {
      const scene::Primitive& primitive = *proxy_.primitives[p];
      std::vector<uint32_t> placeOf(primitive.positions.size());
      for (size_t v = 0; v < placeOf.size(); ++v) {
        const auto next = uint32_t(proxy_.places.size());
        placeOf[v] = table.findOrAdd(grid(primitive.positions[v]), next,
                                     [&](uint32_t stored) { return grid(proxy_.places[stored]); });
        if (placeOf[v] == next) proxy_.places.push_back(primitive.positions[v]);
      }
      std::vector<int>& numbers = proxy_.triangleOf.emplace_back(primitive.indices.size() / 3, -1);
      for (size_t i = 0; i + 2 < primitive.indices.size() && !primitive.isPaint; i += 3) {
        ProxyTriangle t;
        t.primitive = p;
        for (int c = 0; c < 3; ++c)
          t.vertices[c] = primitive.indices[i + size_t(c)], t.places[c] = placeOf[t.vertices[c]];
        const glm::vec3 ab = corner(t, 1) - corner(t, 0), ac = corner(t, 2) - corner(t, 0);
        const glm::vec3 face = glm::cross(ab, ac);
        const float longest = std::max({glm::length(ab), glm::length(ac), glm::length(ac - ab)});
        if (!(glm::length(face) > 1e-5f * longest * longest)) continue;
        t.normal = glm::normalize(face);
        numbers[i / 3] = int(proxy_.triangles.size());
        proxy_.triangles.push_back(t);
      }
    }
  }

  void findNormals() {
    proxy_.normals.assign(proxy_.places.size(), glm::vec3(0));
    proxy_.trianglesAt.resize(proxy_.places.size());
    for (uint32_t t = 0; t < proxy_.triangles.size(); ++t)
      for (int c = 0; c < 3; ++c) {
        const ProxyTriangle& triangle = proxy_.triangles[t];
        const float angle =
            angleAt(corner(triangle, c), corner(triangle, (c + 1) % 3), corner(triangle, (c + 2) % 3));
        proxy_.normals[triangle.places[c]] += angle * triangle.normal;
        proxy_.trianglesAt[triangle.places[c]].push_back(t);
      }
    for (size_t p = 0; p < proxy_.normals.size(); ++p)
      proxy_.normals[p] =
          unitOr(proxy_.trianglesAt[p].empty() ? glm::vec3(0, 1, 0)
                                               : proxy_.triangles[proxy_.trianglesAt[p][0]].normal,
                 proxy_.normals[p]);
  }

  void findEdges() {
    struct Side {
      uint32_t triangle;
      int edge;
    };
    std::map<std::pair<uint32_t, uint32_t>, std::array<std::vector<Side>, 2>> sides;  // by winding
    for (uint32_t t = 0; t < proxy_.triangles.size(); ++t)
      for (int e = 0; e < 3; ++e) {
        const uint32_t a = proxy_.triangles[t].places[e], b = proxy_.triangles[t].places[(e + 1) % 3];
        if (a != b) sides[std::minmax(a, b)][a < b ? 0 : 1].push_back({t, e});
      }
    proxy_.edgesAt.resize(proxy_.places.size());
    for (const auto& [ends, both] : sides) {
      ProxyEdge edge{ends.first, ends.second};
      const size_t first = both[0].empty() ? 1 : 0;
      if (first == 1) std::swap(edge.a, edge.b);
      const Side& own = both[first][0];
      edge.triangles[0] = int(own.triangle);
      if (both[0].size() == 1 && both[1].size() == 1) {
        const Side& other = both[1][0];
        edge.triangles[1] = int(other.triangle);
        proxy_.triangles[own.triangle].across[size_t(own.edge)] = int(other.triangle);
        proxy_.triangles[other.triangle].across[size_t(other.edge)] = int(own.triangle);
      }
      const auto number = uint32_t(proxy_.edges.size());
      proxy_.edges.push_back(edge);
      proxy_.edgesAt[edge.a].push_back(number);
      proxy_.edgesAt[edge.b].push_back(number);
    }
  }

  uint32_t thirdPlace(int triangle, const ProxyEdge& edge) const {
    const glm::uvec3& places = proxy_.triangles[size_t(triangle)].places;
    for (int c = 0; c < 3; ++c)
      if (places[c] != edge.a && places[c] != edge.b) return places[c];
    return edge.a;
  }

  // How far two triangles are from a rectangle; above kMostSkew where they are none.
  float skewOf(const ProxyEdge& edge) const {
    if (edge.triangles[1] < 0) return INFINITY;
    const ProxyTriangle &first = proxy_.triangles[size_t(edge.triangles[0])],
                        &second = proxy_.triangles[size_t(edge.triangles[1])];
    if (first.primitive != second.primitive || glm::dot(first.normal, second.normal) < kNearlyFlat)
      return INFINITY;
    const glm::vec3 &a = proxy_.places[edge.a], &b = proxy_.places[edge.b],
                    &c = proxy_.places[thirdPlace(edge.triangles[0], edge)],
                    &d = proxy_.places[thirdPlace(edge.triangles[1], edge)];
    const float right = 1.5707963f;
    return std::abs(angleAt(a, b, c) + angleAt(a, b, d) - right) +
           std::abs(angleAt(b, a, c) + angleAt(b, a, d) - right) + std::abs(angleAt(c, a, b) - right) +
           std::abs(angleAt(d, a, b) - right);
  }

  void findCharts() {
    std::vector<std::pair<float, uint32_t>> candidates;
    for (uint32_t e = 0; e < proxy_.edges.size(); ++e)
      if (const float skew = skewOf(proxy_.edges[e]); skew < kMostSkew) candidates.emplace_back(skew, e);
    std::sort(candidates.begin(), candidates.end());
    std::vector<bool> taken(proxy_.triangles.size());
    for (const auto& [skew, e] : candidates) {
      ProxyEdge& edge = proxy_.edges[e];
      const auto first = size_t(edge.triangles[0]), second = size_t(edge.triangles[1]);
      if (taken[first] || taken[second]) continue;
      taken[first] = taken[second] = true;
      edge.isDiagonal = true;
      addChart({int(first), int(second)});
    }
    for (size_t t = 0; t < taken.size(); ++t)
      if (!taken[t]) addChart({int(t), -1});
  }

  // Lays triangles into a plane whose x runs along one of their edges, so that their box is small.
  void addChart(const std::array<int, 2>& triangles) {
    Chart chart;
    chart.triangles = triangles;
    ProxyTriangle& first = proxy_.triangles[size_t(triangles[0])];
    layOut(first, unitOr({1, 0, 0}, corner(first, 1) - corner(first, 0)));
    if (triangles[1] >= 0) {
      ProxyTriangle& second = proxy_.triangles[size_t(triangles[1])];
      layOut(second, unitOr({1, 0, 0}, corner(second, 1) - corner(second, 0)));
      // Beside the first, at the edge they share.
      for (size_t e = 0; e < 3; ++e)
        for (size_t o = 0; o < 3; ++o)
          if (first.across[e] == triangles[1] && second.across[o] == triangles[0])
            turn(second, moveBetween(second.flat[(o + 1) % 3], second.flat[o], first.flat[e],
                                     first.flat[(e + 1) % 3]));
    }
    const auto members = [&](const auto& body) {
      for (const int t : triangles)
        if (t >= 0) body(proxy_.triangles[size_t(t)]);
    };
    float best = INFINITY;
    FlatMove chosen;
    members([&](const ProxyTriangle& along) {
      for (size_t e = 0; e < 3; ++e) {
        const glm::vec2 edge = along.flat[(e + 1) % 3] - along.flat[e];
        const float length = glm::length(edge);
        if (!(length > 0)) continue;
        const FlatMove move{{edge.x / length, -edge.y / length}, {0, 0}};
        glm::vec2 low(INFINITY), high(-INFINITY);
        members([&](const ProxyTriangle& t) {
          for (const glm::vec2& p : t.flat) low = glm::min(low, move(p)), high = glm::max(high, move(p));
        });
        const float size = (high.x - low.x) * (high.y - low.y);
        if (size < best * 0.9999f) best = size, chosen = move, chart.low = low, chart.high = high;
      }
    });
    members([&](ProxyTriangle& t) {
      turn(t, chosen);
      t.chart = uint32_t(proxy_.charts.size());
    });
    proxy_.charts.push_back(chart);
  }

  void layOut(ProxyTriangle& t, const glm::vec3& x) const {
    t.axisX = x;
    t.axisY = glm::cross(t.normal, x);
    for (int c = 0; c < 3; ++c) {
      const glm::vec3 from = corner(t, c) - corner(t, 0);
      t.flat[size_t(c)] = {glm::dot(from, t.axisX), glm::dot(from, t.axisY)};
    }
  }

  static void turn(ProxyTriangle& t, const FlatMove& move) {
    for (glm::vec2& p : t.flat) p = move(p);
    const glm::vec3 x = t.axisX, y = t.axisY;
    t.axisX = move.turn.x * x - move.turn.y * y;
    t.axisY = move.turn.y * x + move.turn.x * y;
  }

  void findMoves() {
    for (size_t t = 0; t < proxy_.triangles.size(); ++t) {
      ProxyTriangle& triangle = proxy_.triangles[t];
      for (size_t e = 0; e < 3; ++e) {
        if (triangle.across[e] < 0) continue;
        const ProxyTriangle& other = proxy_.triangles[size_t(triangle.across[e])];
        for (size_t o = 0; o < 3; ++o)
          if (other.across[o] == int(t) && other.places[int(o)] == triangle.places[int(e + 1) % 3])
            triangle.into[e] = moveBetween(triangle.flat[e], triangle.flat[(e + 1) % 3],
                                           other.flat[(o + 1) % 3], other.flat[o]);
      }
    }
  }

  // (Paper 003, section 3.2: one arbitrary vector laid onto each face, and the neighbours' where that
  // vanishes.)
  void findField() {
    std::vector<bool> known(proxy_.triangles.size());
    std::deque<size_t> next;
    const auto begin = [&](size_t t, const glm::vec2& direction) {
      proxy_.triangles[t].field = direction;
      known[t] = true;
      next.push_back(t);
    };
    const auto spread = [&] {
      for (; !next.empty(); next.pop_front()) {
        const ProxyTriangle& from = proxy_.triangles[next.front()];
        for (size_t e = 0; e < 3; ++e)
          if (from.across[e] >= 0 && !known[size_t(from.across[e])])
            begin(size_t(from.across[e]), from.into[e].turned(from.field));
      }
    };
    for (size_t t = 0; t < known.size(); ++t) {
      const ProxyTriangle& triangle = proxy_.triangles[t];
      const glm::vec2 laid(glm::dot(kFieldDirection, triangle.axisX),
                           glm::dot(kFieldDirection, triangle.axisY));
      if (glm::length(laid) > kFieldVanishes) begin(t, glm::normalize(laid));
    }
    spread();
    for (size_t t = 0; t < known.size(); ++t)
      if (!known[t]) begin(t, {1, 0}), spread();
  }

  Proxy proxy_;
};

}  // namespace

Proxy makeProxy(const scene::Mesh& mesh) {
  return Maker(mesh).make();
}

}  // namespace scumble::bake
