#version 460
// Ink over the picture, with lines that are found here: around shadow shapes, where light is on one side of them and shadow
// on the other, and between pieces of meshes. Lines are broken as edges are: a pixel takes the ink from where the warp takes
// its colour.
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/byte_bits.glsl"
#include "../../../shading/frame.glsl"
#include "../../../shading/tiles.shared.h"
#include "../ink_coverage.glsl"
#include "ink_over.shared.h"

layout(constant_id = 0) const int kOptions = 0;  // kInkOverTears ...
const bool kTears = (kOptions & kInkOverTears) != 0, kEnds = (kOptions & kInkOverEnds) != 0;
layout(constant_id = 1) const bool kInMetres = false;  // widths of lines are
layout(constant_id = 2) const int kLines = 0;           // bits of kinds, and kReach
const int kReach = kLines >> kInkOverKinds;  // pixels, for borders of pieces; 0: there are none
bool isShown(int kind) { return (kLines >> kind & 1) != 0; }
layout(set = 1, binding = 0, scalar) uniform Block { InkOverUniforms u; };
layout(set = 1, binding = kInkOverPicture) uniform sampler2DArray soFar;
layout(set = 1, binding = kInkOverStrokes) uniform sampler2DArray strokes;
layout(set = 1, binding = kInkOverWarp) uniform sampler2DArray warp;
layout(set = 1, binding = kInkOverTiles) uniform sampler2DArray tiles;
layout(set = 1, binding = kInkOverLight) uniform sampler2DArray light;
layout(set = 1, binding = kInkOverDepth) uniform sampler2DArray depth;
layout(set = 1, binding = kInkOverPieces) uniform sampler2DArray pieces;
layout(set = 1, binding = kInkOverExtent) uniform sampler2DArray extent;

// Light after its threshold, without the inner glow, and coverage. Plain tiles, which nobody has written, are all in light
// or all in shadow; beside them nothing is read of theirs.
vec2 lightAt(vec2 place, int layer) {
  place = clamp(place, vec2(0.5), frame.imageSize - 0.5);
  ivec2 tile = ivec2(place) / kTileSize;
  uint flags = bitsOf(texelFetch(tiles, ivec3(tile, layer), 0).r);
  if ((flags & kTilePlain) != 0u) return vec2(float((flags & kTileLit) != 0u), 1.0);
  vec2 first = vec2(tile * kTileSize);
  vec2 within = clamp(place, first + 0.5, min(first + float(kTileSize), frame.imageSize) - 0.5);
  vec4 there = textureLod(light, vec3(within / frame.imageSize, layer), 0.0);
  return vec2(there.r - there.b, there.a);
}

// Coverage of lines around shadow shapes, and between steps of light: how much light differs within half their width.
vec2 lightLines(vec2 place, float radius, int layer) {
  float least = 1.0, most = 0.0, covered = 1.0;
  for (int i = 0; i < 9; ++i) {
    vec2 beside = i == 8 ? vec2(0.0) : radius * vec2(cos(0.7853982 * float(i)), sin(0.7853982 * float(i)));
    vec2 there = lightAt(place + beside, layer);
    covered = min(covered, there.y);
    least = min(least, there.x);
    most = max(most, there.x);
  }
  // Other edges have lines of their own.
  if (covered < 0.999) return vec2(0.0);
  float line = smoothstep(0.15, 0.85, (most - least) * u.steps);
  // Shadow begins below half of a step.
  float lit = smoothstep(0.25, 0.75, least * u.steps) * step(1.5, u.steps);
  return line * vec2(1.0 - lit, lit);
}

// A pixel's piece; where nothing is, far away.
vec4 pieceAt(ivec2 pixel, int layer) {
  vec4 piece = texelFetch(pieces, ivec3(clamp(pixel, ivec2(0), ivec2(frame.imageSize) - 1), layer), 0);
  return piece.r > 0.0 ? piece : vec4(0.0, 0.0, 0.0, 1e9);
}

// How far the borders are at which objects end, pieces meet, and textures cut: pixels, from this one's middle.
vec3 bordersAround(ivec2 pixel, int layer) {
  vec3 nearest = vec3(1e9);
  vec4 here = pieceAt(pixel, layer);
  // Most pixels are of one piece with all around them.
  bool isAlike = true;
  for (int i = 0; i < 12; ++i) {
    ivec2 corner = ivec2(i & 1, i >> 1 & 1) * 2 - 1;
    ivec2 side = (i & 1) != 0 ? ivec2(corner.y, 0) : ivec2(0, corner.y);
    vec4 there = pieceAt(pixel + (i < 4 ? kReach * corner : i < 8 ? kReach * side : side), layer);
    isAlike = isAlike && there.r == here.r && there.b + here.b == 0.0;
  }
  if (isAlike) return nearest;
  for (int y = -kReach; y <= kReach; ++y)
    for (int x = -kReach; x <= kReach; ++x) {
      vec4 there = pieceAt(pixel + ivec2(x, y), layer);
      float away = length(vec2(x, y));
      bool isOther = there.r != here.r;
      float steep = kInkSteepest * away * metresOfPixel(min(here.a, there.a), layer);
      bool touches = abs(there.a - here.a) <= steep;
      bool hasHoles = (there.a < here.a ? there.b : here.b) > 0.0;
      float border = away - 0.5;
      if (there.g != here.g) nearest.x = min(nearest.x, border);
      if (isOther && touches) nearest.y = min(nearest.y, border);
      if (hasHoles && !touches) nearest.z = min(nearest.z, border);
    }
  return nearest;
}

vec4 inkOf(int kind, float coverage) { return coverage * vec4(1.0 - u.kinds[kind].color, 1.0); }

// Edges of light are about a pixel and a half wide: lines that are thinner than that are lighter instead.
const float kThinnest = 0.75;

vec4 shade(ivec2 pixel, int layer) {
  vec4 color = texelFetch(soFar, ivec3(pixel, layer), 0);
  vec4 ink;
  uint flags = bitsOf(texelFetch(tiles, ivec3(pixel / kTileSize, layer), 0).r);
  bool isTorn = kTears && (flags & kTileMarked) != 0u;
  vec2 place = vec2(pixel) + 0.5;
  if (isTorn) {
    place += u.warp * texelFetch(warp, ivec3(pixel, layer), 0).rg;
    ink = textureLod(strokes, vec3(place / frame.imageSize, layer), 0.0);
  } else {
    ink = texelFetch(strokes, ivec3(pixel, layer), 0);
  }
  float metres = eyeDepth(texelFetch(depth, ivec3(pixel, layer), 0).r, layer);
  float scale = kInMetres ? 1.0 / mix(metres, 1.0, VIEW_FIELD(orthographic, layer)) : 1.0;
  if ((isShown(kInkOverShadows) || isShown(kInkOverSteps)) && (flags & kTileShaded) != 0u)
    for (int kind = kInkOverShadows; kind <= kInkOverSteps; ++kind) {
      if (!isShown(kind)) continue;
      float radius = u.kinds[kind].radius * scale;
      vec2 lines = lightLines(place, max(radius, kThinnest), layer);
      ink = max(ink, inkOf(kind, min(radius / kThinnest, 1.0) * lines[kind - kInkOverShadows]));
    }
  if (kReach > 0) {
    vec3 nearest = bordersAround(ivec2(floor(place)), layer);
    for (int kind = kInkOverObjects; kind <= kInkOverCutOuts; ++kind) {
      float radius = min(u.kinds[kind].radius * scale, float(kReach));
      if (isShown(kind)) ink = max(ink, inkOf(kind, coverageOf(radius, nearest[kind - kInkOverObjects])));
    }
  }
  if (kEnds) ink *= texelFetch(extent, ivec3(pixel, layer), 0).r;
  if (ink.a > 0.0) {
    vec3 root = 1.0 - clamp(ink.rgb / ink.a, 0.0, 1.0);
    color = mix(color, vec4(root * root, 1.0), ink.a);
  }
  return color;
}

#include "../../../shading/image_pass.glsl"
