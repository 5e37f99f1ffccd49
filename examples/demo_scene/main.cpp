// demo_scene OUT.glb: writes the demo picture, a gaff-rigged boat coming home in low sun.

#include "mesh_kit/glb_writer.h"
#include "parts.h"
#include "timing.h"

namespace {

using namespace demo;

// Degrees: the sun stands low, to the left and a bit in front, so that jib, mast and gaff draw on the
// mainsail.
constexpr float kSunElevation = 18.0f, kSunAzimuth = 45.0f;  // azimuth from the left towards the viewer

constexpr float kSpeed = 1.0f;  // metres a second, of the boat and of the eyes that follow her

Document makeScene() {
  Document document;
  document.materials = palette();
  const int world = document.addNode({"World"});
  const int underway = document.addNode({"Underway", world});
  sailing(document).channels.push_back(meshkit::translationKeys(
      underway, {0.0f, kLoop}, [](float time) { return kSpeed * time * boatHeading(); }));
  addBoat(document, underway);
  addGulls(document, underway);
  addPier(document, world, {-27.0f, 0, -37.0f}, {-8.3f, 0, -10.1f});
  addShore(document, world);
  addLighthouse(document, world, {-25.5f, 4.15f, -79.5f});
  addOcean(document, world);
  addClouds(document, world);

  const float elevation = glm::radians(kSunElevation), azimuth = glm::radians(kSunAzimuth);
  document.addSun({-std::cos(azimuth) * std::cos(elevation), std::sin(elevation),
                   std::sin(azimuth) * std::cos(elevation)},
                  {1.0f, 0.86f, 0.66f}, 3.0f);
  document.addCamera({"Hero", 0.50f}, {0.0f, 3.4f, 21.0f}, {0.0f, 4.8f, 0.0f}, underway);
  document.addCamera({"Sailor", 0.46f}, {2.6f, 1.9f, 5.2f}, {4.3f, 1.30f, 0.0f}, underway);
  document.addCamera({"Pier", 0.56f}, {-14.3f, 3.2f, 0.8f}, {-12.1f, 1.5f, -13.0f});
  document.addCamera({"Wide", 0.62f}, {10.6f, 7.6f, 26.5f}, {-2.6f, 4.1f, -6.0f}, underway);
  document.restAtStartOf(sailing(document));
  return document;
}

}  // namespace

int main(int argc, char** argv) {
  return meshkit::generate(argc, argv, "demo_scene", makeScene);
}
