#version 460
// A brush's stamp at an anchor: a square around it, where the anchor is seen (paper 004, section 3).
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/sphere.glsl"
#include "../../../shading/view_index.glsl"
#include "../watercolor.shared.h"

layout(set = 1, binding = kPigmentBlock, scalar) uniform Block { PigmentUniforms u; };
layout(set = 1, binding = kPigmentAnchors, scalar) readonly buffer Anchors { DrawnAnchor anchors[]; };
layout(set = 1, binding = kPigmentChunks, scalar) readonly buffer Chunks { AnchorChunk chunks[]; };
layout(set = 1, binding = kPigmentVertices, scalar) readonly buffer Vertices { VertexCore vertices[]; };

layout(location = 0) out vec2 outPlace;        // in the stamp, from -1 to 1
layout(location = 1) flat out vec4 outStamp;   // eye depth, metres that it reaches, how much it counts, its turn
layout(location = 2) flat out vec4 outChance;  // four numbers of its own, 0 to 1
layout(location = 3) flat out vec3 outMiddle;  // pixels; how far it reaches

vec4 chanceOf(uint seed) {
  return vec4(uvec4(seed, seed >> 8, seed >> 16, seed >> 24) & 255u) / 255.0;
}

// By how much what is up on the sphere is turned there against the frame's own up, clockwise: stamps are no other in
// another part of it. 0 where the frame is no part of one.
float turnOnSphere(vec3 inEye) {
  vec2 up = upOnSphere(normalize(inEye));
  return atan(up.x, up.y + 1e-20);
}

void main() {
  gl_Position = vec4(2.0, 2.0, 0.0, 1.0);  // outside
  outPlace = vec2(0.0);
  outStamp = outChance = vec4(0.0);
  outMiddle = vec3(0.0);
  int number = gl_VertexIndex / 6, corner = int(uint(gl_VertexIndex) % 6u);
  AnchorChunk chunk = chunks[number / kAnchorChunk];
  uint own = uint(number) % uint(kAnchorChunk);
  if (own >= chunk.count) return;
  DrawnAnchor anchor = anchors[chunk.firstAnchor + own];
  vec3 a = vertices[chunk.firstVertex + anchor.a].position, b = vertices[chunk.firstVertex + anchor.b].position,
       c = vertices[chunk.firstVertex + anchor.c].position;
  vec3 normal = cross(b - a, c - a);
  float scale = sqrt(0.5 * length(normal) / max(anchor.area, 1e-37));  // as large as it is now, however it got there
  vec3 position = a + anchor.toB * (b - a) + anchor.toC * (c - a);

  // Sparser where it is farther away: of the anchors within the same part of the screen there are always as many, and the
  // last ones come and go by their size (FORMULAS 23). Both eyes have the same, from the middle between them.
  int view = viewIndex();
  float parallel = VIEW_FIELD(orthographic, view);  // mixed and not chosen by: no branch on a uniform
  float pixel = metresOfPixel(distance(frame.viewer, position), view);
  float wanted = u.spacing * pixel;
  float grown = smoothstep(0.8, 1.3, anchor.spacing * scale / wanted);
  if (grown <= 0.0) return;
  // It fades where the surface turns away (FORMULAS 22).
  mat4 toEyeSpace = VIEW_FIELD(worldToEye, view);
  vec3 toEye = mix(VIEW_FIELD(eye, view) - position, vec3(toEyeSpace[0][2], toEyeSpace[1][2], toEyeSpace[2][2]), parallel);
  float facing = abs(dot(normal, toEye)) * inversesqrt(max(dot(normal, normal) * dot(toEye, toEye), 1e-37));
  vec4 clip = VIEW_FIELD(worldToClip, view) * vec4(position, 1.0);
  if (clip.w <= 1e-6) return;
  vec2 at = (clip.xy / clip.w + 1.0) * 0.5 * frame.imageSize;
  float radius = u.spacing * u.size * grown;
  if (any(lessThan(at, vec2(-radius))) || any(greaterThan(at, frame.imageSize + radius))) return;
  float counts = smoothstep(0.0, 0.45, facing);
  if (counts <= 0.0) return;

  vec4 chance = chanceOf(anchor.seed);
  outChance = chance;
  outMiddle = vec3(at, radius);
  float turn = turnOnSphere((toEyeSpace * vec4(position, 1.0)).xyz);
  outStamp = vec4(eyeDepth(clip.z / clip.w, view), radius * pixel, counts, 6.2831853 * chance.w - turn);
  bool isRight = corner == 1 || corner == 2 || corner == 4, isLow = corner == 2 || corner == 4 || corner == 5;
  outPlace = vec2(isRight ? 1.0 : -1.0, isLow ? 1.0 : -1.0);
  gl_Position = vec4((at + radius * outPlace) / (0.5 * frame.imageSize) - 1.0, 0.5, 1.0);
}
