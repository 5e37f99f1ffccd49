// owl OUT.glb: writes an owl on a stump, whose plumage (nodes "Plumage ...") waits for feathers: `scumble
// paint --nodes 'Plumage*'`. Its meshes are of even quads, which suit fins.
#include <cmath>

#include "mesh_kit/glb_writer.h"
#include "mesh_kit/mesh_builder.h"

namespace {

using namespace meshkit;

enum Material { kBack, kBreast, kFace, kWing, kTip, kIris, kPupil, kBeak, kFoot, kBark, kWood };

std::vector<meshkit::Material> palette() {
  return {{"Back", "#96683F", "#5B4350"},  {"Breast", "#E8CF9F", "#A98D86"}, {"Face", "#F0DDB8", "#B39C98"},
          {"Wing", "#7C5537", "#4A3A4C"},  {"Tip", "#4E3B3A", "#332C40"},    {"Iris", "#F2A93B", "#B8702F"},
          {"Pupil", "#221D28", "#191620"}, {"Beak", "#4A4048", "#2F2A38"},   {"Foot", "#C98F4E", "#8A5E50"},
          {"Bark", "#6D5A4C", "#413A4A"},  {"Wood", "#CFA878", "#8F7470"}};
}

// Heights with half widths and half depths, metres.
const std::vector<glm::vec3> kBody = {
    {0.00f, 0.07f, 0.07f},   {0.05f, 0.135f, 0.13f}, {0.13f, 0.18f, 0.17f},   {0.24f, 0.197f, 0.18f},
    {0.35f, 0.187f, 0.167f}, {0.43f, 0.17f, 0.15f},  {0.50f, 0.178f, 0.158f}, {0.57f, 0.176f, 0.155f},
    {0.64f, 0.14f, 0.122f},  {0.685f, 0.07f, 0.06f}, {0.70f, 0.012f, 0.012f}};

Mesh makeBody() {
  MeshBuilder mesh("Plumage body");
  const std::vector<glm::vec3> profile = smoothCurve(kBody, 3);
  constexpr size_t kAround = 40;
  Grid grid(profile.size(), kAround);
  for (size_t r = 0; r < profile.size(); ++r)
    for (size_t c = 0; c < kAround; ++c) {
      const float a = 2 * kPi * float(c) / kAround, y = profile[r].x;
      // The breast stands forward, and the face is flat.
      const float front = std::max(std::cos(a), 0.0f),
                  breast = 0.03f * std::exp(-std::pow((y - 0.25f) / 0.12f, 2.0f)),
                  flat = 0.035f * std::exp(-std::pow((y - 0.56f) / 0.07f, 2.0f));
      grid.at(r, c) = {profile[r].y * std::sin(a), y,
                       profile[r].z * std::cos(a) + front * (breast - flat * front)};
    }
  mesh.grid(grid, {.shading = Shading::smooth, .closed = true, .cellMaterial = [&](size_t r, size_t c) {
                     const float y = profile[r].x,
                                 a = std::abs(std::remainder(2 * kPi * (float(c) + 0.5f) / kAround, 2 * kPi));
                     const float x = 0.17f * std::sin(a), side = std::abs(x) - 0.065f;
                     if (a < 1.2f && y > 0.44f && std::hypot(side, y - 0.555f) < 0.078f) return int(kFace);
                     return a < 1.05f && y > 0.03f && y < 0.43f ? int(kBreast) : int(kBack);
                   }});
  return mesh.take();
}

// Flat, tapering, along the body: a wing, the tail, an ear.
Mesh makeBlade(const char* name, const std::vector<glm::vec3>& bones, float width, float thickness,
               const glm::vec3& outward, float darkFrom) {
  MeshBuilder mesh(name);
  const std::vector<glm::vec3> path = smoothCurve(bones, 5);
  constexpr size_t kAround = 20;
  Grid grid(path.size(), kAround);
  for (size_t r = 0; r < path.size(); ++r) {
    const float t = float(r) / float(path.size() - 1);
    const glm::vec3 along = glm::normalize(path[std::min(r + 1, path.size() - 1)] - path[r == 0 ? 0 : r - 1]);
    const glm::vec3 side = glm::normalize(glm::cross(outward, along)), out = glm::cross(along, side);
    const float reach = std::pow(std::sin(kPi * (0.06f + 0.92f * std::pow(t, 0.8f))), 0.7f);
    for (size_t c = 0; c < kAround; ++c) {
      const float a = 2 * kPi * float(c) / kAround;
      grid.at(r, c) = path[r] + reach * (width * std::cos(a) * side + thickness * std::sin(a) * out);
    }
  }
  mesh.grid(grid,
            {.shading = Shading::smooth, .closed = true, .flip = true, .cellMaterial = [&](size_t r, size_t) {
               return float(r) / float(path.size()) < darkFrom ? int(kWing) : int(kTip);
             }});
  return mesh.take();
}

Mesh makeEye() {
  MeshBuilder mesh("Eye");
  std::vector<glm::vec3> points;
  std::vector<glm::uvec3> faces;
  icosphere(3, points, faces);
  for (glm::vec3& p : points) p *= glm::vec3(0.042f, 0.042f, 0.03f);
  mesh.indexed(points, faces, Shading::smooth, [](glm::vec3, glm::vec3 center) {
    return std::hypot(center.x, center.y) < 0.026f && center.z > 0 ? int(kPupil) : int(kIris);
  });
  return mesh.take();
}

Mesh makeBeakAndFeet() {
  MeshBuilder mesh("Beak and feet");
  mesh.setMaterial(kBeak);
  mesh.tube(
      smoothCurve({{0, 0.555f, 0.115f}, {0, 0.545f, 0.15f}, {0, 0.515f, 0.168f}, {0, 0.492f, 0.163f}}, 4),
      {0.019f, 0.019f, 0.019f, 0.018f, 0.018f, 0.017f, 0.016f, 0.015f, 0.013f, 0.01f, 0.007f, 0.004f, 0.001f},
      12);
  mesh.setMaterial(kFoot);
  for (const float side : {-1.0f, 1.0f})
    for (const float turn : {-0.5f, 0.0f, 0.5f}) {
      const glm::vec3 heel(0.065f * side, 0.012f, 0.08f), way(std::sin(turn), 0, std::cos(turn));
      mesh.tube(
          {heel, heel + 0.05f * way + glm::vec3(0, 0.004f, 0), heel + 0.085f * way - glm::vec3(0, 0.012f, 0)},
          {0.017f, 0.014f, 0.005f}, 10);
    }
  return mesh.take();
}

Mesh makeStump() {
  MeshBuilder mesh("Stump");
  constexpr size_t kAround = 36;
  Grid grid(9, kAround);
  for (size_t r = 0; r < 9; ++r)
    for (size_t c = 0; c < kAround; ++c) {
      const float a = 2 * kPi * float(c) / kAround, y = -0.42f + 0.42f * float(r) / 8,
                  root = std::pow(-y / 0.3f, 2.5f);
      const float radius = 0.205f + 0.01f * std::sin(3 * a + 1) + 0.006f * std::sin(11 * a) +
                           root * (0.07f + 0.05f * std::sin(5 * a));
      grid.at(r, c) = {radius * std::sin(a), y, radius * std::cos(a)};
    }
  mesh.setMaterial(kBark);
  mesh.grid(grid, {.shading = Shading::smooth, .closed = true});
  std::vector<glm::vec3> top;
  for (size_t c = 0; c < kAround; ++c) top.push_back(grid.at(8, c));
  mesh.setMaterial(kWood);
  mesh.polygon(top);
  return mesh.take();
}

Document makeScene() {
  Document document;
  document.materials = palette();
  const int owl = document.addNode({"Owl"});
  document.addMesh(makeBody(), owl);
  for (const float side : {-1.0f, 1.0f}) {
    const auto at = [&](float x, float y, float z) { return glm::vec3(side * x, y, z); };
    document.addMesh(makeBlade("Plumage wing",
                               {at(0.14f, 0.43f, 0.03f), at(0.19f, 0.3f, 0.01f), at(0.185f, 0.16f, -0.05f),
                                at(0.12f, 0.03f, -0.15f)},
                               0.085f, 0.026f, at(1, 0, 0), 0.72f),
                     owl);
    document.addMesh(
        makeBlade("Plumage ear",
                  {at(0.08f, 0.63f, 0.02f), at(0.115f, 0.69f, 0.01f), at(0.135f, 0.745f, -0.01f)}, 0.026f,
                  0.018f, at(1, 0, 0.4f), 0.5f),
        owl);
    document.addMesh(makeEye(), owl, at(0.066f, 0.565f, 0.13f),
                     glm::angleAxis(side * 0.32f, glm::vec3(0, 1, 0)));
  }
  document.addMesh(makeBlade("Plumage tail", {{0, 0.15f, -0.14f}, {0, 0.05f, -0.2f}, {0, -0.06f, -0.25f}},
                             0.085f, 0.022f, {0, 0, -1}, 0.5f),
                   owl);
  document.addMesh(makeBeakAndFeet(), owl);
  document.addMesh(makeStump(), owl);
  document.addSun({-0.6f, 0.7f, 0.5f}, {1.0f, 0.93f, 0.82f}, 3.0f);
  document.addCamera({"Portrait", 0.5f, 4.0f / 3.0f, 0.05f, 100.0f}, {0.8f, 0.62f, 2.25f}, {0, 0.25f, 0});
  return document;
}

}  // namespace

int main(int argc, char** argv) {
  return meshkit::generate(argc, argv, "owl", makeScene);
}
