// Knobs of watercolours.
#pragma once

#include <algorithm>

#include "look/look_data.h"

namespace scumble::watercolor {

#define PARAMS_STRUCT WatercolorParams
#define PARAMS_FILE "features/watercolor/watercolor.params"
#define PARAMS_PATH "watercolor"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

// Whether a look is a watercolour at any time.
inline bool mayShow(const look::LookData& look) {
  if (look.get<WatercolorParams>().shown) return true;
  return std::any_of(look.assignments.begin(), look.assignments.end(), [](const look::Assignment& a) {
    return a.block == &WatercolorParams::block() && std::string_view(a.row->name) == "shown" && a.track;
  });
}

}  // namespace scumble::watercolor
