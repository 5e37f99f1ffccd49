#include "xr/grasp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <utility>

namespace scumble::xr {

namespace {

constexpr float kFlatSpace = 1e-18f;  // cubic metres that a cubic metre becomes

// From the world down to it.
std::vector<NodeId> pathTo(const SceneEditor& editor, NodeId node) {
  std::vector<NodeId> path;
  for (; node != NodeId::none; node = editor.parentOf(node)) path.insert(path.begin(), node);
  return path;
}

// Whether all meshes go with a node.
bool isEverything(const SceneEditor& editor, NodeId node) {
  std::vector<bool> isBelow(editor.nodeCount(), false);
  for (size_t i = 0; i < isBelow.size(); ++i) {
    const NodeId own = NodeId(int(i)), parent = editor.parentOf(own);
    isBelow[i] = own == node || (parent != NodeId::none && isBelow[size_t(parent)]);
  }
  for (size_t i = 0; i < isBelow.size(); ++i)
    if (editor.meshOf(NodeId(int(i))) != MeshId::none && !isBelow[size_t(editor.carrierOf(NodeId(int(i))))])
      return false;
  return true;
}

// From its parent to the world.
glm::dmat4 aboveOf(const SceneEditor& editor, NodeId node, const std::vector<glm::dmat4>& world) {
  const NodeId parent = editor.parentOf(node);
  return parent == NodeId::none ? glm::dmat4(1.0) : world.at(size_t(parent));
}

// Without a zero below zero.
float rounded(float degrees) {
  return std::round(degrees) + 0.0f;
}

}  // namespace

Result<Grasp> Grasp::take(SceneEditor& editor, NodeId hit, int support, const Moment& moment) {
  if (int(hit) < 0 || size_t(hit) >= std::min(editor.nodeCount(), moment.world.size()))
    return Error{ErrorKind::usage, "", 0, "", "it is a part of the world", "take hold of something else"};
  const std::vector<NodeId> carrying = pathTo(editor, NodeId(support));
  Grasp grasp;
  size_t first = 0;
  bool isCarried = false;
  Error why{ErrorKind::usage, "", 0, "", "it carries you", "choose another camera to stand at"};
  const NodeId touched = editor.carrierOf(hit);
  for (const NodeId node : pathTo(editor, touched)) {
    const bool isBeneath = std::find(carrying.begin(), carrying.end(), node) != carrying.end();
    if (isBeneath || (node != touched && grasp.path_.empty() && isEverything(editor, node))) continue;
    // In a space that is flat nothing can be placed.
    if (!(std::abs(glm::determinant(glm::dmat3(aboveOf(editor, node, moment.world)))) > kFlatSpace)) continue;
    // Nodes that a clip moves are the clip's; what goes along with one of those is a thing by itself.
    if (Status status = editor.setTransform(node, editor.transformOf(node)); !status) {
      why = status.error();
      isCarried = true;
      continue;
    }
    grasp.path_.push_back(node);
    if (std::exchange(isCarried, false)) first = grasp.path_.size() - 1;
  }
  if (grasp.path_.empty()) return why;
  grasp.level_ = first;
  grasp.before_ = editor.transformOf(grasp.node());
  grasp.inHand_ = glm::inverse(moment.hand) * aboveOf(editor, grasp.node(), moment.world) * grasp.before_;
  return grasp;
}

bool Grasp::widen(SceneEditor& editor, bool isMore, const Moment& moment) {
  if (isMore ? level_ == 0 : level_ + 1 == path_.size()) return false;
  // What is let go takes along again what hangs below it.
  const glm::dmat4 was = aboveOf(editor, node(), moment.world) * before_;
  const glm::dmat4 back = was * glm::inverse(moment.world.at(size_t(node())));
  if (!editor.setTransform(node(), before_)) return false;
  level_ += isMore ? -1 : 1;
  before_ = editor.transformOf(node());
  const glm::dmat4 above = aboveOf(editor, node(), moment.world);
  inHand_ = glm::inverse(moment.hand) * (isMore ? above : back * above) * before_;
  return true;
}

Status Grasp::follow(SceneEditor& editor, const Moment& moment) const {
  return editor.setTransform(node(),
                             glm::inverse(aboveOf(editor, node(), moment.world)) * moment.hand * inHand_);
}

bool Grasp::concerns(const SceneEditor& editor, const Grasp& other) const {
  const std::vector<NodeId> own = pathTo(editor, node()), its = pathTo(editor, other.node());
  const size_t least = std::min(own.size(), its.size());
  return std::equal(own.begin(), own.begin() + ptrdiff_t(least), its.begin());
}

std::string Grasp::told(const SceneEditor& editor, const std::vector<glm::dmat4>& moved) const {
  const glm::dmat4 now = editor.transformOf(node());
  double way = 0, size = 1;
  for (int column = 0; column < 4; ++column) {
    way = std::max(way, glm::length(now[column] - before_[column]));
    size = std::max(size, glm::length(before_[column]));
  }
  if (way < 1e-4 * size) return "";
  const glm::dmat4 world = aboveOf(editor, node(), moved) * editor.transformOf(node());
  const std::string name = editor.nameOf(node());
  std::string text = name.empty() ? "node " + std::to_string(int(node()) + 1) : "'" + name + "'";
  text += fmt::format(" at {:.2f}, {:.2f}, {:.2f}", world[3].x, world[3].y, world[3].z);
  // What is flat has no turn.
  const glm::vec3 x(world[0]), y(world[1]), z(world[2]);
  if (!(std::abs(glm::dot(glm::cross(x, y), z)) > kFlatSpace)) return text;
  const glm::vec3 degrees = glm::degrees(
      glm::eulerAngles(glm::quat_cast(glm::mat3(glm::normalize(x), glm::normalize(y), glm::normalize(z)))));
  return text + fmt::format(", turned by {:.0f}, {:.0f}, {:.0f} degrees", rounded(degrees.x),
                            rounded(degrees.y), rounded(degrees.z));
}

}  // namespace scumble::xr
