// Magic dust: glowing specks that swirl around the cake and rise towards the balloons, each on a loop of
// its own. Their nodes are named, so that a look can hang a glow on them.
#include "mesh_kit/random.h"
#include "parts.h"
#include "timing.h"

namespace henry {
namespace {

using namespace meshkit;

struct Swirl {
  glm::vec3 center;
  float radius, height;  // metres: of the circle, and how far it rises and falls
  float start;           // radians
  int turns;             // in the loop; negative runs the other way
};

glm::vec3 placeAt(const Swirl& s, float time) {
  const float a = s.start + float(s.turns) * phase(time, kLoop);
  const float wave = std::sin(phase(time, 4.0f) + 2.0f * s.start);
  const float radius = s.radius * (1.0f + 0.18f * wave);
  return s.center + glm::vec3(radius * std::cos(a),
                              s.height * std::sin(phase(time, kLoop) + 3.0f * s.start) + 0.03f * wave,
                              radius * std::sin(a));
}

}  // namespace

void addDust(Document& document, int parent) {
  const int dust = document.addNode({"Dust", parent});
  Random random(5);
  constexpr int kSpecks = 20, kAroundCake = 13;
  for (int i = 0; i < kSpecks; ++i) {
    Swirl swirl;
    if (i < kAroundCake) {
      // A funnel above the candles: wider and slower the higher.
      const float up = float(i) / float(kAroundCake - 1);
      swirl = {kCake + glm::vec3(0.02f, glm::mix(0.42f, 1.02f, up), 0.0f), glm::mix(0.24f, 0.50f, up),
               glm::mix(0.04f, 0.10f, up), 2.4f * float(i), up < 0.5f ? 2 : 1};
    } else {
      const float along = float(i - kAroundCake) / float(kSpecks - kAroundCake - 1);
      swirl = {glm::mix(glm::vec3(-0.45f, 1.85f, -1.05f), glm::vec3(1.15f, 1.75f, -2.10f), along),
               random.between(0.24f, 0.42f), 0.12f, 1.9f * float(i), i % 2 ? 1 : -1};
    }
    MeshBuilder mesh("Dust " + std::to_string(i + 1));
    mesh.setMaterial(kDust);
    const float size = random.between(0.012f, 0.022f);
    addBall(mesh, {0, 0, 0}, glm::vec3(size), 1);
    const int node = document.addMesh(mesh.take(), dust);
    party(document).channels.push_back(
        smoothTranslation(node, evenTimes(kLoop, 64), [&](float time) { return placeAt(swirl, time); }));
  }
}

}  // namespace henry
