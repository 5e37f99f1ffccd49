#version 460
// The image half of the Color Pass (shading/surface_color.glsl).
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "../../shading/surface_color.shared.h"
#include "color.shared.h"

layout(constant_id = 0) const int kPart = 0;  // kPartAll ...
layout(constant_id = 1) const bool kHasBlended = false;
layout(set = 1, binding = 0, scalar) uniform Block { SurfaceColors colors; };
layout(set = 1, binding = kColorLight) uniform sampler2DArray finalShadow;
layout(set = 1, binding = kColorLit) uniform sampler2DArray lit;
layout(set = 1, binding = kColorShadowed) uniform sampler2DArray shadowed;
layout(set = 1, binding = kColorDepth) uniform sampler2DArray depth;
layout(set = 1, binding = kColorBlended) uniform sampler2DArray blended;
layout(set = 1, binding = kColorBlendedDistance) uniform sampler2DArray blendedDistance;
#ifdef MULTISAMPLED
layout(set = 1, binding = kColorSampleLight) uniform sampler2DArray sampleLight;
layout(set = 1, binding = kColorLitSamples) uniform sampler2DMSArray litSamples;
layout(set = 1, binding = kColorShadowedSamples) uniform sampler2DMSArray shadowedSamples;
layout(set = 1, binding = kColorDepthSamples) uniform sampler2DMSArray depthSamples;
#endif
#include "../../shading/surface_color.glsl"

#ifdef MULTISAMPLED
bool hasGlowColor() { return true; }
#endif

vec4 shade(ivec2 pixel, int layer) { return colorOf(pixel, layer, kPart); }

#define SHADES_TILES
#include "../../shading/image_pass.glsl"
