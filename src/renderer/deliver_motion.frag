#version 460
#extension GL_GOOGLE_include_directive : require
// One layer of a frame's motion into a rectangle of somebody else's: in normalised device coordinates, and everywhere.
#include "../shading/frame.glsl"
layout(constant_id = 0) const bool kIsUpwards = false;
layout(set = 1, binding = 0) uniform sampler2DArray source;
layout(push_constant) uniform Where { uint layer; int x, y; };
layout(location = 0) out vec4 outputMotion;

const float kMost = 64.0;  // what was behind the viewer has come from anywhere

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy) - ivec2(x, y);
  vec4 moved = texelFetch(source, ivec3(pixel, layer), 0);
  vec2 ndc = (vec2(pixel) + 0.5) / frame.imageSize * 2.0 - 1.0;
  vec4 toRay = frame.views[layer].ndcToEyeRay;
  vec3 ray = vec3(ndc * toRay.xy + toRay.zw, -1.0) * mat3(frame.views[layer].worldToEye);
  vec4 before = frame.views[layer].previousWorldToClip * vec4(ray, 0.0);
  vec3 far = before.w > 0.0 ? vec3(ndc - before.xy / before.w, 0.0) : vec3(0.0);
  vec3 motion = moved.a > 0.0 ? vec3(moved.xy * 2.0 / frame.imageSize, moved.z) : far;
  if (kIsUpwards) motion.y = -motion.y;
  outputMotion = vec4(clamp(motion, -kMost, kMost), 1.0);
}
