#version 460
// How far the painting reaches, for what is drawn over it: to where half of a wash is left.
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/on_screen.glsl"
#include "../watercolor.shared.h"

layout(set = 1, binding = 0, scalar) uniform Block { WashUniforms u; };
layout(set = 1, binding = kExtentPaper) uniform sampler2D paper;
layout(set = 1, binding = kExtentBroad) uniform sampler2D broadly;
#include "paper.glsl"

vec4 shade(ivec2 pixel, int layer) {
  vec2 own = vec2(pixel) + 0.5;
  OnScreen on = placeOnPaper(own, vec2(0.0), layer);
  float beyond = withinMargin(own - VIEW_FIELD(aside, layer), broadOf(on), heightOf(on));
  return vec4(smoothstep(0.08, 0.14, beyond / max(u.margin, 1e-6)), 0.0, 0.0, 1.0);
}

#include "../../../shading/image_pass.glsl"
