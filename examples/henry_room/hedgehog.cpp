// Henry: a small hedgehog on his chair, big eyes, party hat. He breathes and tilts his head.
#include "parts.h"
#include "timing.h"

namespace henry {
namespace {

using namespace meshkit;

// His space: he looks along +Z, +Y is up, the seat is the origin.
constexpr glm::vec3 kHead = {0.0f, 0.44f, 0.03f};

// Spikes on the back of an egg: they point away from it and are swept back.
void addSpikes(MeshBuilder& mesh, glm::vec3 center, glm::vec3 halfSize, int count, float length,
               float front) {
  // Points spread evenly over the sphere by the golden angle.
  for (int i = 0; i < count; ++i) {
    const float y = 1.0f - 2.0f * (float(i) + 0.5f) / float(count), angle = 2.3999632f * float(i);
    const float r = std::sqrt(1.0f - y * y);
    const glm::vec3 way = {r * std::cos(angle), y, r * std::sin(angle)};
    if (way.z > front + 0.25f * std::max(way.y, 0.0f) || std::abs(way.y) > 0.75f) continue;
    const glm::vec3 root = center + way * halfSize;
    const glm::vec3 along = glm::normalize(way + glm::vec3(0, 0.12f, -0.55f));
    const glm::vec3 side = glm::normalize(glm::cross(along, glm::vec3(0.3f, 1, 0.2f)));
    const glm::vec3 other = glm::cross(along, side);
    const float wide = 0.30f * length;
    const std::vector<glm::vec3> foot = ellipseRing(root - 0.02f * along, side * wide, -other * wide, 5);
    const glm::vec3 tip = root + along * length;
    mesh.setMaterial(i % 4 == 0 ? kSpikeTip : kSpike);
    for (size_t k = 0; k < foot.size(); ++k) {
      const glm::vec3 a = foot[k], b = foot[(k + 1) % foot.size()];
      const bool outwards = glm::dot(glm::cross(b - a, tip - a), 0.5f * (a + b) - root) > 0.0f;
      outwards ? mesh.triangle(a, b, tip) : mesh.triangle(b, a, tip);
    }
  }
}

Mesh makeBody() {
  MeshBuilder mesh("Henry body");
  mesh.setMaterial(kSpike);
  addBall(mesh, {0, 0.21f, -0.035f}, {0.195f, 0.225f, 0.175f}, 3);
  mesh.setMaterial(kFur);
  addBall(mesh, {0, 0.20f, 0.03f}, {0.165f, 0.205f, 0.150f}, 3);
  addSpikes(mesh, {0, 0.21f, -0.035f}, {0.19f, 0.22f, 0.17f}, 70, 0.12f, 0.05f);
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
  mesh.setMaterial(kSpike);
  addBall(mesh, middle + glm::vec3(0, 0.02f, -0.045f), {0.225f, 0.205f, 0.185f}, 3);
  addSpikes(mesh, middle + glm::vec3(0, 0.02f, -0.045f), {0.22f, 0.20f, 0.18f}, 95, 0.135f, 0.02f);
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
