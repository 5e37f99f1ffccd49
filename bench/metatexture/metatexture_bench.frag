#version 460
// One full screen of texture: an ordinary trilinear sample, or MetaTexture, on a plane seen at an angle.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "../../src/shading/metatexture.glsl"

layout(constant_id = 0) const int kMethod = 0;  // 0 nothing, 1 trilinear, 2 MetaTexture
layout(constant_id = 1) const int kFeatures = 0;  // MetaTexture.features: without skew 4 samples, else 8

layout(set = 0, binding = 0, scalar) uniform Block {
  vec2 imageSize;
  float askew;  // how far u and v run askew
  MetaTexture meta;
} u;
layout(set = 0, binding = 1) uniform sampler2D example;
layout(location = 0) out vec4 outColor;

void main() {
  // A floor: v grows with distance towards the horizon above the picture.
  vec2 s = gl_FragCoord.xy / u.imageSize.y;
  float distance = 1.0 / (0.3 + s.y);
  vec2 uv = vec2((s.x - 0.9) * distance + u.askew * distance, distance);
  float perPixel = distance / u.imageSize.y;
  vec4 result = vec4(uv, 0.0, 1.0);
  if (kMethod == 1) result = texture(example, uv);
  if (kMethod == 2) {
    // dS/du, dS/dv: the inverse of the derivatives of uv.
    vec2 byX = vec2(perPixel, 0.0), byY = vec2(-(s.x - 0.9 + u.askew) * distance, -distance) * perPixel;
    vec2 dSdu, dSdv;
    metaTextureFromDerivatives(byX, byY, dSdu, dSdv);
    MetaTexture m = u.meta;
    m.features = kFeatures;
    MetaTextureChoice chosen = metaTextureChoose(m, dSdu, dSdv, 1.0);
    result = metaTextureSample(m, chosen, example, uv, vec2(0.0), gl_FragCoord.xy);
  }
  outColor = result;
}
