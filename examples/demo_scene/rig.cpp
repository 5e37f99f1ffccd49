// Spars and rigging: mast, boom, gaff, bowsprit, stays, shrouds, halyards, sheet, pennant and lantern.
#include "parts.h"
#include "rig_form.h"
#include "timing.h"

namespace demo {
namespace {

using namespace meshkit;
constexpr float kRopeRadius = 0.0135f;  // thinner ropes would flicker at 720 lines

void rope(MeshBuilder& mesh, glm::vec3 from, glm::vec3 to, float sag = 0.0f, float radius = kRopeRadius) {
  mesh.tube(hangingRope(from, to, sag, sag > 0.0f ? 8 : 3), {radius}, 5);
}

void spar(MeshBuilder& mesh, glm::vec3 from, glm::vec3 to, float start, float middle, float end,
          int sides = 10) {
  const glm::vec3 along = glm::normalize(to - from) * 0.02f;
  mesh.tube({from, glm::mix(from, to, 0.25f), glm::mix(from, to, 0.6f), to - along, to},
            {start, middle, middle * 0.96f, end, end * 0.5f}, sides);
}

Mesh makeMast() {
  MeshBuilder mesh("Mast");
  mesh.setMaterial(kMast);
  spar(mesh, mastPoint(kSole), mastPoint(kMastTop), 0.078f, 0.074f, 0.04f, 12);
  // Truck, and the band where the shrouds meet.
  mesh.tube({mastPoint(kMastTop - 0.01f), mastPoint(kMastTop + 0.05f)}, {0.055f, 0.045f}, 8, Shading::flat);
  mesh.setMaterial(kIron);
  mesh.tube({mastPoint(4.50f), mastPoint(4.58f)}, {0.085f}, 10, Shading::flat);
  mesh.tube({mastPoint(1.42f), mastPoint(1.50f)}, {0.092f}, 10, Shading::flat);
  return mesh.take();
}

Mesh makeBoom() {
  MeshBuilder mesh("Boom");
  mesh.setMaterial(kMast);
  spar(mesh, boomPoint(-0.01f), boomPoint(1.03f), 0.045f, 0.052f, 0.04f);
  return mesh.take();
}

Mesh makeGaff() {
  MeshBuilder mesh("Gaff");
  mesh.setMaterial(kMast);
  spar(mesh, gaffPoint(-0.01f), gaffPoint(1.04f), 0.05f, 0.05f, 0.034f);
  // Jaws around the mast.
  const glm::vec3 throat = gaffPoint(0.0f);
  mesh.box(throat + glm::vec3(0.06f, -0.02f, 0.09f), {0.26f, 0.07f, 0.04f});
  mesh.box(throat + glm::vec3(0.06f, -0.02f, -0.09f), {0.26f, 0.07f, 0.04f});
  return mesh.take();
}

Mesh makeBowsprit() {
  MeshBuilder mesh("Bowsprit");
  mesh.setMaterial(kMast);
  spar(mesh, bowspritPoint(0.0f), bowspritPoint(1.0f), 0.05f, 0.05f, 0.034f, 8);
  return mesh.take();
}

Mesh makeStandingRigging() {
  MeshBuilder mesh("StandingRigging");
  mesh.setMaterial(kRope);
  const glm::vec3 hounds = mastPoint(4.54f);
  // Where the jib is set, its luff is the line: a rope beside a sail's edge would only dot it.
  const glm::vec3 stayFoot = bowspritPoint(0.95f);
  rope(mesh, hounds, glm::mix(stayFoot, hounds, 0.88f), 0.0f, 0.016f);
  rope(mesh, glm::mix(stayFoot, hounds, 0.06f), stayFoot, 0.0f, 0.016f);
  const glm::vec3 cutwater = hullPoint(1.0f, 0.52f);
  rope(mesh, bowspritPoint(0.95f), cutwater + glm::vec3(0.03f, 0, 0));
  for (float side : {-1.0f, 1.0f}) {
    for (float x : {0.95f, 0.55f}) {
      const float s = stationAt(x);
      const glm::vec3 chain = {x, sheerHeight(s) - 0.02f, side * (halfBeam(s) + 0.03f)};
      mesh.setMaterial(kRope);
      rope(mesh, hounds + glm::vec3(0, 0, side * 0.05f), chain, 0.0f, 0.016f);
      mesh.setMaterial(kIron);
      mesh.box(chain + glm::vec3(0, -0.03f, 0), {0.05f, 0.16f, 0.04f});
    }
  }
  return mesh.take();
}

Mesh makeRunningRigging() {
  MeshBuilder mesh("RunningRigging");
  mesh.setMaterial(kRope);
  // Peak halyard in two parts, topping lift, and the sheet from the boom to the deck at the stern.
  rope(mesh, mastPoint(kMastTop - 0.55f), gaffPoint(0.92f));
  rope(mesh, mastPoint(kMastTop - 0.80f), gaffPoint(0.52f));
  const glm::vec3 block = boomPoint(0.60f);
  const glm::vec3 horse = {-0.48f, kSole + 0.03f, -0.06f};
  rope(mesh, block, horse, 0.0f);
  rope(mesh, boomPoint(0.68f), horse + glm::vec3(-0.06f, 0, 0.02f), 0.0f);
  // Halyard falls along the mast down to a pin.
  rope(mesh, mastPoint(4.4f) + glm::vec3(0.09f, 0, 0.06f), mastPoint(0.95f) + glm::vec3(0.12f, 0, 0.08f));
  mesh.setMaterial(kTrim);
  mesh.box(block + glm::vec3(-0.02f, -0.1f, 0), {0.07f, 0.12f, 0.05f});
  mesh.box(sheetBlock() + glm::vec3(0, 0.03f, 0), {0.07f, 0.13f, 0.05f});
  mesh.box(horse + glm::vec3(0, 0.02f, 0), {0.08f, 0.12f, 0.05f});
  mesh.box(mastPoint(kMastTop - 0.57f) + glm::vec3(-0.08f, 0, 0), {0.06f, 0.11f, 0.05f});
  return mesh.take();
}

// Streams to leeward and aft in two slow waves, and ends in a swallowtail. u from the mast to the end, v from
// foot to head.
glm::vec3 pennantPoint(float u, float v) {
  const float wave = 0.045f * std::sin(u * 6.5f + 0.6f) * (0.3f + u);
  const float width = glm::mix(0.30f, 0.15f, u);
  const float tail = 0.20f * (1.0f - std::abs(2.0f * v - 1.0f)) * u;  // the notch of the swallowtail
  const float length = 0.88f * u - tail * u;
  return {-length * 0.93f, (v - 0.5f) * width - 0.10f * u * u + 0.3f * wave, 0.36f * length + wave};
}

constexpr int kPennantJoints = 4;
float pennantJoint(int joint) {
  return 0.25f * float(joint);
}

Mesh makePennant() {
  MeshBuilder mesh("Pennant");
  mesh.setMaterial(kPennant);
  constexpr size_t kColumns = 16;
  mesh.setBinding([](glm::vec3 p) {
    // Between the two joints that are nearest along it.
    const float u = std::clamp(-p.x / (0.93f * 0.88f) * float(kPennantJoints), 0.0f, kPennantJoints - 1.0f);
    const int joint = std::min(int(u), kPennantJoints - 2);
    return boundBetween(joint, joint + 1, glm::smoothstep(0.0f, 1.0f, u - float(joint)));
  });
  Grid cloth(5, kColumns);
  for (size_t c = 0; c < kColumns; ++c)
    for (size_t r = 0; r < 5; ++r)
      cloth.at(r, c) = pennantPoint(float(c) / float(kColumns - 1), float(r) / 4.0f);
  mesh.grid(cloth, {.shading = Shading::smooth, .projectAlong = {0, 0, 1}});
  return mesh.take();
}

// A wave runs along it every second, wider towards the end.
void addPennant(Document& document, int mast) {
  const int top = document.addNode({"Pennant", mast, mastPoint(kMastTop - 0.12f) + glm::vec3(-0.04f, 0, 0)});
  std::vector<int> joints;
  for (int i = 0; i < kPennantJoints; ++i) {
    const glm::vec3 at = pennantPoint(pennantJoint(i), 0.5f);
    const glm::vec3 before = i == 0 ? glm::vec3(0.0f) : pennantPoint(pennantJoint(i - 1), 0.5f);
    joints.push_back(
        document.addNode({"Pennant" + std::to_string(i + 1), i == 0 ? top : joints.back(), at - before}));
    sailing(document).channels.push_back(rotationKeys(joints.back(), onTwos(), [i](float time) {
      const float wave = std::sin(phase(time, 1.0f) - 1.1f * float(i)), reach = 0.07f + 0.055f * float(i);
      return glm::angleAxis(1.2f * reach * wave, glm::vec3(0, 1, 0)) *
             glm::angleAxis(reach * std::sin(phase(time, 1.0f) - 1.1f * float(i) + 0.7f), glm::vec3(0, 0, 1));
    }));
  }
  document.addBoundMesh(makePennant(), joints, top);
}

Mesh makeLantern() {
  MeshBuilder mesh("Lantern");
  mesh.setMaterial(kIron);
  mesh.lathe({{0, -0.09f}, {0.06f, -0.09f}, {0.06f, -0.06f}, {0.0f, -0.06f}}, 8);
  mesh.lathe({{0, 0.08f}, {0.065f, 0.08f}, {0.03f, 0.13f}, {0.0f, 0.13f}}, 8);
  mesh.setMaterial(kLantern);
  mesh.lathe({{0, -0.06f}, {0.045f, -0.06f}, {0.05f, 0.01f}, {0.04f, 0.08f}, {0.0f, 0.08f}}, 8);
  return mesh.take();
}

}  // namespace

void addRig(Document& document, int boat) {
  const int mast = document.addMesh(makeMast(), boat);
  document.addMesh(makeBoom(), mast);
  document.addMesh(makeGaff(), mast);
  document.addMesh(makeBowsprit(), boat);
  document.addMesh(makeStandingRigging(), mast);
  document.addMesh(makeRunningRigging(), mast);
  addPennant(document, mast);
  document.addMesh(makeLantern(), boat, {-2.38f, deckHeight(-2.38f, 0.36f) + 0.09f, -0.40f});
}

}  // namespace demo
