#include "scene/unfolding.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>

#include "scene/position_weld.h"

namespace scumble::scene {

namespace {

constexpr uint32_t kUnlaid = 0xffffffffu;
constexpr float kMostStretch = 4;
constexpr float kSameCopy =
    1.2f;  // of the side of a square as large as two of it: how far a triangle's corner may be off
constexpr float kCreaseCost = 20;  // how much farther it is over an edge of 90 degrees
constexpr int kRelaxations = 16;
constexpr int kRounds = 16;        // of taking back
constexpr size_t kMostSides = 16;  // of an edge; where there are more nothing goes on
constexpr uint32_t kTries = 64;    // copies of a place that are compared: around it there may be thousands

// Where a triangle's corners lie in its own plane: the first at the origin, the second on the axis x.
struct Flat {
  float length = 0;  // of the first edge
  float along = 0;   // of the third corner, in lengths of that edge
  float height = 0;
  bool isSound() const { return length > 0 && std::isfinite(along) && std::isfinite(height); }
};

Flat flat(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::vec3 edge = b - a, side = c - a;
  const float squared = glm::dot(edge, edge);
  Flat f;
  f.length = std::sqrt(squared);
  f.along = glm::dot(side, edge) / squared;
  f.height = glm::length(side - f.along * edge);
  return f;
}

// Of which nobody would see how it lies.
bool isThin(const Flat& f) {
  return f.height < 1e-5f * f.length;
}

// Whether such a triangle may lie so: not mirrored, and nowhere stretched or squeezed too much.
bool mayLie(const Flat& f, const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
  const glm::vec2 x = (b - a) / f.length, y = (c - a - f.along * (b - a)) / f.height;
  const float det = x.x * y.y - x.y * y.x, sum = glm::dot(x, x) + glm::dot(y, y);
  const float difference = std::sqrt(std::max(sum * sum - 4 * det * det, 0.0f));
  return det > 0 && sum + difference < 2 * kMostStretch * kMostStretch &&
         (sum - difference) * kMostStretch * kMostStretch > 2;
}

class Unfolder {
 public:
  Unfolder(const Primitive& p, float scale) : p_(p), count_(p.indices.size() / 3) {
    findPlaces(scale);
    findNeighbours();
  }

  Unfolding unfold() {
    layAll();
    relax();
    return result();
  }

 private:
  // A place as it lies in a piece; the same place may lie in several, and in one several times.
  struct Copy {
    glm::vec2 uv;
    uint32_t next;  // of the same place, or kUnlaid
    uint32_t piece;
  };
  // A half edge, by the number of the corner where it begins, over which a triangle could be laid.
  struct Front {
    float distance;
    uint32_t half;
    bool operator>(const Front& other) const {
      return distance != other.distance ? distance > other.distance : half > other.half;
    }
  };

  // A triangle as it is, and where it lies.
  struct Form {
    Flat own;
    uint32_t copies[3];
  };

  static uint32_t following(uint32_t half) { return half % 3 == 2 ? half - 2 : half + 1; }
  const glm::vec3& at(uint32_t half) const { return positions_[p_.indices[half]]; }

  void findPlaces(float scale) {
    positions_.resize(p_.vertexCount());
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (size_t v = 0; v < positions_.size(); ++v) {
      positions_[v] = p_.positions[v] * scale;
      low = glm::min(low, positions_[v]), high = glm::max(high, positions_[v]);
    }
    const glm::vec3 extent = high - low;
    size_ = std::max({extent.x, extent.y, extent.z, 1e-30f});
    const std::vector<uint32_t> ofVertex = firstAtPlaces(positions_, PositionGrid(1 / size_));
    place_.resize(p_.indices.size());
    for (size_t i = 0; i < place_.size(); ++i) place_[i] = ofVertex[p_.indices[i]];
    normals_.resize(count_);
    areas_.resize(count_);
    for (uint32_t t = 0; t < count_; ++t) {
      const glm::vec3 across = glm::cross(at(3 * t + 1) - at(3 * t), at(3 * t + 2) - at(3 * t));
      const float length = glm::length(across);
      areas_[t] = std::isfinite(length) ? 0.5f * length : 0.0f;
      normals_[t] = areas_[t] > 0 ? across / length : glm::vec3(0.0f);
    }
  }

  bool isSliver(uint32_t t) const {
    const uint32_t* const places = &place_[3 * t];
    return places[0] == places[1] || places[1] == places[2] || places[2] == places[0];
  }

  void findNeighbours() {
    struct Edge {
      uint64_t ends;
      uint32_t half;
      bool operator<(const Edge& other) const {
        return ends != other.ends ? ends < other.ends : half < other.half;
      }
    };
    std::vector<Edge> edges;
    edges.reserve(place_.size());
    for (uint32_t half = 0; half < place_.size(); ++half) {
      if (isSliver(half / 3)) continue;
      const uint32_t a = place_[half], b = place_[following(half)];
      edges.push_back({uint64_t(std::min(a, b)) << 32 | std::max(a, b), half});
    }
    std::sort(edges.begin(), edges.end());
    twins_.assign(place_.size(), kUnlaid);
    for (size_t first = 0, last = 0; first < edges.size(); first = last) {
      while (last < edges.size() && edges[last].ends == edges[first].ends) ++last;
      if (last - first > kMostSides) continue;
      // Each with the one the other way around that is turned least: not with the back of what it lies on.
      for (size_t i = first; i < last; ++i) {
        const uint32_t one = edges[i].half;
        if (twins_[one] != kUnlaid) continue;
        float least = -2;
        uint32_t found = kUnlaid;
        for (size_t k = i + 1; k < last; ++k) {
          const uint32_t other = edges[k].half;
          if (twins_[other] != kUnlaid || place_[one] == place_[other]) continue;
          const float alike = glm::dot(normals_[one / 3], normals_[other / 3]);
          if (alike > least) least = alike, found = other;
        }
        if (found != kUnlaid) twins_[one] = found, twins_[found] = one;
      }
    }
  }

  void layAll() {
    std::vector<uint32_t> bySize(count_);
    std::iota(bySize.begin(), bySize.end(), 0u);
    std::stable_sort(bySize.begin(), bySize.end(),
                     [&](uint32_t a, uint32_t b) { return areas_[a] > areas_[b]; });
    copy_.assign(place_.size(), kUnlaid);
    firstCopy_.assign(p_.vertexCount(), kUnlaid);
    for (const uint32_t seed : bySize) {
      if (copy_[3 * seed] != kUnlaid || isSliver(seed)) continue;
      begin(seed);
      while (!front_.empty()) {
        const Front next = front_.top();
        front_.pop();
        if (copy_[next.half] == kUnlaid && lay(next.half)) spread(next.half / 3, next.distance);
      }
      ++piece_;
    }
    for (uint32_t half = 0; half < copy_.size(); ++half)
      if (copy_[half] == kUnlaid) {
        const uint32_t lies = firstCopy_[place_[half]];
        copy_[half] = lies != kUnlaid ? lies : addCopy(place_[half], glm::vec2(0.0f));
      }
  }

  uint32_t addCopy(uint32_t place, const glm::vec2& uv) {
    copies_.push_back({uv, firstCopy_[place], piece_});
    return firstCopy_[place] = uint32_t(copies_.size() - 1);
  }

  void begin(uint32_t t) {
    // Upright where the surface is; what lies on the ground or on its back has u along x.
    const glm::vec3& normal = normals_[t];
    glm::vec3 along = glm::cross(glm::vec3(0, 1, 0), normal);
    if (glm::length(along) < 0.1f) along = glm::vec3(1, 0, 0) - normal.x * normal;
    along = glm::length(along) > 0 ? glm::normalize(along) : glm::vec3(1, 0, 0);
    const glm::vec3 upward = glm::cross(normal, along);
    // Pieces begin at different places of a pattern, no farther apart than what keeps the digits of small
    // ones.
    const glm::vec2 shift =
        size_ * glm::vec2(glm::fract(0.618034f * float(piece_)), glm::fract(0.754878f * float(piece_)));
    for (uint32_t half = 3 * t; half < 3 * t + 3; ++half) {
      const glm::vec3 off = at(half) - at(3 * t);
      const glm::vec2 uv(glm::dot(off, along), glm::dot(off, upward));
      copy_[half] = addCopy(place_[half], shift + uv);
    }
    spread(t, 0);
  }

  // Goes on from a triangle that has been laid.
  void spread(uint32_t t, float distance) {
    laid_.push_back(t);
    const auto middle = [&](uint32_t of) { return (at(3 * of) + at(3 * of + 1) + at(3 * of + 2)) / 3.0f; };
    for (uint32_t half = 3 * t; half < 3 * t + 3; ++half) {
      const uint32_t twin = twins_[half];
      if (twin == kUnlaid || copy_[twin] != kUnlaid) continue;
      const float turn = 1 - glm::dot(normals_[t], normals_[twin / 3]);
      front_.push({distance + glm::distance(middle(t), middle(twin / 3)) * (1 + kCreaseCost * turn), twin});
    }
  }

  // Lays the triangle of this half edge beside its twin's.
  bool lay(uint32_t half) {
    const uint32_t next = following(half), third = following(next);
    const uint32_t copyA = copy_[following(twins_[half])], copyB = copy_[twins_[half]];
    const Flat f = flat(at(half), at(next), at(third));
    if (!f.isSound()) return false;
    const glm::vec2 a = copies_[copyA].uv, b = copies_[copyB].uv, edge = b - a;
    const float length = glm::length(edge);
    if (!(length < kMostStretch * f.length && length * kMostStretch > f.length)) return false;
    const glm::vec2 wanted = a + f.along * edge + f.height / length * glm::vec2(-edge.y, edge.x);
    // The copy that lies there already, or one of its own.
    uint32_t found = kUnlaid;
    float nearest = kSameCopy * std::sqrt(length * f.height);
    uint32_t tries = kTries;
    for (uint32_t c = firstCopy_[place_[third]]; tries-- > 0 && c != kUnlaid && copies_[c].piece == piece_;
         c = copies_[c].next) {
      const float away = glm::distance(copies_[c].uv, wanted);
      if (away < nearest && (isThin(f) || mayLie(f, a, b, copies_[c].uv))) found = c, nearest = away;
    }
    copy_[half] = copyA, copy_[next] = copyB;
    copy_[third] = found != kUnlaid ? found : addCopy(place_[third], wanted);
    return true;
  }

  // Each triangle asks for its own form, as it lies, a little larger or smaller; corners lie in the middle of
  // what is asked of them (shape matching; Mueller et al. 2005, "Meshless deformations").
  void relax() {
    // In the order in which they were laid: what lies side by side is then side by side in memory as well.
    std::vector<Form> forms;
    for (const uint32_t t : laid_)
      if (const Flat f = flat(at(3 * t), at(3 * t + 1), at(3 * t + 2)); f.isSound() && areas_[t] > 0)
        forms.push_back({f, {copy_[3 * t], copy_[3 * t + 1], copy_[3 * t + 2]}});
    std::vector<glm::vec3> sums(copies_.size());
    std::vector<glm::vec2> before(copies_.size());
    for (int i = 0; i < kRelaxations; ++i) {
      std::fill(sums.begin(), sums.end(), glm::vec3(0.0f));
      for (const Form& form : forms) ask(form, sums);
      for (size_t c = 0; c < copies_.size(); ++c) {
        before[c] = copies_[c].uv;
        if (sums[c].z > 0) copies_[c].uv = glm::vec2(sums[c]) / sums[c].z;
      }
      if (!takeBack(forms, before)) return;
    }
  }

  // Corners of triangles that may not lie so go back to where they were, until all may, as they did before.
  // False where that has no end soon: then everything has gone back.
  bool takeBack(const std::vector<Form>& forms, const std::vector<glm::vec2>& before) {
    for (int round = 0; round < kRounds; ++round) {
      bool any = false;
      for (const Form& form : forms) {
        const uint32_t* const c = form.copies;
        if (isThin(form.own) || mayLie(form.own, copies_[c[0]].uv, copies_[c[1]].uv, copies_[c[2]].uv))
          continue;
        for (int k = 0; k < 3; ++k) {
          any |= copies_[c[k]].uv != before[c[k]];
          copies_[c[k]].uv = before[c[k]];
        }
      }
      if (!any) return true;
    }
    for (size_t c = 0; c < copies_.size(); ++c) copies_[c].uv = before[c];
    return false;
  }

  void ask(const Form& form, std::vector<glm::vec3>& sums) const {
    const Flat& f = form.own;
    const uint32_t* const copies = form.copies;
    const glm::vec2 lies[3] = {copies_[copies[0]].uv, copies_[copies[1]].uv, copies_[copies[2]].uv};
    glm::vec2 own[3] = {{0, 0}, {f.length, 0}, {f.along * f.length, f.height}};
    const glm::vec2 ownMiddle = (own[0] + own[1] + own[2]) / 3.0f,
                    middle = (lies[0] + lies[1] + lies[2]) / 3.0f;
    float real = 0, imaginary = 0, size = 0;
    for (int k = 0; k < 3; ++k) {
      own[k] -= ownMiddle;
      const glm::vec2 off = lies[k] - middle;
      real += glm::dot(own[k], off), imaginary += own[k].x * off.y - own[k].y * off.x;
      size += glm::dot(own[k], own[k]);
    }
    const float length = std::sqrt(real * real + imaginary * imaginary), area = f.length * f.height;
    if (!(length > 0)) return;
    const float by = std::clamp(length / size, 0.7f, 1.4f) / length;
    const glm::vec2 turn(by * real, by * imaginary);
    for (int k = 0; k < 3; ++k) {
      const glm::vec2 asked =
          middle + glm::vec2(turn.x * own[k].x - turn.y * own[k].y, turn.y * own[k].x + turn.x * own[k].y);
      sums[copies[k]] += area * glm::vec3(asked, 1);
    }
  }

  // A vertex for each copy that has corners of it: the vertex itself for the first, others are added.
  Unfolding result() const {
    struct Use {
      uint64_t vertexAndCopy;
      uint32_t corner;
      bool operator<(const Use& other) const {
        return vertexAndCopy != other.vertexAndCopy ? vertexAndCopy < other.vertexAndCopy
                                                    : corner < other.corner;
      }
    };
    std::vector<Use> uses(p_.indices.size());
    for (uint32_t i = 0; i < uses.size(); ++i) uses[i] = {uint64_t(p_.indices[i]) << 32 | copy_[i], i};
    std::sort(uses.begin(), uses.end());
    Unfolding u;
    u.source.resize(p_.vertexCount());
    std::iota(u.source.begin(), u.source.end(), 0u);
    u.uvs.assign(p_.vertexCount(), glm::vec2(0.0f));
    u.indices.resize(p_.indices.size());
    for (size_t i = 0; i < uses.size(); ++i) {
      const uint32_t v = p_.indices[uses[i].corner];
      const bool isNew = i == 0 || uses[i].vertexAndCopy != uses[i - 1].vertexAndCopy;
      const bool isAdded = isNew && i > 0 && p_.indices[uses[i - 1].corner] == v;
      if (isAdded) u.source.push_back(v), u.uvs.emplace_back();
      const uint32_t vertex = isAdded ? uint32_t(u.source.size() - 1)
                              : isNew ? v
                                      : u.indices[uses[i - 1].corner];
      u.uvs[vertex] = copies_[copy_[uses[i].corner]].uv;
      u.indices[uses[i].corner] = vertex;
    }
    return u;
  }

  const Primitive& p_;
  size_t count_;                      // triangles
  std::vector<uint32_t> place_;       // by corner: the first vertex at its place
  float size_ = 1;                    // of the primitive, in units of uv
  std::vector<glm::vec3> positions_;  // by vertex, in units of uv
  std::vector<uint32_t> twins_;       // by half edge
  std::vector<glm::vec3> normals_;    // by triangle
  std::vector<float> areas_;
  std::vector<uint32_t> copy_;       // by corner; kUnlaid where the triangle does not lie yet
  std::vector<uint32_t> firstCopy_;  // by place
  std::vector<Copy> copies_;
  std::vector<uint32_t> laid_;  // triangles, in order
  uint32_t piece_ = 0;
  std::priority_queue<Front, std::vector<Front>, std::greater<>> front_;
};

}  // namespace

Unfolding unfold(const Primitive& primitive, float scale) {
  return Unfolder(primitive, scale).unfold();
}

}  // namespace scumble::scene
