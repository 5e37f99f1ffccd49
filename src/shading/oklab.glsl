// OKLab (Ottosson 2020), as src/base/oklab.h has it.
#ifndef SCUMBLE_OKLAB_GLSL
#define SCUMBLE_OKLAB_GLSL

// Cube roots, by a third of the logarithm as the bits have it and two steps of Newton's method (to 2e-6): CPU drivers
// take several times as long for pow(). What is below 1e-10 counts as that.
vec3 cubeRoot(vec3 x) {
  x = max(x, vec3(1e-10));
  vec3 root = uintBitsToFloat(uvec3(vec3(floatBitsToUint(x)) * (1.0 / 3.0)) + 0x2A514067u);
  root = (2.0 * root + x / (root * root)) * (1.0 / 3.0);
  return (2.0 * root + x / (root * root)) * (1.0 / 3.0);
}

// How strongly the eye's three kinds of cones answer.
vec3 conesFromLinear(vec3 c) {
  return vec3(dot(c, vec3(0.4122214708, 0.5363325363, 0.0514459929)),
              dot(c, vec3(0.2119034982, 0.6806995451, 0.1073969566)),
              dot(c, vec3(0.0883024619, 0.2817188376, 0.6299787005)));
}
vec3 oklabFromConeRoots(vec3 lms) {
  return vec3(dot(lms, vec3(0.2104542553, 0.7936177850, -0.0040720468)),
              dot(lms, vec3(1.9779984951, -2.4285922050, 0.4505937099)),
              dot(lms, vec3(0.0259040371, 0.7827717662, -0.8086757660)));
}

vec3 oklabFromLinear(vec3 c) { return oklabFromConeRoots(cubeRoot(conesFromLinear(c))); }

// How much dot(way, OKLab) grows with each cone's answer, where the roots of these are `lms`.
vec3 slopeByCones(vec3 way, vec3 lms) {
  return vec3(dot(way, vec3(0.2104542553, 1.9779984951, 0.0259040371)),
              dot(way, vec3(0.7936177850, -2.4285922050, 0.7827717662)),
              dot(way, vec3(-0.0040720468, 0.4505937099, -0.8086757660))) / (3.0 * lms * lms);
}

// Linear RGB; outside [0, 1] for colours outside sRGB.
vec3 linearFromOklab(vec3 lab) {
  vec3 lms = vec3(lab.x + 0.3963377774 * lab.y + 0.2158037573 * lab.z,
                  lab.x - 0.1055613458 * lab.y - 0.0638541728 * lab.z,
                  lab.x - 0.0894841775 * lab.y - 1.2914855480 * lab.z);
  lms *= lms * lms;
  return vec3(dot(lms, vec3(4.0767416621, -3.3077115913, 0.2309699292)),
              dot(lms, vec3(-1.2684380046, 2.6097574011, -0.3413193965)),
              dot(lms, vec3(-0.0041960863, -0.7034186147, 1.7076147010)));
}
#endif
