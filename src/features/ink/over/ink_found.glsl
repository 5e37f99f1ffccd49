// Ink with the lines that are found in the picture: around shadow shapes, where light is on one side of them and shadow on
// the other, and between pieces of meshes. Whoever includes it has the block `u`, the images `strokes`, `tiles`, `light`,
// `depth` and `pieces`, and what they are specialised to, kInMetres and kLines.
#include "../ink_coverage.glsl"

const int kReach = kLines >> kInkOverKinds;  // pixels, for borders of pieces; 0: there are none
bool isShown(int kind) { return (kLines >> kind & 1) != 0; }

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

// How far the borders are at which objects end, pieces meet, and textures cut: pixels, from this one's middle; W: metres
// along the view axis to the nearest of what is on either side.
vec4 bordersAround(ivec2 pixel, int layer) {
  vec4 nearest = vec4(1e9);
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
      nearest.w = min(nearest.w, min(here.a, there.a));
    }
  return nearest;
}

vec4 inkOf(int kind, float coverage) { return coverage * vec4(1.0 - u.kinds[kind].color, 1.0); }

// `place`: pixels, where it is taken from. `ink`: what strokes have there. `metres`: along the view axis, where found lines
// have more of the pixel; else it stays.
vec4 withFoundLines(vec4 ink, ivec2 pixel, vec2 place, int layer, inout float metres) {
  uint flags = bitsOf(texelFetch(tiles, ivec3(pixel / kTileSize, layer), 0).r);
  float seen = eyeDepth(texelFetch(depth, ivec3(pixel, layer), 0).r, layer);
  float scale = kInMetres ? 1.0 / mix(seen, 1.0, VIEW_FIELD(orthographic, layer)) : 1.0;
  if ((isShown(kInkOverShadows) || isShown(kInkOverSteps)) && (flags & kTileShaded) != 0u)
    for (int kind = kInkOverShadows; kind <= kInkOverSteps; ++kind) {
      if (!isShown(kind)) continue;
      float radius = max(u.kinds[kind].radius * scale, u.least);
      vec2 lines = lightLines(place, max(radius, kInkOverThinnest), layer);
      vec4 found = inkOf(kind, min(radius / kInkOverThinnest, 1.0) * lines[kind - kInkOverShadows]);
      metres = found.a > ink.a ? seen : metres;
      ink = max(ink, found);
    }
  if (kReach > 0) {
    vec4 nearest = bordersAround(ivec2(floor(place)), layer);
    for (int kind = kInkOverObjects; kind <= kInkOverCutOuts; ++kind) {
      float radius = min(max(u.kinds[kind].radius * scale, u.least), float(kReach));
      if (!isShown(kind)) continue;
      vec4 found = inkOf(kind, coverageOf(radius, nearest[kind - kInkOverObjects]));
      metres = found.a > ink.a ? nearest.w : metres;
      ink = max(ink, found);
    }
  }
  return ink;
}
