#version 460
// What a brush's stamp lays down, on the object that its anchor lies on: so much more or less pigment, warmer or cooler,
// wetter or drier; or (CELLS) a cell of a weighted Voronoi diagram, of which each place has the nearest (paper 004,
// section 3.6).
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/frame.glsl"
#include "../../../shading/view_index.glsl"
#include "../watercolor.shared.h"

layout(set = 1, binding = kPigmentBlock, scalar) uniform Block { PigmentUniforms u; };
layout(set = 1, binding = kPigmentBrush) uniform sampler2D first;
layout(set = 1, binding = kPigmentSecond) uniform sampler2D second;
layout(set = 1, binding = kPigmentThird) uniform sampler2D third;
layout(set = 1, binding = kPigmentFourth) uniform sampler2D fourth;
layout(set = 1, binding = kPigmentPlaces) uniform sampler2DArray places;

layout(location = 0) in vec2 inPlace;
layout(location = 1) flat in vec4 inStamp;
layout(location = 2) flat in vec4 inChance;
layout(location = 3) flat in float inObject;
layout(location = 4) flat in uint inBrush;
layout(location = 5) flat in vec4 inTint;

layout(location = 0) out vec4 outPigment;
#ifdef COLORED
layout(location = 1) out vec4 outColor;
#endif

// The stamp's brush. All have mip levels, so neighbours are asked before any is chosen.
vec4 brushAt(vec2 at) {
  vec2 alongX = dFdx(at), alongY = dFdy(at);
  if (inBrush == 0u) return textureGrad(first, at, alongX, alongY);
  if (inBrush == 1u) return textureGrad(second, at, alongX, alongY);
  if (inBrush == 2u) return textureGrad(third, at, alongX, alongY);
  return textureGrad(fourth, at, alongX, alongY);
}

void main() {
  // Other objects, and parts of the same one that are far before or behind it, keep what they have.
  vec2 place = texelFetch(places, ivec3(gl_FragCoord.xy, viewIndex()), 0).rg;
  if (place.x != inObject) discard;
  float apart = abs(place.y - inStamp.x) / max(inStamp.y, 1e-12);
  float counts = inStamp.z * (1.0 - smoothstep(0.8, 1.6, apart));
  if (counts <= 0.0) discard;

  float turnedBy = inStamp.w, away = length(inPlace);
  vec2 turned = mat2(cos(turnedBy), sin(turnedBy), -sin(turnedBy), cos(turnedBy)) * inPlace;
#ifdef SHAPES
  // The whole picture, however it is turned.
  vec4 painted = brushAt(0.5 + 0.7071 * turned);
  float covers = mix(dot(painted.rgb, vec3(0.2126, 0.7152, 0.0722)), painted.a, u.byOpacity[min(inBrush, 3u)]);
  covers *= step(max(abs(turned.x), abs(turned.y)), 0.7071);
#else
  float hair = brushAt(0.22 * turned + inChance.xy).r - 0.5;
#endif
  vec3 pigment = vec3(inChance.x, inChance.y, inChance.z);
#ifdef CELLS
  float distance = away * (0.7 + 0.6 * inChance.z) + 0.1 * hair;
  if (distance >= 1.0) discard;
  gl_FragDepth = 1.0 - distance;
  outPigment = vec4(mix(vec3(0.5, 0.5, 0.5), pigment, counts), 1.0);
#ifdef COLORED
  outColor = vec4(inTint.rgb, 1.0) * inTint.a * counts;
#endif
#else
#ifdef SHAPES
  float inside = 0.5 * covers, within = 1.0, alpha = covers;
#else
  float inside = 1.0 - away + 0.9 * hair * (1.0 - 0.5 * away), within = smoothstep(1.0, 0.85, away);
  float alpha = smoothstep(0.0, 0.4, inside) * within;
#endif
  // A wet drop thins what is under it, and pushes pigment to a rim that is hard on the outside.
  if (fract(inChance.w * 37.0) < u.backruns) {
    float rim = exp(-pow((inside - 0.16) / 0.07, 2.0));
    pigment.x = mix(0.28, 1.0, rim);
    alpha = smoothstep(0.06, 0.16, inside) * within;
  }
  outPigment = vec4(pigment, 0.75 * alpha * counts);
#ifdef COLORED
  outColor = vec4(inTint.rgb, inTint.a * alpha * counts);
#endif
#endif
}
