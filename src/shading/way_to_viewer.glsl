#ifndef SCUMBLE_WAY_TO_VIEWER_GLSL
#define SCUMBLE_WAY_TO_VIEWER_GLSL
#include "frame.glsl"

// The way to the middle of all eyes, so that both see the same; in parallel projections everywhere alike.
vec3 wayToViewer(vec3 position) {
  mat4 toEyeSpace = frame.views[0].worldToEye;
  return mix(frame.viewer - position, vec3(toEyeSpace[0][2], toEyeSpace[1][2], toEyeSpace[2][2]),
             frame.views[0].orthographic);
}
#endif
