// The shadow map's sigmoid warp: light-space x and y are bent so that texels are finest around a centre (paper 000,
// section 5, "Depth Pass"; FORMULAS 13). The algebraic sigmoid t / sqrt(1 + t^2), scaled to keep -1 and 1 in place.
#ifndef SCUMBLE_LIGHT_SPACE_GLSL
#define SCUMBLE_LIGHT_SPACE_GLSL

vec2 warpLightSpace(vec2 p) {
  vec2 t = frame.shadowWarp * (p - frame.shadowCenter);
  return frame.shadowScale * (frame.shadowWarp > 0.0 ? t * inversesqrt(1.0 + t * t) : p) + frame.shadowShift;
}

// d(warped) / d(unwarped), per axis: how much finer the map is there.
vec2 lightSpaceMagnification(vec2 p) {
  vec2 t = frame.shadowWarp * (p - frame.shadowCenter);
  vec2 root = inversesqrt(1.0 + t * t);
  return frame.shadowWarp > 0.0 ? frame.shadowScale * frame.shadowWarp * root * root * root : vec2(1.0);
}
#endif
