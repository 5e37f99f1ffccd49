// The old sailor: peaked cap, white beard, heavy coat, boots; one hand on the tiller, one on the knee.
// His space: he faces +Z, +Y is up, his left is +X; the hip is at the origin. Metres of a man of 1.75 m.
#include "parts.h"

namespace demo {
namespace {

using namespace meshkit;

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

// Where the elbow is, given both ends and the lengths of the bones; `towards` is where it points.
glm::vec3 elbow(glm::vec3 shoulder, glm::vec3 hand, float upper, float lower, glm::vec3 towards) {
  const glm::vec3 line = hand - shoulder;
  const float reach = std::min(glm::length(line), upper + lower - 0.001f);
  const glm::vec3 along = glm::normalize(line);
  const float a = (upper * upper - lower * lower + reach * reach) / (2.0f * reach);
  const float h = std::sqrt(std::max(upper * upper - a * a, 0.0f));
  const glm::vec3 off = glm::normalize(towards - along * glm::dot(towards, along));
  return shoulder + along * a + off * h;
}

void addArm(MeshBuilder& mesh, glm::vec3 shoulder, glm::vec3 hand, glm::vec3 elbowTowards) {
  const glm::vec3 bend = elbow(shoulder, hand, 0.31f, 0.30f, elbowTowards);
  const glm::vec3 wrist = glm::mix(bend, hand, 0.80f);
  mesh.setMaterial(kCoat);
  const auto path =
      smoothCurve({shoulder, glm::mix(shoulder, bend, 0.5f), bend, glm::mix(bend, wrist, 0.5f), wrist}, 2);
  std::vector<float> radii;
  for (size_t i = 0; i < path.size(); ++i)
    radii.push_back(glm::mix(0.098f, 0.066f, float(i) / float(path.size() - 1)));
  mesh.tube(path, radii, 9);
  // Turned-up cuff, then the fist.
  mesh.setMaterial(kCoatDark);
  const glm::vec3 along = glm::normalize(hand - bend);
  mesh.tube({wrist - along * 0.06f, wrist + along * 0.012f}, {0.074f, 0.076f}, 9);
  mesh.setMaterial(kSkin);
  mesh.tube({wrist - along * 0.01f, wrist + along * 0.03f, hand, hand + along * 0.04f, hand + along * 0.055f},
            {0.036f, 0.044f, 0.054f, 0.044f, 0.02f}, 8);
}

Mesh makeCoat(glm::vec3 tillerHand) {
  MeshBuilder mesh("Coat");
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
  // The two halves of the skirt lie over the thighs.
  for (float side : {-1.0f, 1.0f}) {
    mesh.tube({{side * 0.10f, 0.02f, 0.02f}, {side * 0.115f, 0.035f, 0.18f}, {side * 0.125f, 0.03f, 0.31f}},
              {0.14f, 0.13f, 0.118f}, 10);
  }
  // Collar, turned up against the wind.
  mesh.setMaterial(kCoatDark);
  mesh.loft(rings({{0.555f, 0.165f, 0.135f, 0.035f},
                   {0.62f, 0.135f, 0.125f, 0.045f},
                   {0.675f, 0.142f, 0.128f, 0.03f},
                   {0.67f, 0.118f, 0.105f, 0.03f},
                   {0.60f, 0.10f, 0.09f, 0.05f}},
                  12, 0.9f),
            {.shading = Shading::flat});
  addArm(mesh, {0.215f, 0.485f, 0.02f}, tillerHand, {0.9f, -0.1f, -0.3f});
  addArm(mesh, {-0.215f, 0.485f, 0.02f}, {-0.145f, 0.135f, 0.36f}, {-0.9f, -0.3f, -0.25f});
  return mesh.take();
}

Mesh makeLegs() {
  MeshBuilder mesh("Legs");
  for (float side : {-1.0f, 1.0f}) {
    const float x = side * 0.13f;
    mesh.setMaterial(kTrousers);
    mesh.tube(smoothCurve({{side * 0.10f, 0.0f, 0.05f},
                           {x, 0.03f, 0.28f},
                           {x, 0.015f, 0.45f},
                           {x, -0.10f, 0.49f},
                           {x, -0.28f, 0.47f}},
                          2),
              {0.10f, 0.10f, 0.095f, 0.092f, 0.09f, 0.088f, 0.085f, 0.08f, 0.075f}, 9);
    mesh.setMaterial(kBoots);
    // Turned-over top, shaft, and a foot with a heel.
    mesh.tube({{x, -0.235f, 0.475f}, {x, -0.135f, 0.488f}}, {0.094f, 0.104f}, 9);
    mesh.tube({{x, -0.45f, 0.45f}, {x, -0.36f, 0.455f}, {x, -0.20f, 0.48f}}, {0.070f, 0.066f, 0.085f}, 9);
    mesh.loft({ellipseRing({x, -0.47f, 0.375f}, {0.045f, 0, 0}, {0, 0.035f, 0}, 8, 0.7f),
               ellipseRing({x, -0.445f, 0.44f}, {0.062f, 0, 0}, {0, 0.068f, 0}, 8, 0.7f),
               ellipseRing({x, -0.455f, 0.54f}, {0.066f, 0, 0}, {0, 0.058f, 0}, 8, 0.7f),
               ellipseRing({x, -0.475f, 0.65f}, {0.064f, 0, 0}, {0, 0.040f, 0}, 8, 0.7f),
               ellipseRing({x, -0.485f, 0.70f}, {0.038f, 0, 0}, {0, 0.026f, 0}, 8, 0.7f)},
              {.shading = Shading::smooth});
  }
  return mesh.take();
}

// The neck is at the origin.
Mesh makeHead() {
  MeshBuilder mesh("Head");
  mesh.setMaterial(kSkin);
  mesh.loft(rings({{-0.06f, 0.055f, 0.06f, -0.01f},
                   {0.02f, 0.066f, 0.08f, 0.012f},
                   {0.07f, 0.078f, 0.098f, 0.016f},
                   {0.12f, 0.081f, 0.101f, 0.014f},
                   {0.17f, 0.080f, 0.100f, 0.008f},
                   {0.22f, 0.07f, 0.09f, 0.0f}},
                  12, 0.92f),
            {.shading = Shading::smooth});
  // A strong nose, ears, cheekbones given by the facets.
  const glm::vec3 bridge = {0, 0.145f, 0.108f}, tip = {0, 0.088f, 0.158f}, left = {0.026f, 0.078f, 0.108f},
                  right = {-0.026f, 0.078f, 0.108f};
  mesh.triangle(bridge, tip, left);
  mesh.triangle(bridge, right, tip);
  mesh.triangle(left, tip, right);
  for (float side : {-1.0f, 1.0f}) mesh.box({side * 0.086f, 0.105f, 0.0f}, {0.022f, 0.06f, 0.04f}, 0.8f);
  return mesh.take();
}

Mesh makeBeard() {
  MeshBuilder mesh("Beard");
  mesh.setMaterial(kBeard);
  mesh.loft(rings({{-0.175f, 0.018f, 0.02f, 0.115f},
                   {-0.13f, 0.052f, 0.052f, 0.105f},
                   {-0.065f, 0.084f, 0.085f, 0.075f},
                   {0.0f, 0.096f, 0.104f, 0.048f},
                   {0.022f, 0.094f, 0.104f, 0.034f},
                   {0.046f, 0.088f, 0.090f, 0.034f},
                   {0.056f, 0.080f, 0.062f, 0.04f}},
                  12, 0.95f),
            {.shading = Shading::smooth});
  // Hair at the back of the head, below the cap; brows.
  mesh.loft(rings({{0.0f, 0.072f, 0.06f, -0.035f},
                   {0.04f, 0.086f, 0.075f, -0.032f},
                   {0.12f, 0.089f, 0.082f, -0.03f},
                   {0.18f, 0.086f, 0.078f, -0.026f}},
                  12, 0.92f),
            {.shading = Shading::smooth});
  for (float side : {-1.0f, 1.0f}) mesh.box({side * 0.038f, 0.142f, 0.108f}, {0.052f, 0.016f, 0.026f});
  return mesh.take();
}

Mesh makeCap() {
  MeshBuilder mesh("Cap");
  mesh.setMaterial(kCap);
  // Band, then a soft crown wider than the band, pulled down to the front.
  mesh.loft(rings({{0.146f, 0.095f, 0.117f, 0.002f},
                   {0.205f, 0.096f, 0.116f, 0.004f},
                   {0.235f, 0.132f, 0.148f, 0.010f},
                   {0.262f, 0.130f, 0.146f, 0.002f},
                   {0.288f, 0.085f, 0.10f, -0.012f},
                   {0.292f, 0.02f, 0.02f, -0.015f}},
                  14, 0.95f),
            {.shading = Shading::smooth});
  // The peak: a bent plate in front of the band.
  Grid top(3, 9), bottom(3, 9);
  for (size_t c = 0; c < 9; ++c) {
    const float angle = glm::mix(-1.05f, 1.05f, float(c) / 8.0f);
    for (size_t r = 0; r < 3; ++r) {
      const float out = float(r) / 2.0f;
      const float reach = 0.105f * out * std::pow(std::cos(angle * 0.9f), 0.7f);
      const glm::vec3 p = {(0.092f + 0.5f * reach) * std::sin(angle),
                           0.180f - 0.042f * out - 0.02f * (1 - std::cos(angle)),
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
  return mesh.take();
}

}  // namespace

int addSailor(Document& document, int parent, glm::vec3 position, glm::quat rotation, float scale,
              glm::vec3 handOnTiller) {
  const int sailor = document.addNode({"Sailor", parent, position, rotation, glm::vec3(scale)});
  document.addMesh(makeCoat(handOnTiller), sailor);
  document.addMesh(makeLegs(), sailor);
  // He looks ahead, past his right shoulder; a head a little large reads better from afar.
  const int head = document.addMesh(
      makeHead(), sailor, {0, 0.645f, 0.055f},
      glm::angleAxis(-0.62f, glm::vec3(0, 1, 0)) * glm::angleAxis(0.06f, glm::vec3(1, 0, 0)));
  document.nodes[size_t(head)].scale = glm::vec3(1.26f);
  document.addMesh(makeBeard(), head);
  document.addMesh(makeCap(), head);
  return sailor;
}

}  // namespace demo
