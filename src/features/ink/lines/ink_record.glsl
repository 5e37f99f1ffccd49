// How a line looks in a view: found once for each, by ink_record.comp as many as there is room for; of others by each of its vertices.
#ifndef SCUMBLE_INK_RECORD_GLSL
#define SCUMBLE_INK_RECORD_GLSL
#include "../fullness.shared.h"
#include "../ink_edge.glsl"
#include "../../../shading/punctual_lights.glsl"

layout(set = 1, binding = kInkNumbers, scalar) readonly buffer Numbers { uint numbers[]; };
layout(buffer_reference, buffer_reference_align = 4, scalar) readonly buffer Rings { EdgeRing at[]; };
layout(buffer_reference, buffer_reference_align = 4, scalar) readonly buffer Frames { VertexFrame at[]; };
layout(set = 1, binding = kInkLines, scalar) readonly buffer Lines { InkLine lines[]; };

const float kNear = 1e-4;  // of clip w, against the ends of lines behind the eye

struct End {
  vec3 position;  // world
  vec4 clip;
  vec3 normal;    // unit, the surface's
};

// Direction that light comes from at a place of the world, by all lights that there are: the key light counts 1, lamps as
// much as they light; unit where they agree, and shorter where they come from both sides.
vec3 lightAt(vec3 position) {
  vec3 key = ink.keyLight.xyz - ink.keyLight.w * position;
  vec3 light = mix(key, key * inversesqrt(max(dot(key, key), 1e-37)), ink.keyLight.w);
  if (!kLamps) return light;
  light += punctualLightVector(position);
  return light / max(length(light), 1.0);
}

// From light that falls on a line: thin where it does, bold where it turns away (FORMULAS 24).
float widthOf(vec3 normal, vec3 light) {
  return mix(ink.greatest, ink.least, clamp(0.5 + 0.5 * dot(normal, light), 0.0, 1.0));
}

vec3 normalOf(uint vertex) {
  vec2 oct = unpackSnorm2x16(Frames(ink.addresses.frames).at[vertex].smoothNormal);
  return decodeNormal(oct);
}

// By how much a triangle turns away, as a sine; it goes on across the edge from x to y, with a third vertex.
float awayOf(vec3 normal, vec3 toEye) { return -dot(normal, toEye) * inversesqrt(max(dot(normal, normal), 1e-37)); }
float awayBeyond(uint first, uint third, vec3 x, vec3 y, float wound, vec3 toEye) {
  if (third == kNoEdgeSide) return -1.0;
  return awayOf(wound * cross(x - y, positionOf(first + third) - y), toEye);
}
// How much the form turns away behind an outline, from 0 to 1. Where a fold is about to close, none of its triangle, those
// beyond and the vertex there does by much; where the form goes on turning, one does when the triangle no longer does.
//
// And how much of the outline is drawn (LineRecord::reach). When a triangle turns away, its other edges take the place of one of
// its outlines. Seen from its edge then, they lie on one line; but where its tip lies beyond that outline, they reach out as far,
// at once. So they are drawn up to where the outline was, and grow to the tip with the angle.
float cosBetween(vec2 a, vec2 b) { return dot(a, b) * inversesqrt(max(dot(a, a) * dot(b, b), 1e-20)); }
struct Turn {
  float all;
  vec2 reach;
};
Turn turnOf(PlacedEdge edge, EdgeRing ring, uint first, bool isRight, uint thirdVertex, float wound, vec3 toEye, vec2 at[2],
            vec2 thirdAt) {
  toEye *= inversesqrt(max(dot(toEye, toEye), 1e-37));
  vec3 from = isRight ? edge.a : edge.b, to = isRight ? edge.b : edge.a, third = positionOf(thirdVertex);
  vec2 beyond;  // at both ends
  beyond.x = awayBeyond(first, isRight ? ring.beyondRight[0] : ring.beyondLeft[0], from, third, wound, toEye);
  beyond.y = awayBeyond(first, isRight ? ring.beyondRight[1] : ring.beyondLeft[1], third, to, wound, toEye);
  if (!isRight) beyond = beyond.yx;
  float own = awayOf(wound * (isRight ? edge.right : edge.left), toEye);
  float turn = max(max(own, max(beyond.x, beyond.y)), awayOf(normalOf(thirdVertex), toEye));
  float bend = bendOf(edge), sinBend = bend > 0.0 ? sqrt(max(1.0 - bend * bend, 0.0)) : 1.0;
  float full = max(min(ink.sinFadeAngle, 0.25 * sinBend), 1e-6);
  // Whether the outline goes on at its ends from triangle to triangle; else it turns around the tip of its own.
  vec2 goesOn = smoothstep(-0.1 * full, 0.0, beyond);
  vec2 along = at[1] - at[0];
  float size = dot(along, along), tip = clamp(dot(thirdAt - at[0], along) / max(size, 1e-6), 0.0, 1.0);
  vec2 back = vec2(cosBetween(thirdAt - at[0], along), cosBetween(at[1] - thirdAt, along));
  vec2 cut = (1.0 - goesOn) * smoothstep(0.0, 0.5, back) * (1.0 - smoothstep(0.0, 1.0, own / full));
  vec2 reach = vec2(mix(1.0, tip, goesOn.y) * cut.x, 1.0 - mix(1.0, 1.0 - tip, goesOn.x) * cut.y);
  return Turn(smoothstep(0.0, 1.0, turn / full), reach);
}

// `keepsTurned`: lines that are seen from behind alone, and so never, have records too, with kInkTurned in their kind.
LineRecord recordOf(uint number, int view, bool keepsTurned) {
  EdgeChunk chunk = chunks[number / uint(kEdgeChunk)];
  DrawnEdge drawn = edgeOf(chunk.firstEdge + number % uint(kEdgeChunk));
  PlacedEdge edge = placed(drawn, chunk.firstVertex);
  vec4 eye = eyeOf(view);
  int kind = kindOf(edge, eye);
  ObjectData object = objects[chunk.object];
  InkLine line = lines[object.material];
  vec3 middle = 0.5 * (edge.a + edge.b), toEye = eye.xyz - eye.w * middle;
  // What is seen from behind alone is hidden by the rest of it, but for open sheets.
  float wound = object.mirrored != 0u ? -1.0 : 1.0;
  int leftSide = sideOf(wound * edge.left, toEye), rightSide = edge.isOpen ? -1 : sideOf(wound * edge.right, toEye);
  bool isTurned = leftSide <= 0 && rightSide <= 0;
  isTurned = isTurned && line.isSingle != 0u;
  if (isTurned && !keepsTurned && !kHidden) kind = kInkNone;

  LineRecord record;
  record.spine = record.shift = record.radii = record.color = record.slopes = vec4(0.0);
  record.outward = vec3(0.0);
  record.turn = vec2(0.0);
  record.reach = vec2(0.0, 1.0);
  record.kind = kInkNone;
  // Beside what is cut away there is nothing to draw.
  EdgeRing ring = Rings(ink.addresses.rings).at[chunk.firstEdge + number % uint(kEdgeChunk)];
  record.seen = ring.seen;
  if (ring.seen == 0u) kind = kInkNone;
  if (kind == kInkNone) return record;
  mat4 worldToClip = VIEW_FIELD(worldToClip, view);
  End ends[2];
  uint first = chunk.firstVertex;
  ends[0] = End(edge.a, worldToClip * vec4(edge.a, 1.0), normalOf(first + (drawn.a & kEdgeVertexMask)));
  ends[1] = End(edge.b, worldToClip * vec4(edge.b, 1.0), normalOf(first + drawn.b));
  // What lies behind the eye is cut off.
  float w0 = ends[0].clip.w, w1 = ends[1].clip.w;
  if (max(w0, w1) <= kNear) return record;
  for (int i = 0; i < 2; ++i)
    if (ends[i].clip.w < kNear)
      ends[i].clip = mix(ends[i].clip, ends[1 - i].clip, (kNear - ends[i].clip.w) / (ends[1 - i].clip.w - ends[i].clip.w));

  vec2 toPixels = 0.5 * frame.imageSize;
  vec2 at[2];
  for (int i = 0; i < 2; ++i) at[i] = (ends[i].clip.xy / ends[i].clip.w + 1.0) * toPixels;
  vec2 along = at[1] - at[0];
  float size = length(along);
  vec2 direction = size > 1e-6 ? along / size : vec2(1.0, 0.0);
  // Away from the form, which on the screen lies on one side of its outline: that on which its triangles reach farther,
  // since one of them may be seen from its edge.
  vec2 across = vec2(-direction.y, direction.x);
  float within = 0.0;
  vec2 thirdAt[2] = vec2[2](at[0], at[0]);
  float thirdDepth[2] = float[2](0.0, 0.0);
  bool isKnown[2] = bool[2](false, false);
  for (int side = 0; side < (edge.isOpen ? 1 : 2); ++side) {
    vec4 third = worldToClip * vec4(positionOf(first + (side == 0 ? drawn.left : drawn.right)), 1.0);
    isKnown[side] = third.w > kNear;
    if (isKnown[side]) thirdAt[side] = (third.xy / third.w + 1.0) * toPixels, thirdDepth[side] = third.z / third.w;
    within += dot(thirdAt[side] - at[0], across);
  }
  if (within > 0.0) across = -across;

  // The edge's surface goes on from it on both sides; where it ends, or is seen from its edge, as the edge itself does.
  float parallel = VIEW_FIELD(orthographic, view);
  float linear[2];
  for (int i = 0; i < 2; ++i) linear[i] = inkLinear(eyeDepth(ends[i].clip.z / ends[i].clip.w, view), parallel);
  vec2 alongSlope = (linear[1] - linear[0]) / max(dot(along, along), 1e-6) * along;
  record.slopes = alongSlope.xyxy;
  for (int side = 0; side < (edge.isOpen ? 1 : 2); ++side) {
    vec2 towards = thirdAt[side] - at[0];
    float away = dot(towards, vec2(-direction.y, direction.x));
    // Of a closed form's outline, one of them is turned away.
    if (kind == kInkSilhouette && (side == 0 ? leftSide : rightSide) < max(leftSide, rightSide)) continue;
    if (!isKnown[side] || abs(away) < 0.01 * size || size < 1e-3) {
      // What is seen nearly from its edge leads to whatever is before it.
      if (kind == kInkSilhouette) record.slopes.xy = alongSlope - mix(100.0, -100.0, parallel) * linear[0] * across;
      continue;
    }
    float there = inkLinear(eyeDepth(thirdDepth[side], view), parallel);
    vec2 slope = alongSlope + (there - linear[0] - dot(alongSlope, towards)) / away * vec2(-direction.y, direction.x);
    bool isBefore = dot(towards, across) < 0.0;
    if (isBefore) record.slopes.xy = slope;
    else record.slopes.zw = slope;
  }

  // Widths: by normals that the edge itself has, or its ends.
  vec3 edgeNormal = wound * (edge.left * inversesqrt(max(dot(edge.left, edge.left), 1e-37)) +
                             edge.right * inversesqrt(max(dot(edge.right, edge.right), 1e-37)));
  edgeNormal *= inversesqrt(max(dot(edgeNormal, edgeNormal), 1e-37));
  vec4 known = unpackUnorm4x8(ring.ends);
  // How much the normals of vertices count, at both ends.
  vec2 roundness = vec2(kWeights == kInkByVertex ? 1.0 : 0.0);
  if (kWeights == kInkHybrid) {
    roundness = vec2(!edge.isOpen && bendOf(edge) > ink.cosSmooth ? 1.0 : 0.0);
    if ((edge.known & kEdgeRoundnessKnown) != 0u) roundness = known.zw;
  }
  InkKind style = ink.kinds[kind];
  vec2 ownWidths = vec2(1.0);
  if (kind == kInkSilhouette) {
    bool isRight = leftSide > rightSide;
    Turn turn = turnOf(edge, ring, first, isRight, first + (isRight ? drawn.right : drawn.left), wound, toEye, at,
                       thirdAt[isRight ? 1 : 0]);
    ownWidths = line.outlineWidth * known.xy;
    record.turn.x = turn.all;
    if (isKnown[isRight ? 1 : 0]) record.reach = turn.reach;
    // What is about to close becomes the inner line that it is besides, or nothing.
    int besides = innerKindOf(edge);
    if (besides != kInkNone) record.turn.y = min(ink.kinds[besides].width / style.width, 1.0);
    if (besides == kInkCrease) record.turn.y *= creaseOf(edge);
  }
  float radii[2];
  bool hasOwn = kind == kInkSilhouette && line.hasOutline != 0u;
  for (int i = 0; i < 2; ++i) {
    vec3 normal = edgeNormal;
    if (kWeights != kInkByEdge && kind == kInkSilhouette) {
      // The normal of a smooth form is square to the view on its outline (paper 004, section 2.3).
      normal = cross(toEye, edge.b - edge.a);
      normal *= (dot(normal, edgeNormal) < 0.0 ? -1.0 : 1.0) * inversesqrt(max(dot(normal, normal), 1e-37));
    }
    float pixelsOfOne = abs(toPixels.y / VIEW_FIELD(ndcToEyeRay, view).y);  // at one metre's distance
    float scale = frame.pixelScale;
    if (kUnit == kInkMetres) scale = pixelsOfOne / mix(ends[i].clip.w, 1.0, VIEW_FIELD(orthographic, view));
    if (kUnit == kInkDegrees) scale = radians(1.0) * pixelsOfOne;
    vec3 light = lightAt(ends[i].position);
    float width = mix(widthOf(normal, light), widthOf(ends[i].normal, light), roundness[i]) * scale;
    if (hasOwn) {
      width = ownWidths[i] * frame.knobHeight;
      if (line.outlineUnit == uint(kInkMetres))
        width = ownWidths[i] * pixelsOfOne / mix(ends[i].clip.w, 1.0, VIEW_FIELD(orthographic, view));
    }
    radii[i] = 0.5 * width * style.width * line.width;
    if (kind == kInkCrease) radii[i] *= creaseOf(edge);
  }

  // Outlines may lie outside of the form. Ends move along normals of vertices, which lines that meet there share
  // (FORMULAS 21), so that they still meet; how far, fragments find out.
  // How far a line must reach beyond its ends to meet the next one halfway follows from that as well; small triangles
  // would else be drawn many times over.
  record.shift = vec4(0.0);
  record.caps = vec2(1.0);
  // So does the border of an open sheet, which ends nowhere on a form.
  if (kind == kInkBoundary) record.turn.y = 1.0;
  bool isOutline = kind == kInkSilhouette || kind == kInkBoundary;
  if (isOutline) {
    vec2 shift[2];
    for (int i = 0; i < 2; ++i) {
      vec4 tip = worldToClip * vec4(ends[i].normal, 0.0);
      shift[i] = (tip.xy - ends[i].clip.xy / ends[i].clip.w * tip.w) * toPixels;
      shift[i] *= inversesqrt(max(dot(shift[i], shift[i]), 1e-30));
      // Where a corner's normal says little of this edge, the edge decides.
      float agrees = dot(shift[i], across);
      shift[i] = agrees < 0.3 ? across : shift[i] / max(agrees, 0.7);
      record.caps[i] = agrees < 0.3 ? 1.0 : sqrt(max(1.0 - agrees * agrees, 0.0)) / max(agrees, 0.7);
    }
    record.shift = vec4(shift[0], shift[1]);
  }
  record.spine = vec4(at[0], at[1]);
  record.radii = vec4(radii[0], radii[1], ends[0].clip.z / ends[0].clip.w, ends[1].clip.z / ends[1].clip.w);
  vec4 color = vec4(line.color, line.ownColor);
  if (hasOwn) color = vec4(line.outlineColor, -line.outlineLight);
  record.color = vec4(mix(color.rgb, style.color, style.colorAmount), color.a * (1.0 - style.colorAmount));
  record.outward = vec3(across, isOutline ? 1.0 : 0.0);

  record.kind = isTurned ? kind | kInkTurned : kind;
  return record;
}
#endif
