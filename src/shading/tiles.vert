#version 460
// Two triangles for each tile that a job runs on, or one pair for a whole block of tiles that it runs on; as near as can
// be, where there is a depth buffer.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_multiview : require
#include "tiles.glsl"

layout(set = 2, binding = 0) uniform sampler2DArray tiles;

void main() {
  const ivec2 kCorners[] = ivec2[](ivec2(0, 0), ivec2(1, 0), ivec2(0, 1), ivec2(0, 1), ivec2(1, 0), ivec2(1, 1));
  int layer = rule.firstView + gl_ViewIndex;
  uint number = uint(gl_VertexIndex) / 6u, across = uint(rule.across);
  ivec2 tile = ivec2(number % across, number / across), size = ivec2(1);
  // What is left out has no area.
  vec4 own = texelFetch(tiles, ivec3(tile, layer), 0);
  bool runs = runsOn(own);
  uint every = bitsOf(own.g), any = bitsOf(own.b);
  if ((every & rule.value) == rule.value && (any & rule.mask & ~rule.value) == 0u) {
    runs = all(equal(uvec2(tile) % uint(kTileBlock), uvec2(0)));
    size = ivec2(kTileBlock);
  }
  vec2 corner = vec2(tile + size * kCorners[uint(gl_VertexIndex) % 6u]) * rule.extent - 1.0;
  gl_Position = vec4(runs ? corner : vec2(2.0), 1.0, 1.0);
}
