#version 460
// Warp vectors and breakup marks, attached to the surface by MetaTexture (paper 000, section 4), for the pixels of one
// setup: materials that share a texture and its knobs.
// Out: R, G: vector in pixels (x right, y down); B: breakup marks in [0, 1]; A: eye depth of the inflated surface, 0 where
// there is none. Vectors and marks are 0 where they are not asked for.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/displacement.shared.h"
#include "../../shading/frame.glsl"
#include "../../shading/metatexture.glsl"
#include "warp.shared.h"

layout(constant_id = 0) const int kNeeds = 0;
layout(constant_id = 1) const int kFieldFeatures = 0;  // MetaTexture.features
layout(constant_id = 2) const int kMarksFeatures = 0;

layout(set = 1, binding = 0, scalar) uniform Block {
  MetaTexture field, marks;
  uint setup;  // from 1; setup 1 also has the pixels where nothing is
  float marksAmount;
  // Of the examples themselves; where a Gaussian twin is blended, MetaTexture.mean is the twin's.
  vec2 fieldMean;
  float marksMean;
} u;
layout(set = 1, binding = kWarpPattern) uniform usampler2DArray pattern;
layout(set = 1, binding = kWarpKnobs) uniform usampler2DArray knobs;
layout(set = 1, binding = kWarpDepth) uniform sampler2DArray depth;
layout(set = 1, binding = kWarpFieldExample) uniform sampler2D fieldExample;
layout(set = 1, binding = kWarpFieldInverse) uniform sampler2D fieldInverse;
layout(set = 1, binding = kWarpMarksExample) uniform sampler2D marksExample;
layout(set = 1, binding = kWarpMarksInverse) uniform sampler2D marksInverse;

vec4 valueOf(MetaTexture m, int features, sampler2D example, sampler2D inverse, vec2 uv, vec2 dSdu, vec2 dSdv, vec2 wraps, vec2 at,
             out MetaTextureChoice chosen) {
  m.features = features;
  chosen = metaTextureChoose(m, dSdu, dSdv, 1.0);
  vec4 value = metaTextureSample(m, chosen, example, uv, wraps, at);
  if (metaTextureContrast(m) == 2) value = metaTextureHistogram(inverse, value);
  return value;
}

vec4 shade(ivec2 pixel, int layer) {
  if (kNeeds == 0) return vec4(0.0);
  ivec3 at = ivec3(pixel, layer);
  uint knob = texelFetch(knobs, at, 0).r;
  // Anything is there where nothing is drawn.
  uvec4 packed = knob != 0u ? texelFetch(pattern, at, 0) : uvec4(0u);
  vec2 uv = uintBitsToFloat(packed.xy), dSdu = unpackBfloat(packed.z), dSdv = unpackBfloat(packed.w);
  vec2 wraps = vec2(uvec2(knob >> 16, knob >> 17) & 1u);
  MetaTextureChoice chosen, chosenForMarks;
  vec4 value = vec4(0.0);
  vec2 vector = vec2(0.0);
  float marks = 0.0;
  if ((kNeeds & kWarpVectors) != 0 || (kNeeds & kWarpApart) == 0)
    value = valueOf(u.field, kFieldFeatures, fieldExample, fieldInverse, uv, dSdu, dSdv, wraps, vec2(pixel) + 0.5, chosen);
  if ((kNeeds & kWarpMarks) != 0) {
    marks = value.b;
    if ((kNeeds & kWarpApart) != 0)
      marks = valueOf(u.marks, kMarksFeatures, marksExample, marksInverse, uv, dSdu, dSdv, wraps, vec2(pixel) + 0.5,
                      chosenForMarks).b;
    marks = clamp((marks - u.marksMean) * u.marksAmount + u.marksMean, 0.0, 1.0);
  }
  if ((kNeeds & kWarpVectors) != 0) {
    vector = (value.xy - u.fieldMean) * 2.0;
    vector *= min(kFarthestTear * inversesqrt(max(dot(vector, vector), 1e-12)), 1.0);
    // What is finer than the texture should be is shallower by as much, so that no tear is steeper than others.
    if ((kFieldFeatures & 3) == 0) {
      float finer = metaTextureFineness(u.field, chosen);
      vector *= finer > 1.5 ? 1.5 / finer : 1.0;
    }
    // Camera roll (section 4.3): the frame of reference follows the gradient of u, so the pattern sticks to the surface.
    // Its direction is across dS/dv, on the side that does not change where a mapping is mirrored along u.
    float lengthV = length(dSdv);
    vec2 axis = lengthV > 0.0 && (kFieldFeatures & 3) != 2 ? vec2(dSdv.y, -dSdv.x) / lengthV : vec2(1.0, 0.0);
    vector = vec2(axis.x * vector.x - axis.y * vector.y, axis.y * vector.x + axis.x * vector.y) * unpackHalf2x16(knob).x;
  }
  float far = min(eyeDepth(texelFetch(depth, at, 0).r, layer), 60000.0);
  return knob != 0u ? vec4(vector, marks, far) : vec4(0.0);
}

#define SHADES_SOME
bool shades(ivec2 pixel, int layer) {
  if ((kNeeds & kWarpSeveral) == 0) return true;
  uint setup = texelFetch(knobs, ivec3(pixel, layer), 0).r >> 18;
  return setup == u.setup || (setup == 0u && u.setup == 1u);
}

#define SHADES_TILES
#include "../../shading/image_pass.glsl"
