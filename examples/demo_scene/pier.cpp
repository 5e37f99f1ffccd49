// The pier: planks on stringers on posts, and what stands about at its head.
#include "mesh_kit/random.h"
#include "parts.h"

namespace demo {
namespace {

using namespace meshkit;
constexpr float kDeckTop = 1.45f, kWidth = 2.5f;  // metres; the deck above the water
constexpr float kPostDepth = -2.2f;               // posts go down here, well below the waves

glm::mat4 placed(glm::vec3 at, float turn) {
  return glm::rotate(glm::translate(glm::mat4(1.0f), at), turn, glm::vec3(0, 1, 0));
}

// Pier space: +X from the root to the head, the deck's middle at z = 0.
Mesh makeDeck(float length) {
  MeshBuilder mesh("PierDeck");
  Random random(11);
  constexpr float kPitch = 0.36f;
  const int count = int(length / kPitch);
  for (int i = 0; i < count; ++i) {
    mesh.setMaterial(random.unit() < 0.10f ? kPierDark : kPier);
    const float x = (float(i) + 0.5f) * kPitch;
    mesh.setTransform(
        placed({x, kDeckTop - 0.035f + random.between(-0.008f, 0.008f), random.between(-0.02f, 0.02f)},
               random.between(-0.006f, 0.006f)));
    mesh.box({0, 0, 0}, {kPitch - 0.014f, 0.07f, kWidth + random.between(-0.03f, 0.04f)});
  }
  mesh.setTransform(glm::mat4(1.0f));
  mesh.setMaterial(kPierDark);
  for (float z : {-0.9f, 0.9f}) mesh.box({0.5f * length, kDeckTop - 0.19f, z}, {length, 0.22f, 0.16f});
  return mesh.take();
}

Mesh makePosts(float length) {
  MeshBuilder mesh("PierPosts");
  Random random(12);
  constexpr float kBay = 4.2f;
  const int bays = int((length - 0.6f) / kBay);
  for (int i = 0; i <= bays; ++i) {
    const float x = length - 0.35f - float(i) * kBay;
    for (float side : {-1.0f, 1.0f}) {
      // Every second post rises above the deck, so that the pier has a rhythm.
      const float z = side * (0.5f * kWidth - 0.02f);
      const bool tall = i % 2 == 0;
      const float top = tall ? kDeckTop + random.between(0.55f, 0.75f) : kDeckTop - 0.05f;
      const glm::vec3 foot = {x + random.between(-0.08f, 0.08f), kPostDepth, z * 1.06f};
      const glm::vec3 head = {x, top, z};
      mesh.setMaterial(kPierDark);
      mesh.tube({foot, glm::mix(foot, head, 0.6f), head}, {0.17f, 0.15f, 0.14f}, 8, Shading::flat);
      mesh.setMaterial(kRockWet);
      mesh.tube(
          {glm::mix(foot, head, 0.45f), glm::mix(foot, head, (0.45f - kPostDepth) / (top - kPostDepth))},
          {0.175f, 0.168f}, 8, Shading::flat);
    }
    mesh.setMaterial(kPierDark);
    mesh.box({x, kDeckTop - 0.38f, 0}, {0.2f, 0.2f, kWidth + 0.3f});
  }
  return mesh.take();
}

void crate(MeshBuilder& mesh, glm::vec3 at, float turn, glm::vec3 size, Paint paint, Paint frame) {
  const glm::mat4 before = mesh.transform();
  mesh.setTransform(before * placed(at, turn));
  mesh.setMaterial(paint);
  mesh.box({0, 0.5f * size.y, 0}, size - glm::vec3(0.03f));
  mesh.setMaterial(frame);
  const glm::vec3 h = 0.5f * size;
  constexpr float kBoard = 0.09f;
  for (float x : {-1.0f, 1.0f}) {
    for (float z : {-1.0f, 1.0f}) {
      mesh.box({x * (h.x - 0.03f), h.y, z * (h.z - 0.03f)}, {kBoard, size.y, kBoard});
    }
  }
  for (float y : {0.05f, size.y - 0.05f}) {
    for (float z : {-1.0f, 1.0f}) mesh.box({0, y, z * (h.z - 0.01f)}, {size.x, kBoard, 0.05f});
    for (float x : {-1.0f, 1.0f}) mesh.box({x * (h.x - 0.01f), y, 0}, {0.05f, kBoard, size.z});
  }
  mesh.setTransform(before);
}

Mesh makeCrates() {
  MeshBuilder mesh("Crates");
  crate(mesh, {-2.3f, 0, -0.45f}, 0.15f, {0.95f, 0.75f, 0.8f}, kCrate, kCrateLight);
  crate(mesh, {-3.25f, 0, -0.35f}, -0.2f, {0.8f, 0.65f, 0.7f}, kCrateLight, kCrate);
  crate(mesh, {-2.45f, 0.75f, -0.4f}, 0.5f, {0.68f, 0.55f, 0.6f}, kCrateLight, kCrate);
  return mesh.take();
}

Mesh makeBarrel() {
  MeshBuilder mesh("Barrel");
  mesh.setMaterial(kBarrel);
  std::vector<glm::vec2> staves{{0.0f, 0.0f}};
  for (int i = 0; i <= 8; ++i) {
    const float v = float(i) / 8.0f;
    staves.push_back({0.29f + 0.09f * std::sin(v * kPi), 0.95f * v});
  }
  staves.insert(staves.end(), {{0.25f, 0.95f}, {0.25f, 0.91f}, {0.0f, 0.91f}});
  mesh.lathe(staves, 14);
  mesh.setMaterial(kIron);
  for (float y : {0.12f, 0.30f, 0.62f, 0.80f}) {
    const float r = 0.305f + 0.09f * std::sin(y / 0.95f * kPi);
    mesh.lathe({{r - 0.03f, y}, {r, y}, {r, y + 0.06f}, {r - 0.03f, y + 0.06f}}, 14);
  }
  return mesh.take();
}

Mesh makeCoil() {
  MeshBuilder mesh("RopeCoil");
  mesh.setMaterial(kRope);
  std::vector<glm::vec3> path;
  constexpr int kTurns = 5, kPerTurn = 14;
  for (int i = 0; i <= kTurns * kPerTurn; ++i) {
    const float turn = float(i) / kPerTurn, angle = turn * 2.0f * kPi;
    const float r = 0.40f - 0.018f * turn;
    path.push_back({r * std::cos(angle), 0.045f + 0.065f * turn, r * std::sin(angle)});
  }
  path.push_back({0.1f, 0.25f, -0.15f});
  path.push_back({0.02f, 0.05f, 0.05f});
  mesh.tube(path, {0.045f}, 6);
  return mesh.take();
}

Mesh makeBollards(float length) {
  MeshBuilder mesh("Bollards");
  for (glm::vec2 at : {glm::vec2(length - 1.15f, 0.72f), glm::vec2(length - 6.4f, 0.85f),
                       glm::vec2(length - 6.4f, -0.85f)}) {
    mesh.setTransform(placed({at.x, kDeckTop, at.y}, 0.2f));
    mesh.setMaterial(kIron);
    mesh.lathe({{0.0f, 0.0f},
                {0.24f, 0.0f},
                {0.22f, 0.06f},
                {0.14f, 0.10f},
                {0.12f, 0.36f},
                {0.21f, 0.42f},
                {0.20f, 0.50f},
                {0.10f, 0.55f},
                {0.0f, 0.56f}},
               10);
  }
  // A turn of mooring line about the first, hanging to the water.
  mesh.setTransform(glm::mat4(1.0f));
  mesh.setMaterial(kRope);
  std::vector<glm::vec3> turn;
  for (int i = 0; i <= 24; ++i) {
    const float a = 2.0f * kPi * float(i) / 10.0f;
    turn.push_back({length - 1.15f + 0.16f * std::cos(a), kDeckTop + 0.15f + 0.004f * float(i),
                    0.72f + 0.16f * std::sin(a)});
  }
  mesh.tube(turn, {0.032f}, 6);
  return mesh.take();
}

// A lamp on a post, unlit by day.
Mesh makeLampPost() {
  MeshBuilder mesh("LampPost");
  mesh.setMaterial(kPierDark);
  mesh.tube({{0, -1.0f, 0}, {0, 3.0f, 0}}, {0.09f, 0.07f}, 8, Shading::flat);
  mesh.bar({{0, 2.85f, 0}, {0.62f, 2.95f, 0}}, 0.07f, 0.09f, {0, 1, 0});
  mesh.bar({{0, 2.4f, 0}, {0.42f, 2.9f, 0}}, 0.05f, 0.06f, {0, 1, 0});
  mesh.setMaterial(kIron);
  mesh.setTransform(placed({0.56f, 2.42f, 0}, 0));
  mesh.lathe({{0, 0}, {0.10f, 0}, {0.10f, 0.04f}, {0.0f, 0.04f}}, 6);
  mesh.lathe({{0, 0.30f}, {0.15f, 0.30f}, {0.05f, 0.42f}, {0.03f, 0.50f}, {0.0f, 0.50f}}, 6);
  mesh.setMaterial(kLighthouseWhite);
  mesh.lathe({{0, 0.04f}, {0.08f, 0.04f}, {0.11f, 0.30f}, {0.0f, 0.30f}}, 6);
  return mesh.take();
}

}  // namespace

int addPier(Document& document, int parent, glm::vec3 root, glm::vec3 head) {
  const glm::vec3 along = head - root;
  const float length = glm::length(along);
  const int pier = document.addNode(
      {"Pier", parent, root, glm::angleAxis(std::atan2(-along.z, along.x), glm::vec3(0, 1, 0))});
  document.addMesh(makeDeck(length), pier);
  document.addMesh(makePosts(length), pier);
  document.addMesh(makeBollards(length), pier);
  document.addMesh(makeCrates(), pier, {length, kDeckTop, 0});
  document.addMesh(makeBarrel(), pier, {length - 1.35f, kDeckTop, -0.72f});
  document.addMesh(makeCoil(), pier, {length - 2.35f, kDeckTop, 0.55f});
  document.addMesh(makeLampPost(), pier, {length - 17.2f, kDeckTop, -1.12f});
  return pier;
}

}  // namespace demo
