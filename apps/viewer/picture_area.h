// What fills the window behind the interface: the picture, one of its passes, both eyes, or another look
// beside it at a line that is dragged.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "interface.h"
#include "pictures.h"

namespace scumble::viewer {

class PictureArea {
 public:
  // Both eyes are seen of the picture alone: a pass is seen by one.
  void setEyes(Eyes eyes) { eyes_ = eyes; }
  void nextEyes() { eyes_ = Eyes((int(eyes_) + 1) % 4); }
  Eyes eyes() const { return eyes_; }
  void choosePass(const std::string& aov) { pass_ = aov; }
  std::string& pass() { return pass_; }  // empty: the picture
  bool isSeenByBoth() const { return eyes_ != Eyes::one && pass_.empty(); }

  void toggleSplit() { isSplit_ = !isSplit_; }
  bool isSplit() const { return isSplit_ && !isSeenByBoth(); }
  std::string& otherLook() { return otherLook_; }  // right of the line; empty: as the look is saved

  // Pixels that one view has in a window of such a size.
  glm::uvec2 viewSize(const glm::uvec2& window) const;
  // Where a place of the window (0 to 1) is in a view, and in which (1: the right eye's).
  struct Place {
    glm::vec2 place;
    size_t view;
  };
  Place placeIn(glm::vec2 place) const;

  // True where the line was dragged.
  bool layOut(const glm::vec2& window, const Pictures& pictures);
  // Numbers and names of what is under the mouse (pixels), as the pass pictures have it; empty: nothing is.
  std::string pixelFacts(const glm::vec2& mouse, const Pictures& pictures) const;

  // What was laid out, as long as frames that show it are under way.
  std::vector<std::shared_ptr<const Picture>> takeShown() { return std::exchange(shown_, {}); }
  const Picture* keep(std::shared_ptr<const Picture> picture);

 private:
  Eyes eyes_ = Eyes::one;
  std::string pass_, otherLook_;
  bool isSplit_ = false;
  float line_ = 0.5f;  // across the window
  std::vector<std::shared_ptr<const Picture>> shown_;
};

}  // namespace scumble::viewer
