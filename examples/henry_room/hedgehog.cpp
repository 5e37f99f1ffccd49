// Henry: a small hedgehog on his chair, big eyes, party hat. He breathes and tilts his head.
#include "mesh_kit/random.h"
#include "parts.h"
#include "timing.h"

namespace henry {
namespace {

using namespace meshkit;

// His space: he looks along +Z, +Y is up, the seat is the origin.
constexpr glm::vec3 kHead = {0.0f, 0.44f, 0.03f};

// Quills in rows on the back of an egg.
struct Coat {
  glm::vec3 center, halfSize;
  float face;          // degrees from +Z at which the first row stands
  int rows, around;    // and quills in the longest row
  float length;        // of the longest
  float crown, belly;  // heights in the unit egg above and below which it is bare
};

// A quill: it leaves the skin, bends backwards and has a light tip.
void addQuill(MeshBuilder& mesh, glm::vec3 root, glm::vec3 out, glm::vec3 back, float length) {
  const glm::vec3 middle = root + 0.55f * length * glm::normalize(out + 0.5f * back);
  const glm::vec3 tip = middle + 0.45f * length * glm::normalize(out + back);
  const glm::vec3 along = glm::normalize(tip - root);
  const glm::vec3 side = glm::normalize(glm::cross(along, glm::vec3(0.31f, 0.9f, 0.3f)));
  auto ring = [&](glm::vec3 center, float radius) {
    return ellipseRing(center, side * radius, glm::cross(along, side) * radius, 5);
  };
  const float wide = 0.09f * length;
  const LoftOptions open{.shading = Shading::smooth, .capStart = false, .capEnd = false};
  const auto neck = ring(middle, 0.82f * wide);
  mesh.loft({ring(root - 0.1f * length * out, wide), neck}, open);
  mesh.setMaterial(kSpikeTip);
  mesh.loft({neck, ring(tip, 0.06f * wide)}, open);
}

// Rows like shingles: each stands in the gaps of the one before, and those behind are longer.
void addQuills(MeshBuilder& mesh, const Coat& coat) {
  Random random(11);
  for (int row = 0; row < coat.rows; ++row) {
    const float t = float(row) / float(coat.rows - 1);
    const float slope = glm::radians(glm::mix(coat.face, 172.0f, t));
    const int count = std::max(int(float(coat.around) * std::sin(slope)), 3);
    for (int i = 0; i < count; ++i) {
      const float turn =
          2.0f * kPi * (float(i) + 0.5f * float(row % 2) + random.between(-0.2f, 0.2f)) / float(count);
      const glm::vec3 way = {std::sin(slope) * std::sin(turn), std::sin(slope) * std::cos(turn),
                             std::cos(slope)};
      if (way.y > coat.crown || way.y < coat.belly) continue;
      const glm::vec3 out = glm::normalize(way / coat.halfSize + 0.7f * random.direction());
      const float length =
          coat.length * glm::mix(0.62f, 1.0f, std::min(3.0f * t, 1.0f)) * random.between(0.88f, 1.1f);
      mesh.setMaterial((row + i) % 3 == 0 ? kSpikeDark : kSpike);
      // Those around the face lie flat, so that it stays clear.
      addQuill(mesh, coat.center + way * coat.halfSize, out,
               glm::mix(1.3f, 0.75f, std::min(2.0f * t, 1.0f)) * glm::vec3(0, 0.07f, -1.0f), length);
    }
  }
}

Mesh makeBody() {
  MeshBuilder mesh("Henry body");
  mesh.setMaterial(kSpikeDark);
  addBall(mesh, {0, 0.21f, -0.035f}, {0.195f, 0.225f, 0.175f}, 3);
  mesh.setMaterial(kFur);
  addBall(mesh, {0, 0.20f, 0.03f}, {0.165f, 0.205f, 0.150f}, 3);
  addQuills(mesh, {{0, 0.21f, -0.035f}, {0.19f, 0.22f, 0.17f}, 62.0f, 11, 48, 0.13f, 0.90f, -0.80f});
  // Feet over the seat's edge; arms that reach for the table.
  mesh.setMaterial(kFurDark);
  for (float x : {-1.0f, 1.0f}) {
    addBall(mesh, {0.10f * x, 0.03f, 0.19f}, {0.055f, 0.05f, 0.085f}, 2);
    mesh.tube(
        smoothCurve({{0.16f * x, 0.30f, 0.04f}, {0.19f * x, 0.27f, 0.15f}, {0.13f * x, 0.31f, 0.26f}}, 4),
        {0.05f, 0.048f, 0.046f, 0.045f, 0.044f, 0.042f, 0.040f, 0.042f, 0.046f}, 10);
    addBall(mesh, {0.13f * x, 0.315f, 0.27f}, glm::vec3(0.052f, 0.045f, 0.052f), 2);
  }
  return mesh.take();
}

// The neck is at the origin.
Mesh makeHead() {
  MeshBuilder mesh("Henry head");
  const glm::vec3 middle = {0, 0.18f, 0};
  mesh.setMaterial(kSpikeDark);
  addBall(mesh, middle + glm::vec3(0, 0.02f, -0.045f), {0.225f, 0.205f, 0.185f}, 3);
  addQuills(
      mesh,
      {middle + glm::vec3(0, 0.02f, -0.045f), {0.22f, 0.20f, 0.18f}, 60.0f, 12, 54, 0.155f, 0.62f, -0.72f});
  mesh.setMaterial(kFur);
  addBall(mesh, middle + glm::vec3(0, -0.01f, 0.03f), {0.205f, 0.180f, 0.165f}, 3);
  // Snout, nose, ears.
  mesh.loft({ellipseRing({0, 0.145f, 0.15f}, {0.105f, 0, 0}, {0, 0.085f, 0}, 16),
             ellipseRing({0, 0.140f, 0.21f}, {0.078f, 0, 0}, {0, 0.062f, 0}, 16),
             ellipseRing({0, 0.145f, 0.265f}, {0.050f, 0, 0}, {0, 0.042f, 0}, 16),
             ellipseRing({0, 0.150f, 0.295f}, {0.024f, 0, 0}, {0, 0.022f, 0}, 16)},
            {.shading = Shading::smooth});
  mesh.setMaterial(kNose);
  addBall(mesh, {0, 0.152f, 0.300f}, {0.034f, 0.029f, 0.028f}, 2);
  mesh.setMaterial(kFurDark);
  for (float x : {-1.0f, 1.0f}) addBall(mesh, {0.19f * x, 0.29f, 0.01f}, {0.06f, 0.062f, 0.028f}, 2);
  // A smile under the nose.
  mesh.setMaterial(kNose);
  mesh.tube(smoothCurve({{-0.055f, 0.112f, 0.226f}, {0, 0.088f, 0.228f}, {0.055f, 0.112f, 0.226f}}, 4),
            {0.008f}, 6);
  // Eyes that are mostly pupil, with a light in each.
  for (float x : {-1.0f, 1.0f}) {
    const glm::vec3 eye = {0.088f * x, 0.225f, 0.150f};
    mesh.setMaterial(kEye);
    addBall(mesh, eye, {0.060f, 0.072f, 0.045f}, 2);
    mesh.setMaterial(kNose);
    addBall(mesh, eye + glm::vec3(-0.010f * x, -0.004f, 0.022f), {0.040f, 0.050f, 0.032f}, 2);
    mesh.setMaterial(kEye);
    addBall(mesh, eye + glm::vec3(-0.010f * x - 0.012f, 0.018f, 0.050f), {0.013f, 0.015f, 0.008f}, 1);
  }
  return mesh.take();
}

Mesh makeHat() {
  MeshBuilder mesh("Henry hat");
  mesh.setTransform(glm::translate(glm::mat4(1.0f), {0.03f, 0.335f, -0.015f}) *
                    glm::rotate(glm::mat4(1.0f), -0.16f, {0, 0, 1}) *
                    glm::rotate(glm::mat4(1.0f), -0.10f, {1, 0, 0}));
  mesh.setMaterial(kHat);
  mesh.lathe({{0.128f, 0.025f}, {0.004f, 0.285f}}, 20, Shading::smooth);
  mesh.setMaterial(kHatBand);
  mesh.lathe({{0.120f, 0.0f}, {0.138f, 0.0f}, {0.132f, 0.040f}, {0.115f, 0.045f}}, 20);
  addBall(mesh, {0, 0.29f, 0}, glm::vec3(0.042f), 1);
  return mesh.take();
}

}  // namespace

void addHedgehog(Document& document, int parent) {
  // Between the cake and the viewer's side of the room: three quarters of his face show.
  const glm::quat turn = glm::angleAxis(0.02f, glm::vec3(0, 1, 0));
  const glm::vec3 seat = kHedgehog + glm::vec3(0, kSeat + 0.05f, 0);
  const int henry = document.addNode({"Henry", parent, seat, turn, glm::vec3(1.28f)});
  const int body = document.addMesh(makeBody(), henry);
  const int head = document.addMesh(makeHead(), henry, kHead);
  document.addMesh(makeHat(), head);

  // Two breaths in the loop; the head goes up with the breast, and looks from the cake to the dust and back.
  auto breath = [](float time) { return 0.5f - 0.5f * std::cos(phase(time, 4.0f)); };
  std::vector<Channel>& channels = party(document).channels;
  channels.push_back(scaleKeys(body, onTwos(), [=](float time) {
    const float b = breath(time);
    return glm::vec3(1.0f + 0.03f * b, 1.0f + 0.02f * b, 1.0f + 0.035f * b);
  }));
  channels.push_back(translationKeys(
      head, onTwos(), [=](float time) { return kHead + glm::vec3(0, 0.010f * breath(time - 0.1f), 0); }));
  channels.push_back(rotationKeys(head, onTwos(), [](float time) {
    // He holds each look for a while, so the tilt is a sine with flat ends.
    const float s = std::sin(phase(time, kLoop) + 2.4f), held = glm::clamp(1.9f * s, -1.0f, 1.0f);
    const float eased = held * (1.5f - 0.5f * held * held);
    return glm::angleAxis(0.04f - 0.20f * eased, glm::vec3(0, 1, 0)) *
           glm::angleAxis(0.01f - 0.06f * eased, glm::vec3(1, 0, 0)) *
           glm::angleAxis(0.13f * eased, glm::vec3(0, 0, 1));
  }));
}

}  // namespace henry
