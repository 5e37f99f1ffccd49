// Holes that volumes cut into what a feature draws: AlphaMode::cut.
#ifndef SCUMBLE_CUTOUTS_GLSL
#define SCUMBLE_CUTOUTS_GLSL
#include "cutouts.shared.h"
#include "frame.glsl"

layout(set = 0, binding = 3, scalar) readonly buffer CutoutBlock { Cutouts cutouts; };
// For each point of a grid, along x, then z, then y: its number and those of its neighbours along x, along z, and along
// both, as snorm8.
layout(set = 0, binding = 4, scalar) readonly buffer CutoutPoints { uint cutoutPoints[]; };

#define CUT cutouts.all[index]

// How far a place is within, from -1 to 1, and how that grows along the three axes. `at`: numbers of points.
vec4 withinCutout(int index, vec3 at) {
  ivec3 size = ivec3(CUT.size), from = ivec3(clamp(at, vec3(0.0), CUT.size - 2.0));
  vec3 f = clamp(at - vec3(from), 0.0, 1.0);
  int word = CUT.first + (from.y * size.z + from.z) * size.x + from.x;
  vec4 low = unpackSnorm4x8(cutoutPoints[word]), high = unpackSnorm4x8(cutoutPoints[word + size.x * size.z]);
  vec4 four = mix(low, high, f.y), up = high - low;
  vec2 two = mix(four.xy, four.zw, f.z), along = four.zw - four.xy, rising = mix(up.xy, up.zw, f.z);
  return vec4(two.y - two.x, mix(rising.x, rising.y, f.x), mix(along.x, along.y, f.x), mix(two.x, two.y, f.x));
}

// Whether the fragment that is being shaded is within one.
bool isCutOut(int view) {
  vec2 ndc = gl_FragCoord.xy / frame.imageSize * 2.0 - 1.0;
  float far = eyeDepth(gl_FragCoord.z, view), parallel = VIEW_FIELD(orthographic, view);
  vec4 toRay = VIEW_FIELD(ndcToEyeRay, view);
  vec2 across = ndc * toRay.xy + toRay.zw;
  mat3 toWorld = transpose(mat3(VIEW_FIELD(worldToEye, view)));
  vec3 world = VIEW_FIELD(eye, view) + toWorld * vec3(across * mix(far, 1.0, parallel), -far);
  vec3 ray = toWorld * vec3(across * (1.0 - parallel), -1.0);
  vec3 alongX = dFdx(world), alongY = dFdy(world);
  bool isCut = false;
  for (int index = 0; index < cutouts.count; ++index) {
    vec3 at = (CUT.toPoints * vec4(world, 1.0)).xyz, last = CUT.size - 1.0;
    bool isNear = all(greaterThan(at, vec3(0.0))) && all(lessThan(at, vec3(last.x, CUT.ceiling, last.z)));
    for (; isNear; isNear = false) {
      vec4 within = withinCutout(index, min(at, last));
      // What is next to its border is hidden by the side that is seen: what is cut too far by the inner one, what is
      // left standing by the outer one. So nothing shows that is not exact. What is seen edge-on is left standing.
      vec3 way = mat3(CUT.toPoints) * ray;
      float enters = dot(way, within.xyz) * inversesqrt(max(dot(way, way) * dot(within.xyz, within.xyz), 1e-12));
      float margin = kCutoutMargin / kCutoutReach * clamp(4.0 * enters + 0.3, -1.0, 1.0);
      // Samples of a pixel are up to half of it away from its middle, which decides for all of them.
      mat3 toPoints = mat3(CUT.toPoints);
      float halfPixel = 0.5 * (abs(dot(toPoints * alongX, within.xyz)) + abs(dot(toPoints * alongY, within.xyz)));
      isCut = isCut || within.w > margin + min(halfPixel, 0.5) * min(enters, 0.0);
    }
  }
  return isCut;
}
#undef CUT
#endif
