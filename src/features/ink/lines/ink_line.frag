#version 460
// Ink of a line, where the edge is seen.
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/frame.glsl"
#include "../../../shading/view_index.glsl"
#include "../ink_choices.glsl"
#include "../ink_coverage.glsl"

layout(set = 1, binding = kInkBlock, scalar) uniform Ink { InkUniforms ink; };
#include "ink_seen.glsl"
#include "ink_texture.glsl"
layout(set = 2, binding = kInkShadowed) uniform sampler2DArray shadowed;

layout(location = 0) flat in vec4 inSpine;
layout(location = 1) flat in vec4 inShift;
layout(location = 2) flat in vec4 inRadii;
layout(location = 3) flat in vec4 inColor;
layout(location = 4) flat in vec3 inOutward;
layout(location = 5) flat in vec4 inTurn;  // and reach
layout(location = 6) flat in vec3 inRestA;
layout(location = 7) flat in vec3 inRestB;
layout(location = 8) flat in vec3 inAcross;
layout(location = 9) flat in vec3 inDown;
layout(location = 10) flat in uint inSeen;
layout(location = 11) flat in vec4 inSlopes;
layout(location = 12) flat in uint inTurned;

// COVER: depth alone, of pixels that the line covers wholly.
#ifndef COVER
layout(set = 2, binding = kInkNearest) uniform sampler2DArray nearestLine;
layout(location = 0) out vec4 outInk;
#ifdef DISTANCE
layout(location = 1) out vec4 outNearness;
#endif
#endif

// Lines that lie so many pixels apart, as what those measure there, cover each other; nearer ones meet at a corner.
const float kInkApart = 1.5;

// How far along a line is nearest, from 0 to 1.
float nearestOn(vec2 from, vec2 to, vec2 point) {
  vec2 along = to - from;
  return clamp(dot(point - from, along) / max(dot(along, along), 1e-12), 0.0, 1.0);
}

// A place on the edge in the object's space at rest, and how far away it is, metres; in a parallel projection 1.
vec3 restAt(float t, int view, out float metresAway) {
  float parallel = VIEW_FIELD(orthographic, view);
  vec2 metres = vec2(eyeDepth(inRadii.z, view), eyeDepth(inRadii.w, view));
  vec2 nearness = mix(1.0 / metres, vec2(1.0), parallel);
  metresAway = 1.0 / mix(nearness.x, nearness.y, t);
  return mix(inRestA * nearness.x, inRestB * nearness.y, t) * metresAway;
}

// A line's coverage of a pixel. `nearest`: of the line as it is drawn; `spine`: of the edge, at `t`.
float lineCoverage(float radius, vec2 pixel, vec2 nearest, vec2 spine, float t, int view) {
  float away = distance(pixel, nearest), plain = coverageOf(radius, away);
  if (kTexture == kInkPlain && !kBreaks) return plain;
  float metresAway;
  vec3 place = restAt(t, view, metresAway);
  vec2 off = (pixel - spine) * metresAway, along = inSpine.zw - inSpine.xy;
  vec3 beside = place + off.x * inAcross + off.y * inDown;
  // Beyond its ends a line goes straight on, as the next one does, which lies there as well.
  place += (inRestB - inRestA) * dot(pixel - spine, along) / max(dot(along, along), 1e-3);
  float size = length(inAcross) * metresAway * ink.textureSize;
  if (kBreaks) plain = coverageOf(max(radius, 0.5), away) * unbroken(place, size, radius);
  if (kTexture == kInkPlain) return plain;
  // Inner lines have no sides that would stay where they are.
  float side = dot(pixel - nearest, inOutward.xy);
  return plain * strokeCoverage(place, beside, size, radius,
                                inOutward.z > 0.0 ? side : abs(side));
}

// The same of a line that something hides: dashes along the edge, which stay on it where it moves.
float dashedCoverage(float radius, vec2 pixel, vec2 spine, float t, int view) {
  float metresAway;
  vec3 place = restAt(t, view, metresAway), along = inRestB - inRestA;
  float way = dot(place, along) * inversesqrt(max(dot(along, along), 1e-37));
  return coverageOf(radius, distance(pixel, spine)) * dashAt(way, length(inAcross) * metresAway * ink.hiddenDash, ink.hiddenDash);
}

void main() {
  int view = viewIndex();
  vec2 pixel = gl_FragCoord.xy;
  float t = nearestOn(inSpine.xy, inSpine.zw, pixel);
  float whole = mix(inRadii.x, inRadii.y, t);

  vec2 outward = inOutward.xy;
  vec2 spine = mix(inSpine.xy, inSpine.zw, t);
  InkSpine edge = InkSpine(inSpine, inRadii.zw, outward, inSlopes, inTurn.xy, inTurn.zw, inOutward.z > 0.0, inSeen);
  LineSeen seen = lineSeenAt(edge, t, whole, view);
  float radius = whole * seen.fullness, distance = eyeDepth(mix(inRadii.z, inRadii.w, t), view);
  if (radius <= 0.0 && !kHidden) discard;
  // A line makes room for what is nearer, so that it comes out from behind that little by little.
  bool isOutside = kPlacement == kInkExterior && inOutward.z > 0.0;
  InkCover beyond = coverTowards(edge, spine, outward, distance, view);
  float reach = isOutside ? 2.0 * radius : radius;
  radius *= spaceBeside(beyond, reach, whole, view) / max(reach, 1e-6);

  float moved = ink.offset * frame.pixelScale + (kPlacement == kInkExterior ? max(radius - ink.overlap, 0.0) : 0.0);
  vec4 line = inSpine + inShift * moved;
  vec2 nearest = mix(line.xy, line.zw, nearestOn(line.xy, line.zw, pixel));
  float coverage = lineCoverage(radius, pixel, nearest, spine, t, view);
  if (kDoubled && inOutward.z > 0.0) {
    line = inSpine + inShift * (moved + ink.doubled * frame.pixelScale);
    nearest = mix(line.xy, line.zw, nearestOn(line.xy, line.zw, pixel));
    coverage = max(coverage, lineCoverage(radius * ink.doubledWidth, pixel, nearest, spine, t, view));
  }
  if (coverage > 0.0) {
    InkCover towards = coverTowards(edge, spine, normalize(pixel - spine + 1e-3 * outward), distance, view);
    coverage *= 1.0 - max(coveredAt(towards, pixel, whole, view), float(inTurned));
  }
#ifdef COVER
  if (coverage < 0.999) discard;
  gl_FragDepth = mix(inRadii.z, inRadii.w, t);
#else
  if (kHidden)
    coverage = max(coverage, max(seen.hidden, float(inTurned)) * dashedCoverage(whole * ink.hidden, pixel, spine, t, view));
  if (coverage <= 0.0) discard;
  if (kCovers) {
    float nearer = distance - eyeDepth(texelFetch(nearestLine, ivec3(pixel, view), 0).r, view);
    if (nearer > kInkApart * metresOfPixel(distance, view)) discard;
  }
  vec3 color = inColor.rgb;
  if (inColor.a != 0.0) {
    vec2 inside = clamp(spine - 2.0 * outward, vec2(0.0), frame.imageSize - 1.0);
    vec4 surface = texelFetch(shadowed, ivec3(inside, view), 0);
    if (surface.a > 0.0) color = mix(color, (inColor.a > 0.0 ? vec3(0.6) : color) * surface.rgb / surface.a, abs(inColor.a));
  }
  outInk = coverage * vec4(1.0 - color, 1.0);
#ifdef DISTANCE
  outNearness = coverage * vec4(frame.sceneRadius / distance, 1.0, 0.0, 1.0);
#endif
#endif
}
