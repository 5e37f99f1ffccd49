#include "features/ink/drawing/drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/type_precision.hpp>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <unordered_map>

#include "features/ink/drawing/chains.h"
#include "features/ink/drawing/contours.h"
#include "features/ink/fullness.shared.h"
#include "features/ink/ink.h"
#include "features/ink/ink.shared.h"
#include "features/ink/ink_knobs.h"
#include "features/ink/over/over_lines.h"
#include "passes/final_shadow/final_shadow_knobs.h"

namespace scumble::ink {

namespace {

using AovOfView = frame::LineDrawing::AovOfView;

// Layers, from the lowest one on, as the knobs of kinds are called.
constexpr const char* kLayersOfOver[] = {"shadows", "steps", "objects", "intersections", "cutouts"};
constexpr const char* kLayersOfEdges[] = {"silhouettes", "boundaries", "materials", "creases", "colors"};
static_assert(std::size(kLayersOfOver) == shared::kInkOverKinds);
static_assert(std::size(kLayersOfEdges) == shared::kInkKinds);

constexpr float kStep = 1.5f;       // pixels between places at which a line is looked at
constexpr float kShortest = 2.0f;   // pixels: what is seen or hidden for less than that is not
constexpr float kThinnest = 0.05f;  // pixels of radius
// Pixels by which strokes may differ from lines; and from borders of pixels, which are stairs.
constexpr float kPrecision = 0.1f, kPrecisionOfStairs = 0.75f;

glm::vec4 texel(const Image& image, uint32_t x, uint32_t y) {
  glm::vec4 value(0.0f);
  for (size_t c = 0; c < std::min<size_t>(4, image.channels.size()); ++c)
    value[int(c)] = image.at(x, y, uint32_t(c));
  return value;
}
glm::vec4 nearestTexel(const Image& image, glm::vec2 place) {
  return texel(image, uint32_t(std::clamp(place.x, 0.0f, float(image.width - 1))),
               uint32_t(std::clamp(place.y, 0.0f, float(image.height - 1))));
}

// What is drawn at a place of a chain.
struct Place {
  Drawing::Point point;
  bool isSeen = true;
};

// By how much a point is off the way from one to another.
float errorOf(const Drawing::Point& point, const Drawing::Point& from, const Drawing::Point& to) {
  const glm::vec3 a(from.x, from.y, from.radius), p(point.x, point.y, point.radius);
  const glm::vec3 way = glm::vec3(to.x, to.y, to.radius) - a;
  const float t = std::clamp(glm::dot(p - a, way) / std::max(glm::dot(way, way), 1e-12f), 0.0f, 1.0f);
  return glm::length(p - a - t * way);
}

// Leaves out what lies between others (Douglas and Peucker 1973).
std::vector<Drawing::Point> simplified(const std::vector<Drawing::Point>& points, float precision) {
  std::vector<bool> isKept(points.size());
  isKept.front() = isKept.back() = true;
  std::vector<std::pair<size_t, size_t>> open{{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    size_t worst = from;
    float error = precision;
    for (size_t i = from + 1; i < to; ++i)
      if (const float here = errorOf(points[i], points[from], points[to]); here > error)
        worst = i, error = here;
    if (worst == from) continue;
    isKept[worst] = true;
    open.push_back({from, worst});
    open.push_back({worst, to});
  }
  std::vector<Drawing::Point> kept;
  for (size_t i = 0; i < points.size(); ++i)
    if (isKept[i]) kept.push_back(points[i]);
  return kept;
}

float lengthOf(std::span<const Place> places) {
  float length = 0;
  for (size_t i = 1; i < places.size(); ++i)
    length += glm::distance(glm::vec2(places[i - 1].point.x, places[i - 1].point.y),
                            glm::vec2(places[i].point.x, places[i].point.y));
  return length;
}

// A chain's places as strokes: one for each run that is seen, or hidden.
void addStrokes(std::vector<Place> places, bool isClosed, const Drawing::Stroke& style, float precision,
                std::vector<Drawing::Stroke>& strokes) {
  const auto endOfRun = [&](size_t from) {
    size_t to = from;
    while (to < places.size() && places[to].isSeen == places[from].isSeen) ++to;
    return to;
  };
  // A closed chain begins where its longest run does.
  if (isClosed) {
    places.pop_back();  // the first one again
    const size_t change = endOfRun(0) % places.size();
    std::rotate(places.begin(), places.begin() + std::ptrdiff_t(change), places.end());
    size_t longest = 0, most = 0;
    for (size_t from = 0; from < places.size(); from = endOfRun(from))
      if (const size_t length = endOfRun(from) - from; length > most) longest = from, most = length;
    std::rotate(places.begin(), places.begin() + std::ptrdiff_t(longest), places.end());
  }
  // What is short is as what comes before it, where something comes after it.
  for (size_t from = endOfRun(0); from < places.size();) {
    const size_t to = endOfRun(from);
    const bool isShort =
        (isClosed || to < places.size()) && lengthOf(std::span(places).subspan(from, to - from)) < kShortest;
    for (size_t i = from; isShort && i < to; ++i) places[i].isSeen = !places[i].isSeen;
    from = to;
  }
  if (isClosed) {
    isClosed = endOfRun(0) == places.size();
    places.push_back(places.front());
    places.back().isSeen = places[places.size() - 2].isSeen;
  }
  for (size_t from = 0; from < places.size();) {
    const size_t to = endOfRun(from);
    std::vector<Drawing::Point> points;
    for (size_t i = from; i < to; ++i) points.push_back(places[i].point);
    // Runs reach to where the next one begins, which is as wide as if it were seen.
    if (to < places.size()) {
      const Drawing::Point& next = places[to].point;
      points.push_back({next.x, next.y, points.back().radius});
    }
    const bool isSeen = places[from].isSeen;
    from = to;
    if (isSeen && std::all_of(points.begin(), points.end(),
                              [](const Drawing::Point& point) { return point.radius < kThinnest; }))
      continue;
    if (points.size() < 2) continue;
    Drawing::Stroke stroke = style;
    stroke.isHidden = !isSeen;
    stroke.isClosed = isClosed;
    stroke.points = simplified(points, precision);
    if (isClosed) stroke.points.pop_back();
    if (stroke.points.size() > 1) strokes.push_back(std::move(stroke));
  }
}

// -- Lines of edges

// A line of the table (ink.shared.h).
struct TableLine {
  glm::vec2 ends[2], shift[2];
  float radii[2], metres[2];
  glm::vec4 color;
  glm::vec2 outward, turn, reach, beforeSlope, beyondSlope;
  bool isOutline, isTurned;  // away, which nobody sees
  int kind;
  uint32_t seen;  // as LineRecord has it
};

struct Table {
  float pixelScale, sceneRadius, parallel, metresOfPixel, fade, outer, overlap, offset, doubled, doubledWidth;
  bool isExterior;
  std::vector<TableLine> lines;
  uint32_t leftOut = 0;
};

Table tableOf(const Image& image) {
  constexpr uint32_t kHeader = uint32_t(shared::kLineTableRows * shared::kLineTexels);
  const glm::vec4 first = texel(image, 0, kHeader), second = texel(image, 1, kHeader),
                  third = texel(image, 2, kHeader);
  Table table{first.y,
              first.z,
              first.w,
              second.x,
              second.y,
              second.z,
              second.w,
              third.x,
              third.y,
              third.z,
              int(third.w) == shared::kInkExterior,
              {}};
  const uint32_t count = uint32_t(first.x), room = uint32_t(shared::kLineTableRoom);
  table.leftOut = count - std::min(count, room);
  for (uint32_t n = 0; n < std::min(count, room); ++n) {
    const auto part = [&](uint32_t down) {
      return texel(image, n % uint32_t(shared::kLineTableWidth),
                   n / uint32_t(shared::kLineTableWidth) * uint32_t(shared::kLineTexels) + down);
    };
    const glm::vec4 spine = part(0), shift = part(1), radii = part(2), outward = part(4), turn = part(5),
                    seen = part(6), slopes = part(7);
    if (outward.w <= 0) continue;
    table.lines.push_back({{{spine.x, spine.y}, {spine.z, spine.w}},
                           {{shift.x, shift.y}, {shift.z, shift.w}},
                           {radii.x, radii.y},
                           {radii.z, radii.w},
                           part(3),
                           {outward.x, outward.y},
                           {turn.x, turn.y},
                           {turn.z, turn.w},
                           {slopes.x, slopes.y},
                           {slopes.z, slopes.w},
                           outward.z > 0,
                           ((int(outward.w) - 1) & shared::kInkTurned) != 0,
                           (int(outward.w) - 1) & ~shared::kInkTurned,
                           uint32_t(seen.x) | uint32_t(seen.y) << 16});
  }
  return table;
}

// Nodes are places on the screen, at a distance: vertices that faces share are placed alike, but for
// rounding.
class PlacedNodes {
 public:
  uint32_t at(glm::vec2 place, float metres) {
    const glm::i64vec2 cell = glm::floor(place / kCell);
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        if (const auto found = cells_.find(keyOf(cell + glm::i64vec2(x, y))); found != cells_.end())
          for (const Node& node : found->second)
            if (glm::distance(node.place, place) < kCell && std::abs(node.metres - metres) < 1e-4f * metres)
              return node.number;
    cells_[keyOf(cell)].push_back({place, metres, count_});
    return count_++;
  }
  uint32_t count() const { return count_; }

 private:
  static constexpr float kCell = 1.0f / 64;  // pixels
  struct Node {
    glm::vec2 place;
    float metres;
    uint32_t number;
  };
  static uint64_t keyOf(glm::i64vec2 cell) { return uint64_t(cell.y) << 32 ^ uint64_t(cell.x & 0xFFFFFFFF); }
  std::unordered_map<uint64_t, std::vector<Node>> cells_;
  uint32_t count_ = 0;
};

// Drops lines that lie on others of their kind, as those of objects in one place do: pens would draw them
// twice.
std::vector<Link> linksOf(std::vector<TableLine>& lines, uint32_t& nodeCount) {
  PlacedNodes nodes;
  std::set<std::tuple<uint32_t, uint32_t, int, bool>> known;
  std::erase_if(lines, [&](const TableLine& line) {
    const uint32_t a = nodes.at(line.ends[0], line.metres[0]), b = nodes.at(line.ends[1], line.metres[1]);
    return a != b && !known.emplace(std::min(a, b), std::max(a, b), line.kind, line.isTurned).second;
  });
  std::map<std::array<float, 5>, uint32_t> families;
  std::vector<Link> links;
  for (const TableLine& line : lines) {
    Link link{};
    for (int i = 0; i < 2; ++i) {
      link.nodes[i] = nodes.at(line.ends[i], line.metres[i]);
      link.ends[i] = line.ends[i];
    }
    const glm::vec4 c = line.color;
    const float kind = float(line.kind + (line.isTurned ? shared::kInkTurned : 0));
    link.family =
        families.emplace(std::array{c.r, c.g, c.b, c.a, kind}, uint32_t(families.size())).first->second;
    links.push_back(link);
  }
  nodeCount = nodes.count();
  return links;
}

class EdgeStrokes {
 public:
  EdgeStrokes(const Table& table, const Image& depth, const Image& surface)
      : table_(table), depth_(depth), surface_(surface) {}

  void add(const Chain& chain, std::vector<Drawing::Stroke>& strokes) const {
    // At the nodes between lines, both of them agree.
    const size_t count = chain.parts.size();
    std::vector<float> radii(count + 1);
    std::vector<glm::vec2> shifts(count + 1);
    for (size_t node = 0; node <= count; ++node) {
      const bool hasBefore = node > 0 || chain.isClosed, hasAfter = node < count || chain.isClosed;
      float radius = 0, weight = 0;
      glm::vec2 shift(0.0f);
      const auto take = [&](size_t part, bool isEnd) {
        const TableLine& line = table_.lines[chain.parts[part].link];
        const int end = int(chain.parts[part].isReversed != isEnd);
        radius += line.radii[end], shift += line.shift[end], weight += 1;
      };
      if (hasBefore) take(node > 0 ? node - 1 : count - 1, true);
      if (hasAfter) take(node < count ? node : 0, false);
      radii[node] = radius / weight, shifts[node] = shift / weight;
    }
    std::vector<Place> places, doubled;
    glm::vec3 color(0.0f);
    for (size_t part = 0; part < count; ++part) {
      const TableLine& line = table_.lines[chain.parts[part].link];
      const int from = int(chain.parts[part].isReversed), to = 1 - from;
      const int steps = std::max(1, int(std::ceil(glm::distance(line.ends[0], line.ends[1]) / kStep)));
      for (int i = part == 0 ? 0 : 1; i <= steps; ++i) {
        const float t = float(i) / float(steps), radius = glm::mix(radii[part], radii[part + 1], t);
        const glm::vec2 spine = glm::mix(line.ends[from], line.ends[to], t);
        const glm::vec2 shift = glm::mix(shifts[part], shifts[part + 1], t);
        const float fullness = meanFullnessAt(line, from == 0 ? t : 1 - t, radius);
        const bool isSeen = fullness > 0;
        const float drawn = isSeen ? radius * fullness : radius;
        color += colorAt(line, spine);
        const float moved = line.isOutline ? table_.offset * table_.pixelScale : 0;
        const auto place = [&](float pixels, float half) {
          const glm::vec2 at = spine + pixels * shift;
          return Place{{at.x, at.y, half}, isSeen};
        };
        const float out = line.isOutline && table_.isExterior ? std::max(drawn - table_.overlap, 0.0f) : 0;
        places.push_back(place(moved + out, drawn));
        if (line.isOutline && table_.doubled != 0)
          doubled.push_back(
              place(moved + out + table_.doubled * table_.pixelScale, drawn * table_.doubledWidth));
      }
    }
    Drawing::Stroke style;
    const TableLine& first = table_.lines[chain.parts.front().link];
    style.layer = kLayersOfEdges[first.kind];
    color /= float(places.size());
    style.color = color * color;
    addStrokes(std::move(places), chain.isClosed, style, kPrecision, strokes);
    if (doubled.size() > 1) addStrokes(std::move(doubled), chain.isClosed, style, kPrecision, strokes);
  }

 private:
  // On the screen, what is linear is one over the distance; but in a parallel projection the distance itself.
  float metresAt(const TableLine& line, float t) const {
    if (table_.parallel > 0.5f) return shared::inkDepthAlong(line.metres[0], line.metres[1], t);
    return 1 / shared::inkDepthAlong(1 / line.metres[0], 1 / line.metres[1], t);
  }
  float depthAt(glm::vec2 place) const {
    const float metres = nearestTexel(depth_, place).x;
    return std::isfinite(metres) ? metres : 1e30f;
  }
  // As ink_seen.glsl has both.
  float meanFullnessAt(const TableLine& line, float t, float radius) const {
    if (line.isTurned) return 0;
    const float size = std::max(glm::distance(line.ends[0], line.ends[1]), 1e-3f);
    float sum = 0;
    for (int i = -1; i <= 1; ++i)
      sum += fullnessAt(line, t + float(i) * shared::kInkMeanOver / size, size, radius);
    return sum / 3;
  }
  float fullnessAt(const TableLine& line, float t, float size, float radius) const {
    const glm::vec2 place = glm::mix(line.ends[0], line.ends[1], t);
    // What lies outside of the picture is not drawn.
    if (place.x < -radius || place.y < -radius || place.x > float(depth_.width) + radius ||
        place.y > float(depth_.height) + radius)
      return 0;
    const float end = metresAt(line, glm::clamp(t, 0.0f, 1.0f));
    const float pixel = table_.metresOfPixel * glm::mix(end, 1.0f, table_.parallel);
    const float metres = shared::inkNoFurther(metresAt(line, t), end, t, pixel);
    float farthest = 0;
    const auto look = [&](float away) {
      const glm::vec2 slope = away > 0 ? line.beyondSlope : line.beforeSlope,
                      at = place + away * line.outward;
      const float seen = depthAt(at);
      const glm::vec2 middle =
          glm::floor(glm::clamp(at, glm::vec2(0.0f), glm::vec2(depth_.width, depth_.height) - 1.0f)) + 0.5f;
      const float linear = shared::inkLinear(metres, table_.parallel) + glm::dot(slope, middle - place);
      if (away > 0) farthest = std::max(farthest, seen);
      return shared::inkBefore(metres, shared::inkLinear(linear, table_.parallel), seen, pixel,
                               std::abs(away));
    };
    const glm::vec2 beyond(look(shared::kInkBeyond), look(shared::kInkFarBeyond)),
        before(look(-shared::kInkBefore), look(-shared::kInkFarBefore));
    const float hidden = shared::inkHidden(beyond, before, uint32_t(line.isOutline));
    const shared::InkPlace p{metres,
                             farthest,
                             hidden,
                             pixel,
                             radius,
                             line.turn,
                             shared::inkReach(t, line.reach, size),
                             uint32_t(line.isOutline)};
    return shared::inkSeen(t, line.seen) *
           shared::inkFullness(p, table_.sceneRadius, table_.fade, table_.outer);
  }
  // Square root; as ink_line.frag has it.
  glm::vec3 colorAt(const TableLine& line, glm::vec2 spine) const {
    const glm::vec3 color = line.color;
    if (line.color.a == 0) return color;
    const glm::vec4 surface = nearestTexel(surface_, spine - 2.0f * line.outward);
    if (surface.a <= 0) return color;
    return glm::mix(color, (line.color.a > 0 ? glm::vec3(0.6f) : color) * glm::sqrt(glm::vec3(surface)),
                    std::abs(line.color.a));
  }

  const Table& table_;
  const Image& depth_;
  const Image& surface_;  // its colours in shadow, linear
};

// -- Lines of the picture

// Through the middles of links, and the ends of the chain: of stairs that is half as high.
void addContours(const Contours& contours, float precision, const Drawing::Stroke& style,
                 const std::function<float(glm::vec2)>& radius, std::vector<Drawing::Stroke>& strokes) {
  for (const Chain& chain : chainsOf(contours.links, contours.nodeCount)) {
    std::vector<Place> places;
    const auto add = [&](glm::vec2 place) { places.push_back({{place.x, place.y, radius(place)}}); };
    const auto endOf = [&](const Chain::Part& part, bool isLast) {
      return contours.links[part.link].ends[part.isReversed != isLast ? 1 : 0];
    };
    if (!chain.isClosed) add(endOf(chain.parts.front(), false));
    for (const Chain::Part& part : chain.parts) add(0.5f * (endOf(part, false) + endOf(part, true)));
    if (chain.isClosed)
      places.push_back(places.front());
    else
      add(endOf(chain.parts.back(), true));
    if (lengthOf(places) >= kShortest)
      addStrokes(std::move(places), chain.isClosed, style, precision, strokes);
  }
}

void addPictureLines(const AovOfView& aov, const look::LookData& look, const Table& table,
                     std::vector<Drawing::Stroke>& strokes) {
  const std::array<OverLine, shared::kInkOverKinds> lines = overLines(look);
  const Image& depth = *aov("depth");
  const bool inMetres = look.get<InkParams>().unit == shared::kInkMetres;
  const float scale = pixelsOfUnit(look, 1 / table.metresOfPixel, table.pixelScale);
  const auto styleOf = [&](int kind) {
    Drawing::Stroke style;
    style.layer = kLayersOfOver[kind];
    const glm::vec3 root = lines[size_t(kind)].color;
    style.color = root * root;
    return style;
  };
  const auto radiusOf = [&](int kind) {
    const float radius = lines[size_t(kind)].radius * scale;
    return [radius, inMetres, &depth, &table](glm::vec2 place) {
      const float metres = nearestTexel(depth, place).x;
      return inMetres && table.parallel < 0.5f && std::isfinite(metres) ? radius / metres : radius;
    };
  };
  // Around shadow shapes, and between steps of light.
  const int steps = look.get<passes::FinalShadowParams>().steps;
  for (const int kind : {shared::kInkOverShadows, shared::kInkOverSteps}) {
    if (!lines[size_t(kind)].isShown) continue;
    const Image& light = *aov("final-shadow");
    const auto lit = [&](uint32_t x, uint32_t y) -> std::optional<float> {
      const glm::vec4 there = texel(light, x, y);
      if (there.a < 0.999f) return std::nullopt;
      return (there.r - there.b) * float(std::max(steps, 1));
    };
    const int first = kind == shared::kInkOverShadows ? 0 : 1,
              last = kind == shared::kInkOverShadows ? 1 : steps;
    for (int step = first; step < last; ++step)
      addContours(levelContours(light.width, light.height, lit, float(step) + 0.5f), kPrecision,
                  styleOf(kind), radiusOf(kind), strokes);
  }
  // Between pieces.
  const Image* const seenPieces = aov(kPiecesAov);
  for (int kind = shared::kInkOverObjects; seenPieces && kind < shared::kInkOverKinds; ++kind) {
    if (!lines[size_t(kind)].isShown) continue;
    const Image& pieces = *seenPieces;
    const auto pieceAt = [&](uint32_t x, uint32_t y) {
      const glm::vec4 piece = texel(pieces, x, y);
      return piece.r > 0 ? piece : glm::vec4(0, 0, 0, 1e9f);
    };
    const auto isBorder = [&](uint32_t x, uint32_t y, uint32_t otherX, uint32_t otherY) {
      const glm::vec4 here = pieceAt(x, y), there = pieceAt(otherX, otherY);
      const float metres = std::min(here.a, there.a);
      const float steep = shared::kInkSteepest * table.metresOfPixel * glm::mix(metres, 1.0f, table.parallel);
      const bool touches = std::abs(there.a - here.a) <= steep;
      if (kind == shared::kInkOverObjects) return there.g != here.g;
      if (kind == shared::kInkOverIntersections) return there.r != here.r && touches;
      return (there.a < here.a ? there.b : here.b) > 0 && !touches;
    };
    addContours(borderContours(pieces.width, pieces.height, isBorder), kPrecisionOfStairs, styleOf(kind),
                radiusOf(kind), strokes);
  }
}

std::vector<const char*> aovs(const scene::SceneData& scene, const look::LookData& look) {
  if (!mayShow(look)) return {};
  std::vector<const char*> names{kLineTableAov, "depth", "shadowed"};
  if (mayShowShadows(look)) names.push_back("final-shadow");
  if (mayShowPieces(scene, look)) names.push_back(kPiecesAov);
  return names;
}

void add(const AovOfView& aov, const look::LookData& look, Drawing& drawing) {
  const Image* const lines = aov(kLineTableAov);
  if (!lines) return;  // the look, at its time, draws none
  Table table = tableOf(*lines);
  if (table.metresOfPixel <= 0) return;  // nothing has edges
  drawing.leftOut += table.leftOut;
  addPictureLines(aov, look, table, drawing.strokes);
  // Outlines above all.
  uint32_t nodeCount = 0;
  const std::vector<Link> links = linksOf(table.lines, nodeCount);
  const std::vector<Chain> chains = chainsOf(links, nodeCount);
  const EdgeStrokes strokes(table, *aov("depth"), *aov("shadowed"));
  for (int kind = shared::kInkKinds - 1; kind >= 0; --kind)
    for (const Chain& chain : chains)
      if (table.lines[chain.parts.front().link].kind == kind) strokes.add(chain, drawing.strokes);
}

}  // namespace

frame::LineDrawing lineDrawing() {
  return {aovs, add};
}

}  // namespace scumble::ink
