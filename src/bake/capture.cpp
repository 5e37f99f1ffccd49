#include "bake/capture.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "base/example_pictures.h"
#include "base/mipmaps.h"
#include "base/srgb.h"
#include "scene/parallel.h"
#include "shading/brush.shared.h"

namespace scumble::bake {

namespace {

constexpr float kSeen = 3.0f / 255;  // less opaque than this is nothing
constexpr float kSoftTop = 0.12f;    // of a fin's height, over which paint ends that would be cut off
// A direction laid onto a plane that is shorter than this says nothing.
constexpr float kVanishes = 0.1f;

Tile tileOf(const std::vector<glm::vec4>& texels, uint32_t width, uint32_t height) {
  Tile tile{width, height, std::vector<uint8_t>(size_t(width) * height * 4)};
  const SrgbEncoder& encode = SrgbEncoder::instance();
  for (size_t i = 0; i < texels.size(); ++i) {
    const glm::vec4& t = texels[i];
    // Light that is added is more than its opacity: it covers as much as it shows.
    const float alpha = std::min(std::max({t.a, t.x, t.y, t.z}), 1.0f);
    for (int c = 0; c < 3; ++c) {
      const float root = alpha > 0 ? t[c] / alpha : 0.0f;
      tile.rgba[4 * i + size_t(c)] = encode(root * root);
    }
    tile.rgba[4 * i + 3] = alphaCode(alpha);
  }
  return tile;
}

float distanceTo(const glm::vec2& p, const glm::vec2& a, const glm::vec2& b) {
  const glm::vec2 along = b - a;
  const float size = glm::dot(along, along);
  const float t = size > 0 ? glm::clamp(glm::dot(p - a, along) / size, 0.0f, 1.0f) : 0.0f;
  return glm::distance(p, a + t * along);
}

// With the border.
glm::uvec2 sizeOf(const glm::vec2& metres, float texel) {
  constexpr float kMost = 1 << 15;  // more fits nowhere
  return glm::uvec2(glm::clamp(glm::ceil(metres / texel), 2.0f, kMost)) + 2u * uint32_t(kGutter);
}

// Of so many texels those between two places, which may lie anywhere.
struct Range {
  int first, last;
};
Range rangeOf(float low, float high, float texels, int count) {
  return {int(glm::clamp(std::ceil(low * texels), 0.0f, float(count))),
          int(glm::clamp(std::floor(high * texels), -1.0f, float(count - 1)))};
}

}  // namespace

glm::uvec2 tileSize(const Chart& chart, float texel) {
  return sizeOf(chart.high - chart.low, texel);
}
glm::uvec2 tileSize(const Fin& fin, float texel) {
  const auto& c = fin.corners;
  return sizeOf({std::max(glm::distance(c[0], c[1]), glm::distance(c[3], c[2])),
                 std::max(glm::distance(c[0], c[3]), glm::distance(c[1], c[2]))},
                texel);
}

ValuePicture::ValuePicture(int example) {
  const Pixels pixels = builtInExample(example);
  const auto add = [&](std::span<const uint8_t> rgba, uint32_t size) {
    Level level{size, std::vector<uint8_t>(size_t(size) * size)};
    for (size_t i = 0; i < level.values.size(); ++i) level.values[i] = rgba[4 * i];
    levels_.push_back(std::move(level));
  };
  add(pixels.rgba, pixels.width);
  uint32_t size = pixels.width;
  for (const std::vector<uint8_t>& smaller : makeValueMipmaps(pixels.rgba, size, size))
    add(smaller, size = std::max(1u, size / 2));
}

float ValuePicture::at(const glm::vec2& uv, float texel) const {
  const float wanted = std::log2(std::max(texel * float(levels_[0].size), 1e-6f));
  const float exact = glm::clamp(wanted, 0.0f, float(levels_.size() - 1));
  const auto first = size_t(exact);
  const auto bilinear = [&](const Level& level) {
    const glm::vec2 p = uv * float(level.size) - 0.5f, cell = glm::floor(p), part = p - cell;
    const auto value = [&](int dx, int dy) {
      const uint32_t mask = level.size - 1;
      return float(level.values[size_t(uint32_t(int(cell.y) + dy) & mask) * level.size +
                                (uint32_t(int(cell.x) + dx) & mask)]);
    };
    return glm::mix(glm::mix(value(0, 0), value(1, 0), part.x), glm::mix(value(0, 1), value(1, 1), part.x),
                    part.y) /
           255;
  };
  const float between = exact - float(first);
  const float near = bilinear(levels_[first]);
  return between > 0 ? glm::mix(near, bilinear(levels_[first + 1]), between) : near;
}

struct Capture::Brush {
  int brush = 0;
  shared::BrushPlace place;
  glm::vec3 root{0};
  float alpha = 0, inverseRadius = 0, reach = 0;  // reach: metres
};

Capture::Capture(const Proxy& proxy, const Shell& shell, const std::vector<Splat>& splats,
                 const BakeOptions& options, float texel)
    : proxy_(proxy), shell_(shell), splats_(splats), options_(options), texel_(texel) {
  splatsOver_.resize(proxy.triangles.size());
  for (uint32_t s = 0; s < splats.size(); ++s) splatsOver_[size_t(splats[s].triangle)].push_back(s);
  land(options);
}

// A splat comes to every chart within its reach by the shortest way over edges, unfolded into one plane. (A
// chain of turns around edges.)
void Capture::land(const BakeOptions& options) {
  struct Step {
    float away;
    int triangle;
    glm::vec2 at, along;
    bool operator<(const Step& other) const { return away > other.away; }
  };
  struct Found {
    uint32_t chart;
    Landing landing;
  };
  constexpr size_t kChunk = 2048;
  const size_t chunks = (splats_.size() + kChunk - 1) / kChunk;
  std::vector<std::vector<Found>> found(chunks);
  scene::parallelFor(chunks, scene::threadCount(options.threads), [&](size_t chunk) {
    // Which splat, plus one, has come last to a triangle, and to a chart.
    std::vector<size_t> seenTriangle(proxy_.triangles.size()), seenChart(proxy_.charts.size());
    for (size_t s = chunk * kChunk; s < std::min((chunk + 1) * kChunk, splats_.size()); ++s) {
      const Splat& splat = splats_[s];
      const ProxyTriangle& own = proxy_.triangles[size_t(splat.triangle)];
      glm::vec2 along(glm::dot(splat.along, own.axisX), glm::dot(splat.along, own.axisY));
      const float laid = glm::length(along);
      along = laid > kVanishes ? along / laid : own.field;
      glm::vec2 foot(0);
      float offset = 0;
      for (int c = 0; c < 3; ++c)
        foot += splat.parts[c] * own.flat[size_t(c)],
            offset += splat.parts[c] * shell_.offsets[own.places[c]];
      const float share = offset > 0 ? splat.height / offset : 0.0f;
      const float reach = splat.radius + (float(kGutter) + 1.5f) * texel_;
      std::priority_queue<Step> steps;
      steps.push({0, splat.triangle, foot, along});
      while (!steps.empty()) {
        const Step step = steps.top();
        steps.pop();
        if (seenTriangle[size_t(step.triangle)] == s + 1) continue;
        seenTriangle[size_t(step.triangle)] = s + 1;
        const ProxyTriangle& t = proxy_.triangles[size_t(step.triangle)];
        if (seenChart[t.chart] != s + 1)
          found[chunk].push_back({t.chart, {uint32_t(s), step.at, step.along, share}});
        seenChart[t.chart] = s + 1;
        for (size_t e = 0; e < 3; ++e) {
          if (t.across[e] < 0 || seenTriangle[size_t(t.across[e])] == s + 1) continue;
          const float away = std::max(step.away, distanceTo(step.at, t.flat[e], t.flat[(e + 1) % 3]));
          if (away < reach) steps.push({away, t.across[e], t.into[e](step.at), t.into[e].turned(step.along)});
        }
      }
    }
  });
  landings_.resize(proxy_.charts.size());
  for (std::vector<Found>& of : found) {
    for (const Found& one : of) landings_[one.chart].push_back(one.landing);
    of = {};
  }
}

Capture::Brush Capture::brushOf(const Splat& splat, float sine) const {
  Brush brush;
  brush.brush = splat.brush;
  const float pixels = splat.radius / texel_, drawn = std::max(pixels, 0.5f);
  const float apart = shared::splatsApart(options_.spacing, texel_, splat.radius);
  brush.place.from = splat.from, brush.place.to = splat.to;
  brush.place.pixels = drawn, brush.place.chance = splat.chance;
  brush.root = splat.root;
  brush.alpha = shared::splatFade(apart, sine, splat.spacing) *
                shared::splatOpacity(splat.brush, splat.opacity, apart) * (pixels / drawn);
  brush.inverseRadius = 1 / (drawn * texel_);
  brush.reach = (drawn + 1) * texel_;
  return brush;
}

void Capture::lay(const Brush& brush, const glm::vec2& offset, glm::vec4& texel) const {
  shared::BrushPlace place = brush.place;
  place.place = offset * brush.inverseRadius;
  glm::vec3 root = brush.root;
  float mark = 0.5f;
  if (brush.brush == shared::kBristles) {
    mark = bristles_.at(shared::bristlesAt(place), 0.31f / place.pixels);
    root *= 1 + options_.variation * (mark - 0.5f);
  }
  const float alpha =
      brush.alpha * shared::brushCovers(brush.brush, place, mark, options_.streaks, options_.dryEnds);
  if (alpha <= 0) return;
  const float hides = brush.brush == shared::kLight ? 0.25f * alpha : alpha;
  texel = glm::vec4(glm::min(root, glm::vec3(1)) * alpha, hides) + texel * (1 - hides);
}

Tile Capture::coat(uint32_t number, float low, float high) const {
  const Chart& chart = proxy_.charts[number];
  const glm::uvec2 size = tileSize(chart, texel_);
  std::vector<glm::vec4> texels(size_t(size.x) * size.y, glm::vec4(0));
  // The middle of texel (x, y), y downwards.
  const glm::vec2 first = chart.low + (0.5f - float(kGutter)) * texel_;
  const float top = chart.low.y + (float(size.y) - float(kGutter) - 0.5f) * texel_;
  bool isThere = false;
  for (const Landing& landing : landings_[number]) {
    if (landing.share < low || landing.share >= high) continue;
    const Splat& splat = splats_[landing.splat];
    const float along = glm::dot(splat.along, proxy_.triangles[size_t(splat.triangle)].normal);
    const Brush brush = brushOf(splat, std::sqrt(std::max(1 - along * along, 0.0f)));
    if (brush.alpha <= 0) continue;
    const glm::vec2 middle(landing.at.x - first.x, top - landing.at.y);
    const Range columns = rangeOf(middle.x - brush.reach, middle.x + brush.reach, 1 / texel_, int(size.x));
    const Range rows = rangeOf(middle.y - brush.reach, middle.y + brush.reach, 1 / texel_, int(size.y));
    for (int y = rows.first; y <= rows.last; ++y)
      for (int x = columns.first; x <= columns.last; ++x) {
        const glm::vec2 d(first.x + float(x) * texel_ - landing.at.x, top - float(y) * texel_ - landing.at.y);
        if (glm::dot(d, d) > brush.reach * brush.reach) continue;
        glm::vec4& texel = texels[size_t(y) * size.x + size_t(x)];
        lay(brush, {glm::dot(d, landing.along), landing.along.x * d.y - landing.along.y * d.x}, texel);
        isThere |= texel.a > kSeen;
      }
  }
  return isThere ? tileOf(texels, size.x, size.y) : Tile();
}

struct Capture::Standing {
  uint32_t splat;
  Brush brush;
  glm::vec3 onto, across;  // its directions as it is seen
  float height;            // of its middle over the fin's foot, metres
};

// (Section 3.2 and figure 10.) What lies over the triangles around a fin, as the strip of it in which it lies
// sees it.
std::vector<Capture::Standing> Capture::standingOn(const Fin& fin, float& most) const {
  const ProxyEdge& edge = proxy_.edges[fin.edge];
  std::vector<uint32_t> around = proxy_.trianglesAt[edge.a], candidates;
  around.insert(around.end(), proxy_.trianglesAt[edge.b].begin(), proxy_.trianglesAt[edge.b].end());
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  for (const uint32_t t : around)
    candidates.insert(candidates.end(), splatsOver_[t].begin(), splatsOver_[t].end());
  std::sort(candidates.begin(), candidates.end());

  const auto& c = fin.corners;
  const float length = glm::distance(c[0], c[1]);
  const glm::vec3 along = (c[1] - c[0]) / length, normal = glm::cross(fin.normal, along);
  const glm::vec3 up = glm::dot(normal, c[3] - c[0] + c[2] - c[1]) < 0 ? -normal : normal;
  most = std::max(glm::dot(up, c[3] - c[0]), glm::dot(up, c[2] - c[1]));
  std::vector<Standing> standing;
  for (const uint32_t s : candidates) {
    const Splat& splat = splats_[s];
    const glm::vec3 from = splat.position - c[0];
    const float deep = glm::dot(from, fin.normal);
    if (std::abs(deep) > fin.depth) continue;
    const float part = glm::clamp(glm::dot(from, along) / length, 0.0f, 1.0f);
    const glm::vec3 view = unitOr(fin.normal, glm::mix(fin.matched[0], fin.matched[1], part));
    const float facing = glm::dot(view, fin.normal);
    if (std::abs(facing) < 0.3f) continue;
    const glm::vec3 onto = splat.along - view * glm::dot(splat.along, view);
    const float sine = glm::length(onto);
    Standing one{s, brushOf(splat, sine), {}, {}, glm::dot(from - view * (deep / facing), up)};
    if (one.brush.alpha <= 0 || one.height < -one.brush.reach || one.height > most + one.brush.reach)
      continue;
    one.onto = sine > kVanishes ? onto / sine : unitOr(along, along - view * glm::dot(along, view));
    one.across = glm::cross(view, one.onto);
    standing.push_back(one);
  }
  return standing;
}

Tile Capture::fin(const Fin& fin, float& top) const {
  float most = 0;
  const std::vector<Standing> standing = standingOn(fin, most);
  if (standing.empty() || !(most > 0)) return {};
  const glm::uvec2 whole = tileSize(fin, texel_);
  const float allRows = float(whole.y) - 2 * float(kGutter);
  float highest = 0;
  for (const Standing& one : standing) highest = std::max(highest, one.height + one.brush.reach);
  const float rows = glm::clamp(std::ceil(highest / most * allRows), 2.0f, allRows);
  top = rows / allRows;
  // As its two triangles are drawn; row 0 is the lowest here.
  const int width = int(whole.x), height = int(rows) + 2 * kGutter;
  const glm::vec3 &a = fin.corners[0], &b = fin.corners[1], overB = top * (fin.corners[2] - b),
                  overA = top * (fin.corners[3] - a);
  std::vector<glm::vec3> at(size_t(width) * size_t(height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float s = (float(x - kGutter) + 0.5f) / float(width - 2 * kGutter),
                  t = (float(y - kGutter) + 0.5f) / rows;
      at[size_t(y * width + x)] = a + s * (b - a) + (s >= t ? t * overB : t * overA + s * (overB - overA));
    }

  // Rows that a splat may come to: the lower side's lie closer.
  const glm::vec3 up = unitOr({0, 0, 0}, glm::cross(glm::cross(b - a, overA + overB), b - a));
  const float sides[] = {glm::dot(up, overA), glm::dot(up, overB)};
  const float high = std::max(sides[0], sides[1]), low = std::max(std::min(sides[0], sides[1]), 0.1f * high);
  std::vector<glm::vec4> texels(at.size(), glm::vec4(0));
  bool isThere = false;
  for (const Standing& one : standing) {
    const float bottom = one.height - one.brush.reach, roof = one.height + one.brush.reach;
    const float border = float(kGutter) / rows + 2 / rows;
    const Range touched = rangeOf(bottom / (bottom < 0 ? low : high) + border - 4 / rows,
                                  roof / (roof < 0 ? high : low) + border, rows, height);
    for (int y = touched.first; y <= touched.last; ++y)
      for (int x = 0; x < width; ++x) {
        const size_t i = size_t(y * width + x);
        const glm::vec3 d = at[i] - splats_[one.splat].position;
        const glm::vec2 offset(glm::dot(d, one.onto), glm::dot(d, one.across));
        if (glm::dot(offset, offset) > one.brush.reach * one.brush.reach) continue;
        lay(one.brush, offset, texels[i]);
        isThere |= texels[i].a > kSeen && x >= kGutter && x < width - kGutter && y >= kGutter;
      }
  }
  if (!isThere) return {};

  // Paint that would be cut off at the top of the shell ends softly.
  std::vector<glm::vec4> lying;
  lying.reserve(texels.size());
  for (int y = height; y-- > 0;) {
    const float t = top * (float(y - kGutter) + 0.5f) / rows;
    const float soft = glm::clamp((1 - t) / kSoftTop, 0.0f, 1.0f);
    for (int x = 0; x < width; ++x) lying.push_back(texels[size_t(y * width + x)] * soft);
  }
  return tileOf(lying, whole.x, uint32_t(height));
}

}  // namespace scumble::bake
