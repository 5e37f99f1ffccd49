// Large, quiet clouds behind everything: flat below, heaped above.
#include "mesh_kit/random.h"
#include "parts.h"

namespace demo {
namespace {

using namespace meshkit;

struct Lump {
  glm::vec3 at, halfSize;
};

Mesh makeCloud(const std::string& name, const std::vector<Lump>& lumps) {
  MeshBuilder mesh(name);
  mesh.setMaterial(kCloud);
  std::vector<glm::vec3> ball;
  std::vector<glm::uvec3> faces;
  icosphere(3, ball, faces);
  for (const Lump& lump : lumps) {
    std::vector<glm::vec3> points = ball;
    for (glm::vec3& p : points) {
      p = lump.at + p * lump.halfSize;
      p.y = std::max(p.y, 0.0f);  // all lumps share one flat floor
    }
    mesh.indexed(points, faces, Shading::smooth);
  }
  return mesh.take();
}

}  // namespace

int addClouds(Document& document, int parent) {
  const int clouds = document.addNode({"Clouds", parent});
  document.addMesh(makeCloud("CloudLeft", {{{0, 4, 0}, {46, 13, 18}},
                                           {{-24, 9, -2}, {22, 15, 14}},
                                           {{10, 13, 0}, {25, 19, 15}},
                                           {{38, 3, 2}, {26, 8, 12}},
                                           {{-58, 2, 0}, {26, 6, 10}}}),
                   clouds, {-160, 98, -560});
  document.addMesh(makeCloud("CloudRight", {{{0, 3, 0}, {60, 10, 20}},
                                            {{-18, 9, 0}, {24, 13, 14}},
                                            {{22, 7, 0}, {28, 10, 14}},
                                            {{-66, 1, 0}, {30, 5, 10}}}),
                   clouds, {186, 98, -540});
  document.addMesh(makeCloud("CloudFar", {{{0, 2, 0}, {52, 6, 14}}, {{14, 5, 0}, {22, 8, 10}}}), clouds,
                   {-58, 62, -590});
  return clouds;
}

}  // namespace demo
