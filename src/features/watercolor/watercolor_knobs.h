// Knobs of watercolours.
#pragma once

#include "look/look_data.h"

namespace scumble::watercolor {

#define PARAMS_STRUCT WatercolorParams
#define PARAMS_FILE "features/watercolor/watercolor.params"
#define PARAMS_PATH "watercolor"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

#define PARAMS_STRUCT StampParams
#define PARAMS_FILE "features/watercolor/stamps.params"
#define PARAMS_PATH "watercolor.stamps"
#define PARAMS_TARGETS kScene | kMaterials | kNodes
#include "look/define_params.h"

// Whether any stamp of a look, at its time, may have a colour of its own.
bool mayColorStamps(const look::LookData& look);

// Whether a look, at its time, is a watercolour.
inline bool mayShow(const look::LookData& look) {
  return look.get<WatercolorParams>().shown;
}

}  // namespace scumble::watercolor
