// The panel of knobs: every one that acts on the whole scene, with its range, unit and meaning.
#pragma once

#include <string>
#include <vector>

#include "document.h"

namespace scumble::viewer {

class Inspector {
 public:
  Inspector();
  // Within an ImGui window. True where a knob was turned. `time`: seconds, at which tracks are read.
  bool layOut(Document& document, double time);

 private:
  struct Group {
    std::string name;  // what paths begin with
    std::vector<Knob> knobs;
  };
  bool layOutKnob(const Knob& knob, Document& document, double time) const;

  std::vector<Group> groups_;
  char search_[64] = "";
  bool onlyTurned_ = false;
};

}  // namespace scumble::viewer
