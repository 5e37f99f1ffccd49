// What a hand has hold of, and takes with it.
#pragma once

#include <string>

#include "scumble/scene_editor.h"
#include "xr/place.h"

namespace scumble::xr {

class Grasp {
 public:
  // Takes hold of what a node belongs to: of the nodes above it the outermost one that is not all that is
  // drawn. `hand`: in the scene. `support`: a node that carries whoever grasps, or -1. Fails with usage where
  // a clip moves it, or where it carries them.
  static Result<Grasp> take(SceneEditor& editor, NodeId hit, int support, const Pose& hand);

  NodeId node() const { return node_; }
  // Where the hand takes it: as it was taken hold of, so it stays in the hand.
  Status follow(SceneEditor& editor, const Pose& hand) const;
  // How the hand has moved it: its origin, metres, and degrees about x, then y, then z, in the world.
  std::string told(const SceneEditor& editor) const;

 private:
  NodeId node_ = NodeId::none;
  glm::mat4 inHand_{1.0f};        // node to hand
  glm::mat4 aboveToWorld_{1.0f};  // of its parent
};

}  // namespace scumble::xr
