#version 460
// The look's colorizers, one after the other (paper 002): colour and depth are read once, the result is written once.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "../../shading/frame.glsl"
#include "colorize.shared.h"
#include "fog.shared.h"

layout(constant_id = 0) const int kCount = 0;
layout(constant_id = 1) const int kFeatures = 0;
layout(set = 1, binding = 0, scalar) uniform Block { ColorizeUniforms u; };
layout(set = 1, binding = 1) uniform sampler2DArray color;
layout(set = 1, binding = 2) uniform sampler2DArray depth;

#define SHADES_AREAS

bool has(int feature) { return (kFeatures & feature) != 0; }

// The pixel's ray in the world, and how far it goes.
struct Sight {
  vec3 origin;  // from the eye; of parallel projections
  vec3 ray;
  float way;  // metres
};

Sight sightOf(ivec2 pixel, int layer) {
  vec2 ndc = (vec2(pixel) + 0.5) / frame.imageSize * 2.0 - 1.0;
  vec4 toRay = VIEW_FIELD(ndcToEyeRay, layer);
  vec2 across = ndc * toRay.xy + toRay.zw;
  mat3 toEye = mat3(VIEW_FIELD(worldToEye, layer));
  float distance = min(eyeDepth(texelFetch(depth, ivec3(pixel, layer), 0).r, layer), 1e15);
  float parallel = has(kHasParallel) ? VIEW_FIELD(orthographic, layer) : 0.0;
  vec3 eyeRay = vec3(across * (1.0 - parallel), -1.0);
  float stretch = inversesqrt(dot(eyeRay, eyeRay));
  Sight sight;
  sight.origin = vec3(across * parallel, 0.0) * toEye;
  sight.ray = (eyeRay * stretch) * toEye;
  sight.way = distance / stretch;
  return sight;
}

// What the volume has along the ray or at its end, from 0 to 1.
float strength(Colorizer c, Sight sight, int layer) {
  vec3 eye = kViewCount == 1 || layer == 0 ? c.eyes[0] : c.eyes[1];
  bool isFog = !has(kHasSurface) || (has(kHasFog) && c.atmospheric != 0);
  float result = 0.0;
  if (has(1 << kShapeSphere) || has(1 << kShapeScene)) {
    if (has(kHasParallel)) eye += c.perMetre * sight.origin;
    float way = c.perMetre * sight.way;
    if (has(1 << kShapeSphere)) {
      float fog = has(kHasFog) ? sphereFog(eye, sight.ray, max(way, 0.0)) : 0.0;
      float density = has(kHasSurface) ? sphereDensity(eye + way * sight.ray) : 0.0;
      result = c.shape == kShapeSphere ? (isFog ? fog : density) : result;
    }
    if (has(1 << kShapeScene)) result = c.shape == kShapeScene ? (isFog ? saturated(max(way, 0.0)) : 1.0) : result;
  }
  const int kOthers = 1 << kShapeEllipsoid | 1 << kShapeBox | 1 << kShapeCapsule | 1 << kShapeHalfSpace;
  if (has(kOthers)) {
    vec3 own = kViewCount == 1 || layer == 0 ? c.eyes[0] : c.eyes[1];
    if (has(kHasParallel)) own += c.toUnit * sight.origin;
    vec3 ray = c.toUnit * sight.ray;
    float shrink = inversesqrt(dot(ray, ray)), end = sight.way / shrink, way = max(end, 0.0);
    ray *= shrink;
    vec3 at = own + end * ray;
    if (has(1 << kShapeEllipsoid)) {
      float fog = has(kHasFog) ? sphereFog(own, ray, way) : 0.0;
      result = c.shape == kShapeEllipsoid ? (isFog ? fog : sphereDensity(at)) : result;
    }
    if (has(1 << kShapeBox)) {
      float fog = has(kHasFog) ? boxFog(own, ray, way) : 0.0;
      result = c.shape == kShapeBox ? (isFog ? fog : boxDensity(at)) : result;
    }
    if (has(1 << kShapeCapsule)) {
      float fog = has(kHasFog) ? capsuleFog(own, ray, way, c.axis) : 0.0;
      result = c.shape == kShapeCapsule ? (isFog ? fog : capsuleDensity(at, c.axis)) : result;
    }
    if (has(1 << kShapeHalfSpace)) {
      float fog = has(kHasFog) ? halfSpaceFog(own, ray, way) : 0.0;
      result = c.shape == kShapeHalfSpace ? (isFog ? fog : halfSpaceDensity(at)) : result;
    }
  }
  return clamp(result, 0.0, 1.0);
}

// FORMULAS 17. An amount of 0 leaves the bits as they are, since everything is finite: nothing is brighter than what
// half floats hold.
vec3 colorized(vec3 from, Colorizer c, Sight sight, int layer) {
  float x = strength(c, sight, layer);
  if (has(kHasFalloff)) x = x / (x + c.falloff * (1.0 - x));
  float amount = min(c.density * x, 1.0);
  float gray = dot(from, vec3(0.2126, 0.7152, 0.0722));
  vec3 graded = max(c.bias + c.color * from + c.gray * gray, 0.0);
  if (has(kHasGamma)) graded = pow(graded, c.gamma);
  return from + amount * (min(graded, 65504.0) - from);
}

// Four of the list. CPU drivers load uniforms pixel by pixel where they do not know the index, so it has to be a
// constant; and their compilers take time by the square of what stands between two jumps, so there is one.
vec3 chunk(vec3 from, int first, Sight sight, int layer) {
  int runs = 0;
  do {
    [[unroll]] for (int i = 0; i < 4; ++i)
      if (first + i < kCount) from = colorized(from, u.list[first + i], sight, layer);
  } while (++runs < u.once);
  return from;
}
#define CHUNK(first) \
  if (kCount > first) after = chunk(after, first, sight, layer);

vec4 shade(ivec2 pixel, int layer) {
  vec4 before = texelFetch(color, ivec3(pixel, layer), 0);
  if (kCount == 0) return before;
  Sight sight = sightOf(pixel, layer);
  // Colours are premultiplied by their coverage; where all is covered, this changes nothing.
  vec3 straight = before.rgb / max(before.a, 1e-6);
  vec3 after = straight;
  CHUNK(0) CHUNK(4) CHUNK(8) CHUNK(12) CHUNK(16) CHUNK(20) CHUNK(24) CHUNK(28)
  CHUNK(32) CHUNK(36) CHUNK(40) CHUNK(44) CHUNK(48) CHUNK(52) CHUNK(56) CHUNK(60)
  bvec3 same = equal(after, straight);
  return vec4(mix(after * before.a, before.rgb, same), before.a);
}

#include "../../shading/image_pass.glsl"
