// The boat as a whole: hull, rig, sails, and the sailor who hauls in her sheet.
#include "hull_form.h"
#include "parts.h"

namespace demo {

int addBoat(Document& document, int parent) {
  using meshkit::kPi;
  // She heads to the left and towards the viewer, and her crew's weight heels her to this side, so that the
  // deck shows.
  constexpr float kYaw = -0.26f, kHeel = 0.13f, kTrim = 0.012f;  // radians
  const glm::vec2 place = {2.3f, 0.0f};
  const glm::quat rotation = glm::angleAxis(kPi - kYaw, glm::vec3(0, 1, 0)) *
                             glm::angleAxis(kTrim, glm::vec3(0, 0, 1)) *
                             glm::angleAxis(-kHeel, glm::vec3(1, 0, 0));
  const int boat = document.addNode({"Boat", parent, {place.x, 0.03f, place.y}, rotation});
  addHull(document, boat);
  addRig(document, boat);
  addSails(document, boat);

  addFoam(document, parent, document.worldMatrix(boat));
  addSailor(document, boat);
  addSheet(document, boat);
  return boat;
}

}  // namespace demo
