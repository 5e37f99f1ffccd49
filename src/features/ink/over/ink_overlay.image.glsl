#version 460
// Ink and found lines as an overlay of the picture, with their distance (frame/roles.h).
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/byte_bits.glsl"
#include "../../../shading/frame.glsl"
#include "../../../shading/tiles.shared.h"
#include "ink_over.shared.h"

layout(constant_id = 1) const bool kInMetres = false;  // widths of lines are
layout(constant_id = 2) const int kLines = 0;           // bits of kinds, and kReach
layout(set = 1, binding = 0, scalar) uniform Block { InkOverUniforms u; };
layout(set = 1, binding = kInkOverlayStrokes) uniform sampler2DArray strokes;
layout(set = 1, binding = kInkOverlayTiles) uniform sampler2DArray tiles;
layout(set = 1, binding = kInkOverlayLight) uniform sampler2DArray light;
layout(set = 1, binding = kInkOverlayDepth) uniform sampler2DArray depth;
layout(set = 1, binding = kInkOverlayPieces) uniform sampler2DArray pieces;
layout(set = 1, binding = kInkOverlayNearness) uniform sampler2DArray nearness;
#include "ink_found.glsl"

const float kFarthest = 6e4;  // radii of the scene, which halves hold

void shadeTwo(ivec2 pixel, int layer, out vec4 first, out vec4 second) {
  vec4 near = texelFetch(nearness, ivec3(pixel, layer), 0);
  float metres = frame.sceneRadius * near.g / max(near.r, 1e-9);
  vec4 ink = withFoundLines(texelFetch(strokes, ivec3(pixel, layer), 0), pixel, vec2(pixel) + 0.5, layer, metres);
  first = vec4(clamp(ink.a - ink.rgb, 0.0, 1.0), ink.a);
  second = ink.a * vec4(min(metres / frame.sceneRadius, kFarthest), 1.0, 0.0, 0.0);
}

#define SHADES_TWO
#include "../../../shading/image_pass.glsl"
