// A frame as a part of a sphere (RenderOptions::sphere).
#ifndef SCUMBLE_SPHERE_GLSL
#define SCUMBLE_SPHERE_GLSL
#include "frame.glsl"

// What is up on the sphere, seen along a unit direction of eye space: its parts to the frame's right and up, where those
// are square to that direction. 0 where the frame is no part of one.
vec2 upOnSphere(vec3 ahead) {
  vec3 up = vec3(0.0, 1.0, 0.0) * frame.eyeToSphere;
  return vec2(dot(up, normalize(vec3(1.0, 0.0, 0.0) - ahead * ahead.x)),
              dot(up, normalize(vec3(0.0, 1.0, 0.0) - ahead * ahead.y)));
}
#endif
