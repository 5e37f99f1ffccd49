#version 460
// Shadow shapes: the blurred light is thresholded to a hard, rounded edge; inside the dark an inner glow; where the
// breakup map is set, more steps (paper 000, section 5.1).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_multiview : require
#extension GL_EXT_scalar_block_layout : require
#include "final_shadow.shared.h"

layout(set = 1, binding = 0, scalar) uniform Block { FinalShadowUniforms u; };
layout(set = 1, binding = 1) uniform sampler2DArray blurred;
layout(set = 1, binding = 2) uniform sampler2DArray shadow;

// Blurred light, free of the background.
float blurredLight(vec2 at, int layer) {
  vec4 b = textureLod(blurred, vec3(at, layer), 0.0);
  return b.r / max(b.a, 1e-3);
}

vec4 shade(ivec2 pixel, int layer) {
  vec4 own = texelFetch(shadow, ivec3(pixel, layer), 0);
  if (own.a <= 0.0) return vec4(0.0);
  own.rgb /= own.a;
  vec2 texel = 1.0 / vec2(textureSize(shadow, 0).xy);
  vec2 at = (vec2(pixel) + 0.5) * texel;
  float light = mix(own.r, blurredLight(at, layer), u.blurAmount);

  // FORMULAS 15: the edge is about `softness` pixels wide, whatever the slope of the blurred image.
  vec2 dx = vec2(texel.x, 0.0), dy = vec2(0.0, texel.y);
  float slope = 0.5 * length(vec2(blurredLight(at + dx, layer) - blurredLight(at - dx, layer),
                                  blurredLight(at + dy, layer) - blurredLight(at - dy, layer)));
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
