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
    covers *= smoothstep(0.55, 0.65, mark);
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
