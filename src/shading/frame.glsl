// Descriptor set 0, the same for every pass, and small functions on it.
#ifndef SCUMBLE_FRAME_GLSL
#define SCUMBLE_FRAME_GLSL
#extension GL_EXT_scalar_block_layout : require
#include "frame.shared.h"
#include "geometry_constants.shared.h"

layout(set = 0, binding = 0, scalar) uniform FrameBlock { FrameUniforms frame; };
layout(set = 0, binding = 1, scalar) readonly buffer ObjectBlock { ObjectData objects[]; };
layout(set = 0, binding = 2, scalar) readonly buffer LightBlock { PunctualLight lights[]; };

layout(constant_id = kViewCountId) const int kViewCount = 2;

// A field of one view's uniforms. Choosing between two loads costs less than one at an index that the compiler does not
// know to be the same for all pixels: CPU drivers then load it pixel by pixel.
#define VIEW_FIELD(field, view) \
  (kViewCount == 1 || (view) == 0 ? frame.views[0].field : frame.views[1].field)

// Unit vectors in 2 x snorm16, by the octahedral map (Cigolle et al. 2014).
vec3 decodeNormal(vec2 oct) {
  vec3 n = vec3(oct, 1.0 - abs(oct.x) - abs(oct.y));
  float fold = max(-n.z, 0.0);
  n.x += n.x >= 0.0 ? -fold : fold;
  n.y += n.y >= 0.0 ? -fold : fold;
  return normalize(n);
}

uint encodeNormal(vec3 n) {
  n /= max(abs(n.x) + abs(n.y) + abs(n.z), 1e-20);
  vec2 oct = n.xy;
  if (n.z < 0.0) oct = (1.0 - abs(n.yx)) * vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
  return packSnorm2x16(oct);
}

// The upper halves of two floats in one word.
uint packBfloat(vec2 v) {
  uvec2 bits = floatBitsToUint(v) + 0x8000u;
  return bits.x >> 16 | (bits.y & 0xFFFF0000u);
}
vec2 unpackBfloat(uint word) { return uintBitsToFloat(uvec2(word << 16, word & 0xFFFF0000u)); }

// Metres along the view axis, from a depth buffer's value; very far (1e30) where nothing is.
const float kNothing = 1e30;
float eyeDepth(float depth, int view) {
  vec4 t = VIEW_FIELD(depthToEye, view);
  return depth <= 0.0 ? kNothing : (t.x + t.y * depth) / (t.z + t.w * depth);
}

// How much a pixel covers there, metres; in a parallel projection as much everywhere. (Mixed and not chosen by: no branch
// on a uniform.)
float metresOfPixel(float distance, int view) {
  return 2.0 * abs(VIEW_FIELD(ndcToEyeRay, view).y) / frame.imageSize.y *
         mix(distance, 1.0, VIEW_FIELD(orthographic, view));
}
#endif
