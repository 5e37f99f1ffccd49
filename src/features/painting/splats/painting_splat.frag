#version 460
// What a brush leaves within a splat. Marks of bristles lie where they lie on the stroke, so that splats of one stroke agree.
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/frame.glsl"
#include "../../../shading/view_index.glsl"
#include "../painting.shared.h"

layout(set = 1, binding = kPaintingBlock, scalar) uniform Block { PaintingUniforms u; };
layout(set = 2, binding = kPaintingDepth) uniform sampler2DArray depth;
layout(set = 2, binding = kPaintingBristles) uniform sampler2D bristles;

layout(location = 0) in vec2 inPlace;
layout(location = 1) flat in vec4 inColor;
layout(location = 2) flat in vec4 inStroke;
layout(location = 3) flat in vec2 inDepth;
layout(location = 4) flat in int inBrush;

layout(location = 0) out vec4 outPaint;

// Drops, at most one in each cell of a grid on the stroke.
float dropsAt(vec2 onStroke) {
  const float kCells = 2.2;  // a radius
  vec2 place = kCells * onStroke, cell = floor(place);
  uvec2 key = uvec2(ivec2(cell)) + uint(inStroke.w * 65536.0);
  uint h = key.x * 0x9E3779B9u ^ key.y * 0x85EBCA6Bu;
  h = (h ^ h >> 15) * 0x2C1B3C6Du;
  h = (h ^ h >> 12) * 0x297A2D39u;
  vec4 chance = unpackUnorm4x8(h ^ h >> 15);
  float size = mix(0.08, 0.34, chance.z * chance.z);
  vec2 middle = mix(vec2(size), vec2(1.0 - size), chance.xy);
  float soft = kCells / max(inStroke.z, 1.0);
  return 1.0 - smoothstep(size - soft, size + 0.01, distance(place - cell, middle));
}

void main() {
  float away = length(inPlace), pixels = inStroke.z;
  float covers = clamp((1.0 - away) * pixels + 0.5, 0.0, 1.0);
  // Radii from the stroke's beginning, and across.
  vec2 onStroke = vec2(inStroke.x + inPlace.x, inPlace.y);
  float mark = texture(bristles, vec2(0.03 * onStroke.x + inStroke.w, 0.31 * onStroke.y + 7.0 * inStroke.w)).r;
  vec3 root = inColor.rgb;
  float soft = max(1.0 - away * away, 0.0);
  if (inBrush == kBristles) {
    float ends = 1.0 - smoothstep(0.0, max(u.dryEnds, 1e-3), inStroke.y - inPlace.x);
    float dry = u.streaks * (0.35 + 0.65 * max(smoothstep(0.0, 1.0, abs(onStroke.y)), ends));
    covers *= smoothstep(dry - 0.25, dry + 0.05, mark + 0.45);
    root *= 1.0 + u.variation * (mark - 0.5);
  } else if (inBrush == kWash) {
    covers = 0.35 * soft * soft;
  } else if (inBrush == kSpatter) {
    covers *= dropsAt(onStroke);
  } else if (inBrush == kLight) {
    covers = soft * soft * soft;
  }
  // Hidden where it lies too far behind what is seen.
  float there = eyeDepth(texelFetch(depth, ivec3(gl_FragCoord.xy, viewIndex()), 0).r, viewIndex());
  float behind = inDepth.x - there;
  covers *= 1.0 - smoothstep(0.5 * inDepth.y, max(inDepth.y, 1e-6 * inDepth.x), behind);
  float alpha = covers * inColor.a;
  if (alpha <= 0.0) discard;
  outPaint = vec4(root * alpha, inBrush == kLight ? 0.25 * alpha : alpha);
}
