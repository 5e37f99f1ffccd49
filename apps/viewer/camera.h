// Whose camera the window shows: that which it was opened with, another one that was asked for, or one that
// hands have taken up.
#pragma once

#include <optional>

#include "navigation.h"
#include "scumble/scene.h"

namespace scumble::viewer {

class Camera {
 public:
  explicit Camera(const Viewpoint& first) : first_(first) {}

  Viewpoint viewpoint() const { return isHeld_ ? navigation_.viewpoint() : base_.value_or(first_); }
  // Whether it is another one than that which it was opened with.
  bool isOther() const { return isHeld_ || base_; }
  uint64_t moves() const { return moves_; }  // grows with each change

  const glm::dvec3& centre() const { return centre_; }  // of the scene, in the world
  // What hands go around.
  void setBounds(const SceneSummary& summary);
  // Hands have it from now on, from where it is seen at present (nothing: that is not known yet).
  Navigation& hold(const std::optional<View>& present);
  bool isHeld() const { return isHeld_; }
  // Hands let go of it: another one; nothing: the first.
  void set(const std::optional<Viewpoint>& viewpoint);

 private:
  const Viewpoint first_;
  std::optional<Viewpoint> base_;
  Navigation navigation_;
  bool isHeld_ = false;
  uint64_t moves_ = 0;
  glm::dvec3 centre_{0.0};
  float radius_ = 1;
};

}  // namespace scumble::viewer
