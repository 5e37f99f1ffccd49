#version 460
// The look's colorizers, one after the other (paper 002): colour and depth are read once, the result is written once.
// With OVERLAY: of an overlay of the picture (frame/roles.h), behind the air before it. With BLENDED: there are blended
// surfaces.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_quad : require
#include "../../shading/blended_parts.glsl"
#include "../../shading/frame.glsl"
#include "../../shading/luminance.shared.h"
#include "colorize.shared.h"
#include "fog.shared.h"

layout(constant_id = 0) const int kFeatures = 0;
layout(set = 1, binding = 0, scalar) uniform Block { ColorizeUniforms u; };
layout(set = 1, binding = kColorizeColor) uniform sampler2DArray color;
layout(set = 1, binding = kColorizeDepth) uniform sampler2DArray depth;
#ifdef BLENDED
layout(set = 1, binding = kColorizeBlended) uniform sampler2DArray blended;
layout(set = 1, binding = kColorizeBlendedDistance) uniform sampler2DArray blendedDistance;
#endif

bool has(int feature) { return (kFeatures & feature) != 0; }

// An `if` that CPU drivers jump over: of other ones they execute both sides for all pixels.
#define BRANCH(condition) for (bool is_ = (condition); is_; is_ = false)

// The pixel's ray in the world, and how far it goes.
struct Sight {
  vec3 origin;  // from the eye; of parallel projections
  vec3 ray;
  float way;  // metres
};

#define SIGHT_FIELD(field) (kViewCount == 1 || layer == 0 ? u.sights[0].field : u.sights[1].field)

// `distance`: metres along the view axis.
Sight sightOf(ivec2 pixel, float distance, int layer) {
  vec2 ndc = (vec2(pixel) + 0.5) / frame.imageSize * 2.0 - 1.0;
  vec3 ray = SIGHT_FIELD(ray[0]) + ndc.x * SIGHT_FIELD(ray[1]) + ndc.y * SIGHT_FIELD(ray[2]);
  float stretch = inversesqrt(dot(ray, ray));
  Sight sight;
  sight.origin = vec3(0.0);
  if (has(kHasParallel))
    sight.origin = SIGHT_FIELD(origin[0]) + ndc.x * SIGHT_FIELD(origin[1]) + ndc.y * SIGHT_FIELD(origin[2]);
  sight.ray = ray * stretch;
  sight.way = distance / stretch;
  return sight;
}

// The pixels of a quad all look at the same colorizer. Each reads one of four rows and tells the others, since CPU
// drivers load uniforms pixel by pixel, and that would take most of the time.
struct Rows {
  vec4 a, b, c, d;
};
Rows together(vec4 own) {
  return Rows(subgroupQuadBroadcast(own, 0u), subgroupQuadBroadcast(own, 1u), subgroupQuadBroadcast(own, 2u),
              subgroupQuadBroadcast(own, 3u));
}
// The view's eye, bias, color and gray.
Rows commonRows(int index, int layer) {
  int own = int(gl_SubgroupInvocationID & 3u);
  return together(u.list[index].rows[own == 0 ? kRowEyes + layer : kRowBias - 1 + own]);
}
// Gamma and the columns of toUnit.
Rows otherRows(int index) { return together(u.list[index].rows[kRowGamma + int(gl_SubgroupInvocationID & 3u)]); }

const int kTypes = (1 << 12) - 1;

bool isType(int shape, int kind, int type) {
  int other = 2 * shape + kind;
  return has(1 << other) && ((kFeatures & kTypes) == 1 << other || type == other);
}

// What the volume has along the ray or at its end.
float strength(int index, vec4 eyeRow, int type, Sight sight) {
  const int kSurface = 0, kFog = 1, kSpheres = 3 << 2 * kShapeSphere,
            kOthers = (1 << 2 * kShapeScene) - (1 << 2 * kShapeEllipsoid);
  float result = 0.0;
  BRANCH(isType(kShapeScene, kSurface, type)) result = 1.0;
  BRANCH(isType(kShapeScene, kFog, type)) result = saturated(max(eyeRow.w * sight.way, 0.0));
  if (has(kSpheres)) {
    bool isFog = isType(kShapeSphere, kFog, type);
    BRANCH(isFog || isType(kShapeSphere, kSurface, type)) {
      vec3 eye = eyeRow.xyz;
      if (has(kHasParallel)) eye += eyeRow.w * sight.origin;
      float way = eyeRow.w * sight.way;
      BRANCH(isFog) result = sphereFog(eye, sight.ray, max(way, 0.0));
      BRANCH(!isFog) result = sphereDensity(eye + way * sight.ray);
    }
  }
  if (has(kOthers)) {
    BRANCH((kFeatures & kTypes & ~kOthers) == 0 || (1 << type & kOthers) != 0) {
      Rows rows = otherRows(index);
      mat3 toUnit = mat3(rows.b.xyz, rows.c.xyz, rows.d.xyz);
      float axis = rows.a.w;
      vec3 eye = eyeRow.xyz;
      if (has(kHasParallel)) eye += toUnit * sight.origin;
      vec3 ray = toUnit * sight.ray;
      float shrink = inversesqrt(dot(ray, ray)), end = sight.way / shrink, way = max(end, 0.0);
      ray *= shrink;
      vec3 at = eye + end * ray;
      BRANCH(isType(kShapeEllipsoid, kFog, type)) result = sphereFog(eye, ray, way);
      BRANCH(isType(kShapeEllipsoid, kSurface, type)) result = sphereDensity(at);
      BRANCH(isType(kShapeBox, kFog, type)) result = boxFog(eye, ray, way);
      BRANCH(isType(kShapeBox, kSurface, type)) result = boxDensity(at);
      BRANCH(isType(kShapeCapsule, kFog, type)) result = capsuleFog(eye, ray, way, axis);
      BRANCH(isType(kShapeCapsule, kSurface, type)) result = capsuleDensity(at, axis);
      BRANCH(isType(kShapeHalfSpace, kFog, type)) result = halfSpaceFog(eye, ray, way);
      BRANCH(isType(kShapeHalfSpace, kSurface, type)) result = halfSpaceDensity(at);
    }
  }
  return result;
}

// FORMULAS 17. An amount of 0 leaves the bits as they are, since everything is finite: nothing is brighter than what
// half floats hold.
vec3 colorized(vec3 from, int index, Sight sight, int layer) {
  Rows rows = commonRows(index, layer);
  // Ways longer than the axis gather more than 1.
  float x = clamp(strength(index, rows.a, int(rows.d.w), sight), 0.0, 1.0);
  if (has(kHasFalloff)) x = x / (x + rows.c.w * (1.0 - x));
  float amount = clamp(rows.b.w * x, 0.0, 1.0);
  vec3 graded = rows.b.rgb + rows.c.rgb * from;
  if (has(kHasSaturation)) graded += rows.d.rgb * dot(from, kLuminance);
  graded = max(graded, 0.0);
  if (has(kHasGamma)) {
    vec3 gamma = otherRows(index).a.rgb;
    BRANCH(gamma != vec3(1.0)) graded = pow(graded, gamma);
  }
  return from + amount * (min(graded, 65504.0) - from);
}

// A straight colour that far along the pixel's ray, metres along the view axis.
vec3 colorizedAt(vec3 straight, float distance, ivec2 pixel, int layer) {
  // What any of the pixels that are computed together sees; where one does not see it, it does nothing.
  ivec2 strip = (pixel >> u.stripBits) + layer * kMaxStrips;
  uvec2 left = subgroupOr(u.columns[strip.x] & u.rows[strip.y]);
  Sight sight = sightOf(pixel, min(distance, 1e15), layer);
  vec3 after = straight;
  while ((left.x | left.y) != 0u) {
    bool low = left.x != 0u;
    uint word = low ? left.x : left.y;
    uint rest = word & (word - 1u);
    after = colorized(after, findLSB(word) + (low ? 0 : 32), sight, layer);
    left = low ? uvec2(rest, left.y) : uvec2(0u, rest);
  }
  return after;
}

#if defined(OVERLAY) || defined(BLENDED)
vec3 inAir(vec3 straight, float distance) {
  return mix(straight, u.air.horizon, u.air.amount * smoothstep(u.air.start, u.air.end, distance));
}
#endif

#ifdef BLENDED
// A picture of blended surfaces before others, which were mixed as square roots: each part at its own distance.
vec3 colorizedThrough(vec3 straight, float coverage, float distance, ivec2 pixel, int layer) {
  vec4 front = texelFetch(blended, ivec3(pixel, layer), 0);
  float there = blendedDistanceOf(texelFetch(blendedDistance, ivec3(pixel, layer), 0));
  // By itself it is not in the air yet, as it is in the picture.
  vec3 own = front.rgb / max(front.a, 1e-6);
  BlendedParts parts = blendedParts(sqrt(straight), coverage, sqrt(inAir(own * own, there)), front.a);
  vec3 behind = parts.behind * parts.behind, before = parts.before * parts.before;
  vec3 after = colorizedAt(behind, distance, pixel, layer), near = colorizedAt(before, there, pixel, layer);
  bool isSame = after == behind && near == before;
  return isSame ? straight : mixedColor(BlendedParts(parts.share, sqrt(near), sqrt(after)));
}
#endif

vec4 shade(ivec2 pixel, int layer) {
  vec4 whole = texelFetch(color, ivec3(pixel, layer), 0), far = texelFetch(depth, ivec3(pixel, layer), 0);
  // Colours are premultiplied by their coverage; where all is covered, this changes nothing.
  vec3 straight = whole.rgb / max(whole.a, 1e-6);
#ifdef OVERLAY
  float distance = blendedDistanceOf(far);
  straight *= straight;
  vec3 after = colorizedAt(inAir(straight, distance), distance, pixel, layer);
  bvec3 same = equal(after, straight);
  after = sqrt(max(after, vec3(0.0)));
#else
  float distance = eyeDepth(far.r, layer);
#ifdef BLENDED
  vec3 after = colorizedThrough(straight, whole.a, distance, pixel, layer);
#else
  vec3 after = colorizedAt(straight, distance, pixel, layer);
#endif
  bvec3 same = equal(after, straight);
#endif
  return vec4(mix(after * whole.a, whole.rgb, same), whole.a);
}

#include "../../shading/image_pass.glsl"
