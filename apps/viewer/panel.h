// The panel at the side: which look, what was picked, and the knobs of it.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "inspector.h"
#include "pictures.h"

namespace scumble::viewer {

class Panel {
 public:
  struct Facts {
    std::string title, lines;
    double time = 0;  // seconds
  };
  // True where a knob was turned. `other`: the name of a look that is compared with, as Opened has it; null
  // where none is.
  bool layOut(const glm::vec2& window, const Facts& facts, Document& document, std::string* other);
  // Knobs are those of its material from now on, if it has one.
  void select(const Picked& picked);
  const Picked& picked() const { return picked_; }

 private:
  void layOutTargets();

  Inspector inspector_;
  Picked picked_;
  Target target_;
};

// Room that the panel takes at the right, in pixels, with its margins.
float panelWidth(const glm::vec2& window);

}  // namespace scumble::viewer
