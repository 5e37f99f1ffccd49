#version 460
// A brush's stamp at an anchor: a square around it, where the anchor is seen (paper 004, section 3).
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/frame.glsl"
#include "../../../shading/view_index.glsl"
#include "../watercolor.shared.h"

layout(set = 1, binding = kPigmentBlock, scalar) uniform Block { PigmentUniforms u; };
layout(set = 1, binding = kPigmentAnchors, scalar) readonly buffer Anchors { DrawnAnchor anchors[]; };
layout(set = 1, binding = kPigmentChunks, scalar) readonly buffer Chunks { AnchorChunk chunks[]; };
layout(set = 1, binding = kPigmentVertices, scalar) readonly buffer Vertices { VertexCore vertices[]; };
layout(set = 1, binding = kPigmentDepth) uniform sampler2DArray depth;

layout(location = 0) out vec2 outPlace;        // in the stamp, from -1 to 1
layout(location = 1) flat out vec4 outStamp;   // eye depth, metres that it reaches, how much it counts, its turn
layout(location = 2) flat out vec4 outChance;  // four numbers of its own, 0 to 1

vec4 chanceOf(uint seed) {
  return vec4(uvec4(seed, seed >> 8, seed >> 16, seed >> 24) & 255u) / 255.0;
}

void main() {
  gl_Position = vec4(2.0, 2.0, 0.0, 1.0);  // outside
  outPlace = vec2(0.0);
  outStamp = outChance = vec4(0.0);
  int number = gl_VertexIndex / 6, corner = gl_VertexIndex % 6;
  AnchorChunk chunk = chunks[number / kAnchorChunk];
  uint own = uint(number % kAnchorChunk);
  if (own >= chunk.count) return;
  DrawnAnchor anchor = anchors[chunk.firstAnchor + own];
  vec3 a = vertices[chunk.firstVertex + anchor.a].position, b = vertices[chunk.firstVertex + anchor.b].position,
       c = vertices[chunk.firstVertex + anchor.c].position;
  vec3 position = a + anchor.toB * (b - a) + anchor.toC * (c - a);

  // Sparser where it is farther away: of the anchors within the same part of the screen there are always as many, and the
  // last ones come and go by their size (FORMULAS 23). Both eyes have the same, from the middle between them.
  int view = viewIndex();
  bool isParallel = VIEW_FIELD(orthographic, view) != 0.0;
  float metresOfPixel = 2.0 * abs(VIEW_FIELD(ndcToEyeRay, view).y) / frame.imageSize.y *
                        (isParallel ? 1.0 : distance(frame.viewer, position));
  float wanted = u.spacing * metresOfPixel;
  float grown = smoothstep(0.8, 1.3, anchor.spacing * chunk.scale / wanted);
  if (grown <= 0.0) return;
  // It fades where the surface turns away (FORMULAS 22).
  vec3 normal = cross(b - a, c - a);
  vec3 toEye = isParallel ? vec3(VIEW_FIELD(worldToEye, view)[0][2], VIEW_FIELD(worldToEye, view)[1][2], VIEW_FIELD(worldToEye, view)[2][2])
                          : VIEW_FIELD(eye, view) - position;
  float facing = abs(dot(normal, toEye)) * inversesqrt(max(dot(normal, normal) * dot(toEye, toEye), 1e-37));
  vec4 clip = VIEW_FIELD(worldToClip, view) * vec4(position, 1.0);
  if (clip.w <= 1e-6) return;
  vec2 at = (clip.xy / clip.w + 1.0) * 0.5 * frame.imageSize;
  float radius = u.spacing * u.size * grown;
  if (any(lessThan(at, vec2(-radius))) || any(greaterThan(at, frame.imageSize + radius))) return;
  // Hidden by what is nearer, by how many of a few places around it (section 3.6).
  float eyeDistance = eyeDepth(clip.z / clip.w, view), seen = 0.0;
  for (int i = 0; i < 5; ++i) {
    vec2 beside = i == 0 ? vec2(0.0) : 0.25 * radius * vec2((i & 1) * 2 - 1, (i >> 1 & 1) * 2 - 1);
    ivec2 texel = ivec2(clamp(at + beside, vec2(0.0), frame.imageSize - 1.0));
    seen += eyeDepth(texelFetch(depth, ivec3(texel, view), 0).r, view) > eyeDistance - radius * metresOfPixel ? 0.2 : 0.0;
  }
  float counts = smoothstep(0.0, 0.45, facing) * seen;
  if (counts <= 0.0) return;

  vec4 chance = chanceOf(anchor.seed);
  outChance = chance;
  outStamp = vec4(eyeDistance, radius * metresOfPixel, counts, 6.2831853 * chance.w);
  bool isRight = corner == 1 || corner == 2 || corner == 4, isLow = corner == 2 || corner == 4 || corner == 5;
  outPlace = vec2(isRight ? 1.0 : -1.0, isLow ? 1.0 : -1.0);
  gl_Position = vec4((at + radius * outPlace) / (0.5 * frame.imageSize) - 1.0, 0.5, 1.0);
}
