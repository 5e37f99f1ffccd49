// The panel at the side: which look, what was picked, and the knobs of it.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "handles.h"
#include "inspector.h"
#include "pictures.h"

namespace scumble::viewer {

class Panel {
 public:
  struct Facts {
    std::string title, lines;
    double time = 0;  // seconds
    float below = 0;  // pixels of the window that something takes below it
  };
  // What a hand has done in it.
  struct Change : Inspector::Change {
    std::optional<Addable> added;
  };
  // `other`: the name of a look that is compared with, as Opened has it; null where none is.
  Change layOut(const glm::vec2& window, const Facts& facts, Document& document, std::string* other);
  // Knobs are those of its material from now on, if it has one.
  void select(const Picked& picked);
  const Picked& picked() const { return picked_; }
  // Whose knobs are there.
  void choose(const Target& target) { target_ = target; }
  const Target& target() const { return target_; }
  // The setting whose row is under the mouse; empty: none.
  const std::string& hovered() const { return inspector_.hovered(); }

 private:
  void layOutTargets(const Look& look);
  void layOutAdd(Change& change);

  Inspector inspector_;
  Picked picked_;
  Target target_;
};

// Room that the panel takes at the right, in pixels, with its margins.
float panelWidth(const glm::vec2& window);

}  // namespace scumble::viewer
