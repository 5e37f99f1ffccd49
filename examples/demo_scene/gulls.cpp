// Gulls in flight: a spindle of a body and two wings of two joints each. They circle without a hurry, mostly
// gliding, with a few beats now and then.
#include "parts.h"
#include "timing.h"

namespace demo {
namespace {

using namespace meshkit;

enum Joint : int { kBody, kInner, kOuter, kInnerRight, kOuterRight, kJointCount };

// The left wing's shoulder and wrist.
constexpr glm::vec3 kShoulder = {0.05f, 0.03f, 0.02f}, kWrist = {0.42f, 0.03f, 0.06f};

// A wing bends at the shoulder and at the wrist.
Binding wing(glm::vec3 p) {
  const int right = p.x < 0 ? 2 : 0;
  const float out = std::abs(p.x);
  const bool atWrist = out > 0.25f;
  const float t =
      atWrist ? glm::smoothstep(kWrist.x - 0.08f, kWrist.x + 0.08f, out) : glm::smoothstep(0.03f, 0.12f, out);
  const int from = atWrist ? kInner + right : int(kBody), to = (atWrist ? kOuter : kInner) + right;
  return boundBetween(from, to, t);
}

// Flies towards +Z, its wings level.
Mesh makeGull(const std::string& name) {
  MeshBuilder mesh(name);
  mesh.setBinding([](glm::vec3) { return boundTo(kBody); });
  mesh.setMaterial(kGull);
  auto ring = [](float z, float y, float width, float height) {
    return ellipseRing({0, y, z}, {width, 0, 0}, {0, height, 0}, 8);
  };
  mesh.loft({ring(-0.34f, 0.02f, 0.05f, 0.008f), ring(-0.22f, 0.01f, 0.045f, 0.03f),
             ring(-0.05f, 0.0f, 0.075f, 0.07f), ring(0.10f, 0.0f, 0.075f, 0.075f),
             ring(0.20f, 0.02f, 0.045f, 0.05f), ring(0.25f, 0.035f, 0.045f, 0.048f),
             ring(0.30f, 0.03f, 0.02f, 0.022f)},
            {.shading = Shading::smooth});
  mesh.setMaterial(kBeak);
  mesh.loft({ring(0.295f, 0.03f, 0.016f, 0.018f), ring(0.36f, 0.015f, 0.004f, 0.004f)});
  mesh.setBinding(wing);
  // The wing: forward up to the wrist, then back to the tip; leading and trailing edge per station.
  struct Station {
    float out, front, back;
  };
  const Station stations[] = {{0.04f, 0.14f, -0.12f}, {0.22f, 0.19f, -0.11f}, {0.36f, 0.205f, -0.085f},
                              {0.48f, 0.19f, -0.07f}, {0.64f, 0.12f, -0.09f}, {0.81f, 0.00f, -0.14f},
                              {0.96f, -0.13f, -0.19f}};
  for (float side : {-1.0f, 1.0f}) {
    constexpr size_t kStations = std::size(stations);
    // An upper and a lower skin, a thumb's breadth apart in the middle of the chord.
    Grid top(3, kStations), bottom(3, kStations);
    for (size_t i = 0; i < kStations; ++i) {
      const Station& s = stations[i];
      const float thick = 0.03f * (1.0f - 0.8f * float(i) / float(kStations - 1));
      const glm::vec3 front = {side * s.out, 0.03f, s.front}, back = {side * s.out, 0.015f, s.back};
      const glm::vec3 middle = glm::mix(front, back, 0.35f);
      top.at(0, i) = bottom.at(0, i) = back;
      top.at(1, i) = middle + glm::vec3(0, thick, 0);
      bottom.at(1, i) = middle - glm::vec3(0, 0.3f * thick, 0);
      top.at(2, i) = bottom.at(2, i) = front;
    }
    auto paint = [](size_t, size_t column) -> int { return column + 2 >= kStations ? kGullTip : kGull; };
    mesh.grid(top, {.flip = side > 0, .cellMaterial = paint});
    mesh.grid(bottom, {.flip = side < 0, .cellMaterial = paint});
  }
  return mesh.take();
}

// A circle that takes the whole loop, and when the bird beats its wings on it.
struct Flight {
  glm::vec3 start;      // where it is when the clip begins
  float heading, bank;  // radians, then; heading 0 flies towards the viewer, a positive bank turns right
  float radius, rise;   // metres; halfway it is twice `rise` higher
  float beatsFrom, beats, lift;  // seconds; how many; radians, of the wings when it glides
};
constexpr float kBeat = 2.0f / 3.0f;  // seconds: eight drawn poses

// How far into a run of beats, and how strong there: 0 while it glides.
struct Stroke {
  float phase, strength;
};
Stroke strokeAt(const Flight& flight, float time) {
  float since = std::fmod(time - flight.beatsFrom + kLoop, kLoop);
  const float length = flight.beats * kBeat;
  const float strength = glm::smoothstep(0.0f, 0.4f * kBeat, since) *
                         (1.0f - glm::smoothstep(length - 0.4f * kBeat, length, since));
  return {phase(since, kBeat), strength};
}

glm::vec3 placeAt(const Flight& flight, float time) {
  const float side = flight.bank > 0 ? 1.0f : -1.0f, angle = side * phase(time, kLoop);
  auto right = [&](float heading) {
    return side * flight.radius * glm::vec3(-std::cos(heading), 0.0f, std::sin(heading));
  };
  // The heading turns with the circle: what was on its right at the start is the centre.
  const glm::vec3 center = flight.start + right(flight.heading);
  return center - right(flight.heading - angle) +
         glm::vec3(0, flight.rise * (1.0f - std::cos(phase(time, kLoop))), 0);
}

glm::quat attitudeAt(const Flight& flight, float time) {
  const float side = flight.bank > 0 ? 1.0f : -1.0f;
  const float bank = flight.bank * (1.0f + 0.25f * std::sin(phase(time, 4.0f)));
  return glm::angleAxis(flight.heading - side * phase(time, kLoop), glm::vec3(0, 1, 0)) *
         glm::angleAxis(bank, glm::vec3(0, 0, 1));
}

void addGull(Document& document, int parent, const std::string& name, const Flight& flight) {
  const int gull = document.addNode({name, parent, placeAt(flight, 0.0f), attitudeAt(flight, 0.0f)});
  document.nodes[size_t(gull)].scale = glm::vec3(1.2f);
  const glm::vec3 mirror = {-1, 1, 1};
  std::vector<int> joints(kJointCount);
  joints[kBody] = document.addNode({name + "Body", gull});
  joints[kInner] = document.addNode({name + "InnerLeft", joints[kBody], kShoulder});
  joints[kOuter] = document.addNode({name + "OuterLeft", joints[kInner], kWrist - kShoulder});
  joints[kInnerRight] = document.addNode({name + "InnerRight", joints[kBody], mirror * kShoulder});
  joints[kOuterRight] =
      document.addNode({name + "OuterRight", joints[kInnerRight], mirror * (kWrist - kShoulder)});
  document.addBoundMesh(makeGull(name), joints, gull);

  std::vector<Channel>& channels = sailing(document).channels;
  channels.push_back(smoothTranslation(gull, slowKeys(), [&](float time) { return placeAt(flight, time); }));
  channels.push_back(smoothRotation(gull, slowKeys(), [&](float time) { return attitudeAt(flight, time); }));
  // The body rises against the wings.
  channels.push_back(translationKeys(joints[kBody], onTwos(), [&](float time) {
    const Stroke stroke = strokeAt(flight, time);
    return glm::vec3(0, -0.05f * stroke.strength * std::sin(stroke.phase), 0);
  }));
  for (float side : {1.0f, -1.0f}) {
    const int right = side < 0 ? 2 : 0;
    // Positive lifts the wing; the outer one comes a quarter of a beat later and folds on the way up.
    channels.push_back(rotationKeys(joints[size_t(kInner + right)], onTwos(), [&, side](float time) {
      const Stroke stroke = strokeAt(flight, time);
      const float lift = flight.lift + stroke.strength * (0.62f * std::sin(stroke.phase) + 0.05f);
      return glm::angleAxis(side * lift, glm::vec3(0, 0, 1));
    }));
    channels.push_back(rotationKeys(joints[size_t(kOuter + right)], onTwos(), [&, side](float time) {
      const Stroke stroke = strokeAt(flight, time);
      const float lift =
          -0.85f * flight.lift - 0.12f + stroke.strength * (0.55f * std::sin(stroke.phase - 1.5f) - 0.15f);
      return glm::angleAxis(side * lift, glm::vec3(0, 0, 1));
    }));
  }
}

}  // namespace

int addGulls(Document& document, int parent) {
  const int gulls = document.addNode({"Gulls", parent});
  const Flight flights[] = {{{-1.6f, 7.0f, 1.0f}, -2.05f, 0.42f, 3.4f, 0.45f, 1.5f, 4.0f, 0.42f},
                            {{2.0f, 13.2f, -31.0f}, -2.3f, 0.34f, 7.0f, 0.5f, 5.0f, 3.0f, 0.30f},
                            {{8.3f, 11.6f, -14.0f}, -1.2f, 0.34f, 4.5f, 0.9f, 3.4f, 5.0f, 0.50f}};
  int number = 1;
  for (const Flight& f : flights) addGull(document, gulls, "Gull" + std::to_string(number++), f);
  return gulls;
}

}  // namespace demo
