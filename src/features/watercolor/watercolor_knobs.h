// Knobs of watercolours.
#pragma once

#include "look/look_data.h"

namespace scumble::watercolor {

#define PARAMS_STRUCT WatercolorParams
#define PARAMS_FILE "features/watercolor/watercolor.params"
#define PARAMS_PATH "watercolor"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

// Whether a look, at its time, is a watercolour.
inline bool mayShow(const look::LookData& look) {
  return look.get<WatercolorParams>().shown;
}

}  // namespace scumble::watercolor
