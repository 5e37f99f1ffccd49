// Knobs of how the ocean is painted.
#pragma once

#include "frame/metatexture.h"
#include "look/look_data.h"

namespace scumble::ocean {

#define PARAMS_STRUCT OceanPaintParams
#define PARAMS_FILE "features/ocean/paint/ocean_paint.params"
#define PARAMS_PATH "ocean.paint"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

#define METATEXTURE_SIZE 850.0  // broad strokes
#define METATEXTURE_SKEW 0      // that lie along the horizon in all of the picture
#define METATEXTURE_EXAMPLE 3   // sea
#define PARAMS_STRUCT OceanMetaTextureParams
#define PARAMS_FILE "shading/metatexture.params"
#define PARAMS_PATH "ocean.metatexture"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"
#undef METATEXTURE_EXAMPLE
#undef METATEXTURE_SKEW
#undef METATEXTURE_SIZE

}  // namespace scumble::ocean
