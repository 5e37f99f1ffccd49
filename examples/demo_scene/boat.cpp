// The boat as a whole: hull, rig, sails, and the sailor who hauls in her sheet.
#include "parts.h"

namespace demo {
namespace {

using meshkit::kPi;

// She heads to the left and towards the viewer, and her crew's weight heels her to this side, so that the
// deck shows. The waves add theirs.
constexpr float kYaw = -0.26f, kHeel = 0.13f, kTrimAngle = 0.012f;  // radians
constexpr glm::vec3 kPlace = {2.3f, 0.03f, 0.0f};

glm::quat course() {
  return glm::angleAxis(kPi - kYaw, glm::vec3(0, 1, 0));
}

glm::quat attitude() {
  return course() * glm::angleAxis(kTrimAngle, glm::vec3(0, 0, 1)) *
         glm::angleAxis(-kHeel, glm::vec3(1, 0, 0));
}

}  // namespace

glm::vec3 boatHeading() {
  return course() * glm::vec3(1, 0, 0);
}

int addBoat(Document& document, int parent) {
  const int boat = document.addNode({"Boat", parent, kPlace, attitude()});
  document.nodes[size_t(boat)].extras = R"({"scumble_float": {"length": 5, "beam": 1.8, "bow": "x"}})";
  addHull(document, boat);
  addRig(document, boat);
  addSails(document, boat);
  addSailor(document, boat);
  addSheet(document, boat);
  return boat;
}

}  // namespace demo
