// What a look makes of a scene's clips: which of them play, and how long poses stand.
#pragma once

#include "look/look_data.h"
#include "scene/animation.h"
#include "stage/animation_params.h"

namespace scumble::stage {

// The time whose pose is shown: that of the last frame of the 24 fps grid on which a drawing that stands for
// `frames` frames began (paper 000, section 6.3). 0 frames: `time` itself.
double heldTime(double time, int frames);

// The clips that play under a look at a time (LookData::at). Where the look names no clip, the first of each
// file does.
std::vector<scene::PlayedClip> playedClips(const scene::SceneData& scene, const look::LookData& look);

// Those that play at any time under a look with its tracks.
std::vector<int> everPlayed(const scene::SceneData& scene, const look::LookData& look);

// How long each node's own transform is held, in frames; -1 where the look does not say it of the node: by
// its name, by that of the nearest node above it that is named, or by a material of its mesh.
std::vector<int> namedHolds(const scene::SceneData& scene, const look::LookData& look);

}  // namespace scumble::stage
