// Where a point of the world lies in the shadow map.
vec4 shadowMapPosition(vec3 world) {
  vec3 p = (frame.worldToLight * vec4(world, 1.0)).xyz;
  return vec4(shadowMapUv(sigmoidArgument(p.xy)) * 2.0 - 1.0, p.z, 1.0);
}
