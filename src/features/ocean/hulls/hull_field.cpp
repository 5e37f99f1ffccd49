#include "features/ocean/hulls/hull_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "shading/cutouts.shared.h"

namespace scumble::ocean {

namespace {

constexpr int kCoarsePoints = 1 << 15, kFinePoints = 1 << 16;
constexpr size_t kMostTriangles = size_t(1) << 20;
// Slope of the levels at which a vessel is to hold water besides the flat one: 14 degrees.
constexpr float kTilt = 0.25f;

enum class Label : uint8_t { unknown, outside, tilted, inside };

// About the vertical, so that the grid lies along the mesh.
glm::mat4 turnOf(std::span<const Triangle> triangles) {
  constexpr int kTurns = 18;  // of a right angle
  float smallest = std::numeric_limits<float>::infinity();
  glm::mat4 best(1.0f);
  for (int i = 0; i < kTurns; ++i) {
    const glm::mat4 turn =
        glm::rotate(glm::mat4(1.0f), glm::radians(90.0f * float(i) / kTurns), glm::vec3(0, 1, 0));
    glm::vec2 least(1e30f), most(-1e30f);
    for (const Triangle& t : triangles)
      for (const glm::vec3& corner : {t.a, t.b, t.c}) {
        const glm::vec3 turned = turn * glm::vec4(corner, 1.0f);
        least = glm::min(least, glm::vec2(turned.x, turned.z));
        most = glm::max(most, glm::vec2(turned.x, turned.z));
      }
    const float area = (most.x - least.x) * (most.y - least.y);
    if (area < 0.999f * smallest) smallest = area, best = turn;
  }
  return best;
}

// Some of these points, each the farthest one from all before it: so many of the first ones as one likes lie
// all over them.
std::vector<glm::vec3> spread(const std::vector<glm::vec3>& points, size_t most) {
  std::vector<glm::vec3> chosen;
  std::vector<float> away(points.size(), std::numeric_limits<float>::infinity());
  for (size_t next = 0; chosen.size() < std::min(most, points.size());) {
    chosen.push_back(points[next]);
    for (size_t i = 0; i < points.size(); ++i)
      away[i] = std::min(away[i], glm::distance(points[i], chosen.back()));
    next = size_t(std::max_element(away.begin(), away.end()) - away.begin());
  }
  return chosen;
}

class Vessel {
 public:
  Vessel(std::span<const Triangle> triangles, const glm::vec3& least, const glm::vec3& most, int budget)
      : grid_(least, most, budget, 2), isWhole_(grid_.add(triangles)) {
    labels_.assign(isWhole_ ? grid_.count() : 0, Label::unknown);
  }
  bool isWhole() const { return isWhole_; }
  float cell() const { return grid_.cell(); }

  // Labels all points by where water comes that rises around the mesh.
  void pour() {
    pour(glm::vec3(0, 1, 0), Label::inside);
    for (const glm::vec2 slope :
         {glm::vec2(kTilt, 0), glm::vec2(-kTilt, 0), glm::vec2(0, kTilt), glm::vec2(0, -kTilt)})
      pour(glm::normalize(glm::vec3(slope.x, 1, slope.y)), Label::tilted);
    joinTilted();
    held_ = size_t(std::count(labels_.begin(), labels_.end(), Label::inside));
    label();
  }
  // The same where all is inside that nothing reaches.
  void fill() {
    pour(glm::vec3(0, 1, 0), Label::outside);
    for (size_t i = 0; i < labels_.size(); ++i)
      if (labels_[i] == Label::unknown && !grid_.isTouched(i)) labels_[i] = Label::inside, ++held_;
    label();
  }

  // Points that the mesh leaves free, and that water does not reach.
  size_t held() const { return held_; }
  float volume() const { return float(held_) * cell() * cell() * cell(); }
  // What is inside, with as much around it as its sides may take up.
  std::pair<glm::vec3, glm::vec3> box() const {
    glm::vec3 least(1e30f), most(-1e30f);
    for (size_t i = 0; i < labels_.size(); ++i)
      if (labels_[i] == Label::inside) {
        least = glm::min(least, grid_.middle(grid_.at(i)));
        most = glm::max(most, grid_.middle(grid_.at(i)));
      }
    return {least - 1.5f * cell(), most + 1.5f * cell()};
  }

  HullField field(const glm::mat4& turn, bool isOpen);

 private:
  // Water that rises from all around, with its level across `up`: what it reaches only by coming over
  // something is held.
  void pour(const glm::vec3& up, Label held);
  // What holds water when it is tilted is inside where it goes on from what does when level: not beside a
  // hole that happens to be lifted out.
  void joinTilted();
  // Points of cubes that the mesh goes through, from their neighbours on the same side of it.
  void label();
  std::vector<float> distances() const;  // cells, above 0 within

  template <class Visit>
  void forNeighbours(const glm::ivec3& at, Visit&& visit) const {
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        for (int x = -1; x <= 1; ++x)
          if ((x || y || z) && grid_.contains(at + glm::ivec3(x, y, z))) visit(at + glm::ivec3(x, y, z));
  }
  // By column, the highest point that is inside; -1: none is.
  std::vector<int> tops() const;
  // Carries an open vessel on upwards: what comes over its rim stays out as well. True for what that adds.
  std::vector<uint8_t> rise(const std::vector<int>& tops);
  // There the sides stand as they end at the rim.
  void standUpright(const std::vector<uint8_t>& isRisen, std::vector<float>& distances) const;

  VoxelGrid grid_;
  bool isWhole_;
  std::vector<Label> labels_;
  size_t held_ = 0;
};

void Vessel::pour(const glm::vec3& up, Label held) {
  // The level at which water comes to a point: the least, over all ways to it from the border, of the highest
  // place on that way. Sweeps forth and back until it stays.
  constexpr float kNever = std::numeric_limits<float>::infinity();
  const glm::ivec3 size = grid_.size();
  std::vector<float> level(grid_.count(), kNever);
  const auto height = [&](const glm::ivec3& at) { return glm::dot(up, glm::vec3(at)); };
  for (size_t i = 0; i < level.size(); ++i)
    if (grid_.isBorder(grid_.at(i)) && !grid_.isTouched(i)) level[i] = height(grid_.at(i));
  const size_t steps[] = {1, size_t(size.x), size_t(size.x) * size_t(size.z)};
  bool changes = true;
  const auto sweep = [&](const glm::ivec3& at) {
    const size_t i = grid_.index(at);
    if (grid_.isTouched(i)) return;
    float least = level[i];
    for (const size_t step : steps) least = std::min({least, level[i - step], level[i + step]});
    const float rises = std::max(least, height(at));
    if (rises < level[i]) level[i] = rises, changes = true;
  };
  for (bool isForth = true; changes; isForth = !isForth) {
    changes = false;
    for (int j = 1; j + 1 < size.y; ++j)
      for (int k = 1; k + 1 < size.z; ++k)
        for (int l = 1; l + 1 < size.x; ++l)
          sweep(isForth ? glm::ivec3(l, j, k) : size - 1 - glm::ivec3(l, j, k));
  }
  constexpr float kLeast = 0.75f;  // cells: the grid itself is as uneven
  for (size_t i = 0; i < level.size(); ++i)
    if (level[i] != kNever)
      labels_[i] = std::max(labels_[i], level[i] > height(grid_.at(i)) + kLeast ? held : Label::outside);
}

void Vessel::joinTilted() {
  std::vector<size_t> next;
  for (size_t i = 0; i < labels_.size(); ++i)
    if (labels_[i] == Label::inside) next.push_back(i);
  while (!next.empty()) {
    const glm::ivec3 here = grid_.at(next.back());
    next.pop_back();
    forNeighbours(here, [&](const glm::ivec3& at) {
      const size_t to = grid_.index(at);
      if (labels_[to] != Label::tilted) return;
      labels_[to] = Label::inside;
      next.push_back(to);
    });
  }
  std::replace(labels_.begin(), labels_.end(), Label::tilted, Label::outside);
}

void Vessel::label() {
  std::deque<size_t> next;
  for (size_t i = 0; i < labels_.size(); ++i)
    if (labels_[i] != Label::unknown) next.push_back(i);
  while (!next.empty()) {
    const size_t from = next.front();
    next.pop_front();
    const glm::ivec3 here = grid_.at(from);
    forNeighbours(here, [&](const glm::ivec3& at) {
      const size_t to = grid_.index(at);
      if (labels_[to] != Label::unknown || !grid_.isTouched(to) || grid_.isBetween(here, at)) return;
      labels_[to] = labels_[from];
      next.push_back(to);
    });
  }
  // Within the mesh itself: planks and masts that stand inside go along with it.
  const std::vector<Label> before = labels_;
  for (size_t i = 0; i < labels_.size(); ++i) {
    if (before[i] != Label::unknown) continue;
    labels_[i] = Label::outside;
    forNeighbours(grid_.at(i), [&](const glm::ivec3& at) {
      if (before[grid_.index(at)] == Label::inside) labels_[i] = Label::inside;
    });
  }
}

std::vector<float> Vessel::distances() const {
  std::vector<float> distances(labels_.size());
  for (size_t i = 0; i < labels_.size(); ++i) {
    const glm::ivec3 here = grid_.at(i);
    bool isEdge = false;
    forNeighbours(here, [&](const glm::ivec3& at) { isEdge |= labels_[grid_.index(at)] != labels_[i]; });
    float away = shared::kCutoutReach;
    if (isEdge)
      if (const std::optional<float> there = grid_.distance(here)) away = std::min(away, *there / cell());
    distances[i] = labels_[i] == Label::inside ? away : -away;
  }
  return distances;
}

std::vector<int> Vessel::tops() const {
  const glm::ivec3 size = grid_.size();
  std::vector<int> tops(size_t(size.x) * size_t(size.z), -1);
  for (size_t i = 0; i < labels_.size(); ++i) {
    const glm::ivec3 at = grid_.at(i);
    if (labels_[i] == Label::inside) tops[size_t(at.z) * size_t(size.x) + size_t(at.x)] = at.y;
  }
  return tops;
}

std::vector<uint8_t> Vessel::rise(const std::vector<int>& tops) {
  const glm::ivec3 size = grid_.size();
  std::vector<uint8_t> isRisen(labels_.size(), 0);
  for (int z = 0; z < size.z; ++z)
    for (int x = 0; x < size.x; ++x) {
      const int top = tops[size_t(z) * size_t(size.x) + size_t(x)];
      for (int y = top + 1; top >= 0 && y < size.y; ++y) {
        if (grid_.isBetween({x, y - 1, z}, {x, y, z})) break;
        labels_[grid_.index({x, y, z})] = Label::inside;
        isRisen[grid_.index({x, y, z})] = 1;
      }
    }
  return isRisen;
}

void Vessel::standUpright(const std::vector<uint8_t>& isRisen, std::vector<float>& distances) const {
  // Above the rim no side hides what is cut too far (shading/cutouts.glsl).
  const float kLess = 2 * shared::kCutoutMargin;
  std::vector<uint8_t> isUpright(labels_.size(), 0);
  for (size_t i = 0; i < labels_.size(); ++i) {
    const glm::ivec3 here = grid_.at(i);
    if (here.y == 0) continue;
    bool isBeside = false, isAtSide = false;
    for (int dz = -1; dz <= 1; ++dz)
      for (int dx = -1; dx <= 1; ++dx) {
        const glm::ivec3 at = here + glm::ivec3(dx, 0, dz);
        if (!grid_.contains(at)) continue;
        isBeside |= isRisen[grid_.index(at)] != 0;
        isAtSide |= grid_.isTouched(grid_.index(at));
      }
    const size_t foot = grid_.index(here - glm::ivec3(0, 1, 0));
    if (!isBeside || isAtSide || (!isUpright[foot] && (distances[foot] > 0) != (distances[i] > 0))) continue;
    distances[i] = std::max(distances[foot] - (isUpright[foot] ? 0 : kLess), -shared::kCutoutReach);
    isUpright[i] = 1;
  }
}

HullField Vessel::field(const glm::mat4& turn, bool isOpen) {
  constexpr size_t kMostOfRim = 96;
  HullField field;
  field.size = grid_.size();
  field.toPoints = glm::scale(glm::mat4(1.0f), glm::vec3(1.0f / cell())) *
                   glm::translate(glm::mat4(1.0f), -grid_.origin()) * turn;
  const std::vector<int> tops = this->tops();
  std::vector<uint8_t> isRisen;
  if (isOpen) isRisen = rise(tops);
  std::vector<float> distances = this->distances();
  field.top = float(*std::max_element(tops.begin(), tops.end()));
  if (isOpen) {
    standUpright(isRisen, distances);
    std::vector<glm::vec3> rim;
    const auto topAt = [&](int x, int z) { return tops[size_t(z) * size_t(field.size.x) + size_t(x)]; };
    for (int z = 1; z + 1 < field.size.z; ++z)
      for (int x = 1; x + 1 < field.size.x; ++x)
        if (topAt(x, z) >= 0 &&
            std::min({topAt(x - 1, z), topAt(x + 1, z), topAt(x, z - 1), topAt(x, z + 1)}) < 0)
          rim.emplace_back(x, topAt(x, z), z);
    field.rim = spread(rim, kMostOfRim);
  }
  for (const float distance : distances)
    field.within.push_back(int8_t(std::lround(127.0f * distance / shared::kCutoutReach)));
  return field;
}

// Triangles that are somewhere, turned along their grid, and their box; none: they fill no space.
struct Input {
  glm::mat4 turn{1.0f};
  std::vector<Triangle> triangles;
  glm::vec3 least{1e30f}, most{-1e30f};
};
std::optional<Input> inputOf(std::span<const Triangle> triangles) {
  constexpr float kFarthest = 1e6f, kFlattest = 0.01f;
  if (triangles.size() > kMostTriangles) return std::nullopt;
  Input input;
  for (const Triangle& t : triangles) {
    const glm::vec3 most = glm::max(glm::abs(t.a), glm::max(glm::abs(t.b), glm::abs(t.c)));
    if (glm::all(glm::lessThan(most, glm::vec3(kFarthest)))) input.triangles.push_back(t);
  }
  input.turn = turnOf(input.triangles);
  for (Triangle& t : input.triangles)
    for (glm::vec3* corner : {&t.a, &t.b, &t.c}) {
      *corner = input.turn * glm::vec4(*corner, 1.0f);
      input.least = glm::min(input.least, *corner);
      input.most = glm::max(input.most, *corner);
    }
  const glm::vec3 extent = input.most - input.least;
  const float longest = std::max({extent.x, extent.y, extent.z});
  if (!(longest > 1e-6f) || std::min({extent.x, extent.y, extent.z}) < kFlattest * longest)
    return std::nullopt;
  return input;
}

}  // namespace

std::optional<HullField> findHull(std::span<const Triangle> triangles) {
  const std::optional<Input> input = inputOf(triangles);
  if (!input) return std::nullopt;
  // Where in the mesh it is, rigging and all.
  constexpr size_t kLeastCoarse = 24, kLeast = 160;  // points; what has fewer is a dent
  Vessel coarse(input->triangles, input->least, input->most, kCoarsePoints);
  if (!coarse.isWhole()) return std::nullopt;
  coarse.pour();
  if (coarse.held() < kLeastCoarse) return std::nullopt;
  // There, as fine as can be; but seams between parts that are open by more than a fine cell are tight in the
  // coarse one.
  const auto [least, most] = coarse.box();
  Vessel fine(input->triangles, least, most, kFinePoints);
  if (fine.isWhole() && fine.cell() < coarse.cell()) {
    fine.pour();
    if (fine.volume() > 0.6f * coarse.volume())
      return fine.held() < kLeast ? std::nullopt : std::optional(fine.field(input->turn, true));
  }
  return coarse.held() < kLeast ? std::nullopt : std::optional(coarse.field(input->turn, true));
}

std::optional<HullField> fillHull(std::span<const Triangle> triangles) {
  const std::optional<Input> input = inputOf(triangles);
  if (!input) return std::nullopt;
  Vessel vessel(input->triangles, input->least, input->most, kFinePoints);
  if (!vessel.isWhole()) return std::nullopt;
  vessel.fill();
  if (vessel.held() == 0) return std::nullopt;
  return vessel.field(input->turn, false);
}

}  // namespace scumble::ocean
