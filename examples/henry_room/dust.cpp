// Magic dust: specks that leave the candles in a braid and flow over to the balloons, and others that wind up
// around each balloon. Each has a loop of its own and a trail: a skin over joints that take the speck's path
// a little later.
#include "mesh_kit/random.h"
#include "parts.h"
#include "timing.h"

namespace henry {
namespace {

using namespace meshkit;

constexpr int kSpecks = 20, kFromCandles = 12;
constexpr int kJoints = 8;
constexpr float kLag = 0.18f;    // seconds from joint to joint
constexpr float kApart = 0.05f;  // metres between joints where the mesh is built

// A curve, and a helix around it that is widest in the middle.
struct Flight {
  std::vector<glm::vec3> curve;
  float radius, turns, start;  // metres, in the whole flight, radians
  float shift;                 // of the loop: where on its flight the speck is at time 0

  glm::vec3 at(float along) const {
    const float place = glm::clamp(along, 0.0f, 1.0f) * float(curve.size() - 1);
    const size_t piece = std::min(size_t(place), curve.size() - 2);
    const float angle = start + 2.0f * kPi * turns * along, wide = radius * std::sin(kPi * along);
    return glm::mix(curve[piece], curve[piece + 1], place - float(piece)) +
           wide * glm::vec3(std::cos(angle), 0.5f * std::sin(2.0f * angle), std::sin(angle));
  }
  float along(float time) const { return glm::fract(time / kLoop + shift); }
  // A trail does not reach back beyond where the flight begins.
  float alongOf(int joint, float time) const {
    return std::max(along(time) - float(joint) * kLag / kLoop, 0.0f);
  }
  // Nothing at both ends, where the speck jumps back.
  float strength(float time) const {
    const float a = along(time);
    return glm::smoothstep(0.03f, 0.10f, a) * (1.0f - glm::smoothstep(0.84f, 0.97f, a));
  }
};

Flight fromCandle(int number) {
  const glm::vec3 flame = flameAt(number % kCandles);
  const float spread = 0.10f * float(number % 3 - 1);
  return {smoothCurve({flame,
                       flame + glm::vec3(-0.02f, 0.30f, 0.0f),
                       {-0.86f, 1.97f + spread, -0.95f},
                       {-0.05f, 2.12f + spread, -1.35f},
                       {0.80f, 1.92f - spread, -1.95f},
                       {1.42f, 1.62f, -2.25f}},
                      24),
          0.17f, 2.5f, 2.4f * float(number), float(number) / float(kFromCandles)};
}

Flight aroundBalloon(int number) {
  const glm::vec3 middle = balloonAt(number % kBalloons);
  return {smoothCurve({middle - glm::vec3(0, 0.36f, 0), middle, middle + glm::vec3(0, 0.55f, 0)}, 24), 0.30f,
          2.0f, 1.9f * float(number), 0.29f * float(number)};
}

// A drop with a long tail towards +Z, and grains that fall behind. Joints stand kApart from each other.
Mesh makeTrail(const std::string& name, float size, Random& random) {
  MeshBuilder mesh(name);
  mesh.setMaterial(kDust);
  mesh.setBinding([](glm::vec3 place) {
    const float joint = glm::clamp(place.z / kApart, 0.0f, float(kJoints - 1));
    const int before = std::min(int(joint), kJoints - 2);
    return boundBetween(before, before + 1, joint - float(before));
  });
  std::vector<glm::vec3> path;
  std::vector<float> radii;
  const std::pair<float, float> profile[] = {{-1.0f, 0.05f}, {-0.8f, 0.6f}, {-0.3f, 0.95f},
                                             {0.2f, 0.95f},  {0.7f, 0.7f},  {1.2f, 0.46f}};
  for (const auto& [back, radius] : profile) {
    path.push_back({0, 0, size * back});
    radii.push_back(size * radius);
  }
  const float end = float(kJoints - 3) * kApart;
  for (int i = 1; i <= 10; ++i) {
    const float t = float(i) / 10.0f;
    path.push_back({0, 0, glm::mix(1.2f * size, end, t)});
    radii.push_back(size * glm::mix(0.44f, 0.03f, t));
  }
  mesh.tube(path, radii, 7);
  for (int joint = 3; joint < kJoints; ++joint) {
    mesh.setBinding([joint](glm::vec3) { return boundTo(joint); });
    const glm::vec3 aside = 1.9f * size * random.direction();
    addBall(mesh, glm::vec3(0, 0, float(joint) * kApart) + aside,
            glm::vec3(size * random.between(0.16f, 0.32f)), 0);
  }
  return mesh.take();
}

void addSpeck(Document& document, int parent, const std::string& name, const Flight& flight, Random& random) {
  std::vector<int> joints;
  for (int k = 0; k < kJoints; ++k)
    joints.push_back(document.addNode(
        {k == 0 ? name : name + " trail " + std::to_string(k), parent, glm::vec3(0, 0, float(k) * kApart)}));
  document.addBoundMesh(makeTrail(name + " drop", random.between(0.016f, 0.024f), random), joints, parent);
  std::vector<Channel>& channels = party(document).channels;
  const std::vector<float> times = evenTimes(kLoop, 64);
  for (int k = 0; k < kJoints; ++k) {
    channels.push_back(translationKeys(joints[size_t(k)], times,
                                       [&](float time) { return flight.at(flight.alongOf(k, time)); }));
    channels.push_back(rotationKeys(joints[size_t(k)], times, [&](float time) {
      const float along = flight.alongOf(k, time);
      return lookAlong(flight.at(along + 0.004f) - flight.at(along - 0.004f));
    }));
    channels.push_back(
        scaleKeys(joints[size_t(k)], times, [&](float time) { return glm::vec3(flight.strength(time)); }));
  }
}

}  // namespace

void addDust(Document& document, int parent) {
  const int dust = document.addNode({"Dust", parent});
  Random random(5);
  for (int i = 0; i < kSpecks; ++i)
    addSpeck(document, dust, "Dust " + std::to_string(i + 1),
             i < kFromCandles ? fromCandle(i) : aroundBalloon(i - kFromCandles), random);
}

}  // namespace henry
