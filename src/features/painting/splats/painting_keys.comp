#version 460
// How far each splat is from between the eyes: the farthest are the least. Those that are not there come last.
#extension GL_GOOGLE_include_directive : require
#include "../strokes.glsl"

layout(local_size_x = kPaintingThreads) in;
layout(set = 1, binding = kPaintingPlaced, scalar) readonly buffer Placed { PlacedPoint placed[]; };
layout(set = 1, binding = kPaintingOrder, scalar) writeonly buffer Order { uint order[]; };
layout(set = 1, binding = kPaintingKeys, scalar) writeonly buffer Keys { uint keys[]; };
layout(push_constant, scalar) uniform Push { uint count; };

void main() {
  uint i = (gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x) * kPaintingThreads + gl_LocalInvocationID.x;
  if (i >= count) return;
  Splat splat = splats[i];
  PlacedPoint from = placed[splat.point], to = placed[splat.point + (splat.toNext > 0.0 ? 1u : 0u)];
  StrokePoint point = points[splat.point];
  vec3 position = mix(from.position, to.position, splat.toNext);
  float radius = mix(from.radius, to.radius, splat.toNext);
  float time = mix(point.time, points[splat.point + (splat.toNext > 0.0 ? 1u : 0u)].time, splat.toNext);
  Sight sight = sightOf(position, mix(from.tangent, to.tangent, splat.toNext));
  float fade = fadeOf(splat, radius, metresOfPixel(sight.away, 0), sight.sine);
  bool isThere = fade > 0.0 && time <= u.until;
  // Later strokes come forward.
  keys[i] = isThere ? ~distanceKey(position + sight.way * (u.order * radius * point.order)) : 0xFFFFFFFFu;
  order[i] = i;
}
