#include "xr/grasp.h"

#include <algorithm>
#include <cstdio>
#include <glm/gtc/quaternion.hpp>
#include <vector>

namespace scumble::xr {

namespace {

glm::mat4 matrixOf(const Pose& pose) {
  glm::mat4 matrix = glm::mat4_cast(pose.turn);
  matrix[3] = glm::vec4(pose.place, 1);
  return matrix;
}

// From the world down to it.
std::vector<NodeId> pathTo(const SceneEditor& editor, NodeId node) {
  std::vector<NodeId> path;
  for (; node != NodeId::none; node = editor.parentOf(node)) path.insert(path.begin(), node);
  return path;
}

// Whether all meshes hang below a node.
bool isEverything(const SceneEditor& editor, NodeId node) {
  std::vector<bool> isBelow(editor.nodeCount(), false);
  for (size_t i = 0; i < isBelow.size(); ++i) {
    const NodeId own = NodeId(int(i)), parent = editor.parentOf(own);
    isBelow[i] = own == node || (parent != NodeId::none && isBelow[size_t(parent)]);
    if (!isBelow[i] && editor.meshOf(own) != MeshId::none) return false;
  }
  return true;
}

}  // namespace

Result<Grasp> Grasp::take(SceneEditor& editor, NodeId hit, int support, const Pose& hand) {
  const std::vector<NodeId> path = pathTo(editor, hit);
  if (path.empty() || size_t(hit) >= editor.nodeCount())
    return Error{ErrorKind::usage, "", 0, "", "it is part of the world", "take hold of something else"};
  Grasp grasp;
  for (const NodeId node : path) {
    // What a clip moves is not where it is at rest, nor is what hangs below it.
    if (Status status = editor.setTransform(node, editor.transformOf(node)); !status) return status.error();
    grasp.node_ = node;
    if (!isEverything(editor, node)) break;
    if (node != hit) grasp.aboveToWorld_ *= editor.transformOf(node);
  }
  const std::vector<NodeId> carried = pathTo(editor, NodeId(support));
  if (std::find(carried.begin(), carried.end(), grasp.node_) != carried.end())
    return Error{ErrorKind::usage, "", 0, "", "it carries you", "step off it: choose another camera"};
  grasp.inHand_ = glm::inverse(matrixOf(hand)) * grasp.aboveToWorld_ * editor.transformOf(grasp.node_);
  return grasp;
}

Status Grasp::follow(SceneEditor& editor, const Pose& hand) const {
  return editor.setTransform(node_, glm::inverse(aboveToWorld_) * matrixOf(hand) * inHand_);
}

std::string Grasp::told(const SceneEditor& editor) const {
  const glm::mat4 world = aboveToWorld_ * editor.transformOf(node_);
  const glm::vec3 degrees = glm::degrees(glm::eulerAngles(
      glm::quat_cast(glm::mat3(glm::normalize(glm::vec3(world[0])), glm::normalize(glm::vec3(world[1])),
                               glm::normalize(glm::vec3(world[2]))))));
  char text[160];
  std::snprintf(text, sizeof text, "at %.2f, %.2f, %.2f, turned by %.0f, %.0f, %.0f degrees", world[3].x,
                world[3].y, world[3].z, degrees.x, degrees.y, degrees.z);
  return text;
}

}  // namespace scumble::xr
