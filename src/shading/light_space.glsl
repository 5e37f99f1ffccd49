// The shadow map's sigmoid warp: light-space x and y are bent so that texels are finest around a centre (paper 000,
// section 5, "Depth Pass"; FORMULAS 13). The algebraic sigmoid t / sqrt(1 + t^2), scaled to keep the borders in place, and
// beyond the paper a part of the even map, so that no place is ever coarser than that part allows.
#ifndef SCUMBLE_LIGHT_SPACE_GLSL
#define SCUMBLE_LIGHT_SPACE_GLSL

// The sigmoid's argument, linear in position: vertices compute it, fragments interpolate it.
vec2 sigmoidArgument(vec2 p) { return frame.shadowWarp * (p - frame.shadowCenter); }

// Texture coordinates in the shadow map.
vec2 shadowMapUv(vec2 argument) {
  return frame.shadowScale * argument * inversesqrt(1.0 + argument * argument) + frame.shadowEven * argument +
         frame.shadowShift;
}

// d(warped) / d(unwarped), per axis, from -1 to 1 on both: how much finer the map is there.
vec2 lightSpaceMagnification(vec2 argument) {
  vec2 root = inversesqrt(1.0 + argument * argument);
  return 2.0 * frame.shadowWarp * (frame.shadowScale * root * root * root + frame.shadowEven);
}
#endif
