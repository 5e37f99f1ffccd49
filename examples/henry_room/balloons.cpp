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
  float size;      // its largest radius; 0: the dog
  int paint, shade;
  float period;  // seconds; divides the loop
};

// Three at the chair by the arch, the dog at the present.
constexpr Balloon kHanging[kBalloons] = {
    {kChairBack, {-0.16f, 0.50f, 0.02f}, 0.17f, kBalloonRose, kBalloonRoseDark, 4.0f},
    {kChairBack, {0.22f, 0.36f, 0.10f}, 0.15f, kBalloonSage, kBalloonSageDark, 8.0f},
    {kChairBack, {0.10f, 0.78f, 0.05f}, 0.16f, kBalloonHoney, kBalloonHoneyDark, 4.0f},
    {kPresent + glm::vec3(0, 0.245f, 0), {0, 0.66f, 0}, 0.0f, kBalloonRose, kBalloonRoseDark, 8.0f}};

// The side of the windows, and where their light is mirrored towards the room.
const glm::vec3 kLightSide = glm::normalize(glm::vec3(-0.85f, 0.50f, 0.05f));
const glm::vec3 kMirror = glm::normalize(glm::vec3(-0.62f, 0.42f, 0.66f));

void addForm(MeshBuilder& mesh) {
  const std::vector<glm::vec3> outline = smoothCurve({{0.0f, -0.10f, 0},
                                                      {0.11f, -0.09f, 0},
                                                      {0.05f, 0.0f, 0},
                                                      {0.20f, 0.12f, 0},
                                                      {0.55f, 0.46f, 0},
                                                      {0.85f, 0.92f, 0},
                                                      {1.0f, 1.42f, 0},
                                                      {0.93f, 1.90f, 0},
                                                      {0.68f, 2.24f, 0},
                                                      {0.36f, 2.40f, 0},
                                                      {0.0f, 2.46f, 0}},
                                                     3);
  mesh.lathe(std::vector<glm::vec2>(outline.begin(), outline.end()), 40, Shading::smooth);
}

// A window's picture on the skin: a flat ellipse that stands out of the ball around `middle` by a breath.
void addShine(MeshBuilder& mesh, glm::vec3 middle, glm::vec3 way, glm::vec2 halfSize) {
  const glm::mat4 before = mesh.transform();
  mesh.setTransform(before * glm::translate(glm::mat4(1.0f), middle) *
                    glm::mat4_cast(lookAlong(-glm::normalize(way))));
  mesh.setMaterial(kShine);
  addBall(mesh, {0, 0, 0.95f}, {halfSize, 0.09f}, 3);
  mesh.setTransform(before);
}

Mesh makeBalloon(const std::string& name, const Balloon& balloon) {
  MeshBuilder mesh(name);
  const glm::mat4 at =
      glm::translate(glm::mat4(1.0f), balloon.rise) * glm::scale(glm::mat4(1.0f), glm::vec3(balloon.size));
  mesh.setMaterial(balloon.paint);
  mesh.setTransform(at);
  addForm(mesh);
  const glm::vec3 middle = {0, 1.48f, 0};
  // The dark side is the same form, a little smaller and farther from the light. Where the two meet they
  // cross at an angle, so that the edge is a clean curve.
  mesh.setMaterial(balloon.shade);
  mesh.setTransform(glm::translate(at, 0.05f * middle - 0.17f * kLightSide) *
                    glm::scale(glm::mat4(1.0f), glm::vec3(0.95f)));
  addForm(mesh);
  mesh.setTransform(at);
  addShine(mesh, middle, kMirror, {0.16f, 0.27f});
  addShine(mesh, middle, kMirror + glm::vec3(0.20f, -0.52f, 0.10f), {0.075f, 0.09f});
  mesh.setTransform(glm::mat4(1.0f));
  mesh.setMaterial(kString);
  const glm::vec3 aside = {0.03f, 0, 0.02f};
  mesh.tube(
      smoothCurve({{0, 0, 0}, 0.35f * balloon.rise + aside, 0.7f * balloon.rise - aside, balloon.rise}, 4),
      {0.006f}, 5);
  return mesh.take();
}

void addSausage(MeshBuilder& mesh, glm::vec3 from, glm::vec3 to, float radius) {
  std::vector<glm::vec3> path;
  std::vector<float> radii;
  auto draw = [&](int paint, glm::vec3 shift, float thick, float start, float end) {
    path.clear();
    radii.clear();
    for (int i = 0; i <= 8; ++i) {
      const float t = float(i) / 8.0f, along = glm::mix(start, end, t);
      path.push_back(glm::mix(from, to, along) + shift);
      radii.push_back(thick * std::max(std::pow(std::sin(kPi * glm::mix(0.03f, 0.97f, t)), 0.45f), 0.2f));
    }
    mesh.setMaterial(paint);
    mesh.tube(path, radii, 12);
  };
  draw(kBalloonRose, {}, radius, 0.0f, 1.0f);
  draw(kBalloonRoseDark, -0.16f * radius * kLightSide, radius, 0.0f, 1.0f);
  draw(kShine, 0.90f * radius * kMirror, 0.17f * radius, 0.22f, 0.58f);
}

// Sausages knotted together; it looks along +X. The knot of its neck is at the origin.
Mesh makeDog(const std::string& name, glm::vec3 rise) {
  MeshBuilder mesh(name);
  mesh.setTransform(glm::translate(glm::mat4(1.0f), rise));
  const glm::vec3 neck = {0.17f, 0.17f, 0}, head = {0.19f, 0.32f, 0}, hip = {-0.17f, 0.17f, 0};
  addSausage(mesh, hip, neck, 0.065f);
  addSausage(mesh, neck, head, 0.05f);
  addSausage(mesh, head, head + glm::vec3(0.17f, -0.03f, 0), 0.06f);
  for (float z : {-1.0f, 1.0f}) {
    addSausage(mesh, head, head + glm::vec3(-0.05f, 0.14f, 0.07f * z), 0.045f);
    addSausage(mesh, neck, neck + glm::vec3(0.03f, -0.20f, 0.065f * z), 0.052f);
    addSausage(mesh, hip, hip + glm::vec3(-0.03f, -0.20f, 0.065f * z), 0.052f);
  }
  addSausage(mesh, hip, hip + glm::vec3(-0.12f, 0.16f, 0), 0.04f);
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
         glm::angleAxis(0.12f * std::sin(phase(time, 8.0f) + 2.0f * shift), glm::vec3(0, 1, 0));
}

}  // namespace

glm::vec3 balloonAt(int balloon) {
  const Balloon& b = kHanging[balloon];
  return b.tied + b.rise + (b.size > 0.0f ? glm::vec3(0, 1.3f * b.size, 0) : glm::vec3(0.03f, 0.17f, 0));
}

void addBalloons(Document& document, int parent) {
  int number = 1;
  for (const Balloon& b : kHanging) {
    const std::string name = "Balloon " + std::to_string(number);
    const float shift = 1.9f * float(number++);
    const int node =
        document.addMesh(b.size > 0.0f ? makeBalloon(name, b) : makeDog(name, b.rise), parent, b.tied);
    party(document).channels.push_back(
        smoothRotation(node, slowKeys(), [&b, shift](float time) { return swayAt(b, time, shift); }));
  }
}

}  // namespace henry
