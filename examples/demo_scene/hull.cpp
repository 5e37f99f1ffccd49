// The hull: clinker planks, transom, deck with a cockpit, coaming, rails, benches, rudder and tiller.
#include "hull_form.h"
#include "parts.h"

namespace demo {
namespace {

using namespace meshkit;
constexpr int kStations = 34, kStrakes = 7;
constexpr float kLap = 0.024f;  // how far a plank's lower edge stands off the one below

float stationOf(int i) {
  // Closer together towards the stem, where the planks bend most.
  const float t = float(i) / float(kStations);
  return 1.0f - std::pow(1.0f - t, 1.25f);
}

// A point of a plank, `out` metres off the hull's form; side +1 is starboard.
glm::vec3 plankPoint(float s, float t, float out, float side) {
  glm::vec3 p = hullPoint(s, t);
  const float fade = std::min(1.0f, (1.0f - s) * 12.0f);  // planks run flush into the stem
  p.z += out * fade;
  p.y -= 0.35f * out * fade;
  return {p.x, p.y, side * p.z};
}

void addPlanks(MeshBuilder& mesh, float side) {
  for (int strake = 0; strake < kStrakes; ++strake) {
    const float t0 = float(strake) / kStrakes, t1 = float(strake + 1) / kStrakes;
    mesh.setMaterial(strake == kStrakes - 1 ? kHullTop : strake < 3 ? kHullBottom : kHull);
    Grid plank(3, kStations + 1), ledge(2, kStations + 1);
    for (int i = 0; i <= kStations; ++i) {
      const float s = stationOf(i);
      plank.at(0, i) = plankPoint(s, t0, kLap, side);
      plank.at(1, i) = plankPoint(s, 0.5f * (t0 + t1), 0.5f * kLap, side);
      plank.at(2, i) = plankPoint(s, t1, 0.0f, side);
      ledge.at(0, i) = plankPoint(s, t0, 0.0f, side);
      ledge.at(1, i) = plankPoint(s, t0, kLap, side);
    }
    // Facing outward: starboard rows run up and columns ahead, so ahead x up is starboard.
    mesh.grid(plank, {.shading = Shading::smooth, .flip = side < 0});
    if (strake > 0) mesh.grid(ledge, {.flip = side < 0});
  }
}

// The inside of the bulwark down to the deck.
void addBulwark(MeshBuilder& mesh, float side) {
  mesh.setMaterial(kTrim);
  Grid inside(2, kStations + 1);
  for (int i = 0; i <= kStations; ++i) {
    glm::vec3 p = hullPoint(stationOf(i), 1.0f);
    p.z = std::max(p.z - 0.03f, 0.0f);
    inside.at(1, i) = {p.x, p.y, side * p.z};
    // Leaning in below, or it would show through the planks, which draw in there too.
    inside.at(0, i) = {p.x, p.y - 0.1f, side * std::max(0.93f * p.z - 0.01f, 0.0f)};
  }
  mesh.grid(inside, {.flip = side > 0});
}

std::vector<glm::vec3> sheerLine(float side, float raise, float inset) {
  std::vector<glm::vec3> line;
  for (int i = 0; i <= kStations; ++i) {
    const glm::vec3 p = hullPoint(stationOf(i), 1.0f);
    line.push_back({p.x, p.y + raise, side * std::max(p.z - inset, 0.0f)});
  }
  return line;
}

// Where deck stations lie: dense at both ends of the cockpit, whose outline is round there.
std::vector<float> deckStations() {
  std::vector<float> xs;
  const float aft = -2.60f, fore = 2.68f;
  for (int i = 0; i < 6; ++i) xs.push_back(glm::mix(aft, kCockpitAft, float(i) / 6.0f));
  for (int i = 0; i < 36; ++i) {
    const float u = float(i) / 36.0f;
    xs.push_back(glm::mix(kCockpitAft, kCockpitFore, 0.5f - 0.5f * std::cos(u * kPi)));
  }
  for (int i = 0; i <= 14; ++i) xs.push_back(glm::mix(kCockpitFore, fore, float(i) / 14.0f));
  return xs;
}

void addDeck(MeshBuilder& mesh, float side) {
  const std::vector<float> xs = deckStations();
  mesh.setMaterial(kDeck);
  constexpr size_t kAcross = 4;
  Grid deck(kAcross + 1, xs.size());
  for (size_t i = 0; i < xs.size(); ++i) {
    const float outer = std::max(0.93f * halfBeam(stationAt(xs[i])) - 0.02f, 0.0f);
    const float inner = std::min(cockpitHalfWidth(xs[i]), outer);
    for (size_t r = 0; r <= kAcross; ++r) {
      const float z = glm::mix(outer, inner, float(r) / float(kAcross));
      deck.at(r, i) = {xs[i], deckHeight(xs[i], z), side * z};
    }
  }
  mesh.grid(deck, {.shading = Shading::smooth, .flip = side < 0, .projectAlong = {0, 1, 0}});
}

// The cockpit's outline, once round, counter-clockwise seen from above.
std::vector<glm::vec2> cockpitOutline() {
  std::vector<glm::vec2> outline;
  constexpr int kPieces = 30;
  for (int i = 0; i < kPieces; ++i) {
    const float x = glm::mix(kCockpitAft, kCockpitFore, 0.5f - 0.5f * std::cos(float(i) / kPieces * kPi));
    outline.push_back({x, cockpitHalfWidth(x)});
  }
  for (int i = 0; i < kPieces; ++i) {
    const float x = glm::mix(kCockpitFore, kCockpitAft, 0.5f - 0.5f * std::cos(float(i) / kPieces * kPi));
    outline.push_back({x, -cockpitHalfWidth(x)});
  }
  return outline;
}

void addCockpit(MeshBuilder& mesh) {
  const std::vector<glm::vec2> outline = cockpitOutline();
  const size_t count = outline.size();
  // Coaming: inner wall, top and outer wall are three rows of one band; the inner wall goes down to the sole.
  Grid inner(2, count), top(2, count), outer(2, count);
  for (size_t i = 0; i < count; ++i) {
    const glm::vec2 p = outline[i];
    const glm::vec2 n = glm::normalize(glm::vec2(p.x + 0.75f, 2.2f * p.y));
    const float deck = deckHeight(p.x, p.y), rim = deck + 0.13f;
    const glm::vec2 q = p + 0.04f * n;
    inner.at(0, i) = {p.x, kSole, p.y};
    inner.at(1, i) = top.at(1, i) = {p.x, rim, p.y};
    top.at(0, i) = outer.at(1, i) = {q.x, rim, q.y};
    outer.at(0, i) = {q.x, deck - 0.03f, q.y};
  }
  mesh.setMaterial(kCockpit);
  mesh.grid(inner, {.closed = true, .flip = true});
  mesh.setMaterial(kTrim);
  mesh.grid(top, {.closed = true});
  mesh.grid(outer, {.closed = true});
  mesh.setMaterial(kCockpit);
  std::vector<glm::vec3> sole;
  for (size_t i = 0; i < count; ++i) sole.push_back({outline[i].x, kSole, outline[i].y});
  mesh.polygon(sole);
  // Benches and a thwart.
  mesh.setMaterial(kDeck);
  for (float side : {-1.0f, 1.0f}) mesh.box({-1.05f, kBench - 0.02f, side * 0.43f}, {1.5f, 0.04f, 0.26f});
  mesh.box({-0.18f, kBench + 0.0f, 0.0f}, {0.26f, 0.05f, 1.12f});
}

void addTransom(MeshBuilder& mesh) {
  std::vector<glm::vec3> edge;
  for (int i = 0; i <= 12; ++i) edge.push_back(hullPoint(0.0f, float(i) / 12.0f));
  mesh.setMaterial(kHull);
  for (size_t i = 0; i + 1 < edge.size(); ++i) {
    const glm::vec3 a = edge[i], b = edge[i + 1];
    mesh.quad({a.x, a.y, -a.z}, {a.x, a.y, a.z}, {b.x, b.y, b.z}, {b.x, b.y, -b.z});
  }
  mesh.setMaterial(kTrim);
  const glm::vec3 corner = hullPoint(0.0f, 1.0f);
  const float inside = corner.x + 0.03f, deck = corner.y - 0.13f, half = 0.97f * corner.z;
  mesh.quad({inside, deck, half}, {inside, deck, -half}, {inside, corner.y, -half}, {inside, corner.y, half});
  mesh.bar({{corner.x, corner.y, -corner.z - 0.03f},
            {corner.x - 0.01f, corner.y + 0.03f, 0},
            {corner.x, corner.y, corner.z + 0.03f}},
           0.07f, 0.06f, {0, 1, 0});
}

Mesh makeHull() {
  MeshBuilder mesh("Hull");
  for (float side : {-1.0f, 1.0f}) {
    addPlanks(mesh, side);
    addBulwark(mesh, side);
    mesh.setMaterial(kTrim);
    mesh.bar(sheerLine(side, 0.0f, 0.0f), 0.075f, 0.055f, {0, 1, 0});
  }
  addTransom(mesh);
  // Stem post and keel.
  mesh.setMaterial(kTrim);
  std::vector<glm::vec3> stem;
  for (int i = 0; i <= 14; ++i) {
    const glm::vec3 p = hullPoint(1.0f, float(i) / 14.0f);
    stem.push_back({p.x + 0.02f, p.y + (i == 14 ? 0.07f : 0.0f), 0});
  }
  mesh.bar(stem, 0.07f, 0.08f, {1, 0, 0.001f});
  mesh.box({-0.5f, -0.36f, 0}, {3.6f, 0.16f, 0.08f});
  return mesh.take();
}

Mesh makeDeck() {
  MeshBuilder mesh("Deck");
  addDeck(mesh, 1.0f);
  addDeck(mesh, -1.0f);
  addCockpit(mesh);
  // A low hatch on the foredeck and a bitt for the bowsprit and the mooring line.
  mesh.setMaterial(kTrim);
  mesh.box({1.52f, deckHeight(1.52f, 0) + 0.05f, 0}, {0.36f, 0.12f, 0.42f}, 0.9f);
  mesh.box({2.02f, deckHeight(2.0f, 0) + 0.08f, 0.1f}, {0.08f, 0.26f, 0.08f});
  mesh.box({2.02f, deckHeight(2.0f, 0) + 0.08f, -0.1f}, {0.08f, 0.26f, 0.08f});
  mesh.box({2.02f, deckHeight(2.0f, 0) + 0.15f, 0.0f}, {0.07f, 0.06f, 0.34f});
  return mesh.take();
}

Mesh makeRudder() {
  MeshBuilder mesh("Rudder");
  mesh.setMaterial(kTrim);
  const std::vector<glm::vec2> blade = {{-2.47f, -0.42f}, {-2.53f, 0.2f}, {-2.66f, 0.98f}, {-2.84f, 0.98f},
                                        {-2.84f, 0.62f},  {-2.82f, 0.3f}, {-2.92f, 0.0f},  {-3.0f, -0.42f}};
  mesh.extrude(blade, -0.03f, 0.03f);
  return mesh.take();
}

Mesh makeTiller() {
  MeshBuilder mesh("Tiller");
  mesh.setMaterial(kMast);
  const auto path = smoothCurve(
      {{-2.78f, 0.93f, 0.0f}, {-2.4f, 0.97f, -0.07f}, {-2.0f, 0.98f, -0.17f}, {-1.44f, 1.03f, -0.33f}}, 4);
  std::vector<float> radii;
  for (size_t i = 0; i < path.size(); ++i)
    radii.push_back(glm::mix(0.042f, 0.028f, float(i) / float(path.size())));
  mesh.tube(path, radii, 7);
  // Lashed to the near coaming while his hands are busy.
  mesh.setMaterial(kRope);
  const glm::vec3 grip = glm::mix(path[path.size() - 3], path[path.size() - 2], 0.5f);
  mesh.tube({grip + glm::vec3(0.035f, 0, 0.01f), grip - glm::vec3(0.035f, 0, 0.01f)}, {0.046f}, 8);
  mesh.tube({grip, {grip.x + 0.06f, deckHeight(grip.x, 0.54f) + 0.12f, -cockpitHalfWidth(grip.x) - 0.02f}},
            {0.014f}, 5);
  return mesh.take();
}

}  // namespace

void addHull(Document& document, int boat) {
  const int hull = document.addMesh(makeHull(), boat);
  document.addMesh(makeDeck(), hull);
  document.addMesh(makeRudder(), hull);
  document.addMesh(makeTiller(), hull);
}

}  // namespace demo
