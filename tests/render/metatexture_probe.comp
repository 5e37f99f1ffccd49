#version 460
// MetaTexture at any points, for tests: what it chooses and what it gives.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "../../src/shading/metatexture.glsl"

layout(constant_id = 0) const int kFeatures = -1;  // of MetaTexture; -1: as the uniforms say

struct Query {
  vec2 uv, dSdu, dSdv, wraps, pixel;
  float alpha;
};
struct Answer {
  vec4 value, histogram;
  vec2 exponent;
  float q, variance, skewBlend;
  vec2 psi[2];
};
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) uniform Block { MetaTexture meta; };
layout(set = 0, binding = 1, scalar) readonly buffer Queries { Query queries[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Answers { Answer answers[]; };
layout(set = 0, binding = 3) uniform sampler2D example;
layout(set = 0, binding = 4) uniform sampler2D inverse;

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= queries.length()) return;
  Query query = queries[i];
  MetaTexture m = meta;
  if (kFeatures >= 0) m.features = kFeatures;
  MetaTextureChoice chosen = metaTextureChoose(m, query.dSdu, query.dSdv, query.alpha);
  Answer answer;
  answer.value = metaTextureSample(m, chosen, example, query.uv, query.wraps, query.pixel);
  answer.histogram = metaTextureHistogram(inverse, answer.value);
  answer.exponent = metaTextureMeanExponent(chosen);
  answer.q = chosen.q;
  answer.variance = metaTextureVariance(m, chosen);
  answer.skewBlend = chosen.skewBlend;
  answer.psi = chosen.psi;
  answers[i] = answer;
}
