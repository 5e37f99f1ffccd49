// The foam along the hull: one flat, ragged shape that lies on the water.
#include "hull_form.h"
#include "mesh_kit/random.h"
#include "parts.h"
#include "timing.h"

namespace demo {
namespace {

using namespace meshkit;
constexpr float kAbove = 0.045f;  // metres over the water: its facets lie a little above or below its waves

// Where the hull's side at a station goes through the water, in the world.
glm::vec3 waterline(const glm::mat4& boat, float s, float side) {
  glm::vec3 below{0.0f};
  for (int i = 0; i <= 100; ++i) {
    glm::vec3 p = hullPoint(s, float(i) / 100.0f);
    p.z *= side;
    p = glm::vec3(boat * glm::vec4(p, 1.0f));
    below = p;
    if (p.y > seaHeight({p.x, p.z}) + kAbove) break;
  }
  return below;
}

glm::vec3 onWater(glm::vec2 p) {
  return {p.x, seaHeight(p) + kAbove, p.y};
}

}  // namespace

void addFoam(Document& document, int parent, const glm::mat4& boat) {
  MeshBuilder mesh("Foam");
  mesh.setMaterial(kFoam);
  Random random(21);
  const glm::vec3 middle = {boat[3].x, 0.0f, boat[3].z};
  const glm::vec2 ahead = glm::normalize(glm::vec2(boat[0].x, boat[0].z));
  for (float side : {-1.0f, 1.0f}) {
    const glm::vec2 abeam = side * glm::normalize(glm::vec2(boat[2].x, boat[2].z));
    constexpr size_t kPieces = 22;
    Grid strip(2, kPieces + 1);
    for (size_t i = 0; i <= kPieces; ++i) {
      // From the stem aft; widest where the bow wave curls away, ragged all along.
      const float s = glm::mix(0.995f, 0.02f, float(i) / float(kPieces));
      const glm::vec3 hull = waterline(boat, s, side);
      const glm::vec2 at = {hull.x, hull.z};
      const float curl = std::exp(-18.0f * (s - 0.80f) * (s - 0.80f));
      const float width = (0.30f + 0.45f * curl) * random.between(0.6f, 1.2f);
      // Well under the hull, which rolls in it.
      strip.at(0, i) = onWater(at - 0.20f * abeam) - middle;
      strip.at(1, i) = onWater(at + width * abeam - 0.6f * width * ahead) - middle;
    }
    mesh.grid(strip, {.flip = side < 0});
  }
  // It spreads as she comes down and draws in as she rises.
  const int foam = document.addMesh(mesh.take(), parent, middle);
  sailing(document).channels.push_back(meshkit::smoothScale(foam, slowKeys(), [](float time) {
    const float spread = std::sin(phase(time, 4.0f) + 2.4f);
    return glm::vec3(1.0f + 0.012f * spread, 1.0f, 1.0f + 0.05f * spread);
  }));
}

}  // namespace demo
