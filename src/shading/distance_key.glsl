// How far a place is from between the eyes of a rig, as an integer that grows with it; what is not finite is the
// nearest.
#ifndef SCUMBLE_DISTANCE_KEY_GLSL
#define SCUMBLE_DISTANCE_KEY_GLSL
#include "frame.glsl"

uint distanceKey(vec3 place) {
  vec3 from = place - frame.viewer;
  // Parallel projections count along the axis, which may be before the viewer as well.
  float along = -(frame.views[0].worldToEye * vec4(place, 1.0)).z;
  float distance = mix(dot(from, from), along, frame.views[0].orthographic);
  uint bits = floatBitsToUint(distance);
  if ((bits & 0x7F800000u) == 0x7F800000u) return 1u;
  return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}
#endif
