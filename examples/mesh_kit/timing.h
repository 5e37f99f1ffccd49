// The clock that the scenes share: loops of one length, and when things that move have their keys.
#pragma once

#include "mesh_kit/clip.h"

namespace meshkit {

constexpr float kFrameRate = 24.0f;  // frames a second
constexpr float kLoop = 8.0f;        // seconds; every period in a scene divides it

// What is drawn by hand has its poses on every second frame; the motions between are told there.
inline std::vector<float> onTwos() {
  return evenTimes(kLoop, int(kLoop * kFrameRate / 2.0f));
}

// What swings slowly needs four keys a second.
inline std::vector<float> slowKeys() {
  return evenTimes(kLoop, int(kLoop) * 4);
}

// The phase at `time` of something that repeats each `period` seconds, radians.
inline float phase(float time, float period) {
  return 6.2831853f * time / period;
}

}  // namespace meshkit
