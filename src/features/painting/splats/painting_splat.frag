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
#ifdef DISTANCE
layout(location = 1) out vec4 outDistance;
#endif

void main() {
  BrushPlace p = BrushPlace(inPlace, inStroke.x, inStroke.y, inStroke.z, inStroke.w);
  float mark = texture(bristles, bristlesAt(p)).r;
  float covers = brushCovers(inBrush, p, mark, u.streaks, u.dryEnds);
  vec3 root = inColor.rgb;
  if (inBrush == kBristles) root *= 1.0 + u.variation * (mark - 0.5);
  // Hidden where it lies too far behind what is seen.
  float there = eyeDepth(texelFetch(depth, ivec3(gl_FragCoord.xy, viewIndex()), 0).r, viewIndex());
  float behind = inDepth.x - there;
  covers *= 1.0 - smoothstep(0.5 * inDepth.y, max(inDepth.y, 1e-6 * inDepth.x), behind);
  float alpha = covers * inColor.a;
  if (alpha <= 0.0) discard;
  outPaint = vec4(root * alpha, inBrush == kLight ? 0.25 * alpha : alpha);
#ifdef DISTANCE
  outDistance = vec4(inDepth.x / frame.sceneRadius, 1.0, 0.0, 1.0) * alpha;
#endif
}
