// A flat sheet of water. The renderer knows the node by its name and puts its ocean there instead; other
// viewers show the sheet.
#include "parts.h"

namespace demo {

int addOcean(Document& document, int parent) {
  constexpr float kReach = 650.0f;  // metres: behind what lies on the horizon
  MeshBuilder mesh("Ocean");
  mesh.setMaterial(kOcean);
  meshkit::Grid water(2, 2);
  water.points = {{-kReach, 0, -kReach}, {kReach, 0, -kReach}, {-kReach, 0, kReach}, {kReach, 0, kReach}};
  mesh.grid(water, {.flip = true});
  return document.addMesh(mesh.take(), parent);
}

}  // namespace demo
