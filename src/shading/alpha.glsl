// Alpha of a surface, for passes that only need to know where it is (masked and blended materials).
#ifndef SCUMBLE_ALPHA_GLSL
#define SCUMBLE_ALPHA_GLSL

vec2 baseUv(MaterialData material, vec2 uv0, vec2 uv1) {
  vec3 uv = vec3(material.baseUvSet == 1 ? uv1 : uv0, 1.0);
  return vec2(dot(material.baseUvRowU, uv), dot(material.baseUvRowV, uv));
}

// Ends the fragment where a masked surface has a hole, and where a blended one is nearly not there.
void discardHoles(MaterialData material, float alpha, int alphaMode) {
  if (alphaMode == 1 && alpha < material.alphaCutoff) discard;
  if (alphaMode == 2 && alpha < 0.5) discard;
}
#endif
