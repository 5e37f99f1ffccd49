#version 460
// The picture: the colour pass warped by the warp pass, over the picture behind everything if there is one, with bloom
// from the lens channel.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "../../shading/color_map.glsl"
#include "../../shading/displacement.glsl"
#include "../../shading/luminance.shared.h"
#include "final_color.shared.h"

layout(constant_id = 0) const int kGlows = 1;     // whether anything in the scene acts on the lens
layout(constant_id = 1) const int kRipple = 0;    // of displacement.shared.h; layered: there is what lies behind
layout(constant_id = 2) const int kBackdrop = 0;  // kBackdropIsThere ...; 0: there is no picture behind everything
const bool kLayered = kRipple == kRippleLayered;
layout(set = 1, binding = 0, scalar) uniform Block { FinalColorUniforms u; };
layout(set = 1, binding = kFinalColorColor) uniform sampler2DArray color;
layout(set = 1, binding = kFinalColorWarp) uniform sampler2DArray warp;
layout(set = 1, binding = kFinalColorDepth) uniform sampler2DArray depth;
layout(set = 1, binding = kFinalColorBlurred) uniform sampler2DArray blurred;
layout(set = 1, binding = kFinalColorBehind) uniform sampler2DArray behind;
layout(set = 1, binding = kFinalColorBehindDepth) uniform sampler2DArray behindDepth;
layout(set = 1, binding = kFinalColorLight) uniform sampler2DArray finalShadow;
layout(set = 1, binding = kFinalColorLit) uniform sampler2DArray lit;
layout(set = 1, binding = kFinalColorBehindLight) uniform sampler2DArray behindShadow;
layout(set = 1, binding = kFinalColorBehindLit) uniform sampler2DArray behindLit;
layout(set = 1, binding = kFinalColorBackdrop) uniform sampler2D backdrop;
layout(set = 1, binding = kFinalColorTear) uniform sampler2D tear;
#include "backdrop.glsl"

vec4 shade(ivec2 pixel, int layer) {
  Place place = displaced(u.displacement, kRipple, warp, depth, behindDepth, pixel, layer);
  vec4 result = textureLod(color, vec3(place.at / frame.imageSize, layer), 0.0);
  bool isBehind = kLayered && place.isBehind;
  if (isBehind) result = texelFetch(behind, ivec3(pixel, layer), 0);
  if (kBackdrop != 0) {
    float matte = isBehind ? matteShadowBehind(pixel, layer) : matteShadow(place.at, layer);
    float nearest = texelFetch(depth, ivec3(ivec2(place.at), layer), 0).r;
    if (isBehind) nearest = texelFetch(behindDepth, ivec3(pixel, layer), 0).r;
    vec2 at = backdropPlace(pixel, isBehind ? vec2(pixel) + 0.5 : place.at, layer);
    result = overBackdrop(result, matte, eyeDepth(nearest, layer), at);
  }
  vec2 own = vec2(pixel) + 0.5;
  if (kGlows != 0) result.rgb += u.bloom * textureLod(blurred, vec3(own / frame.imageSize, layer), 0.0).g * result.a;
  return result;
}

#include "../../shading/image_pass.glsl"
