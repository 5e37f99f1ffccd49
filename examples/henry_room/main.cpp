// henry_room OUT.glb: writes a round room in the late morning, with a cake, a hedgehog and some magic.

#include "mesh_kit/glb_writer.h"
#include "parts.h"
#include "timing.h"

namespace {

using namespace henry;

Document makeScene() {
  Document document;
  document.materials = palette();
  const int world = document.addNode({"World"});
  addRoom(document, world);
  addShafts(document, world);
  addFloor(document, world);
  addKitchenDoor(document, world);
  addLeaves(document, world);
  addShelf(document, world);
  addTable(document, world);
  addChairs(document, world);
  addPresent(document, world);
  addCake(document, world);
  addHedgehog(document, world);
  addBalloons(document, world);
  addDust(document, world);
  addParlour(document, world);

  document.addSun(towardsSun(), {1.0f, 0.88f, 0.66f}, 3.0f);
  auto camera = [&](const char* name, float fov, glm::vec3 eye, glm::vec3 target) {
    document.addCamera({name, fov, 16.0f / 9.0f, 0.05f, 100.0f}, eye, target);
    // The thing that it looks at has the name alone.
    document.nodes.back().name += " camera";
  };
  camera("Room", 0.80f, {0.40f, 1.46f, 2.90f}, {0.0f, 0.93f, -0.9f});
  camera("Cake", 0.60f, {-0.45f, 1.28f, 1.27f}, {-0.83f, 1.14f, -0.95f});
  camera("Parlour", 0.66f, {0.34f, 1.38f, -0.95f}, {0.42f, 1.06f, -4.5f});
  camera("Window", 0.74f, {0.9f, 1.25f, 0.8f}, {-2.1f, 1.3f, -1.7f});
  document.restAtStartOf(party(document));
  return document;
}

}  // namespace

int main(int argc, char** argv) {
  return meshkit::generate(argc, argv, "henry_room", makeScene);
}
