// Twigs that hang before the windows: green in the light that comes through, and a few leaf shadows inside.
#include "mesh_kit/random.h"
#include "parts.h"

namespace henry {
namespace {

using namespace meshkit;

// A leaf folded along its rib.
void addLeaf(MeshBuilder& mesh, glm::vec3 root, glm::vec3 along, glm::vec3 side, float length) {
  const glm::vec3 fold = 0.12f * length * glm::normalize(glm::cross(along, side));
  const glm::vec3 tip = root + along * length, middle = root + along * (0.45f * length);
  const glm::vec3 a = middle + side * (0.26f * length) + fold, b = middle - side * (0.26f * length) + fold;
  mesh.triangle(root, a, middle);
  mesh.triangle(middle, a, tip);
  mesh.triangle(root, middle, b);
  mesh.triangle(middle, tip, b);
}

void addTwig(MeshBuilder& mesh, Random& random, const std::vector<glm::vec3>& points) {
  const std::vector<glm::vec3> path = smoothCurve(points, 6);
  mesh.setMaterial(kBranch);
  mesh.tube(path, {0.022f}, 6);
  for (size_t i = 3; i < path.size(); ++i) {
    const glm::vec3 forward = glm::normalize(path[i] - path[i - 1]);
    for (int k = 0; k < 2; ++k) {
      const glm::vec3 along = glm::normalize(forward + 0.9f * random.direction() + glm::vec3(0, -0.5f, 0));
      const glm::vec3 side = glm::normalize(glm::cross(along, random.direction()));
      mesh.setMaterial(random.unit() < 0.4f ? kLeafDark : kLeaf);
      addLeaf(mesh, path[i], along, side, random.between(0.20f, 0.28f));
    }
  }
}

}  // namespace

void addLeaves(Document& document, int parent) {
  Random random(21);
  int number = 1;
  // Outside each window: from above on one side, down across a corner of the view.
  const glm::vec2 ways[][4] = {{{-1.0f, -0.9f}, {-0.62f, -0.62f}, {-0.40f, -0.42f}, {-0.22f, -0.34f}},
                               {{1.0f, 0.85f}, {0.58f, 0.58f}, {0.36f, 0.44f}, {0.18f, 0.40f}},
                               {{-0.9f, -0.7f}, {-0.5f, -0.42f}, {-0.24f, -0.28f}, {0.0f, -0.30f}}};
  for (size_t w = 1; w < 3; ++w) {
    MeshBuilder mesh("Twig " + std::to_string(number++));
    std::vector<glm::vec3> points;
    for (const glm::vec2& p : ways[w - 1]) points.push_back({p.x, 1.2f * p.y, -0.55f});
    addTwig(mesh, random, points);
    const float bearing = float(kWindowColumns[w]) * kColumnDegrees;
    document.addMesh(mesh.take(), parent, room().at(bearing, kWindow.height), onWall(bearing));
  }
}

}  // namespace henry
