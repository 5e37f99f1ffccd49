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
const Wave kWaves[] = {{{0.35f, 0.94f}, 17.0f, 0.13f, 0.4f},
                       {{-0.25f, 0.97f}, 9.5f, 0.085f, 2.1f},
                       {{0.62f, 0.78f}, 5.6f, 0.045f, 4.4f},
                       {{-0.55f, 0.83f}, 3.5f, 0.022f, 1.3f}};

// Waves shorter than a few facets are left out, or they would alias in the mesh itself.
float height(glm::vec2 p, float cell) {
  float y = 0.0f;
  for (const Wave& w : kWaves) {
    const float keep = glm::smoothstep(2.0f, 4.0f, w.length / cell);
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

int addSea(Document& document, int parent, glm::vec2 nearCenter) {
  MeshBuilder mesh("Sea");
  Random random(5);
  constexpr size_t kSectors = 144;
  constexpr float kReach = 650.0f;
  std::vector<float> radii{0.0f};
  while (radii.back() < kReach) radii.push_back(radii.back() + 0.55f + 0.042f * radii.back());
  Grid water(radii.size(), kSectors);
  for (size_t r = 0; r < radii.size(); ++r) {
    const float cell = 0.55f + 0.042f * radii[r];
    const bool edge = r == 0 || r + 1 == radii.size();
    for (size_t c = 0; c < kSectors; ++c) {
      // Uneven rings: an even pattern of facets would show as rays.
      const float jitter = edge ? 0.0f : 0.34f;
      const float radius = radii[r] + cell * random.between(-jitter, jitter);
      const float angle =
          2.0f * kPi * (float(c) + random.between(-jitter, jitter) + 0.5f * float(r % 2)) / kSectors;
      const glm::vec2 p = nearCenter + radius * glm::vec2(std::cos(angle), -std::sin(angle));
      water.at(r, c) = {p.x, edge && r > 0 ? 0.0f : height(p, std::max(cell, 0.04f * radii[r])), p.y};
    }
  }
  auto paint = [&](size_t r, size_t c) -> int {
    const glm::vec3 a = water.at(r, c), b = water.at(r, (c + 1) % kSectors), d = water.at(r + 1, c),
                    e = water.at(r + 1, (c + 1) % kSectors);
    const glm::vec3 middle = 0.25f * (a + b + d + e);
    const glm::vec3 across = glm::cross(e - a, d - b);
    if (glm::length(across) < 1e-9f) return kSea2;
    const glm::vec3 normal = glm::normalize(across);
    // Facets that lean towards the viewer show the depth, those that lean away mirror the sky.
    const float lean = -normal.z * 7.0f;
    const float distance = glm::length(glm::vec2(middle.x, middle.z) - nearCenter);
    const float far = glm::smoothstep(40.0f, 320.0f, distance);
    const float tone =
        lean * (1.0f - far) + 0.55f * windPatch({middle.x, middle.z}) * (1.0f - 0.5f * far) + 1.25f * far;
    if (tone > 0.92f) return kSea4;
    if (tone > 0.42f) return kSea1;
    if (tone > -0.42f) return kSea2;
    return kSea3;
  };
  mesh.grid(water, {.closed = true, .cellMaterial = paint});
  return document.addMesh(mesh.take(), parent);
}

}  // namespace demo
