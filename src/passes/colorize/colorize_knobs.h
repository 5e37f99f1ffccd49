// Knobs of colorizers.
#pragma once

#include "look/look_data.h"
#include "scene/scene_data.h"

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

// Whether anything changes the colours of overlays by their distance: colorizers, or air that begins within
// two radii of the scene behind its middle. Farther off nothing of it is drawn.
bool changesOverlays(const look::LookData& look, const scene::SceneData& scene);

// Whether a colorizer that the look declares may change any colour: not where it grades nothing, or in the
// space of a node that is not there.
bool mayGrade(const look::LookData& look, const std::string& colorizer, const scene::SceneData& scene);

}  // namespace scumble::passes
