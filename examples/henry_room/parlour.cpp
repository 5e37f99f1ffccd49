// The back parlour behind the arch: its own small shell with a window, an armchair, a lamp and shelves. Its
// colours are as strong as the room's; the look's mist takes it back.
#include "parts.h"

namespace henry {
namespace {

using namespace meshkit;

// Looks along +Z.
Mesh makeArmchair() {
  MeshBuilder mesh("Armchair");
  mesh.setMaterial(kParlourChair);
  mesh.box({0, 0.24f, 0.02f}, {0.62f, 0.30f, 0.56f}, 1.0f);
  mesh.loft({ellipseRing({0, 0.20f, -0.26f}, {0.40f, 0, 0}, {0, 0, -0.13f}, 20, 0.7f),
             ellipseRing({0, 0.75f, -0.32f}, {0.42f, 0, 0}, {0, 0, -0.13f}, 20, 0.7f),
             ellipseRing({0, 0.98f, -0.35f}, {0.33f, 0, 0}, {0, 0, -0.11f}, 20, 0.7f),
             ellipseRing({0, 1.05f, -0.36f}, {0.18f, 0, 0}, {0, 0, -0.06f}, 20, 0.7f)},
            {.shading = Shading::smooth});
  for (float x : {-0.37f, 0.37f})
    mesh.tube({{x, 0.46f, -0.26f}, {x, 0.48f, 0.0f}, {x, 0.46f, 0.28f}}, {0.11f, 0.12f, 0.11f}, 12);
  for (float x : {-0.37f, 0.37f}) mesh.box({x, 0.26f, 0.02f}, {0.18f, 0.40f, 0.54f});
  mesh.setMaterial(kParlourWood);
  for (float x : {-0.36f, 0.36f})
    for (float z : {-0.24f, 0.24f}) mesh.box({x, 0.04f, z}, {0.07f, 0.10f, 0.07f});
  return mesh.take();
}

Mesh makeLamp() {
  MeshBuilder mesh("Lamp");
  mesh.setMaterial(kParlourWood);
  mesh.lathe({{0.16f, 0.0f}, {0.16f, 0.03f}, {0.025f, 0.06f}, {0.02f, 1.25f}, {0.0f, 1.25f}}, 12);
  mesh.setMaterial(kParlourLamp);
  mesh.lathe({{0.26f, 1.12f}, {0.14f, 1.46f}, {0.0f, 1.47f}}, 20, Shading::smooth);
  mesh.lathe({{0.0f, 1.14f}, {0.26f, 1.12f}}, 20);
  return mesh.take();
}

Mesh makeBookcase() {
  MeshBuilder mesh("Bookcase");
  mesh.setMaterial(kParlourWood);
  for (float y : {0.05f, 0.45f, 0.85f, 1.22f}) mesh.box({0, y, 0}, {0.80f, 0.05f, 0.26f});
  for (float x : {-0.40f, 0.40f}) mesh.box({x, 0.62f, 0}, {0.05f, 1.24f, 0.28f});
  mesh.box({0, 0.62f, -0.12f}, {0.80f, 1.20f, 0.02f});
  mesh.setMaterial(kParlourChair);
  mesh.box({-0.20f, 0.62f, 0.01f}, {0.30f, 0.28f, 0.18f});
  mesh.box({0.18f, 0.20f, 0.01f}, {0.34f, 0.26f, 0.18f});
  mesh.setMaterial(kParlourLamp);
  mesh.box({0.16f, 1.00f, 0.01f}, {0.26f, 0.24f, 0.18f});
  return mesh.take();
}

}  // namespace

void addParlour(Document& document, int parent) {
  const Shell& shell = parlour();
  const int top = document.addNode({"Parlour", parent, shell.center});
  // The shell is built in the world, its furniture around the middle of the parlour.
  document.addMesh(
      makeShell("Parlour shell", shell, {kParlourWall, kParlourWainscot, kParlourWall, kParlourWall}),
      parent);
  const Opening& window = shell.openings.front();
  addWindow(document, parent, "Parlour window", shell, window, kParlourWindow);
  auto turned = [](float degrees) { return glm::angleAxis(glm::radians(degrees), glm::vec3(0, 1, 0)); };
  document.addMesh(makeArmchair(), top, {0.30f, 0, -0.85f}, turned(-25.0f));
  document.addMesh(makeLamp(), top, {-0.42f, 0, -1.30f});
  document.addMesh(makeBookcase(), top, {1.25f, 0, -1.15f}, turned(-48.0f));
}

}  // namespace henry
