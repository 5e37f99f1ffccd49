#include "scene/mesh_edges.h"

#include <algorithm>
#include <cstdlib>

#include "scene/position_weld.h"

namespace scumble::scene {

namespace {

// A triangle's edge, from the vertex with the lower number to the other one, by places.
struct HalfEdge {
  uint32_t high;    // place
  uint32_t corner;  // index of where it begins, in the indices
  bool isForward;   // the triangle goes from the lower to the higher one
};

uint32_t nextCorner(uint32_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

// What differs by less is a gradient that two triangles share.
constexpr int kLeastBorder = 24;  // of 255

bool areUnlike(const glm::u8vec4& a, const glm::u8vec4& b) {
  const auto apart = [](uint8_t x, uint8_t y) { return std::abs(int(x) - int(y)); };
  return std::max({apart(a.r, b.r), apart(a.g, b.g), apart(a.b, b.b)}) >= kLeastBorder;
}

glm::u8vec4 colorOf(const Primitive& primitive, uint32_t vertex) {
  return primitive.colors.empty() ? glm::u8vec4(255) : primitive.colors[vertex];
}

// Whether colours differ at both ends of an edge that goes from a to b, and in the other primitive from c to
// d.
bool isColorBorder(const Primitive& left, uint32_t a, uint32_t b, const Primitive& right, uint32_t c,
                   uint32_t d) {
  return areUnlike(colorOf(left, a), colorOf(right, d)) && areUnlike(colorOf(left, b), colorOf(right, c));
}

}  // namespace

std::vector<MeshEdge> edgesOf(const Primitive& primitive) {
  const std::vector<uint32_t>& indices = primitive.indices;
  const Primitive* const one[] = {&primitive};
  const std::vector<uint32_t> place = firstAtPlaces(primitive.positions, gridOf(one));
  const auto placeOf = [&](uint32_t corner) { return place[indices[corner]]; };
  const auto hasArea = [&](uint32_t corner) {
    const uint32_t first = corner - corner % 3;
    const uint32_t a = placeOf(first), b = placeOf(first + 1), c = placeOf(first + 2);
    return a != b && b != c && c != a;
  };

  // By their lower end, in one array.
  std::vector<uint32_t> begin(primitive.positions.size() + 1, 0);
  for (uint32_t c = 0; c < indices.size(); ++c)
    if (hasArea(c)) ++begin[std::min(placeOf(c), placeOf(nextCorner(c))) + 1];
  for (size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
  std::vector<HalfEdge> halves(begin.back());
  std::vector<uint32_t> filled(begin.begin(), begin.end() - 1);
  for (uint32_t c = 0; c < indices.size(); ++c) {
    if (!hasArea(c)) continue;
    const uint32_t from = placeOf(c), to = placeOf(nextCorner(c));
    halves[filled[std::min(from, to)]++] = {std::max(from, to), c, from < to};
  }
  filled = {};

  std::vector<MeshEdge> edges;
  edges.reserve(indices.size() / 2 + 8);
  std::vector<uint32_t> across(indices.size(),
                               MeshEdge::kNone);  // by corner, what lies across the edge there
  const auto third = [&](const HalfEdge& half) { return nextCorner(nextCorner(half.corner)); };
  const auto add = [&](const HalfEdge& left, const HalfEdge* right) {
    MeshEdge edge{indices[left.corner], indices[nextCorner(left.corner)], indices[third(left)]};
    edge.beyond[0] = left.corner;  // until all are known
    if (!primitive.roundness.empty()) edge.kinds |= kRoundnessKnown;
    if (right) {
      edge.right = indices[third(*right)];
      edge.beyond[2] = right->corner;
      across[left.corner] = edge.right, across[right->corner] = edge.left;
      if (isColorBorder(primitive, edge.a, edge.b, primitive, indices[right->corner],
                        indices[nextCorner(right->corner)]))
        edge.kinds |= kColorBorder;
    }
    edges.push_back(edge);
  };
  std::vector<const HalfEdge*> forward, backward;
  for (size_t v = 0; v + 1 < begin.size(); ++v) {
    const auto first = halves.begin() + begin[v], last = halves.begin() + begin[v + 1];
    std::sort(first, last, [](const HalfEdge& x, const HalfEdge& y) {
      return x.high != y.high ? x.high < y.high : x.corner < y.corner;
    });
    for (auto group = first; group != last;) {
      const auto end = std::find_if(group, last, [&](const HalfEdge& h) { return h.high != group->high; });
      if (end - group == 2 && group[0].isForward != group[1].isForward &&
          placeOf(third(group[0])) != placeOf(third(group[1]))) {
        add(group[0], &group[1]);
      } else {
        forward.clear(), backward.clear();
        for (auto half = group; half != end; ++half) {
          const auto isSame = [&](const HalfEdge& other) {
            return placeOf(third(other)) == placeOf(third(*half));
          };
          if (std::any_of(group, half, isSame)) continue;
          (half->isForward ? forward : backward).push_back(&*half);
        }
        for (size_t i = 0; i < std::max(forward.size(), backward.size()); ++i) {
          if (i < forward.size())
            add(*forward[i], i < backward.size() ? backward[i] : nullptr);
          else
            add(*backward[i], nullptr);
        }
      }
      group = end;
    }
  }
  for (MeshEdge& edge : edges)
    for (const int side : {0, 2}) {
      const uint32_t corner = edge.beyond[side];
      if (corner == MeshEdge::kNone) continue;
      edge.beyond[side] = across[nextCorner(corner)];
      edge.beyond[side + 1] = across[nextCorner(nextCorner(corner))];
    }
  return edges;
}

std::vector<SharedEdge> sharedEdges(std::span<const Primitive* const> primitives,
                                    std::span<const std::vector<MeshEdge>* const> edges) {
  // Ends of open edges, as places in all primitives.
  struct Open {
    uint32_t low, high;  // places
    uint32_t primitive, edge;
    bool isForward;
  };
  const PositionGrid grid = gridOf(primitives);
  std::vector<glm::vec3> ends;
  std::vector<Open> open;
  for (uint32_t p = 0; p < primitives.size(); ++p)
    for (uint32_t e = 0; e < edges[p]->size(); ++e) {
      const MeshEdge& edge = (*edges[p])[e];
      if (edge.right != MeshEdge::kNone) continue;
      ends.push_back(primitives[p]->positions[edge.a]);
      ends.push_back(primitives[p]->positions[edge.b]);
      open.push_back({0, 0, p, e, true});
    }
  const std::vector<uint32_t> place = firstAtPlaces(ends, grid);
  for (size_t i = 0; i < open.size(); ++i) {
    const uint32_t a = place[2 * i], b = place[2 * i + 1];
    open[i].low = std::min(a, b), open[i].high = std::max(a, b), open[i].isForward = a < b;
  }
  std::stable_sort(open.begin(), open.end(), [](const Open& x, const Open& y) {
    return x.low != y.low ? x.low < y.low : x.high < y.high;
  });

  std::vector<SharedEdge> shared;
  for (auto group = open.begin(); group != open.end();) {
    const auto end = std::find_if(group, open.end(), [&](const Open& other) {
      return other.low != group->low || other.high != group->high;
    });
    std::vector<bool> isTaken(size_t(end - group), false);
    for (auto one = group; one != end; ++one)
      for (auto other = one + 1; other != end && !isTaken[size_t(one - group)]; ++other) {
        if (isTaken[size_t(other - group)] || one->isForward == other->isForward ||
            one->primitive == other->primitive)
          continue;
        isTaken[size_t(one - group)] = isTaken[size_t(other - group)] = true;
        const Primitive &left = *primitives[one->primitive], &right = *primitives[other->primitive];
        const MeshEdge &edge = (*edges[one->primitive])[one->edge],
                       &back = (*edges[other->primitive])[other->edge];
        const bool isBorder = isColorBorder(left, edge.a, edge.b, right, back.a, back.b);
        shared.push_back({one->primitive, other->primitive, one->edge, other->edge,
                          isBorder ? uint32_t(kColorBorder) : 0u});
      }
    group = end;
  }
  return shared;
}

}  // namespace scumble::scene
