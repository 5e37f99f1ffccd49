#version 460
// Shadow shapes: the blurred light is thresholded to a hard, rounded edge; inside the dark an inner glow; where the
// breakup map is set, more steps (paper 000, section 5.1).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_multiview : require
#include "../../shading/frame.glsl"
#include "final_shadow.shared.h"

layout(set = 1, binding = 0, scalar) uniform Block { FinalShadowUniforms u; };
layout(set = 1, binding = 1) uniform sampler2DArray blurred;
layout(set = 1, binding = 2) uniform sampler2DArray shadow;
layout(set = 1, binding = 3) uniform sampler2DArray depthBuffer;

float lightOf(vec4 b) { return b.r / max(b.a, 1e-3); }

// Blurred light at a full-size pixel: of the four texels around it, those at its own depth count.
float blurredLight(vec2 at, float depth, int layer) {
  vec2 texel = at * vec2(textureSize(blurred, 0).xy) - 0.5;
  ivec2 corner = ivec2(floor(texel)), last = textureSize(blurred, 0).xy - 1;
  vec2 f = texel - vec2(corner);
  float sum = 0.0, weights = 0.0;
  for (int i = 0; i < 4; ++i) {
    ivec2 offset = ivec2(i & 1, i >> 1);
    vec4 b = texelFetch(blurred, ivec3(clamp(corner + offset, ivec2(0), last), layer), 0);
    vec2 side = mix(1.0 - f, f, vec2(offset));
    float z = (b.b - depth) / depth;
    float weight = side.x * side.y * max(exp(-z * z * u.depthFalloff), 1e-4) * (b.a + 1e-4);
    sum += weight * lightOf(b);
    weights += weight;
  }
  return sum / weights;
}

vec4 shade(ivec2 pixel, int layer) {
  vec4 own = texelFetch(shadow, ivec3(pixel, layer), 0);
  if (own.a <= 0.0) return vec4(0.0);
  own.rgb /= own.a;
  vec2 texel = 1.0 / vec2(textureSize(shadow, 0).xy);
  vec2 at = (vec2(pixel) + 0.5) * texel;
  float depth = min(eyeDepth(texelFetch(depthBuffer, ivec3(pixel, layer), 0).r, layer), 60000.0);
  float light = mix(own.r, blurredLight(at, depth, layer), u.blurAmount);

  // FORMULAS 15: the edge is about `softness` pixels wide, whatever the slope of the blurred image.
  vec2 dx = vec2(texel.x, 0.0), dy = vec2(0.0, texel.y);
  float slope = 0.5 * length(vec2(lightOf(textureLod(blurred, vec3(at + dx, layer), 0.0)) -
                                      lightOf(textureLod(blurred, vec3(at - dx, layer), 0.0)),
                                  lightOf(textureLod(blurred, vec3(at + dy, layer), 0.0)) -
                                      lightOf(textureLod(blurred, vec3(at - dy, layer), 0.0))));
  float width = max(0.5 * u.softness * slope, 1e-3);
  float lit = smoothstep(u.threshold - width, u.threshold + width, light);

  // Texture indication: the marks push the blurred light over the threshold in a few more steps, each a flat shape.
  float marks = own.b;
  if (marks > 0.0) {
    float pushed = 0.0;
    for (int i = 1; i <= u.indicationSteps; ++i) {
      float step_ = u.threshold + u.indication * (float(i) / float(u.indicationSteps)) * 0.9;
      pushed += smoothstep(step_ - 0.02, step_ + 0.02, light + marks * u.indication) / float(u.indicationSteps);
    }
    lit = max(lit, pushed * smoothstep(0.0, 0.15, light));
  }

  // Inner glow: the inverted blur, clamped, adds light to the interior of the dark, none at its edge.
  float inside = clamp((u.threshold - light) / u.threshold, 0.0, 1.0);
  float result = lit + (1.0 - lit) * u.innerGlow * inside;
  return vec4(result, own.g, marks, own.a);
}

#include "../../shading/image_pass.glsl"
