// The rocky point with its lighthouse, the rocks at the pier's root, and what lies on the horizon.
#include "parts.h"
#include "rocks.h"

namespace demo {
namespace {

using namespace meshkit;

struct RockPlace {
  float x, z, halfX, halfY, halfZ, turn, top;
  int levels;
};

Mesh makeRocks(const char* name, const std::vector<RockPlace>& places, Paint rock, Paint grass,
               float grassFrom, uint64_t seed) {
  MeshBuilder mesh(name);
  for (const RockPlace& p : places) {
    RockShape shape{.center = {p.x, -0.22f * p.halfY, p.z},
                    .halfSize = {p.halfX, p.halfY, p.halfZ},
                    .turn = p.turn,
                    .top = p.top,
                    .levels = p.levels,
                    .seed = seed++};
    addRock(mesh, shape, [&](glm::vec3 normal, glm::vec3 center) -> int {
      if (center.y < -0.8f) return -1;  // never seen
      if (normal.y > 0.80f && center.y > grassFrom) return grass;
      return center.y < 0.55f ? kRockWet : rock;
    });
  }
  return mesh.take();
}

// A far, low ridge: a row of columns with a front and a sloping top.
Mesh makeHeadland(const char* name, Paint paint, float distance, float from, float to, float height,
                  uint64_t seed) {
  MeshBuilder mesh(name);
  mesh.setMaterial(paint);
  Random random(seed);
  constexpr size_t kColumns = 26;
  Grid ridge(3, kColumns);
  for (size_t c = 0; c < kColumns; ++c) {
    const float t = float(c) / float(kColumns - 1), angle = glm::mix(from, to, t);
    const glm::vec3 out = {std::sin(angle), 0, -std::cos(angle)};
    const float swell = std::pow(std::max(std::sin(kPi * t), 0.0f), 1.3f) *
                        (0.62f + 0.38f * std::sin(5.0f * t + float(seed)));
    const float y = height * swell * random.between(0.82f, 1.0f);
    ridge.at(0, c) = out * distance + glm::vec3(0, -1.5f, 0);
    ridge.at(1, c) = out * (distance + 0.7f * y) + glm::vec3(0, 0.6f * y - 0.5f, 0);
    ridge.at(2, c) = out * (distance + 2.2f * y) + glm::vec3(0, y - 0.5f, 0);
  }
  mesh.grid(ridge);
  return mesh.take();
}

Mesh makeTower() {
  MeshBuilder mesh("LighthouseTower");
  constexpr int kSides = 12;
  const std::vector<float> heights = {0.0f, 0.5f, 2.5f, 4.3f, 6.1f, 7.6f};
  auto radius = [](float y) { return glm::mix(1.55f, 0.98f, std::pow(y / 7.6f, 0.8f)); };
  for (size_t i = 0; i + 1 < heights.size(); ++i) {
    mesh.setMaterial(i == 0 ? kLighthouseDark : i % 2 == 0 ? kLighthouseRed : kLighthouseWhite);
    const float base = i == 0 ? 0.15f : 0.0f;
    mesh.lathe({{radius(heights[i]) + base, heights[i]}, {radius(heights[i + 1]) + base, heights[i + 1]}},
               kSides);
  }
  // Gallery with a parapet, lantern room, roof.
  mesh.setMaterial(kLighthouseDark);
  mesh.lathe({{0.98f, 7.4f}, {1.45f, 7.62f}, {1.45f, 7.78f}, {0.0f, 7.78f}}, kSides);
  for (int i = 0; i < kSides; ++i) {
    const float a = 2.0f * kPi * float(i) / kSides, b = 2.0f * kPi * float(i + 1) / kSides;
    const glm::vec3 p = {1.38f * std::cos(a), 7.78f, -1.38f * std::sin(a)},
                    q = {1.38f * std::cos(b), 7.78f, -1.38f * std::sin(b)};
    mesh.tube({p, p + glm::vec3(0, 0.62f, 0)}, {0.035f}, 4, Shading::flat);
    mesh.tube({p + glm::vec3(0, 0.6f, 0), q + glm::vec3(0, 0.6f, 0)}, {0.04f}, 4, Shading::flat);
  }
  mesh.setMaterial(kLighthouseLamp);
  mesh.lathe({{0.62f, 7.78f}, {0.62f, 9.05f}}, 8);
  mesh.setMaterial(kLighthouseDark);
  for (int i = 0; i < 8; ++i) {
    const float a = 2.0f * kPi * float(i) / 8.0f;
    mesh.tube({{0.64f * std::cos(a), 7.78f, -0.64f * std::sin(a)},
               {0.64f * std::cos(a), 9.05f, -0.64f * std::sin(a)}},
              {0.05f}, 4, Shading::flat);
  }
  mesh.setMaterial(kLighthouseRed);
  mesh.lathe({{0.0f, 9.02f},
              {0.86f, 9.02f},
              {0.80f, 9.14f},
              {0.45f, 9.72f},
              {0.10f, 9.98f},
              {0.10f, 10.2f},
              {0.0f, 10.3f}},
             8);
  // Door and windows stand a hand's breadth proud of the wall.
  mesh.setMaterial(kLighthouseDark);
  mesh.box({0.1f, 1.1f, 1.42f}, {0.75f, 1.5f, 0.3f});
  mesh.box({0.45f, 3.6f, 1.18f}, {0.4f, 0.65f, 0.2f});
  mesh.box({-0.3f, 5.4f, 1.06f}, {0.36f, 0.6f, 0.2f});
  return mesh.take();
}

Mesh makeCottage() {
  MeshBuilder mesh("KeepersCottage");
  mesh.setMaterial(kLighthouseWhite);
  const std::vector<glm::vec2> gable = {
      {-1.5f, -1.8f}, {1.5f, -1.8f}, {1.5f, 1.8f}, {0.0f, 3.0f}, {-1.5f, 1.8f}};
  mesh.setTransform(glm::rotate(glm::mat4(1.0f), 0.5f * kPi, glm::vec3(0, 1, 0)));
  mesh.extrude(gable, -2.4f, 2.4f);
  mesh.setMaterial(kCottageRoof);
  for (float side : {-1.0f, 1.0f}) {
    const std::vector<glm::vec2> slope =
        side < 0 ? std::vector<glm::vec2>{{-1.75f, 1.6f}, {0, 3.0f}, {0, 3.25f}, {-1.75f, 1.8f}}
                 : std::vector<glm::vec2>{{0, 3.0f}, {1.75f, 1.6f}, {1.75f, 1.8f}, {0, 3.25f}};
    mesh.extrude(slope, -2.6f, 2.6f);
  }
  mesh.setTransform(glm::mat4(1.0f));
  mesh.setMaterial(kCottageRoof);
  mesh.box({1.5f, 3.3f, 0.0f}, {0.55f, 1.2f, 0.55f});
  mesh.setMaterial(kLighthouseDark);
  mesh.box({0.2f, 0.4f, 1.5f}, {0.7f, 1.5f, 0.1f});
  mesh.box({-1.3f, 0.8f, 1.5f}, {0.6f, 0.7f, 0.1f});
  mesh.box({1.5f, 0.8f, 1.5f}, {0.6f, 0.7f, 0.1f});
  return mesh.take();
}

}  // namespace

int addLighthouse(Document& document, int parent, glm::vec3 position) {
  const int lighthouse = document.addNode({"Lighthouse", parent, position});
  document.addMesh(makeTower(), lighthouse);
  document.addMesh(makeCottage(), lighthouse, {-4.95f, 0.05f, -0.2f},
                   glm::angleAxis(0.25f, glm::vec3(0, 1, 0)));
  return lighthouse;
}

int addShore(Document& document, int parent) {
  const int shore = document.addNode({"Shore", parent});
  constexpr float kPlatform = 4.3f;
  document.addMesh(makeRocks("RockyPoint",
                             {{-66, -74, 20, 9.0f, 12, 0.2f, 1e9f, 3},
                              {-50, -78, 14, 7.5f, 10, -0.3f, 1e9f, 3},
                              {-38, -79, 11, 6.4f, 9, 0.4f, kPlatform + 0.6f, 3},
                              {-26, -80, 10, 6.2f, 8, 0.1f, kPlatform, 3},
                              {-16.5f, -80, 5.5f, 3.6f, 5, 0.7f, 1e9f, 2},
                              {-20, -73.5f, 5, 3.0f, 3.5f, -0.4f, 1e9f, 3},
                              {-31, -71.5f, 6, 3.4f, 4, 0.3f, 1e9f, 3},
                              {-43, -70, 7, 4.2f, 4, -0.2f, 1e9f, 2},
                              {-10.5f, -79, 2.6f, 1.6f, 2.4f, 0.5f, 1e9f, 2},
                              {-12.6f, -75, 1.4f, 0.9f, 1.2f, 1.1f, 1e9f, 2}},
                             kRockFar, kRockFarGrass, 1.6f, 40),
                   shore);
  document.addMesh(makeRocks("PierRocks",
                             {{-33, -40, 9, 5.0f, 7, 0.3f, 1e9f, 3},
                              {-27.5f, -37.5f, 4.0f, 2.6f, 3.4f, 0.8f, 1.42f, 3},
                              {-25.5f, -41.5f, 3.6f, 2.2f, 3.0f, -0.5f, 1e9f, 2},
                              {-22.6f, -39.8f, 1.5f, 1.0f, 1.3f, 0.2f, 1e9f, 2},
                              {-28, -33.2f, 2.4f, 1.6f, 2.0f, 0.2f, 1e9f, 2}},
                             kRock, kRockGrass, 2.2f, 60),
                   shore);
  const int horizon = document.addNode({"Horizon", parent});
  document.addMesh(makeHeadland("HeadlandFar", kHeadlandFar, 560, -0.28f, 0.22f, 17, 3), horizon);
  document.addMesh(makeHeadland("HeadlandRight", kHeadland, 470, 0.30f, 0.95f, 24, 5), horizon);
  document.addMesh(makeHeadland("HeadlandLeft", kHeadland, 500, -1.3f, -0.42f, 26, 8), horizon);
  return shore;
}

}  // namespace demo
