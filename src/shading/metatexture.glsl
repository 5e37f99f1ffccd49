// MetaTexture (paper 000, section 3): an example texture that keeps its size and proportions on the screen while it
// sticks to a surface. Copies at the nearest power-of-two scales are blended.
#ifndef SCUMBLE_METATEXTURE_GLSL
#define SCUMBLE_METATEXTURE_GLSL

struct MetaTextureParams {
#define PARAM(type, name, defaultValue, low, high, unit, meaning) type name;
#include "metatexture.params"
#undef PARAM
};

// Screen-space gradients of u and v (per pixel; x right, y down) from the projections of dP/du and dP/dv (pixels per
// unit of u and v). Paper eq. 9 and 10 assume that these are perpendicular on the screen; the inverse of the 2 x 2
// Jacobian needs no such assumption and is exact on a plane.
void uvGradients(vec2 dSdu, vec2 dSdv, out vec2 gradU, out vec2 gradV) {
  float det = dSdu.x * dSdv.y - dSdu.y * dSdv.x;
  // Edge-on surfaces: keep the magnitude finite, at an angle of about 1 / 100.
  float least = 0.01 * length(dSdu) * length(dSdv) + 1e-20;
  float safe = abs(det) < least ? (det < 0.0 ? -least : least) : det;
  gradU = vec2(dSdv.y, -dSdv.x) / safe;
  gradV = vec2(-dSdu.y, dSdu.x) / safe;
}

// Projects a world-space tangent vector, given in clip space, to pixels at the point with the given clip w and ndc.
vec2 projectTangent(vec3 tangentClip, vec2 ndc, float w, vec2 imageSize) {
  return (tangentClip.xy - ndc * tangentClip.z) / w * 0.5 * imageSize;
}

// The upper halves of two floats in one word.
uint packBfloat(vec2 v) {
  uvec2 bits = floatBitsToUint(v) + 0x8000u;
  return bits.x >> 16 | (bits.y & 0xFFFF0000u);
}
vec2 unpackBfloat(uint word) { return uintBitsToFloat(uvec2(word << 16, word & 0xFFFF0000u)); }

struct MetaTextureScale {
  vec2 exponent;  // eq. 2
  vec2 blend;     // eq. 7
};

// `size`: edge of the example texture on the screen, pixels. Where the surface is seen edge-on and u and v run askew,
// both gradients point across the silhouette, and a scale chosen by them would stretch the texture along it. Their
// magnitudes are therefore bounded by twice what they would be without skew, 1 / |dS/du| and 1 / |dS/dv|.
MetaTextureScale metaTextureScale(vec2 gradU, vec2 gradV, vec2 dSdu, vec2 dSdv, float size) {
  MetaTextureScale s;
  vec2 magnitude = vec2(length(gradU), length(gradV));
  vec2 bound = 2.0 / max(vec2(length(dSdu), length(dSdv)), vec2(1e-20));
  magnitude = max(min(magnitude, bound), vec2(1e-20));
  s.exponent = clamp(-log2(size * magnitude), vec2(-60.0), vec2(60.0));
  vec2 t = s.exponent - floor(s.exponent);
  s.blend = t * t * (3.0 - 2.0 * t);
  return s;
}

// Variance of the blend relative to the texture's (eq. 24 and 25; FORMULAS 2: contrast is restored by its root).
float metaTextureVariance(MetaTextureScale s) {
  vec2 k = 2.0 * s.blend * s.blend - 2.0 * s.blend + 1.0;
  return k.x * k.y;
}

// Eq. 3 to 8, with Bu going with the copy that doubles u (FORMULAS 1). `mean`: the texture's mean; `contrast`: 1
// restores what blending takes away; `shift` moves every copy by as much of the texture.
vec4 metaTexture(sampler2D image, vec2 uv, MetaTextureScale s, vec4 mean, float contrast, vec2 shift) {
  vec2 u0 = exp2(floor(s.exponent)) * uv;
  vec2 u3 = 2.0 * u0;
  u0 += shift;
  u3 += shift;
  vec4 low = mix(textureLod(image, u0, 0.0), textureLod(image, vec2(u3.x, u0.y), 0.0), s.blend.x);
  vec4 high = mix(textureLod(image, vec2(u0.x, u3.y), 0.0), textureLod(image, u3, 0.0), s.blend.x);
  vec4 blended = mix(low, high, s.blend.y);
  float gain = mix(1.0, inversesqrt(metaTextureVariance(s)), contrast);
  return mean + (blended - mean) * gain;
}
#endif
