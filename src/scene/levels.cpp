#include "scene/levels.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "scene/landing.h"

namespace scumble::scene {

namespace {

constexpr size_t kFewTriangles = 256;  // which are drawn as they are
// Of triangles, one of so many is left. The first level takes more memory than all others together, so it is
// a longer step.
constexpr size_t kFirstStep = 4, kStep = 3;
constexpr float kWorthIt = 0.75f;  // of the triangles before: more are no level of their own
constexpr size_t kSamples = 256;   // vertices, about, at which a level is compared with the whole
// Squares of how many triangles have a vertex, in all, by corner: finding fewer triangles takes as long. A
// sphere has 6.
constexpr uint64_t kBusiest = 256;
constexpr uint32_t kNone = LandingSearch::kNone;

// Differences that nobody sees.
constexpr float kUvStep = 1.0f / 4096, kNormalStep = 0.03f, kColorStep = 4.0f, kWarpStep = 0.05f;
// The parts of a slide that count for light and for how much is torn: edges of tones are rounded and torn by
// more than what is left.
constexpr float kToneShare = 0.0625f;
// Of a pattern's slide: its strokes are some sixteen pixels wide, and tear edges by four, so that a tear is
// another one by a part of that.
constexpr float kPatternShare = 0.125f;

// How far along a triangle one would have to go for the difference that an attribute makes.
class Slide {
 public:
  Slide(const Primitive& p, size_t vertex, const std::array<uint32_t, 3>& corners, const glm::vec3& weights)
      : vertex_(vertex), corners_(corners), weights_(weights) {
    for (int k = 0; k < 3; ++k)
      edge_ = std::max(
          edge_, glm::distance(p.positions[corners[size_t(k)]], p.positions[corners[size_t(k + 1) % 3]]));
  }
  template <class T>
  float operator()(const std::vector<T>& values, float step) const {
    if (values.empty()) return 0;
    const glm::vec4 a = wide(values[corners_[0]]), b = wide(values[corners_[1]]),
                    c = wide(values[corners_[2]]);
    const float off =
        glm::distance(weights_.x * a + weights_.y * b + weights_.z * c, wide(values[vertex_])) - step;
    if (!(off > 0)) return 0;
    const float spread = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
    return edge_ * off / std::max(spread, off);
  }

 private:
  static glm::vec4 wide(float v) { return {v, 0, 0, 0}; }
  static glm::vec4 wide(const glm::vec2& v) { return {v, 0, 0}; }
  static glm::vec4 wide(const glm::vec3& v) { return {v, 0}; }
  static glm::vec4 wide(const glm::u8vec4& v) { return glm::vec4(v); }

  size_t vertex_;
  std::array<uint32_t, 3> corners_;
  glm::vec3 weights_;
  float edge_ = 0;
};

// How much farther joints and morph targets may take a vertex from where it lands: all targets at once, and
// by joints over a quarter of the primitive's size, as a limb that turns by a right angle does.
float bentApart(const Primitive& p, size_t vertex, const std::array<uint32_t, 3>& corners,
                const glm::vec3& weights, float size) {
  float apart = 0;
  for (const MorphTarget& target : p.morphTargets) {
    if (target.positions.empty()) continue;
    glm::vec3 off = -target.positions[vertex];
    for (int k = 0; k < 3; ++k) off += weights[k] * target.positions[corners[size_t(k)]];
    apart += glm::length(off);
  }
  if (p.influences == 0) return apart;
  std::vector<std::pair<uint16_t, float>> shares;  // by joint: of the landing, less the vertex's own
  const auto add = [&](size_t v, float by) {
    for (size_t k = v * size_t(p.influences); k < (v + 1) * size_t(p.influences); ++k) {
      const auto known = std::find_if(shares.begin(), shares.end(),
                                      [&](const auto& share) { return share.first == p.joints[k]; });
      if (known == shares.end())
        shares.emplace_back(p.joints[k], by * p.weights[k]);
      else
        known->second += by * p.weights[k];
    }
  };
  add(vertex, -1);
  for (int k = 0; k < 3; ++k) add(corners[size_t(k)], weights[k]);
  float others = 0;  // that another joint moves
  for (const auto& [joint, share] : shares) others += 0.5f * std::abs(share);
  return apart + 0.25f * size * others;
}

// By vertex, one that `kept` triangles have: over the edges of those that they were made from. `nearest`: as
// it was for those.
bool follow(std::span<const uint32_t> before, std::span<const uint32_t> kept,
            std::vector<uint32_t>& nearest) {
  const TrianglesByCorner corners(before, nearest.size());
  std::vector<uint32_t> next(nearest.size(), kNone), reached;
  for (const uint32_t v : kept) {
    if (next[v] == kNone) reached.push_back(v);
    next[v] = v;
  }
  for (size_t i = 0; i < reached.size(); ++i)
    for (const uint32_t t : corners[reached[i]])
      for (const uint32_t v : before.subspan(3 * t, 3)) {
        if (next[v] == kNone) reached.push_back(v), next[v] = next[reached[i]];
      }
  for (uint32_t& v : nearest) {
    if (v == kNone) continue;
    // Of a piece of which nothing is left.
    if (next[v] == kNone && !corners[v].empty()) return false;
    v = next[v];
  }
  return true;
}

// A fan of a hundred thousand triangles would take minutes.
bool isTooBusy(std::span<const uint32_t> triangles, size_t vertices) {
  std::vector<uint32_t> of(vertices, 0);
  for (const uint32_t v : triangles) ++of[v];
  const uint64_t squares = std::accumulate(of.begin(), of.end(), uint64_t(0),
                                           [](uint64_t sum, uint32_t n) { return sum + uint64_t(n) * n; });
  return squares > kBusiest * triangles.size();
}

template <class T>
bool varies(const std::vector<T>& values) {
  return std::any_of(values.begin(), values.end(), [&](const T& value) { return value != values[0]; });
}

}  // namespace

Strays straysOf(const Primitive& p, std::span<const uint32_t> triangles, std::span<const uint32_t> nearest) {
  LandingSearch landingOf(p.positions, triangles);
  const float size = glm::distance(p.extent.box.min, p.extent.box.max);
  Strays most{};
  const size_t count = p.positions.size();
  // What is painted by vertices may be as small as they are.
  const size_t samples = varies(p.colors) || varies(p.warpScales) ? count : std::min(count, kSamples);
  for (size_t i = 0; i < samples; ++i) {
    // Not every so many: they might all lie on one line.
    const size_t v = count == samples ? i : size_t(i * 2654435761u % count);
    if (nearest[v] == kNone) continue;  // no triangle has it
    const Landing landing = landingOf(p.positions[v], nearest[v]);
    std::array<uint32_t, 3> at;
    for (size_t k = 0; k < 3; ++k) at[k] = triangles[3 * landing.triangle + k];
    const Slide slide(p, v, at, landing.weights);
    most.surface = std::max(most.surface, landing.distance + bentApart(p, v, at, landing.weights, size));
    most.textures = std::max({most.textures, slide(p.uv0, kUvStep), slide(p.uv1, kUvStep)});
    most.drawn = std::max({most.drawn, most.surface, kPatternShare * slide(p.patternCoordinates(), kUvStep),
                           slide(p.colors, kColorStep), kToneShare * slide(p.normals, kNormalStep),
                           kToneShare * slide(p.warpScales, kWarpStep)});
  }
  return most;
}

void makeLevels(Primitive& p) {
  p.levels.clear(), p.levelIndices.clear();
  const float scale = meshopt_simplifyScale(&p.positions[0].x, p.positions.size(), sizeof(glm::vec3));
  std::vector<uint32_t> nearest(p.positions.size());
  std::iota(nearest.begin(), nearest.end(), 0u);
  std::vector<uint32_t> before = p.indices, now(before.size());
  float strayed = 0;
  while (p.levels.size() < kMaxLevels && before.size() / 3 >= kFewTriangles &&
         !isTooBusy(before, p.positions.size())) {
    float error = 0;
    now.resize(before.size());
    // Open borders stay: another primitive may go on there, and a crack would be torn wide.
    const size_t wanted = before.size() / 3 / (p.levels.empty() ? kFirstStep : kStep) * 3;
    now.resize(meshopt_simplify(now.data(), before.data(), before.size(), &p.positions[0].x,
                                p.positions.size(), sizeof(glm::vec3), wanted, 1.0f,
                                meshopt_SimplifyLockBorder, &error));
    if (now.empty() || float(now.size()) > kWorthIt * float(before.size())) break;
    if (!follow(before, now, nearest)) break;
    strayed += error * scale;
    DetailLevel level;
    level.firstIndex = uint32_t(p.levelIndices.size()), level.indexCount = uint32_t(now.size());
    const Strays strays = straysOf(p, now, nearest);
    level.shadowError = std::max(strayed, strays.surface), level.error = std::max(strayed, strays.drawn);
    level.textureError = strays.textures;
    if (!p.levels.empty())
      for (float DetailLevel::*const of :
           {&DetailLevel::error, &DetailLevel::textureError, &DetailLevel::shadowError})
        level.*of = std::max(level.*of, p.levels.back().*of);
    for (size_t i = 0; i < now.size(); ++i)
      level.longestEdge = std::max(
          level.longestEdge, glm::distance(p.positions[now[i]], p.positions[now[i - i % 3 + (i + 1) % 3]]));
    p.levels.push_back(level);
    p.levelIndices.insert(p.levelIndices.end(), now.begin(), now.end());
    before = now;
  }
  p.levelIndices.shrink_to_fit();
}

}  // namespace scumble::scene
