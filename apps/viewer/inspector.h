// The panel of knobs: every one that acts on the whole scene, with its range, unit and meaning.
#pragma once

#include <optional>
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
  bool layOutKnob(const Knob& knob, Document& document, double time);
  std::optional<std::string> layOutWord(const std::string& present);
  std::optional<std::string> layOutValue(const Knob& knob, const KnobValue& value);

  std::vector<Group> groups_;
  char search_[64] = "";
  bool onlyTurned_ = false;
  // What is being typed, until it is left.
  unsigned typedInto_ = 0;
  char typed_[256] = "";
};

}  // namespace scumble::viewer
