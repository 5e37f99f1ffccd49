#include "spheres.h"

#include <algorithm>
#include <cmath>

#include "mesh_kit/mesh_builder.h"
#include "mesh_kit/random.h"

namespace spheres {

using namespace meshkit;

Document makeSpheres(size_t triangles, size_t meshes) {
  Document document;
  document.materials = {{"Red", "#C8442F", "#6E2E48"},
                        {"Ochre", "#DDB878", "#85708A"},
                        {"Green", "#5E8F72", "#2F5468"},
                        {"Blue", "#4F7FA0", "#2A3F6B"},
                        {"White", "#F3E9D8", "#9DA6C0"}};
  Random random(2026);
  const auto columns = size_t(std::ceil(std::sqrt(16.0 / 9.0 * double(meshes))));
  // A ball of n latitudes and 2 n longitudes has 4 n (n - 1) triangles.
  const auto latitudes = std::max<size_t>(
      size_t(std::lround(0.5 + std::sqrt(0.25 + double(triangles) / 4.0 / double(meshes)))), 3);
  for (size_t i = 0; i < meshes; ++i) {
    const float radius = random.between(0.3f, 0.45f);
    std::vector<glm::vec2> profile;
    for (size_t k = 0; k <= latitudes; ++k) {
      const float polar = kPi * float(k) / float(latitudes);
      profile.push_back({radius * std::sin(polar), -radius * std::cos(polar)});
    }
    MeshBuilder ball("Ball" + std::to_string(i + 1));
    ball.setMaterial(random.below(int(document.materials.size())));
    ball.lathe(profile, int(2 * latitudes), Shading::smooth);
    document.addMesh(ball.take(), -1,
                     {float(i % columns) - 0.5f * float(columns), radius, -float(i / columns)});
  }
  return document;
}

}  // namespace spheres
