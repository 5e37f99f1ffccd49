// Noise in space.
#ifndef SCUMBLE_NOISE_GLSL
#define SCUMBLE_NOISE_GLSL

// Of integers (Jarzynski and Olano 2020, "Hash functions for GPU rendering", pcg3d), from 0 to 1.
vec3 hashOf(ivec3 cell) {
  uvec3 v = uvec3(cell) * 1664525u + 1013904223u;
  v.x += v.y * v.z, v.y += v.z * v.x, v.z += v.x * v.y;
  v ^= v >> 16u;
  v.x += v.y * v.z, v.y += v.z * v.x, v.z += v.x * v.y;
  return vec3(v >> 8u) * (1.0 / 16777216.0);
}

// Value noise with a mean of 0 and a deviation of about 1.
float noiseAt(vec3 place) {
  vec3 cell = floor(place), t = place - cell;
  t = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
  ivec3 low = ivec3(cell);
  float corners[8];
  for (int i = 0; i < 8; ++i) corners[i] = hashOf(low + ivec3(i & 1, i >> 1 & 1, i >> 2)).x;
  vec4 along = mix(vec4(corners[0], corners[2], corners[4], corners[6]), vec4(corners[1], corners[3], corners[5], corners[7]), t.x);
  vec2 across = mix(along.xz, along.yw, t.y);
  return (mix(across.x, across.y, t.z) - 0.5) * 5.6;
}

// The same with marks of `size` at any size: two octaves, blended so that their deviation stays (FORMULAS 2).
float scaledNoise(vec3 place, float size, vec3 shift) {
  float level = log2(max(size, 1e-20)), octave = floor(level), part = level - octave;
  float fine = noiseAt(place * exp2(-octave) + shift), coarse = noiseAt(place * exp2(-octave - 1.0) + shift);
  return mix(fine, coarse, part) * inversesqrt(part * part + (1.0 - part) * (1.0 - part));
}
#endif
