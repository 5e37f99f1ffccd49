// A scene as the generators describe it, before it becomes a GLB.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "mesh_kit/clip.h"
#include "mesh_kit/mesh.h"

namespace meshkit {

// Colours as "#RRGGBB" in sRGB, the way palettes are written down.
struct Material {
  std::string name;
  std::string lit, shadowed;
  bool doubleSided = false;
  std::string emissive;  // empty: none
};

struct Camera {
  std::string name;
  float verticalFov = 0.6f;  // radians
  float aspect = 16.0f / 9.0f;
  float near = 0.1f, far = 2000.0f;  // metres
};

struct Node {
  std::string name;
  int parent = -1;
  glm::vec3 translation{0.0f};
  glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
  glm::vec3 scale{1.0f};
  int mesh = -1, camera = -1, skin = -1;
  bool sun = false;
  std::string extras;  // JSON; empty: none
};

struct Document {
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Camera> cameras;
  std::vector<Node> nodes;  // parents before children
  std::vector<Skin> skins;
  std::vector<Clip> clips;
  glm::vec3 sunColor{1.0f};
  float sunIntensity = 3.0f;  // lux, in glTF's loose sense

  int addNode(Node node) {
    nodes.push_back(std::move(node));
    return int(nodes.size()) - 1;
  }
  // A node that shows a mesh; an empty mesh makes a bare node.
  int addMesh(Mesh mesh, int parent, glm::vec3 translation = glm::vec3(0.0f),
              glm::quat rotation = glm::quat(1, 0, 0, 0)) {
    Node node{mesh.name, parent, translation, rotation};
    if (!mesh.primitives.empty()) {
      node.mesh = int(meshes.size());
      meshes.push_back(std::move(mesh));
    }
    return addNode(std::move(node));
  }
  // A mesh that follows joints: it was built in the space of the node `space`, around the joints as they
  // stand now. Its own node stands at the root, because glTF lets joints alone place such a mesh.
  int addBoundMesh(Mesh mesh, const std::vector<int>& joints, int space);
  void addCamera(Camera camera, glm::vec3 eye, glm::vec3 target, int parent = -1);
  void addSun(glm::vec3 towardsSun, glm::vec3 color, float intensity);

  // Puts every node where the first keys of the clip want it, so that the scene at rest is the clip's start.
  void restAtStartOf(const Clip& clip);

  glm::mat4 worldMatrix(int node) const;
  size_t triangleCount() const;  // as drawn, with every use of a mesh
};

// The rotation that turns -Z towards `direction`, with +Y as upright as it can be.
glm::quat lookAlong(glm::vec3 direction);

}  // namespace meshkit
