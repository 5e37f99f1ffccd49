// Knobs of movement: how long poses stand, and which of a scene's clips play.
#pragma once

#include "look/look_data.h"

namespace scumble::stage {

#define PARAMS_STRUCT AnimationParams
#define PARAMS_FILE "stage/animation.params"
#define PARAMS_PATH "animation"
#define PARAMS_TARGETS kScene | kMaterials | kNodes
#include "look/define_params.h"

#define PARAMS_STRUCT PlayParams
#define PARAMS_FILE "stage/play.params"
#define PARAMS_PATH "play"
#define PARAMS_TARGETS kClips
#include "look/define_params.h"

}  // namespace scumble::stage
