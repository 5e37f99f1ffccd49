// A stand-in sea until there is a real one: rings of facets, finer near the boat, in four flat blues.
#include "mesh_kit/random.h"
#include "parts.h"

namespace demo {
namespace {

using namespace meshkit;

struct Wave {
  glm::vec2 direction;
  float length, height, phase;  // metres, metres, radians
};

// The crests lie roughly across the picture, so that they read as long, quiet strokes.
const Wave kWaves[] = {{{0.35f, 0.94f}, 17.0f, 0.115f, 0.4f},
                       {{-0.25f, 0.97f}, 9.5f, 0.065f, 2.1f},
                       {{0.62f, 0.78f}, 5.6f, 0.034f, 4.4f},
                       {{-0.55f, 0.83f}, 3.5f, 0.014f, 1.3f}};

// Waves shorter than a few facets are left out, or they would alias in the mesh itself.
float height(glm::vec2 p, float cell) {
  float y = 0.0f;
  for (const Wave& w : kWaves) {
    const float keep = glm::smoothstep(2.5f, 5.0f, w.length / cell);
    y += keep * w.height * std::sin(2.0f * kPi * glm::dot(p, w.direction) / w.length + w.phase);
  }
  return y;
}

// Slow patches of wind, stretched across the picture, in [-1, 1].
float windPatch(glm::vec2 p) {
  return 0.45f * std::sin(p.x * 0.11f + 1.7f * std::sin(p.y * 0.07f) + 0.4f) *
             std::sin(p.y * 0.31f + 0.5f * std::sin(p.x * 0.09f)) +
         0.55f * std::sin(p.x * 0.045f - p.y * 0.16f + 1.1f);
}

}  // namespace

float seaHeight(glm::vec2 place) {
  return height(place, 0.5f);
}

int addSea(Document& document, int parent, glm::vec2 nearCenter, const Wake& wake) {
  MeshBuilder mesh("Sea");
  Random random(5);
  // Square rings around the near centre, each wider than the one within: no pinch in the middle, no long
  // slivers.
  constexpr int kRings = 52;
  constexpr size_t kSide = 2 * kRings + 1;
  constexpr float kCell = 0.62f, kGrowth = 0.087f;  // metres; and more for every metre further out
  auto ringRadius = [](float ring) { return kCell / kGrowth * (std::exp(kGrowth * ring) - 1.0f); };
  Grid water(kSide, kSide);
  for (int r = -kRings; r <= kRings; ++r) {
    for (int c = -kRings; c <= kRings; ++c) {
      const int ring = std::max(std::abs(r), std::abs(c));
      const bool edge = ring == kRings;
      // Uneven, because an even pattern of facets would show.
      const float jitter = edge ? 0.0f : 0.38f;
      const glm::vec2 place = {float(c) + random.between(-jitter, jitter),
                               float(r) + random.between(-jitter, jitter)};
      const float reach = std::max({std::abs(place.x), std::abs(place.y), 1e-3f});
      const float scale = ringRadius(reach) / reach;
      const glm::vec2 p = nearCenter + place * scale;
      const float cell = kCell + kGrowth * ringRadius(reach);
      water.at(size_t(r + kRings), size_t(c + kRings)) = {p.x, edge ? 0.0f : height(p, cell), p.y};
    }
  }
  auto paint = [&](size_t r, size_t c) -> int {
    const glm::vec3 a = water.at(r, c), b = water.at(r, c + 1), d = water.at(r + 1, c),
                    e = water.at(r + 1, c + 1);
    const glm::vec3 middle = 0.25f * (a + b + d + e);
    const glm::vec3 normal = glm::normalize(glm::cross(d - b, e - a));
    // Facets that lean towards the viewer show the depth, those that lean away mirror the sky.
    const float lean = -normal.z * 7.0f;
    const float distance = glm::length(glm::vec2(middle.x, middle.z) - nearCenter);
    const float far = glm::smoothstep(40.0f, 240.0f, distance);
    const float tone =
        lean * (1.0f - far) + 0.55f * windPatch({middle.x, middle.z}) * (1.0f - far) + 1.25f * far;
    // Broken, paler water behind the boat.
    const glm::vec2 behind = glm::vec2(middle.x, middle.z) - wake.stern;
    const float along = glm::dot(behind, wake.astern),
                across = std::abs(wake.astern.x * behind.y - wake.astern.y * behind.x);
    if (along > -0.3f && along < wake.length && across < 0.38f + 0.05f * along) return kSea1;
    if (tone > 0.92f) return kSea4;
    if (tone > 0.42f) return kSea1;
    if (tone > -0.42f) return kSea2;
    return kSea3;
  };
  mesh.grid(water, {.flip = true, .projectAlong = {0, 1, 0}, .cellMaterial = paint});
  return document.addMesh(mesh.take(), parent);
}

}  // namespace demo
