#version 460
// A brush's stamp at an anchor: a square around it, where the anchor is seen (paper 004, section 3).
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/sphere.glsl"
#include "../../../shading/view_index.glsl"
#include "../watercolor.shared.h"

layout(set = 1, binding = kPigmentBlock, scalar) uniform Block { PigmentUniforms u; };
layout(set = 1, binding = kPigmentAnchors, scalar) readonly buffer Anchors { DrawnAnchor anchors[]; };
layout(set = 1, binding = kPigmentObjects, scalar) readonly buffer Objects { PaintedObject painted[]; };
layout(set = 1, binding = kPigmentVertices, scalar) readonly buffer Vertices { VertexCore vertices[]; };
layout(set = 1, binding = kPigmentMaterials, scalar) readonly buffer Materials { PigmentMaterial pigments[]; };
layout(set = 1, binding = kPigmentDepth) uniform sampler2DArray depth;

layout(location = 0) out vec2 outPlace;        // in the stamp, from -1 to 1
layout(location = 1) flat out vec4 outStamp;   // eye depth, metres that it reaches, how much it counts, its turn
layout(location = 2) flat out vec4 outChance;  // four numbers of its own, 0 to 1
layout(location = 3) flat out float outObject;  // 1 + its id
layout(location = 4) flat out uint outBrush;
layout(location = 5) flat out vec4 outTint;  // colour, and how much of it

uint mixed(uint x) {
  x = (x ^ (x >> 16)) * 0x7FEB352Du;
  x = (x ^ (x >> 15)) * 0x846CA68Bu;
  return x ^ (x >> 16);
}
vec4 chanceOf(uint seed) {
  return vec4(uvec4(seed, seed >> 8, seed >> 16, seed >> 24) & 255u) / 255.0;
}

// By how much what is up on the sphere is turned there against the frame's own up, clockwise: stamps are no other in
// another part of it. 0 where the frame is no part of one.
float turnOnSphere(vec3 inEye) {
  vec2 up = upOnSphere(normalize(inEye));
  return atan(up.x, up.y + 1e-20);
}

// What part of an anchor is seen, of so many places around it (paper 004, section 3.6): the surface goes on there as a
// plane, or turns away, and what is before that hides it. `at`: pixels; `inEye`, `normal`: in eye space.
const int kSeenPlaces = 64;
const float kSeenWithin = 0.7;  // of the stamp's reach
float seenPart(vec2 at, float radius, vec3 inEye, vec3 normal, float pixel, int view) {
  float parallel = VIEW_FIELD(orthographic, view), slope = length(normal.xy) / max(abs(normal.z), 0.05), sum = 0.0;
  vec4 toRay = VIEW_FIELD(ndcToEyeRay, view);
  for (int i = 0; i < kSeenPlaces; ++i) {
    // No two in a row or column, so that an edge hides one after the other.
    vec2 beside = 2.0 * vec2((float(i) + 0.5) / float(kSeenPlaces), fract(0.6180340 * (float(i) + 0.5))) - 1.0;
    beside *= kSeenWithin * radius;
    ivec2 texel = ivec2(clamp(at + beside, vec2(0.0), frame.imageSize - 1.0));
    vec2 ray = ((vec2(texel) + 0.5) / frame.imageSize * 2.0 - 1.0) * toRay.xy + toRay.zw;
    // Along the view axis, where the plane is seen through that pixel.
    float along = dot(normal, vec3(ray, -1.0));
    float plane = mix(dot(normal, inEye) / min(along, -0.05 * length(ray) - 0.05),
                      -(inEye.z - dot(normal.xy, ray - inEye.xy) / max(normal.z, 0.05)), parallel);
    float allowed = pixel * (0.25 * length(beside) + 1.0 + slope);
    float nearest = eyeDepth(texelFetch(depth, ivec3(texel, view), 0).r, view);
    sum += 1.0 - smoothstep(allowed, 2.0 * allowed, plane - nearest);
  }
  return sum / float(kSeenPlaces);
}

void main() {
  gl_Position = vec4(2.0, 2.0, 0.0, 1.0);  // outside
  outPlace = vec2(0.0);
  outStamp = outChance = vec4(0.0);
  outObject = 0.0;
  outBrush = 0u;
  outTint = vec4(0.0);
  int corner = int(uint(gl_VertexIndex) % 6u);
  PaintedObject own = painted[gl_InstanceIndex];
  DrawnAnchor anchor = anchors[own.firstAnchor + uint(gl_VertexIndex) / 6u];
  vec3 a = vertices[own.firstVertex + anchor.a].position, b = vertices[own.firstVertex + anchor.b].position,
       c = vertices[own.firstVertex + anchor.c].position;
  vec3 normal = cross(b - a, c - a);
  float scale = sqrt(0.5 * length(normal) / max(anchor.area, 1e-37));  // as large as it is now, however it got there
  vec3 position = a + anchor.toB * (b - a) + anchor.toC * (c - a);

  // Sparser where it is farther away: of the anchors within the same part of the screen there are always as many, and the
  // last ones come and go by their size (FORMULAS 23). Both eyes have the same, from the middle between them.
  int view = viewIndex();
  float parallel = VIEW_FIELD(orthographic, view);  // mixed and not chosen by: no branch on a uniform
  float pixel = metresOfPixel(distance(frame.viewer, position), view);
  PigmentMaterial pigment = pigments[objects[own.object].material];
  float wanted = u.spacing * pixel * inversesqrt(pigment.density);
  float grown = smoothstep(0.8, 1.3, anchor.spacing * scale / wanted);
  if (grown <= 0.0) return;
  // It fades where the surface turns away, and is not seen from behind (FORMULAS 22; paper 004, section 3.4).
  mat4 toEyeSpace = VIEW_FIELD(worldToEye, view);
  vec3 toEye = mix(VIEW_FIELD(eye, view) - position, vec3(toEyeSpace[0][2], toEyeSpace[1][2], toEyeSpace[2][2]), parallel);
  float facing = dot(normal, toEye) * inversesqrt(max(dot(normal, normal) * dot(toEye, toEye), 1e-37));
  if (objects[own.object].mirrored != 0u) facing = -facing;
  if (own.isSided == 0u) facing = abs(facing);
  vec4 clip = VIEW_FIELD(worldToClip, view) * vec4(position, 1.0);
  if (clip.w <= 1e-6) return;
  vec2 at = (clip.xy / clip.w + 1.0) * 0.5 * frame.imageSize;
  uint number = mixed(anchor.seed ^ mixed(own.seed + u.seed));
  // Other numbers than those of what it lays down.
  vec4 kind = chanceOf(mixed(number ^ 0x9E3779B9u));
  float radius = u.spacing * u.size * grown * exp2((2.0 * kind.x - 1.0) * u.sizes);
  if (any(lessThan(at, vec2(-radius))) || any(greaterThan(at, frame.imageSize + radius))) return;
  float counts = smoothstep(0.0, 0.45, facing) * min(pigment.strength, 1.0);
  if (counts <= 0.0) return;

  vec3 inEye = (toEyeSpace * vec4(position, 1.0)).xyz, towards = mat3(toEyeSpace) * normal;
  towards *= inversesqrt(max(dot(towards, towards), 1e-37));
  if (dot(mat3(toEyeSpace) * toEye, towards) < 0.0) towards = -towards;
  counts *= seenPart(at, radius, inEye, towards, pixel, view);
  if (counts <= 0.0) return;

  vec4 chance = chanceOf(number);
  outChance = chance;
  // More than whole stamps, and paler ones, differ more from what is around them.
  outChance.xyz = 0.5 + (chance.xyz - 0.5) * max(pigment.strength, 1.0);
  outBrush = pigment.brush > 0u ? pigment.brush - 1u : min(uint(kind.y * float(u.brushes)), u.brushes - 1u);
  outTint = vec4(pigment.color, pigment.colorAmount * (0.4 + 0.6 * kind.z));
  outObject = float(objects[own.object].id) + 1.0;
  float turn = turnOnSphere(inEye);
  outStamp = vec4(eyeDepth(clip.z / clip.w, view), radius * pixel, counts, 6.2831853 * chance.w * u.turns - turn);
  bool isRight = corner == 1 || corner == 2 || corner == 4, isLow = corner == 2 || corner == 4 || corner == 5;
  outPlace = vec2(isRight ? 1.0 : -1.0, isLow ? 1.0 : -1.0);
  gl_Position = vec4((at + radius * outPlace) / (0.5 * frame.imageSize) - 1.0, 0.5, 1.0);
}
