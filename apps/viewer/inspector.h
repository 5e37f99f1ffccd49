// Knobs: all that a target has, with their ranges, units and meanings.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "document.h"

namespace scumble::viewer {

// Whose knobs: of the whole scene, or of one name of a look's section.
struct Target {
  std::string section, name;
  std::string path(const Knob& knob) const {
    return section.empty() ? knob.path : section + "." + name + "." + knob.path;
  }
  bool operator==(const Target&) const = default;
};

class Inspector {
 public:
  Inspector();
  // What a hand has done; `keyed`: the setting whose track has other keys.
  struct Change {
    bool isTurned = false;
    std::string keyed;
  };
  // Within an ImGui window. `time`: seconds, at which tracks are read, and get keys.
  Change layOut(Document& document, const Target& target, double time);
  // The setting whose row is under the mouse; empty: none.
  const std::string& hovered() const { return hovered_; }

 private:
  struct Group {
    std::string name;  // what paths begin with
    std::vector<const Knob*> knobs;
  };
  void layOutKnob(const Knob& knob, const Target& target, Document& document, double time, Change& change);
  std::optional<std::string> layOutWord(const std::string& present);
  std::optional<std::string> layOutValue(const Knob& knob, const KnobValue& value);

  std::vector<Group> groups_;
  char search_[64] = "";
  bool onlyTurned_ = false;
  std::string hovered_;
  // What is being typed, until it is left.
  unsigned typedInto_ = 0;
  char typed_[256] = "";
};

}  // namespace scumble::viewer
