#include "mesh_kit/document.h"

#include <glm/gtc/matrix_transform.hpp>

namespace meshkit {

glm::quat lookAlong(glm::vec3 direction) {
  const glm::vec3 back = -glm::normalize(direction);
  const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), back));
  return glm::normalize(glm::quat_cast(glm::mat3(right, glm::cross(back, right), back)));
}

int Document::addBoundMesh(Mesh mesh, const std::vector<int>& joints, int space) {
  Skin skin{mesh.name, joints, {}};
  for (int joint : joints) skin.inverseBinds.push_back(glm::inverse(worldMatrix(joint)) * worldMatrix(space));
  const int node = addMesh(std::move(mesh), -1);
  nodes[size_t(node)].skin = int(skins.size());
  skins.push_back(std::move(skin));
  return node;
}

void Document::addCamera(Camera camera, glm::vec3 eye, glm::vec3 target, int parent) {
  Node node{camera.name, parent, eye, lookAlong(target - eye)};
  node.camera = int(cameras.size());
  cameras.push_back(std::move(camera));
  addNode(std::move(node));
}

void Document::addSun(glm::vec3 towardsSun, glm::vec3 color, float intensity) {
  Node node{"Sun", -1, 100.0f * glm::normalize(towardsSun), lookAlong(-towardsSun)};
  node.sun = true;
  sunColor = color;
  sunIntensity = intensity;
  addNode(std::move(node));
}

void Document::restAtStartOf(const Clip& clip) {
  for (const Channel& channel : clip.channels) {
    Node& node = nodes[size_t(channel.node)];
    const size_t keys = channel.times.size() * (channel.interpolation == Interpolation::cubicSpline ? 3 : 1);
    const size_t size = channel.values.size() / keys;
    const float* v = channel.values.data() + (channel.interpolation == Interpolation::cubicSpline ? size : 0);
    if (channel.path == Path::translation) node.translation = {v[0], v[1], v[2]};
    if (channel.path == Path::rotation) node.rotation = glm::quat(v[3], v[0], v[1], v[2]);
    if (channel.path == Path::scale) node.scale = {v[0], v[1], v[2]};
    if (channel.path == Path::weights && node.mesh >= 0)
      meshes[size_t(node.mesh)].weights.assign(v, v + size);
  }
}

glm::mat4 Document::worldMatrix(int node) const {
  glm::mat4 matrix(1.0f);
  for (int i = node; i >= 0; i = nodes[size_t(i)].parent) {
    const Node& n = nodes[size_t(i)];
    matrix = glm::translate(glm::mat4(1.0f), n.translation) * glm::mat4_cast(n.rotation) *
             glm::scale(glm::mat4(1.0f), n.scale) * matrix;
  }
  return matrix;
}

size_t Document::triangleCount() const {
  size_t count = 0;
  for (const Node& node : nodes)
    if (node.mesh >= 0) count += meshes[size_t(node.mesh)].triangleCount();
  return count;
}

}  // namespace meshkit
