#version 460
// Before the sort: each draw's key, by its bucket, whether a view sees it, and how far it is; and the shadow casters'
// commands. After it (kGathers): the commands in the order of the keys. All of them are of a level of detail that is off by
// no more than may be, the same for all eyes.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/distance_key.glsl"
#include "../../shading/draws.shared.h"
#include "../../shading/light_space.glsl"
#include "cull.shared.h"

layout(constant_id = kPassId) const bool kGathers = false;

layout(local_size_x = kCullThreads) in;
layout(set = 1, binding = 0, scalar) uniform Cull { CullUniforms cull; };
layout(set = 1, binding = 1, scalar) readonly buffer Commands { DrawCommand commands[]; };
layout(set = 1, binding = 2, scalar) readonly buffer Places { DrawPlace places[]; };
layout(set = 1, binding = 3, scalar) buffer Keys { uint keys[]; };
layout(set = 1, binding = 4, scalar) buffer Order { uint order[]; };
layout(set = 1, binding = 5, scalar) writeonly buffer Seen { DrawCommand seen[]; };
layout(set = 1, binding = 6, scalar) writeonly buffer Casters { DrawCommand casters[]; };
layout(set = 1, binding = 7, scalar) readonly buffer Levels { DrawLevel levels[]; };
layout(set = 1, binding = 8, scalar) writeonly buffer Torn { DrawCommand torn[]; };
layout(set = 1, binding = 9, scalar) writeonly buffer Drawn { DrawnObject drawn[]; };

// As stage/visibility.h has it.
bool mayBeSeen(DrawPlace place, mat4 worldToClip) {
  // Planes as rows of the matrix: what is seen has -w <= x, y <= w and 0 <= z <= w.
  mat4 rows = transpose(worldToClip);
  vec2 reach = 1.0 + cull.margin;
  vec4 planes[6] = {reach.x * rows[3] + rows[0], reach.x * rows[3] - rows[0], reach.y * rows[3] + rows[1],
                    reach.y * rows[3] - rows[1], rows[2],                     rows[3] - rows[2]};
  vec3 center = 0.5 * (place.low + place.high), halfSize = 0.5 * (place.high - place.low);
  bool isOutside = false;
  // Written so that what is not finite is seen.
  for (int p = 0; p < 6; ++p)
    isOutside = isOutside || dot(planes[p].xyz, center) + planes[p].w + dot(abs(planes[p].xyz), halfSize) < 0.0;
  return !isOutside && !(place.low.x > place.high.x);
}

// Whether the place may lie inside what is in the box.
bool encloses(DrawPlace place, vec3 at) {
  vec3 reach = 0.01 * (place.high - place.low);
  return all(greaterThan(at, place.low - reach)) && all(lessThan(at, place.high + reach));
}

// Pixels that a metre takes in a picture where the box is nearest to an eye, and that is nearer by `closer` metres.
float pixelsPerMetre(DrawPlace place, mat4 worldToClip, float closer) {
  mat4 rows = transpose(worldToClip);
  vec3 center = 0.5 * (place.low + place.high), halfSize = 0.5 * (place.high - place.low);
  float nearest = dot(rows[3].xyz, center) + rows[3].w - dot(abs(rows[3].xyz), halfSize) - closer * length(rows[3].xyz);
  // At the edge of a wide lens a metre takes more than in the middle.
  float along = dot(rows[3].xyz, rows[3].xyz);
  vec2 lengths = 0.5 * frame.imageSize *
                 sqrt(vec2(dot(rows[0].xyz, rows[0].xyz), dot(rows[1].xyz, rows[1].xyz)) + along);
  return nearest > 0.0 ? max(lengths.x, lengths.y) / nearest : 1e30;
}

// The most that any eye sees. Those of a rig that are drawn at other times choose alike: by the middle eye, so near as the
// nearest may be.
float pixelsPerMetre(DrawPlace place) {
  float most = pixelsPerMetre(place, frame.worldToCyclopean, cull.rigRadius);
  for (int v = 0; v < kViewCount; ++v) most = max(most, pixelsPerMetre(place, frame.views[v].worldToClip, 0.0));
  return most;
}

// Texels that a metre across the light takes in the shadow map, where it is finest in the box.
float texelsPerMetre(DrawPlace place) {
  mat4 rows = transpose(frame.worldToLight);
  vec3 center = 0.5 * (place.low + place.high), halfSize = 0.5 * (place.high - place.low);
  vec2 middle = vec2(dot(rows[0].xyz, center) + rows[0].w, dot(rows[1].xyz, center) + rows[1].w);
  vec2 reach = vec2(dot(abs(rows[0].xyz), halfSize), dot(abs(rows[1].xyz), halfSize));
  vec2 away = max(abs(middle - frame.shadowCenter) - reach, 0.0);
  vec2 finest = lightSpaceMagnification(frame.shadowWarp * away);
  vec2 texels = 0.5 * cull.mapSize * finest * vec2(length(rows[0].xyz), length(rows[1].xyz));
  return max(texels.x, texels.y);
}

// A draw's command with the fewest triangles that are off by less than the error, and how far its surface is, metres.
DrawCommand leveled(DrawCommand command, DrawPlace place, int what, out float off) {
  off = 0.0;
  bool castsShadows = what == kLevelCasts;
  float perMetre = castsShadows ? texelsPerMetre(place) : pixelsPerMetre(place);
  float most = what == kLevelTorn ? kTearHides * cull.error : cull.error;
  uint textures = place.textures | cull.textures;
  bool textured = (textures & (castsShadows ? kTexturesCut : kTexturesColor)) != 0u;
  for (uint l = 0u; l < place.levels; ++l) {
    DrawLevel level = levels[place.firstLevel + l];
    float error = castsShadows ? level.shadowError : level.error;
    bool isBent = castsShadows && level.longestEdge * place.scale > cull.longestEdge;
    if (textured) error = max(error, level.textureError);
    if (error * place.scale * perMetre < most && !isBent)
      command.indexCount = level.indexCount, command.firstIndex = level.firstIndex,
      off = level.shadowError * place.scale;
  }
  return command;
}

void main() {
  uint i = (gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x) * kCullThreads + gl_LocalInvocationID.x;
  if (i >= cull.draws) return;
  uint unseenBit = 1u << (cull.bucketShift - 1u);
  if (kGathers) {
    DrawPlace place = places[order[i]];
    DrawCommand command = commands[order[i]];
    if ((keys[i] & unseenBit) != 0u) command.instanceCount = 0u;
    float off;
    torn[i] = leveled(command, place, kLevelTorn, off);
    seen[i] = leveled(command, place, kLevelSeen, off);
    bool hidesBacks = place.isClosed != 0u;
    for (int v = 0; v < kViewCount; ++v) hidesBacks = hidesBacks && !encloses(place, frame.views[v].eye);
    drawn[command.firstInstance] = DrawnObject(off, uint(hidesBacks));
    return;
  }
  DrawPlace place = places[i];
  float off;
  casters[i] = leveled(commands[i], place, kLevelCasts, off);
  bool isSeen = false;
  for (int v = 0; v < kViewCount; ++v) isSeen = isSeen || mayBeSeen(place, frame.views[v].worldToClip);
  uint distance = distanceKey(0.5 * (place.low + place.high)) >> (33u - cull.bucketShift);
  keys[i] = place.bucket << cull.bucketShift | (isSeen ? 0u : unseenBit) | distance;
  order[i] = i;
}
