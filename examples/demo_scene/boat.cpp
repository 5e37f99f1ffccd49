// The boat as a whole: hull, rig, sails, and the sailor who hauls in her sheet; and how she rides the sea.
#include "hull_form.h"
#include "parts.h"
#include "timing.h"

namespace demo {
namespace {

using meshkit::kPi;

// She heads to the left and towards the viewer, and her crew's weight heels her to this side, so that the
// deck shows.
constexpr float kYaw = -0.26f, kHeel = 0.13f, kTrim = 0.012f;  // radians
constexpr glm::vec3 kPlace = {2.3f, 0.03f, 0.0f};

// A swell of four seconds with a slower one under it; their phases are such that she passes through her mean
// place, about, when the clip begins.
glm::vec3 placeAt(float time) {
  const float heave =
      0.045f * std::sin(phase(time, 4.0f) - 0.4f) + 0.020f * std::sin(phase(time, 8.0f) + 1.1f);
  return kPlace + glm::vec3(0, heave, 0);
}

glm::quat attitudeAt(float time) {
  const float roll =
      0.032f * std::sin(phase(time, 4.0f) + 0.3f) + 0.013f * std::sin(phase(time, 8.0f) - 0.8f);
  const float pitch =
      0.017f * std::sin(phase(time, 4.0f) + 2.6f) + 0.008f * std::sin(phase(time, 8.0f) - 1.57f);
  return glm::angleAxis(kPi - kYaw, glm::vec3(0, 1, 0)) * glm::angleAxis(kTrim + pitch, glm::vec3(0, 0, 1)) *
         glm::angleAxis(-kHeel + roll, glm::vec3(1, 0, 0));
}

}  // namespace

int addBoat(Document& document, int parent) {
  const int boat = document.addNode({"Boat", parent, placeAt(0.0f), attitudeAt(0.0f)});
  sailing(document).channels.push_back(meshkit::smoothTranslation(boat, slowKeys(), placeAt));
  sailing(document).channels.push_back(meshkit::smoothRotation(boat, slowKeys(), attitudeAt));
  addHull(document, boat);
  addRig(document, boat);
  addSails(document, boat);
  addSailor(document, boat);
  addSheet(document, boat);
  addFoam(document, parent, document.worldMatrix(boat));
  return boat;
}

}  // namespace demo
