// The part of the sheet that the old sailor hauls on: from the block under the boom to his fists, and its
// slack down into the cockpit.
#include "haul.h"
#include "parts.h"
#include "rig_form.h"
#include "timing.h"

namespace demo {
namespace {

using namespace meshkit;

enum SheetJoint : int { kAtBlock, kInHands, kOnLap };

// Where his lower hand lets the sheet go, in the boat.
glm::vec3 gripAt(float time) {
  return glm::vec3(sailorInBoat() * glm::vec4(haulAt(time * kFrameRate).grip, 1.0f));
}

// Joints only move, they do not turn: so what is bound to two of them in parts is a straight line.
Mesh makeSheet(glm::vec3 block, glm::vec3 grip, glm::vec3 lap) {
  MeshBuilder mesh("Sheet");
  mesh.setMaterial(kRope);
  constexpr float kTaut = 0.018f, kSlack = 0.0135f;  // metres; the hauled part is the picture's line
  mesh.setBinding([=](glm::vec3 p) {
    const glm::vec3 line = grip - block;
    return boundBetween(kAtBlock, kInHands, glm::dot(p - block, line) / glm::dot(line, line));
  });
  mesh.tube({block, glm::mix(block, grip, 0.33f), glm::mix(block, grip, 0.67f), grip}, {kTaut}, 6);
  // The slack hangs from his hands to between his knees, and from there lies still.
  const glm::vec3 sole = {-1.42f, kSole + 0.02f, 0.34f};
  mesh.setBinding([=](glm::vec3 p) {
    const glm::vec3 line = grip - lap;
    return boundBetween(kOnLap, kInHands, glm::dot(p - lap, line) / glm::dot(line, line));
  });
  mesh.tube(smoothCurve({grip, glm::mix(grip, lap, 0.35f) + glm::vec3(0.02f, -0.04f, -0.03f),
                         glm::mix(grip, lap, 0.7f) + glm::vec3(0.02f, -0.03f, -0.02f), lap,
                         glm::mix(lap, sole, 0.5f) + glm::vec3(0.03f, 0.0f, 0.0f), sole},
                        3),
            {kSlack}, 6);
  return mesh.take();
}

}  // namespace

void addSheet(Document& document, int boat) {
  const glm::vec3 block = sheetBlock(), grip = gripAt(0.0f), lap = {-1.54f, 0.96f, 0.335f};
  const int atBlock = document.addNode({"SheetAtBlock", boat, block}),
            inHands = document.addNode({"SheetInHands", boat, grip}),
            onLap = document.addNode({"SheetOnLap", boat, lap});
  document.addBoundMesh(makeSheet(block, grip, lap), {atBlock, inHands, onLap}, boat);
  sailing(document).channels.push_back(translationKeys(inHands, onTwos(), gripAt));
}

}  // namespace demo
