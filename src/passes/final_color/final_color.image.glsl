#version 460
// The picture: the colour pass warped by the warp pass, with bloom from the lens channel.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/displacement.glsl"
#include "../../shading/frame.glsl"
#include "final_color.shared.h"

layout(constant_id = 0) const int kGlows = 1;    // whether anything in the scene acts on the lens
layout(constant_id = 1) const int kLayered = 0;  // whether there is a colour of what lies behind
layout(set = 1, binding = 0, scalar) uniform Block { FinalColorUniforms u; };
layout(set = 1, binding = 1) uniform sampler2DArray color;
layout(set = 1, binding = 2) uniform sampler2DArray warp;
layout(set = 1, binding = 3) uniform sampler2DArray depth;
layout(set = 1, binding = 4) uniform sampler2DArray blurred;
layout(set = 1, binding = 5) uniform sampler2DArray behind;
layout(set = 1, binding = 6) uniform sampler2DArray behindDepth;

vec4 shade(ivec2 pixel, int layer) {
  Place place = displaced(u.displacement, warp, depth, behindDepth, kLayered != 0, pixel, layer);
  vec4 result = textureLod(color, vec3(place.at / frame.imageSize, layer), 0.0);
  if (kLayered != 0 && place.isBehind) result = texelFetch(behind, ivec3(pixel, layer), 0);
  vec2 own = vec2(pixel) + 0.5;
  if (kGlows != 0) result.rgb += u.bloom * textureLod(blurred, vec3(own / frame.imageSize, layer), 0.0).g * result.a;
  return result;
}

#include "../../shading/image_pass.glsl"
