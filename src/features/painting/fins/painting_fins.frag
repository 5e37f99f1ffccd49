#version 460
// Paint as it was captured; a fin fades as it turns away.
#extension GL_GOOGLE_include_directive : require
#define TRANSPARENT
#define TRANSPARENT_TEXTURES
#include "../../../shading/frame.glsl"
#include "../../../shading/material.glsl"
#ifdef DISTANCE
#include "../../../shading/view_index.glsl"
#endif
#include "painting_fins.shared.h"

layout(set = 2, binding = kFinsBlock, scalar) uniform Block { FinsUniforms u; };

layout(location = 0) in vec2 inUv;
layout(location = 1) in vec4 inColor;
layout(location = 2) in vec3 inWorld;
layout(location = 3) in vec3 inNormal;
layout(location = 4) flat in vec2 inFade;
layout(location = 5) flat in ivec3 inSides;

layout(location = 0) out vec4 outPaint;
#ifdef DISTANCE
layout(location = 1) out vec4 outDistance;
#endif

void main() {
  vec4 color = inColor * sampleSlots(ivec4(inSides.x, -1, -1, -1), inUv, 0.0).values[0];
  float alpha = color.a * u.opacity * paintFade(inFade, inWorld, inNormal);
  if (alpha <= 0.0 || (inSides.z != 0 && gl_FrontFacing == (inSides.y != 0))) discard;
  outPaint = vec4(sqrt(clamp(color.rgb, 0.0, 1.0)) * alpha, alpha);
#ifdef DISTANCE
  outDistance = vec4(eyeDepth(gl_FragCoord.z, viewIndex()) / frame.sceneRadius, 1.0, 0.0, 1.0) * alpha;
#endif
}
