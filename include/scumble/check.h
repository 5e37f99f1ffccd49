// Whether a look and a scene go together.
#pragma once

#include <string>
#include <vector>

#include "scumble/export.h"
#include "scumble/look.h"
#include "scumble/scene.h"

namespace scumble {

// Something that a look says to no effect in a scene: a slip, most of the time.
struct Finding {
  enum class Kind {
    noSuchName,  // nothing in the scene is called so, e.g. "materials.Sial"
    noSuchNode,  // it hangs on a node that there is not, e.g. "colorizers.Glow.volume.node"; it is left out
    notThere     // it is about something that the scene does not have, e.g. a group of knobs of the sea
  };
  Kind kind = Kind::noSuchName;
  std::string setting;
  bool bySet = false;  // by Look::set, not by the look's file
  // Why, and what to do: "nothing in the scene has such a name".
  std::string problem;
};

// All of them, in the order of the kinds, each setting once; nothing for an empty scene. Of names that the
// look's file sets something for, only where the look is meant for this one scene (`isForScene`), and without
// patterns ('*' and '?'), for it may know other scenes. What Look::set has set is always meant. Any thread.
SCUMBLE_API std::vector<Finding> check(const Scene& scene, const Look& look, bool isForScene = false);

}  // namespace scumble
