// Knobs of colorizers.
#pragma once

#include "look/look_data.h"

namespace scumble::passes {

#define PARAMS_STRUCT VolumeParams
#define PARAMS_FILE "passes/colorize/volume.params"
#define PARAMS_PATH "volume"
#define PARAMS_TARGETS kColorizers
#include "look/define_params.h"

#define PARAMS_STRUCT GradeParams
#define PARAMS_FILE "passes/colorize/grade.params"
#define PARAMS_PATH "grade"
#define PARAMS_TARGETS kColorizers
#include "look/define_params.h"

// The choices of volume.shape.
enum VolumeShape : int {
  kVolumeSphere,
  kVolumeEllipsoid,
  kVolumeBox,
  kVolumeCapsule,
  kVolumeHalfSpace,
  kVolumeScene
};

}  // namespace scumble::passes
