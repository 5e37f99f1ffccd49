#version 460
// What lies in a row of pixels as long as a tile.
// Out: the least and the most of the roots of the colours that are seen; A of the second: what was found, in bits.
#extension GL_GOOGLE_include_directive : require
#define OUTPUT_FORMAT rgba8
#define SHADES_TWO
#include "../../shading/byte_bits.glsl"
#include "../../shading/frame.glsl"
#include "../../shading/tiles.shared.h"
#include "tile_steps.shared.h"

layout(constant_id = 0) const int kAir = 1;
layout(constant_id = 1) const bool kBlended = false;  // there may be surfaces that count in colours alone
layout(set = 1, binding = 0, scalar) uniform Block { TilePixels u; };
layout(set = 1, binding = kTileShadow) uniform sampler2DArray shadow;
layout(set = 1, binding = kTileLitColor) uniform sampler2DArray lit;
layout(set = 1, binding = kTileShadowedColor) uniform sampler2DArray shadowed;
layout(set = 1, binding = kTileDepth) uniform sampler2DArray depth;

void shadeTwo(ivec2 pixel, int layer, out vec4 least, out vec4 most) {
  ivec2 last = textureSize(shadow, 0).xy - 1, first = pixel * ivec2(kTileSize, 1);
  vec4 light = vec4(0.0);  // the most of: coverage, what is open, not lit, not dark
  float indicated = 0.0, farthest = 1.0;
  for (int i = 0; i < kTileSize; ++i) {
    ivec3 at = ivec3(min(first + ivec2(i, 0), last), layer);
    vec4 s = texelFetch(shadow, at, 0);
    if (kBlended) s.a = max(s.a, texelFetch(lit, at, 0).a);
    light = max(light, vec4(s.a, 1.0 - s.a, abs(s.a - s.r), s.r));
    indicated = max(indicated, s.b);
    if (kAir != 0) farthest = min(farthest, s.a > 0.0 ? texelFetch(depth, at, 0).r : 1.0);
  }
  bvec4 is = greaterThan(light, vec4(0.0));
  bool isFar = kAir != 0 && eyeDepth(farthest, layer) > u.airStart;
  uvec4 found = uvec4(is) * uvec4(kFoundCovered, kFoundOpen, kFoundNotLit, kFoundNotDark);
  uint bits = found.x | found.y | found.z | found.w | (indicated > 0.0 ? kFoundIndicated : 0u) | (isFar ? kFoundFar : 0u);

  // Colours count where nothing else has told already that there are edges. Loops that do not run cost nothing.
  least = vec4(1.0);
  most = vec4(0.0);
  bool isEdge = is.y || (is.z && is.w) || indicated > 0.0 || isFar;
  int litCount = isEdge || is.z ? 0 : kTileSize, shadowedCount = isEdge || !is.z ? 0 : kTileSize;
  for (int i = 0; i < litCount; ++i) {
    vec4 color = texelFetch(lit, ivec3(min(first + ivec2(i, 0), last), layer), 0);
    least = min(least, color);
    most = max(most, color);
  }
  for (int i = 0; i < shadowedCount; ++i) {
    vec4 color = texelFetch(shadowed, ivec3(min(first + ivec2(i, 0), last), layer), 0);
    least = min(least, color);
    most = max(most, color);
  }
  most.a = channelOf(bits);
}

#include "../../shading/image_pass.glsl"
