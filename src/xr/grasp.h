// What a hand has hold of, and takes with it.
#pragma once

#include <string>
#include <vector>

#include "scumble/scene_editor.h"
#include "xr/place.h"

namespace scumble::xr {

class Grasp {
 public:
  // Matrices to the world at a moment: of the hand, and of nodes as clips take them (nodesToWorld()).
  struct Moment {
    glm::dmat4 hand{1.0};
    std::vector<glm::dmat4> world;
  };
  // Takes hold of what a node belongs to: of it and those above it the outermost one that no clip moves, that
  // is not all that is drawn, and that does not carry `support`, the node that whoever grasps stands on (-1:
  // none); below the last one that a clip moves, where there is one. Fails with usage where there is none.
  static Result<Grasp> take(SceneEditor& editor, NodeId hit, int support, const Moment& moment);

  // Has hold of more, or of less: of the node above what is held, or of the next one below towards what was
  // touched. What is let go is where it was. False where there is none.
  bool widen(SceneEditor& editor, bool isMore, const Moment& moment);
  NodeId node() const { return path_[level_]; }
  // Where the hand takes it: as it was taken hold of, so it stays in the hand.
  Status follow(SceneEditor& editor, const Moment& moment) const;
  // Whether what is held is also held by another one, or is a part of that, or has it as a part.
  bool concerns(const SceneEditor& editor, const Grasp& other) const;
  // Where it is now: its name, its origin in the world, metres, and degrees about x, then y, then z. Empty:
  // where it was.
  std::string told(const SceneEditor& editor, const std::vector<glm::dmat4>& world) const;

 private:
  std::vector<NodeId> path_;  // from the outermost one that may be held towards what was touched
  size_t level_ = 0;
  glm::dmat4 inHand_{1.0};  // from the held node to the hand
  glm::dmat4 before_{1.0};  // from the held node to its parent, before it was held
};

}  // namespace scumble::xr
