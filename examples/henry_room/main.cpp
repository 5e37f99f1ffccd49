// henry_room OUT.glb: writes a round room in the late morning, with a cake, a hedgehog and some magic.
#include <cstdio>

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
  addFloor(document, world);
  addKitchenDoor(document, world);
  addLeaves(document, world);
  addShelves(document, world);
  addTable(document, world);
  addChairs(document, world);
  addCake(document, world);
  addHedgehog(document, world);
  addBalloons(document, world);
  addDust(document, world);
  addParlour(document, world);

  const float elevation = glm::radians(kSunElevation);
  document.addSun(std::cos(elevation) * towards(kSunBearing) + glm::vec3(0, std::sin(elevation), 0),
                  {1.0f, 0.88f, 0.66f}, 3.0f);
  document.addCamera({"Room", 0.84f, 16.0f / 9.0f, 0.05f, 100.0f}, {1.05f, 1.38f, 2.75f},
                     {-0.18f, 0.92f, -0.9f});
  document.addCamera({"Cake", 0.60f, 16.0f / 9.0f, 0.05f, 100.0f}, {-0.55f, 1.18f, 1.35f},
                     {-0.85f, 0.95f, -0.6f});
  document.addCamera({"Parlour", 0.66f, 16.0f / 9.0f, 0.05f, 100.0f}, {0.15f, 1.35f, -0.2f},
                     {0.45f, 1.05f, -4.5f});
  document.addCamera({"Window", 0.74f, 16.0f / 9.0f, 0.05f, 100.0f}, {0.9f, 1.25f, 0.9f},
                     {-2.3f, 1.25f, -1.4f});
  document.restAtStartOf(party(document));
  return document;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 || argv[1][0] == '-') {
    std::fprintf(stderr, "usage: henry_room OUT.glb\n");
    return 2;
  }
  const Document document = makeScene();
  const std::string problem = meshkit::writeGlb(document, argv[1], "scumble henry_room");
  if (!problem.empty()) {
    std::fprintf(stderr, "henry_room: error: %s\n", problem.c_str());
    return 5;
  }
  std::printf("%s: %zu triangles, %zu meshes, %zu materials\n", argv[1], document.triangleCount(),
              document.meshes.size(), document.materials.size());
  return 0;
}
