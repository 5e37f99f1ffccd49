// The shadow map's sigmoid warp: light-space x and y are bent so that texels are finest around a centre (paper 000,
// section 5, "Depth Pass"; FORMULAS 13). The algebraic sigmoid t / sqrt(1 + t^2), scaled to keep -1 and 1 in place.
#ifndef SCUMBLE_LIGHT_SPACE_GLSL
#define SCUMBLE_LIGHT_SPACE_GLSL

float sigmoid(float t) { return t * inversesqrt(1.0 + t * t); }

vec2 warpLightSpace(vec2 p, vec2 center, float strength) {
  if (strength <= 0.0) return p;
  vec2 result;
  for (int i = 0; i < 2; ++i) {
    float low = sigmoid(strength * (-1.0 - center[i])), high = sigmoid(strength * (1.0 - center[i]));
    result[i] = 2.0 * (sigmoid(strength * (p[i] - center[i])) - low) / (high - low) - 1.0;
  }
  return result;
}

// d(warped) / d(unwarped), per axis: how much finer the map is there.
vec2 lightSpaceMagnification(vec2 p, vec2 center, float strength) {
  if (strength <= 0.0) return vec2(1.0);
  vec2 result;
  for (int i = 0; i < 2; ++i) {
    float low = sigmoid(strength * (-1.0 - center[i])), high = sigmoid(strength * (1.0 - center[i]));
    float t = strength * (p[i] - center[i]);
    result[i] = 2.0 * strength * pow(1.0 + t * t, -1.5) / (high - low);
  }
  return result;
}
#endif
