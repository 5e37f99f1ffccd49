#version 460
// The picture in watercolour: its colours become amounts of pigment, which gather, settle, thin and run as wet paint does,
// and lie on paper.
#extension GL_GOOGLE_include_directive : require
#include "../../../shading/on_screen.glsl"
#include "../../../shading/sphere.glsl"
#include "../watercolor.shared.h"
#include "wash.glsl"

layout(constant_id = 0) const int kSlopes = 0;  // kSlopesOfRelief ...
layout(constant_id = 1) const bool kTinted = false;  // stamps have colours of their own
layout(set = 1, binding = 0, scalar) uniform Block { WashUniforms u; };
layout(set = 1, binding = kWashPicture) uniform sampler2DArray soFar;
layout(set = 1, binding = kWashDensity) uniform sampler2DArray blurred;
layout(set = 1, binding = kWashPigment) uniform sampler2DArray pigment;
layout(set = 1, binding = kWashLight) uniform sampler2DArray light;
layout(set = 1, binding = kWashTint) uniform sampler2DArray tints;
layout(set = 1, binding = kWashPaper) uniform sampler2D paper;
layout(set = 1, binding = kWashBroad) uniform sampler2D broadly;  // the same, without what is fine
layout(set = 1, binding = kWashNormals) uniform sampler2D normals;
#include "paper.glsl"

// Heights to the right and below, against here.
const float kReliefSlope = 6.0;  // of the paper's normal, where such a difference is 1
vec2 slopeOf(OnScreen on, float height, vec2 own, int layer) {
  if (kSlopes == kNoSlopes) return vec2(0.0);
  if (kSlopes == kSlopesOfRelief)
    return vec2(heightOf(placeOnPaper(own, vec2(u.slopeStep, 0.0), layer)), heightOf(placeOnPaper(own, vec2(0.0, u.slopeStep), layer))) - height;
  vec3 normal = 2.0 * lookUp(normals, vec4(0.5, 0.5, 0.5, 0.0), on, 1.0, vec2(0.0)).rgb;
  return vec2(-normal.x, normal.y) / (max(normal.z, 0.05) * kReliefSlope);
}

// Where the light on the paper comes from, seen from a place on it: x right, y down, z to the viewer.
vec3 towardsLight(vec2 place, vec2 ndc, int layer) {
  if (!kOnSphere) return u.paperLight - vec3(ndc, 0.0);
  // On a sphere from above: light that came from the scene's side would lie flat on it there, and opposite.
  vec2 side = upOnSphere(lookThrough(place, layer)) * vec2(1.0, -1.0);
  return vec3(0.5 * u.paperLight.z * side * inversesqrt(max(dot(side, side), 1e-6)), u.paperLight.z);
}

vec4 shade(ivec2 pixel, int layer) {
  vec2 own = vec2(pixel) + 0.5;
  // The paper's height here and beside it.
  vec2 inFrame = own - VIEW_FIELD(aside, layer);
  OnScreen on = placeOnPaper(own, vec2(0.0), layer);
  float height = heightOf(on);
  vec2 slope = slopeOf(on, height, own, layer), broad = broadOf(on);

  // Edges of colour wobble with the relief (section 4.1).
  vec2 at = own + u.wobble * clamp(5.0 * slope + 2.5 * broad, -1.5, 1.5);
  vec2 uv = clamp(at, vec2(0.5), frame.imageSize - 0.5) / frame.imageSize;
  vec4 color = textureLod(soFar, vec3(uv, layer), 0.0);
  vec3 density = densityOf(onPaper(color, u.white), u.white), around = textureLod(blurred, vec3(uv, layer), 0.0).rgb;
  vec3 brush = textureLod(pigment, vec3(uv, layer), 0.0).rgb * 2.0 - 1.0;

  // Wet washes run into each other, dry ones stop.
  float wet = smoothstep(-0.15, 0.45, brush.z + 1.2 * broad.x);
  vec3 wash = mix(density, around, u.bleeding * wet);
  // Pigment gathers where a wash dries last: just inside of its border.
  wash += u.edges * (1.0 - 0.8 * wet) * max(density - around, 0.0);
  // What is dark is several washes, one over the other.
  float amount = dot(wash, vec3(1.0 / 3.0));
  wash *= 1.0 + u.glazing * smoothstep(0.35, 0.9, amount);
  if (kTinted) {
    // Another pigment, as much as there is of the wash's own.
    vec4 tint = textureLod(tints, vec3(uv, layer), 0.0);
    vec3 other = densityOf(tint.rgb / max(tint.a, 1e-3) * u.white, u.white);
    wash = mix(wash, other * (dot(wash, vec3(1.0)) / max(dot(other, vec3(1.0)), 0.02)), tint.a);
  }
  // More and less of it, warmer and cooler, as the brush had it. Hue wanders more than value.
  wash *= max(1.0 + u.turbulence * (brush.x + broad.y), 0.0);
  wash *= exp(u.hue * brush.y * vec3(-0.55, 0.05, 0.75));
  // Where light falls full on, the paper stays free.
  vec2 lit = textureLod(light, vec3(uv, layer), 0.0).ra;
  float bare = lit.y > 0.0 ? smoothstep(u.bareFrom, 1.0, lit.x / lit.y + 0.35 * brush.x + 0.3 * broad.x - 0.08) : 0.0;
  wash *= 1.0 - u.bare * bare;
  // It settles in valleys, and a dry brush leaves ridges free.
  float thin = 1.0 - smoothstep(0.1, 0.8, amount);
  wash *= max(1.0 - 2.2 * u.granulation * height * (0.4 + 0.6 * (1.0 - thin)), 0.0);
  wash *= 1.0 - u.dryBrush * thin * smoothstep(0.02, 0.2, height + 0.25 * brush.x - 0.1 * wet);
  // The painting runs out before the frame ends, in an edge of its own.
  float margin = max(u.margin, 1e-6), beyond = withinMargin(inFrame, broad, height);
  float ends = smoothstep(0.0, 0.22 * margin, beyond);
  wash *= ends * (1.0 + 0.8 * u.edges * ends * (1.0 - smoothstep(0.0, 0.5 * margin, beyond)));
  vec3 result = u.white * exp(-u.strength * wash);
  // Light on the paper (section 4.2): as bright on the whole as without relief.
  vec3 towards = towardsLight(own, inFrame / frame.imageSize * 2.0 - 1.0, layer);
  vec3 normal = normalize(vec3(-u.relief * kReliefSlope * slope, 1.0));
  result *= clamp(dot(normal, normalize(towards)) / max(normalize(towards).z, 0.2), 0.0, 1.35);
  return vec4(result, 1.0);
}

#include "../../../shading/image_pass.glsl"
