#version 460
// The picture: the colour pass warped by the warp pass, over the picture behind everything if there is one, with bloom
// from the lens channel.
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "../../shading/color_map.glsl"
#include "../../shading/displacement.glsl"
#include "../../shading/luminance.shared.h"
#include "../../shading/oklab.glsl"
#include "final_color.shared.h"

layout(constant_id = 0) const int kOptions = 3;   // kFinalColorGlows, kFinalColorTorn, kFinalColorMixes
layout(constant_id = 1) const int kRipple = 0;    // of displacement.shared.h; layered: there is what lies behind
layout(constant_id = 2) const int kBackdrop = 0;  // kBackdropIsThere ...; 0: there is no picture behind everything
const bool kLayered = kRipple == kRippleLayered;
layout(set = 1, binding = 0, scalar) uniform Block { FinalColorUniforms u; };
layout(set = 1, binding = kFinalColorColor) uniform sampler2DArray color;
layout(set = 1, binding = kFinalColorInflated) uniform sampler2DArray inflated;
layout(set = 1, binding = kFinalColorWarp) uniform sampler2DArray warp;
layout(set = 1, binding = kFinalColorDepth) uniform sampler2DArray depth;
layout(set = 1, binding = kFinalColorBloom) uniform sampler2DArray glow;
layout(set = 1, binding = kFinalColorBehind) uniform sampler2DArray behind;
layout(set = 1, binding = kFinalColorBehindDepth) uniform sampler2DArray behindDepth;
layout(set = 1, binding = kFinalColorLight) uniform sampler2DArray finalShadow;
layout(set = 1, binding = kFinalColorLit) uniform sampler2DArray lit;
layout(set = 1, binding = kFinalColorBehindLight) uniform sampler2DArray behindShadow;
layout(set = 1, binding = kFinalColorBehindLit) uniform sampler2DArray behindLit;
layout(set = 1, binding = kFinalColorBackdrop) uniform sampler2D backdrop;
layout(set = 1, binding = kFinalColorTear) uniform sampler2D tear;
#include "../../shading/on_screen.glsl"
#include "backdrop.glsl"

// A colour from a place, or from behind the pixel, over the picture behind everything.
vec4 withBackdrop(vec4 result, bool isBehind, ivec2 pixel, vec2 place, int layer) {
  float matte = isBehind ? matteShadowBehind(pixel, layer) : matteShadow(place, layer);
  float nearest = texelFetch(depth, ivec3(ivec2(place), layer), 0).r;
  if (isBehind) nearest = texelFetch(behindDepth, ivec3(pixel, layer), 0).r;
  vec2 at = backdropPlace(pixel, isBehind ? vec2(pixel) + 0.5 : place, layer);
  return overBackdrop(result, matte, eyeDepth(nearest, layer), at, layer);
}

vec4 shade(ivec2 pixel, int layer) {
  vec2 own = vec2(pixel) + 0.5;
  vec4 result = vec4(0.0);
  if ((kOptions & kFinalColorTorn) == 0) {
    result = texelFetch(color, ivec3(pixel, layer), 0);
    if (kBackdrop != 0) result = withBackdrop(result, false, pixel, own, layer);
  } else {
    Places places = displaced(u.displacement, kRipple, (kOptions & kFinalColorMixes) != 0, warp, inflated, depth, behindDepth, pixel, layer);
    for (int i = 0; i < kPlaces; ++i) {
      vec4 there = textureLod(color, vec3(places.at[i] / frame.imageSize, layer), 0.0);
      bool isBehind = kLayered && places.isBehind[i];
      if (isBehind) there = texelFetch(behind, ivec3(pixel, layer), 0);
      if (kBackdrop != 0) there = withBackdrop(there, isBehind, pixel, places.at[i], layer);
      result += there / float(kPlaces);
    }
  }
  // Roots, so that a small lamp has a glow as well.
  if ((kOptions & kFinalColorGlows) != 0)
    result.rgb += u.bloom * sqrt(textureLod(glow, vec3(own / frame.imageSize, layer), 0.0).r) * result.a;
  return result;
}

#define SHADES_TILES
#include "../../shading/image_pass.glsl"
