// Volumetric colorizers (paper 002, Henry): regions of space that grade the colours of what lies in them, or
// of what is seen through them.
#pragma once

#include "frame/pass.h"

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

std::unique_ptr<frame::Pass> makeColorize(frame::Layer layer);

}  // namespace scumble::passes
