// The part of the sheet that the old sailor hauls on: from the block under the boom to his fists, and its
// slack down into the cockpit.
#include "haul.h"
#include "parts.h"
#include "rig_form.h"
#include "timing.h"

namespace demo {
namespace {

using namespace meshkit;

enum Joint : int { kAtBlock, kInHands, kOnSole };

// Where his lower hand lets the sheet go, in the boat.
glm::vec3 gripAt(float time) {
  return glm::vec3(sailorInBoat() * glm::vec4(haulAt(time * kFrameRate).grip, 1.0f));
}

// Joints only move, they do not turn: so what is bound to two of them in parts is a straight line.
Mesh makeSheet(glm::vec3 block, glm::vec3 grip, glm::vec3 sole) {
  MeshBuilder mesh("Sheet");
  mesh.setMaterial(kRope);
  constexpr float kTaut = 0.018f, kSlack = 0.0135f;  // metres; the hauled part is the picture's line
  mesh.setBinding([=](glm::vec3 p) {
    const glm::vec3 line = grip - block;
    return boundBetween(kAtBlock, kInHands, glm::dot(p - block, line) / glm::dot(line, line));
  });
  mesh.tube({block, glm::mix(block, grip, 0.33f), glm::mix(block, grip, 0.67f), grip}, {kTaut}, 6);
  // The slack falls to the near side of his knee.
  mesh.setBinding(
      [=](glm::vec3 p) { return boundBetween(kOnSole, kInHands, (p.y - sole.y) / (grip.y - sole.y)); });
  mesh.tube(smoothCurve({grip, glm::mix(grip, sole, 0.15f) + glm::vec3(0.04f, -0.06f, -0.13f),
                         glm::mix(grip, sole, 0.5f) + glm::vec3(0.13f, -0.10f, -0.18f), sole},
                        4),
            {kSlack}, 6);
  return mesh.take();
}

}  // namespace

void addSheet(Document& document, int boat) {
  const glm::vec3 block = sheetBlock(), grip = gripAt(0.0f), sole = {-1.52f, kSole + 0.02f, 0.02f};
  const int atBlock = document.addNode({"SheetAtBlock", boat, block}),
            inHands = document.addNode({"SheetInHands", boat, grip}),
            onSole = document.addNode({"SheetOnSole", boat, sole});
  document.addBoundMesh(makeSheet(block, grip, sole), {atBlock, inHands, onSole}, boat);
  sailing(document).channels.push_back(translationKeys(inHands, onTwos(), gripAt));
}

}  // namespace demo
