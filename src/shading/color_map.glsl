// Evaluates a ColorMap: from the square root of a linear colour to that of another.
#ifndef SCUMBLE_COLOR_MAP_GLSL
#define SCUMBLE_COLOR_MAP_GLSL

vec3 applyColorMap(ColorMap map, vec3 root) {
  vec3 c = map.terms[0] + root.r * map.terms[1] + root.g * map.terms[2] + root.b * map.terms[3];
  vec3 squares = root * root, products = root * root.gbr;
  c += squares.r * map.terms[4] + squares.g * map.terms[5] + squares.b * map.terms[6];
  c += products.r * map.terms[7] + products.g * map.terms[8] + products.b * map.terms[9];
  return max(c, vec3(0.0));
}
#endif
