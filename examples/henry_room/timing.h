// The one clip of the scene and its clock.
#pragma once

#include "mesh_kit/document.h"

namespace henry {

constexpr float kFrameRate = 24.0f;  // frames a second
constexpr float kLoop = 8.0f;        // seconds; every period in the scene divides it

// The start of the scene's clip, to which each part adds its channels.
inline meshkit::Clip& party(meshkit::Document& document) {
  if (document.clips.empty()) document.clips.push_back({"Party", {}});
  return document.clips.front();
}

// What is drawn by hand has its poses on every second frame.
inline std::vector<float> onTwos() {
  return meshkit::evenTimes(kLoop, int(kLoop * kFrameRate / 2.0f));
}

// What swings slowly needs four keys a second.
inline std::vector<float> slowKeys() {
  return meshkit::evenTimes(kLoop, int(kLoop) * 4);
}

// The phase at `time` of something that repeats each `period` seconds, radians.
inline float phase(float time, float period) {
  return 6.2831853f * time / period;
}

}  // namespace henry
