// The cake: two tiers on a stand, icing that runs down, cherries, candles whose flames are nodes.
#include "parts.h"
#include "timing.h"

namespace henry {
namespace {

using namespace meshkit;

constexpr float kLower = 0.27f, kUpper = 0.175f;                  // radii
constexpr float kFoot = 0.085f, kStep = 0.245f, kCrown = 0.385f;  // heights above the table
constexpr float kCandle1 = 0.115f;                                // a candle's length

void addIcing(MeshBuilder& mesh, float radius, float top, float run, float inner) {
  constexpr int kSides = 48;
  Grid icing(6, kSides);
  for (int c = 0; c < kSides; ++c) {
    const float a = -2.0f * kPi * float(c) / float(kSides);
    const float drip = run * (0.62f + 0.38f * std::sin(9.0f * a) + 0.15f * std::sin(4.0f * a + 1.0f));
    const glm::vec3 out = {std::cos(a), 0, std::sin(a)};
    const glm::vec2 profile[] = {{inner, top + 0.014f},           {radius - 0.02f, top + 0.014f},
                                 {radius + 0.012f, top + 0.002f}, {radius + 0.018f, top - 0.02f},
                                 {radius + 0.016f, top - drip},   {radius - 0.01f, top - drip - 0.012f}};
    for (size_t r = 0; r < 6; ++r)
      icing.at(r, size_t(c)) = out * profile[r].x + glm::vec3(0, profile[r].y, 0);
  }
  mesh.setMaterial(kIcing);
  mesh.grid(icing, {.shading = Shading::smooth, .closed = true, .flip = true});
}

Mesh makeCake() {
  MeshBuilder mesh("Cake");
  mesh.setMaterial(kPlate);
  mesh.lathe({{0.0f, 0.004f},
              {0.15f, 0.004f},
              {0.15f, 0.02f},
              {0.05f, 0.035f},
              {0.05f, 0.06f},
              {0.34f, 0.072f},
              {0.35f, kFoot},
              {0.0f, kFoot}},
             32);
  mesh.setMaterial(kSponge);
  mesh.lathe({{kLower - 0.005f, kFoot}, {kLower, kFoot + 0.02f}, {kLower, kStep}, {0.0f, kStep}}, 40,
             Shading::smooth);
  mesh.lathe({{kUpper, kStep}, {kUpper, kCrown}, {0.0f, kCrown}}, 36, Shading::smooth);
  addIcing(mesh, kLower, kStep, 0.085f, kUpper - 0.02f);
  addIcing(mesh, kUpper, kCrown, 0.07f, 0.0f);
  mesh.setMaterial(kCherry);
  for (int i = 0; i < 9; ++i) {
    const float a = 2.0f * kPi * (float(i) + 0.3f) / 9.0f;
    addBall(mesh, {0.225f * std::cos(a), kStep + 0.035f, 0.225f * std::sin(a)}, glm::vec3(0.026f), 1);
  }
  return mesh.take();
}

glm::vec3 candleAt(int i) {
  const float a = 2.0f * kPi * (float(i) + 0.57f) / float(kCandles);
  return {0.115f * std::cos(a), kCrown + 0.01f, 0.115f * std::sin(a)};
}

// Its wick is at the origin.
Mesh makeFlame(const std::string& name) {
  MeshBuilder mesh(name);
  mesh.setMaterial(kFlame);
  mesh.lathe({{0.0f, -0.008f}, {0.014f, 0.004f}, {0.019f, 0.02f}, {0.013f, 0.045f}, {0.0f, 0.075f}}, 10,
             Shading::smooth);
  return mesh.take();
}

// A hand-drawn flicker: sums of periods that divide the loop, another for each flame.
float flicker(float time, int flame, float start) {
  const float shift = 1.7f * float(flame) + start;
  return 0.5f * std::sin(phase(time, 0.8f) + shift) +
         0.3f * std::sin(phase(time, 1.0f / 3.0f) + 2.3f * shift) +
         0.2f * std::sin(phase(time, 2.0f) + 0.7f * shift);
}

glm::vec3 wickAt(int i) {
  return candleAt(i) + glm::vec3(0, kCandle1 + 0.012f, 0);
}

}  // namespace

glm::vec3 flameAt(int candle) {
  return kCake + wickAt(candle) + glm::vec3(0, 0.06f, 0);
}

void addCake(Document& document, int parent) {
  const int cake = document.addMesh(makeCake(), parent, kCake);
  MeshBuilder candles("Candles");
  candles.setMaterial(kCandle);
  for (int i = 0; i < kCandles; ++i)
    candles.tube({candleAt(i), candleAt(i) + glm::vec3(0, kCandle1, 0)}, {0.013f}, 8);
  document.addMesh(candles.take(), cake);
  std::vector<Channel>& channels = party(document).channels;
  for (int i = 0; i < kCandles; ++i) {
    const int flame = document.addMesh(makeFlame("Flame " + std::to_string(i + 1)), cake, wickAt(i));
    channels.push_back(scaleKeys(flame, onTwos(), [i](float time) {
      const float tall = 1.0f + 0.22f * flicker(time, i, 0.0f);
      return glm::vec3(1.0f / std::sqrt(tall), tall, 1.0f / std::sqrt(tall));
    }));
    channels.push_back(rotationKeys(flame, onTwos(), [i](float time) {
      return glm::angleAxis(0.22f * flicker(time, i, 2.0f), glm::vec3(0, 0, 1)) *
             glm::angleAxis(0.16f * flicker(time, i, 4.0f), glm::vec3(1, 0, 0));
    }));
  }
}

}  // namespace henry
