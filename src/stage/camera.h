// The camera that a look may bring.
#pragma once

#include "look/look_data.h"

namespace scumble::stage {

#define PARAMS_STRUCT CameraParams
#define PARAMS_FILE "stage/camera.params"
#define PARAMS_PATH "camera"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

}  // namespace scumble::stage
