// Balloons on strings, and one that was twisted into a dog. Each hangs on its own node, which sways around
// where the string is tied.
#include "parts.h"
#include "timing.h"

namespace henry {
namespace {

using namespace meshkit;

struct Balloon {
  glm::vec3 tied;  // where the string is fast
  glm::vec3 rise;  // from there to the balloon's neck
  float size;      // its largest radius
  int paint;
  float period;  // seconds; divides the loop
};

Mesh makeBalloon(const std::string& name, const Balloon& balloon) {
  MeshBuilder mesh(name);
  mesh.setMaterial(balloon.paint);
  const glm::mat4 at =
      glm::translate(glm::mat4(1.0f), balloon.rise) * glm::scale(glm::mat4(1.0f), glm::vec3(balloon.size));
  mesh.setTransform(at);
  mesh.lathe({{0.0f, -0.10f},
              {0.11f, -0.09f},
              {0.05f, 0.0f},
              {0.20f, 0.12f},
              {0.55f, 0.46f},
              {0.85f, 0.92f},
              {1.0f, 1.42f},
              {0.93f, 1.90f},
              {0.68f, 2.24f},
              {0.36f, 2.40f},
              {0.0f, 2.46f}},
             24, Shading::smooth);
  mesh.setTransform(glm::mat4(1.0f));
  mesh.setMaterial(kString);
  const glm::vec3 aside = {0.03f, 0, 0.02f};
  mesh.tube(
      smoothCurve({{0, 0, 0}, 0.35f * balloon.rise + aside, 0.7f * balloon.rise - aside, balloon.rise}, 4),
      {0.006f}, 5);
  return mesh.take();
}

// Sausages knotted together; it looks along +X. The knot of its neck is at the origin.
Mesh makeDog(const std::string& name, glm::vec3 rise) {
  MeshBuilder mesh(name);
  mesh.setTransform(glm::translate(glm::mat4(1.0f), rise));
  mesh.setMaterial(kBalloonRose);
  auto sausage = [&](glm::vec3 from, glm::vec3 to, float radius) {
    std::vector<glm::vec3> path;
    std::vector<float> radii;
    for (int i = 0; i <= 8; ++i) {
      const float t = float(i) / 8.0f;
      path.push_back(glm::mix(from, to, t));
      radii.push_back(radius * std::max(std::pow(std::sin(kPi * glm::mix(0.03f, 0.97f, t)), 0.45f), 0.2f));
    }
    mesh.tube(path, radii, 12);
  };
  const glm::vec3 neck = {0.17f, 0.17f, 0}, head = {0.19f, 0.32f, 0}, hip = {-0.17f, 0.17f, 0};
  sausage(hip, neck, 0.065f);
  sausage(neck, head, 0.05f);
  sausage(head, head + glm::vec3(0.17f, -0.03f, 0), 0.06f);
  for (float z : {-1.0f, 1.0f}) {
    sausage(head, head + glm::vec3(-0.05f, 0.14f, 0.07f * z), 0.045f);
    sausage(neck, neck + glm::vec3(0.03f, -0.20f, 0.065f * z), 0.052f);
    sausage(hip, hip + glm::vec3(-0.03f, -0.20f, 0.065f * z), 0.052f);
  }
  sausage(hip, hip + glm::vec3(-0.12f, 0.16f, 0), 0.04f);
  mesh.setTransform(glm::mat4(1.0f));
  mesh.setMaterial(kString);
  mesh.tube(smoothCurve({{0, 0, 0}, 0.4f * rise + glm::vec3(0.04f, 0, 0), rise + glm::vec3(0, 0.11f, 0)}, 5),
            {0.006f}, 5);
  return mesh.take();
}

glm::quat swayAt(const Balloon& balloon, float time, float shift) {
  const float a =
      0.075f * std::sin(phase(time, balloon.period) + shift) + 0.02f * std::sin(phase(time, 2.0f) + shift);
  const float b = 0.055f * std::sin(phase(time, balloon.period) + shift + 1.4f);
  return glm::angleAxis(a, glm::vec3(0, 0, 1)) * glm::angleAxis(b, glm::vec3(1, 0, 0)) *
         glm::angleAxis(0.3f * std::sin(phase(time, 8.0f) + 2.0f * shift), glm::vec3(0, 1, 0));
}

}  // namespace

void addBalloons(Document& document, int parent) {
  // Three at the chair by the arch, the dog at the present.
  const glm::vec3 present = kPresent + glm::vec3(0, 0.245f, 0);
  const Balloon balloons[] = {{kChairBack, {-0.16f, 0.50f, 0.02f}, 0.17f, kBalloonRose, 4.0f},
                              {kChairBack, {0.22f, 0.36f, 0.10f}, 0.15f, kBalloonSage, 8.0f},
                              {kChairBack, {0.10f, 0.78f, 0.05f}, 0.16f, kBalloonHoney, 4.0f},
                              {present, {0.0f, 0.66f, 0.0f}, 0.0f, kBalloonRose, 8.0f}};
  int number = 1;
  for (const Balloon& b : balloons) {
    const std::string name = "Balloon " + std::to_string(number);
    const float shift = 1.9f * float(number++);
    const int node =
        document.addMesh(b.size > 0.0f ? makeBalloon(name, b) : makeDog(name, b.rise), parent, b.tied);
    party(document).channels.push_back(
        smoothRotation(node, slowKeys(), [&b, shift](float time) { return swayAt(b, time, shift); }));
  }
}

}  // namespace henry
