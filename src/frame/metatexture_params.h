// Knobs of the MetaTexture that the warp pass uses; the facts pass shows what it chose.
#pragma once

#include "look/param.h"

namespace scumble::frame {

#define PARAMS_STRUCT WarpMetaTextureParams
#define PARAMS_FILE "shading/metatexture.params"
#define PARAMS_PATH "warp.metatexture"
#define PARAMS_PER_MATERIAL true
#include "look/define_params.h"

}  // namespace scumble::frame
