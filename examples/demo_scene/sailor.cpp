// The old sailor: peaked cap, white beard, heavy coat, boots. One mesh, bound to the bones of sailor_form.h.
#include "haul.h"
#include "parts.h"
#include "timing.h"

namespace demo {
namespace {

using namespace meshkit;

glm::vec3 bone(int index) {
  return sailorBones()[size_t(index)].at;
}

struct Section {
  float y, halfWidth, halfDepth, forward;
};

std::vector<std::vector<glm::vec3>> rings(const std::vector<Section>& sections, int sides, float squareness) {
  std::vector<std::vector<glm::vec3>> result;
  for (const Section& s : sections)
    result.push_back(
        ellipseRing({0, s.y, s.forward}, {s.halfWidth, 0, 0}, {0, 0, -s.halfDepth}, sides, squareness));
  return result;
}

// The coat bends over three bones and its collar a little with the neck.
Binding torso(glm::vec3 p) {
  if (p.y < 0.16f) return boundBetween(kHips, kSpine, glm::smoothstep(0.02f, 0.16f, p.y));
  if (p.y < 0.50f) return boundBetween(kSpine, kChest, glm::smoothstep(0.20f, 0.40f, p.y));
  return boundBetween(kChest, kNeck, 0.4f * glm::smoothstep(0.58f, 0.67f, p.y));
}

// A limb of three bones: each joint bends over `soft` metres to both sides.
Binding limb(int first, float soft, glm::vec3 p) {
  const glm::vec3 a = bone(first), b = bone(first + 1), c = bone(first + 2);
  const glm::vec3 upper = glm::normalize(b - a), lower = glm::normalize(c - b);
  const float atEnd = glm::dot(p - c, lower);
  if (atEnd > -0.03f) return boundBetween(first + 1, first + 2, glm::smoothstep(-0.03f, 0.0f, atEnd));
  return boundBetween(first, first + 1,
                      glm::smoothstep(-soft, soft, glm::dot(p - b, glm::normalize(upper + lower))));
}

void addArm(MeshBuilder& mesh, int upperArm) {
  const glm::vec3 shoulder = bone(upperArm), bend = bone(upperArm + 1), hand = bone(upperArm + 2);
  const glm::vec3 upper = glm::normalize(bend - shoulder), along = glm::normalize(hand - bend);
  const glm::vec3 wrist = glm::mix(bend, hand, 0.80f);
  mesh.setBinding([=](glm::vec3 p) { return limb(upperArm, 0.06f, p); });
  // The sleeve begins with a round shoulder, so that it fits the coat whatever way the arm points.
  mesh.setMaterial(kCoat);
  const std::vector<glm::vec3> path =
      smoothCurve({shoulder - upper * 0.095f, shoulder - upper * 0.06f, shoulder,
                   glm::mix(shoulder, bend, 0.5f), bend, glm::mix(bend, wrist, 0.5f), wrist},
                  2);
  std::vector<float> radii = {0.03f, 0.07f, 0.085f, 0.096f, 0.102f};
  for (size_t i = radii.size(); i < path.size(); ++i)
    radii.push_back(glm::mix(0.100f, 0.068f, float(i - 5) / float(path.size() - 6)));
  mesh.tube(path, radii, 10);
  // Turned-up cuff, then the fist around the sheet, with a thumb.
  mesh.setBinding([=](glm::vec3) { return boundTo(upperArm + 1); });
  mesh.setMaterial(kCoatDark);
  mesh.tube({wrist - along * 0.06f, wrist + along * 0.012f}, {0.076f, 0.080f}, 9);
  mesh.setMaterial(kSkin);
  mesh.tube({wrist - along * 0.01f, wrist + along * 0.02f}, {0.040f, 0.044f}, 8);
  mesh.setBinding([=](glm::vec3) { return boundTo(upperArm + 2); });
  mesh.tube({hand - along * 0.062f, hand - along * 0.04f, hand, hand + along * 0.035f, hand + along * 0.052f},
            {0.034f, 0.052f, 0.061f, 0.052f, 0.026f}, 9);
}

void addCoat(MeshBuilder& mesh) {
  mesh.setBinding(torso);
  mesh.setMaterial(kCoat);
  // The skirt spreads over the seat and the thighs; the back is a little bent.
  mesh.loft(rings({{-0.10f, 0.275f, 0.235f, 0.06f},
                   {-0.02f, 0.27f, 0.225f, 0.055f},
                   {0.08f, 0.250f, 0.195f, 0.02f},
                   {0.20f, 0.235f, 0.175f, -0.01f},
                   {0.34f, 0.245f, 0.172f, 0.0f},
                   {0.45f, 0.258f, 0.165f, 0.015f},
                   {0.53f, 0.240f, 0.145f, 0.03f},
                   {0.58f, 0.175f, 0.12f, 0.04f},
                   {0.62f, 0.10f, 0.095f, 0.05f}},
                  14, 0.82f),
            {.shading = Shading::smooth});
  // Collar, turned up against the wind.
  mesh.setMaterial(kCoatDark);
  mesh.loft(rings({{0.555f, 0.165f, 0.135f, 0.035f},
                   {0.62f, 0.135f, 0.125f, 0.045f},
                   {0.675f, 0.142f, 0.128f, 0.03f},
                   {0.67f, 0.118f, 0.105f, 0.03f},
                   {0.60f, 0.10f, 0.09f, 0.05f}},
                  12, 0.9f),
            {.shading = Shading::flat});
  // The two halves of the skirt lie over the thighs.
  mesh.setMaterial(kCoat);
  for (int thigh : {kThigh, kThighRight}) {
    const float side = bone(thigh).x < 0 ? -1.0f : 1.0f;
    mesh.setBinding(
        [=](glm::vec3 p) { return boundBetween(kHips, thigh, glm::smoothstep(-0.02f, 0.14f, p.z)); });
    mesh.tube({{side * 0.10f, 0.02f, 0.02f}, {side * 0.115f, 0.035f, 0.18f}, {side * 0.125f, 0.03f, 0.31f}},
              {0.14f, 0.13f, 0.118f}, 10);
  }
  addArm(mesh, kUpperArm);
  addArm(mesh, kUpperArmRight);
}

void addLeg(MeshBuilder& mesh, int thigh) {
  const glm::vec3 hip = bone(thigh), knee = bone(thigh + 1), ankle = bone(thigh + 2);
  const float x = ankle.x;
  mesh.setBinding([=](glm::vec3 p) { return limb(thigh, 0.08f, p); });
  mesh.setMaterial(kTrousers);
  mesh.tube(
      smoothCurve(
          {hip, glm::mix(hip, knee, 0.5f), {x, 0.018f, 0.43f}, {x, -0.06f, 0.488f}, {x, -0.28f, 0.47f}}, 2),
      {0.10f, 0.10f, 0.10f, 0.098f, 0.094f, 0.090f, 0.085f, 0.08f, 0.075f}, 9);
  // Turned-over top, shaft, and a foot with a heel.
  mesh.setBinding([=](glm::vec3) { return boundTo(thigh + 1); });
  mesh.setMaterial(kBoots);
  mesh.tube({{x, -0.235f, 0.475f}, {x, -0.135f, 0.488f}}, {0.094f, 0.104f}, 9);
  mesh.setBinding([=](glm::vec3 p) { return limb(thigh, 0.08f, p); });
  mesh.tube({{x, -0.45f, 0.45f}, {x, -0.36f, 0.455f}, {x, -0.20f, 0.48f}}, {0.070f, 0.066f, 0.085f}, 9);
  mesh.setBinding([=](glm::vec3) { return boundTo(thigh + 2); });
  mesh.loft({ellipseRing({x, -0.47f, 0.375f}, {0.045f, 0, 0}, {0, 0.035f, 0}, 8, 0.7f),
             ellipseRing({x, -0.445f, 0.44f}, {0.062f, 0, 0}, {0, 0.068f, 0}, 8, 0.7f),
             ellipseRing({x, -0.455f, 0.54f}, {0.066f, 0, 0}, {0, 0.058f, 0}, 8, 0.7f),
             ellipseRing({x, -0.475f, 0.65f}, {0.064f, 0, 0}, {0, 0.040f, 0}, 8, 0.7f),
             ellipseRing({x, -0.485f, 0.70f}, {0.038f, 0, 0}, {0, 0.026f, 0}, 8, 0.7f)},
            {.shading = Shading::smooth});
}

// The neck is at the origin. In the picture the face is fifteen pixels high, smaller than the brush that
// rounds shadow shapes, so the shadow under the peak is painted: a band of its own colour, wherever the sun
// stands.
void addFace(MeshBuilder& mesh) {
  mesh.setMaterial(kSkin);
  mesh.loft(rings({{-0.06f, 0.055f, 0.06f, -0.01f},
                   {0.02f, 0.070f, 0.085f, 0.012f},
                   {0.060f, 0.088f, 0.104f, 0.014f},
                   {0.096f, 0.094f, 0.110f, 0.014f},
                   {0.108f, 0.082f, 0.096f, 0.012f}},
                  12, 0.92f),
            {.shading = Shading::smooth});
  for (float side : {-1.0f, 1.0f}) mesh.box({side * 0.094f, 0.105f, -0.005f}, {0.024f, 0.07f, 0.045f}, 0.8f);
  // Temples, eye sockets and forehead, set back from the cheeks.
  mesh.setMaterial(kSkinShade);
  mesh.loft(rings({{0.100f, 0.083f, 0.099f, 0.012f},
                   {0.145f, 0.082f, 0.097f, 0.012f},
                   {0.165f, 0.088f, 0.107f, 0.012f},
                   {0.250f, 0.080f, 0.100f, 0.006f}},
                  12, 0.92f));
}

// Two dark marks, as a painter would set them: whites would be too small to see. The brows above are grey,
// because white ones would cut the shadow under the peak in two. Both fall towards the temples.
void addEyes(MeshBuilder& mesh) {
  static constexpr glm::vec2 kLids[] = {{-0.024f, -0.003f}, {-0.012f, -0.017f}, {0.012f, -0.017f},
                                        {0.024f, -0.003f},  {0.014f, 0.014f},   {-0.014f, 0.014f}};
  static constexpr glm::vec2 kBrow[] = {
      {-0.025f, 0.022f}, {0.025f, 0.022f}, {0.026f, 0.030f}, {0.0f, 0.037f}, {-0.026f, 0.030f}};
  const glm::mat4 head = mesh.transform();
  for (float side : {-1.0f, 1.0f}) {
    const glm::mat4 socket =
        glm::rotate(glm::translate(head, {side * 0.042f, 0.130f, 0.092f}), side * 0.55f, {0, 1, 0});
    mesh.setTransform(glm::rotate(socket, side * -0.16f, {0, 0, 1}));
    mesh.setMaterial(kEye);
    mesh.extrude(kLids, -0.01f, 0.012f);
    mesh.setMaterial(kBeardShade);
    mesh.extrude(kBrow, -0.01f, 0.020f);
  }
  mesh.setTransform(head);
}

// Large and straight. Its left side and underside are painted dark, for the sun may stand straight before it.
void addNose(MeshBuilder& mesh) {
  const glm::vec3 root = {0, 0.160f, 0.104f}, tip = {0, 0.062f, 0.222f}, base = {0, 0.044f, 0.118f};
  const glm::vec3 ridge = {0.018f, 0, 0}, wing = {0.042f, 0.006f, -0.004f};
  const glm::vec3 left = base + wing, right = base + wing * glm::vec3(-1, 1, 1);
  mesh.setMaterial(kSkin);
  mesh.quad(root - ridge, tip - ridge, tip + ridge, root + ridge);
  mesh.triangle(root - ridge, right, tip - ridge);
  mesh.setMaterial(kSkinShade);
  mesh.triangle(root + ridge, tip + ridge, left);
  mesh.quad(left, tip + ridge, tip - ridge, right);
}

void addBeard(MeshBuilder& mesh) {
  mesh.setMaterial(kBeard);
  mesh.loft(rings({{-0.175f, 0.018f, 0.02f, 0.115f},
                   {-0.13f, 0.052f, 0.052f, 0.105f},
                   {-0.065f, 0.084f, 0.085f, 0.075f},
                   {-0.02f, 0.094f, 0.104f, 0.050f},
                   {0.006f, 0.094f, 0.104f, 0.034f},
                   {0.022f, 0.088f, 0.086f, 0.030f},
                   {0.032f, 0.080f, 0.058f, 0.03f}},
                  12, 0.95f),
            {.shading = Shading::smooth});
  // A moustache that hangs over the beard.
  mesh.tube({{-0.082f, -0.015f, 0.085f},
             {-0.045f, 0.014f, 0.125f},
             {0, 0.028f, 0.132f},
             {0.045f, 0.014f, 0.125f},
             {0.082f, -0.015f, 0.085f}},
            {0.006f, 0.020f, 0.018f, 0.020f, 0.006f}, 7);
  // Hair at the back of the head, below the cap.
  mesh.loft(rings({{0.0f, 0.072f, 0.06f, -0.035f},
                   {0.04f, 0.090f, 0.075f, -0.036f},
                   {0.12f, 0.093f, 0.082f, -0.036f},
                   {0.215f, 0.088f, 0.070f, -0.030f}},
                  12, 0.92f),
            {.shading = Shading::smooth});
}

// A bent plate in front of the band, long and low enough to shade the eyes.
void addPeak(MeshBuilder& mesh) {
  Grid top(3, 9), bottom(3, 9);
  for (size_t c = 0; c < 9; ++c) {
    const float angle = glm::mix(-1.15f, 1.15f, float(c) / 8.0f);
    for (size_t r = 0; r < 3; ++r) {
      const float out = float(r) / 2.0f;
      const float reach = 0.115f * out * std::pow(std::cos(angle * 0.9f), 0.7f);
      const glm::vec3 p = {(0.092f + 0.5f * reach) * std::sin(angle),
                           0.236f - 0.045f * out - 0.01f * (1 - std::cos(angle)),
                           0.006f + (0.112f + reach) * std::cos(angle)};
      top.at(r, c) = p;
      bottom.at(r, c) = p - glm::vec3(0, 0.014f, 0);
    }
  }
  mesh.grid(top, {.flip = true});
  mesh.grid(bottom, {});
  Grid rim(2, 9);
  for (size_t c = 0; c < 9; ++c) {
    rim.at(0, c) = bottom.at(2, c);
    rim.at(1, c) = top.at(2, c);
  }
  mesh.grid(rim, {});
  for (size_t r = 0; r < 2; ++r) {
    mesh.quad(bottom.at(r, 0), bottom.at(r + 1, 0), top.at(r + 1, 0), top.at(r, 0));
    mesh.quad(bottom.at(r + 1, 8), bottom.at(r, 8), top.at(r, 8), top.at(r + 1, 8));
  }
}

void addCap(MeshBuilder& mesh) {
  mesh.setMaterial(kCap);
  // Band, then a soft crown wider than the band, pulled down to the front.
  mesh.loft(rings({{0.204f, 0.096f, 0.117f, 0.002f},
                   {0.246f, 0.097f, 0.116f, 0.004f},
                   {0.268f, 0.128f, 0.144f, 0.008f},
                   {0.290f, 0.126f, 0.142f, 0.000f},
                   {0.312f, 0.085f, 0.10f, -0.014f},
                   {0.316f, 0.02f, 0.02f, -0.017f}},
                  14, 0.95f),
            {.shading = Shading::smooth});
  addPeak(mesh);
}

Mesh makeSailor() {
  MeshBuilder mesh("Sailor");
  addCoat(mesh);
  addLeg(mesh, kThigh);
  addLeg(mesh, kThighRight);
  // Beard and cap are the head's. A head a little large reads better from afar.
  mesh.setBinding([](glm::vec3) { return boundTo(kHead); });
  mesh.setTransform(glm::scale(glm::translate(glm::mat4(1.0f), bone(kHead)), glm::vec3(1.5f)));
  addFace(mesh);
  addEyes(mesh);
  addNose(mesh);
  addBeard(mesh);
  addCap(mesh);
  return mesh.take();
}

}  // namespace

int addSailor(Document& document, int boat) {
  const glm::mat4 place = sailorInBoat();
  Node node{"Sailor", boat, glm::vec3(place[3]), glm::quat_cast(glm::mat3(place) / kSailorScale)};
  node.scale = glm::vec3(kSailorScale);
  const int sailor = document.addNode(std::move(node));
  std::vector<int> joints;
  for (const BoneForm& form : sailorBones()) {
    const bool top = form.parent < 0;
    const glm::vec3 offset = top ? form.at : form.at - bone(form.parent);
    joints.push_back(document.addNode({form.name, top ? sailor : joints[size_t(form.parent)], offset}));
  }
  document.addBoundMesh(makeSailor(), joints, sailor);

  std::vector<Channel>& channels = sailing(document).channels;
  channels.push_back(
      translationKeys(joints[kHips], onTwos(), [](float time) { return haulAt(time * kFrameRate).hips; }));
  for (int i = 0; i < kBoneCount; ++i) {
    if (i == kHand || i == kHandRight) continue;  // they go with their forearms
    channels.push_back(rotationKeys(joints[size_t(i)], onTwos(),
                                    [i](float time) { return haulAt(time * kFrameRate).turns[size_t(i)]; }));
  }
  return sailor;
}

}  // namespace demo
