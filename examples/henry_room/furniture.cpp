// The table with its cloth, three chairs, the rug, a present and a shelf along the wall.
#include "parts.h"

namespace henry {
namespace {

using namespace meshkit;

Mesh makeCloth() {
  MeshBuilder mesh("Cloth");
  mesh.setMaterial(kCloth);
  // Flat on the table, then down in eight soft folds.
  constexpr int kSides = 64;
  const glm::vec2 profile[] = {{0.0f, 0.0f},     {0.40f, 0.0f},    {0.66f, 0.0f},    {0.715f, -0.008f},
                               {0.735f, -0.04f}, {0.745f, -0.12f}, {0.755f, -0.22f}, {0.765f, -0.31f}};
  Grid cloth(std::size(profile), kSides);
  for (size_t r = 0; r < cloth.rows; ++r) {
    for (int c = 0; c < kSides; ++c) {
      const float a = -2.0f * kPi * float(c) / float(kSides);
      const float hangs = glm::clamp(-profile[r].y / 0.31f, 0.0f, 1.0f);
      const float radius = profile[r].x + 0.045f * hangs * std::sin(8.0f * a + 0.6f * std::sin(3.0f * a));
      const float hem = 0.02f * hangs * std::sin(8.0f * a + 1.4f);
      cloth.at(r, size_t(c)) = {radius * std::cos(a), kTableTop + profile[r].y + hem, radius * std::sin(a)};
    }
  }
  mesh.grid(cloth, {.shading = Shading::smooth, .closed = true, .flip = true});
  return mesh.take();
}

Mesh makeTable() {
  MeshBuilder mesh("Table");
  mesh.setMaterial(kChair);
  mesh.lathe({{0.30f, 0.0f},
              {0.30f, 0.05f},
              {0.12f, 0.10f},
              {0.085f, 0.30f},
              {0.10f, 0.52f},
              {0.20f, 0.66f},
              {kTableRadius - 0.02f, 0.685f},
              {kTableRadius - 0.02f, 0.728f},
              {0.0f, 0.73f}},
             28);
  return mesh.take();
}

// A low chair with a round seat and a bent back; it looks along +Z.
Mesh makeChair(const std::string& name, bool back) {
  MeshBuilder mesh(name);
  mesh.setMaterial(kChair);
  for (float x : {-1.0f, 1.0f}) {
    for (float z : {-1.0f, 1.0f})
      mesh.tube({{0.20f * x, 0.0f, 0.20f * z}, {0.15f * x, kSeat - 0.05f, 0.15f * z}}, {0.028f, 0.034f}, 8);
  }
  mesh.lathe(
      {{0.0f, kSeat - 0.07f}, {0.21f, kSeat - 0.07f}, {0.245f, kSeat - 0.04f}, {0.235f, kSeat - 0.01f}}, 20);
  mesh.setMaterial(kCushion);
  mesh.lathe(
      {{0.235f, kSeat - 0.01f}, {0.24f, kSeat + 0.02f}, {0.20f, kSeat + 0.045f}, {0.0f, kSeat + 0.055f}}, 20,
      Shading::smooth);
  if (!back) return mesh.take();
  mesh.setMaterial(kChair);
  const std::vector<glm::vec3> bow = smoothCurve({{-0.20f, kSeat - 0.04f, -0.17f},
                                                  {-0.235f, 0.72f, -0.23f},
                                                  {-0.16f, 0.93f, -0.27f},
                                                  {0.0f, 0.98f, -0.285f},
                                                  {0.16f, 0.93f, -0.27f},
                                                  {0.235f, 0.72f, -0.23f},
                                                  {0.20f, kSeat - 0.04f, -0.17f}},
                                                 4);
  mesh.tube(bow, {0.028f}, 8);
  mesh.box({0, 0.70f, -0.222f}, {0.13f, 0.46f, 0.03f});
  return mesh.take();
}

// A jar or a jug, turned.
void addJar(MeshBuilder& mesh, glm::vec3 foot, float size, int paint) {
  mesh.setTransform(glm::translate(glm::mat4(1.0f), foot) * glm::scale(glm::mat4(1.0f), glm::vec3(size)));
  mesh.setMaterial(paint);
  mesh.lathe({{0.0f, 0.0f},
              {0.32f, 0.0f},
              {0.5f, 0.30f},
              {0.46f, 0.66f},
              {0.26f, 0.84f},
              {0.30f, 1.0f},
              {0.0f, 1.0f}},
             14);
  mesh.setTransform(glm::mat4(1.0f));
}

// A board along the wall between two columns of the mesh.
void addBoard(MeshBuilder& mesh, float from, float to, float height) {
  constexpr int kPieces = 6;
  Grid board(5, size_t(kPieces) + 1);
  for (int c = 0; c <= kPieces; ++c) {
    const float bearing = glm::mix(from, to, float(c) / float(kPieces)) * kColumnDegrees;
    const float in[] = {-0.04f, 0.22f, 0.22f, -0.04f, -0.04f}, up[] = {-0.04f, -0.04f, 0, 0, -0.04f};
    for (size_t r = 0; r < 5; ++r)
      board.at(r, size_t(c)) = room().at(bearing, height, in[r]) + glm::vec3(0, up[r], 0);
  }
  mesh.setMaterial(kBeam);
  mesh.grid(board);
  for (size_t end : {size_t(0), size_t(kPieces)}) {
    glm::vec3 a = board.at(0, end), b = board.at(1, end), c = board.at(2, end), d = board.at(3, end);
    end == 0 ? mesh.quad(d, c, b, a) : mesh.quad(a, b, c, d);
  }
}

}  // namespace

void addTable(Document& document, int parent) {
  const int table = document.addMesh(makeTable(), parent, kTable);
  document.addMesh(makeCloth(), table);
  MeshBuilder rug("Rug");
  rug.setMaterial(kRugBand);
  rug.lathe({{1.50f, 0.0f}, {1.48f, 0.016f}, {1.30f, 0.018f}}, 56);
  rug.setMaterial(kRug);
  rug.lathe({{1.30f, 0.018f}, {0.0f, 0.020f}}, 56);
  document.addMesh(rug.take(), parent, kTable + glm::vec3(0.25f, 0, 0.1f));
}

void addChairs(Document& document, int parent) {
  auto facing = [](glm::vec3 from) {
    const glm::vec3 to = kTable - from;
    return glm::angleAxis(std::atan2(to.x, to.z), glm::vec3(0, 1, 0));
  };
  document.addMesh(makeChair("Henry's chair", false), parent, kHedgehog, facing(kHedgehog));
  const glm::vec3 left = {-1.80f, 0, -1.42f}, right = {1.34f, 0, -2.25f};
  document.addMesh(makeChair("Chair 1", true), parent, left, facing(left));
  document.addMesh(makeChair("Chair 2", true), parent, right,
                   facing(right) * glm::angleAxis(0.35f, glm::vec3(0, 1, 0)));
}

void addPresent(Document& document, int parent) {
  MeshBuilder mesh("Present");
  mesh.setMaterial(kCushion);
  mesh.box({0, 0.12f, 0}, {0.30f, 0.24f, 0.30f});
  // The ribbon lies on the box.
  mesh.setMaterial(kBalloonHoney);
  mesh.box({0, 0.1225f, 0}, {0.308f, 0.247f, 0.06f});
  mesh.box({0, 0.1225f, 0}, {0.06f, 0.247f, 0.308f});
  document.addMesh(mesh.take(), parent, kPresent, glm::angleAxis(0.5f, glm::vec3(0, 1, 0)));
}

void addShelf(Document& document, int parent) {
  MeshBuilder mesh("Shelf");
  constexpr float kHeight = 1.28f;
  addBoard(mesh, 70.2f, 72.3f, kHeight);
  auto on = [](float column) { return room().at(column * kColumnDegrees, kHeight, 0.12f); };
  addJar(mesh, on(70.35f), 0.15f, kJarSage);
  addJar(mesh, on(70.9f), 0.24f, kJar);
  // Two books beside the jars.
  mesh.setMaterial(kBook);
  const float bearing = 71.7f * kColumnDegrees;
  mesh.setTransform(glm::translate(glm::mat4(1.0f), on(71.7f)) * glm::mat4_cast(onWall(bearing)));
  mesh.box({0.02f, 0.13f, 0}, {0.06f, 0.26f, 0.17f});
  mesh.box({-0.05f, 0.11f, 0}, {0.05f, 0.22f, 0.16f});
  document.addMesh(mesh.take(), parent);
}

}  // namespace henry
