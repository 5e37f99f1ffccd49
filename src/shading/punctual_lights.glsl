// Light of the scene's point and spot lights: the distance and the cone as KHR_lights_punctual has them. Their colour does
// not count.
#ifndef SCUMBLE_PUNCTUAL_LIGHTS_GLSL
#define SCUMBLE_PUNCTUAL_LIGHTS_GLSL

// Light of one of them on a surface that faces it; and the direction to it, unit.
float lampAt(int i, vec3 point, out vec3 towards) {
  vec3 away = lights[i].position - point;
  float squared = max(dot(away, away), 1e-12);
  towards = away * inversesqrt(squared);
  float part = squared * lights[i].inverseRangeSquared;
  float window = clamp(1.0 - part * part, 0.0, 1.0);
  float cone = clamp(lights[i].coneOffset - lights[i].coneScale * dot(towards, lights[i].direction), 0.0, 1.0);
  return lights[i].strength * window * cone * cone / squared;
}

// Of all of them, with Lambert's term.
float punctualLight(vec3 point, vec3 normal) {
  float sum = 0.0;
  for (int i = 0; i < lights.length(); ++i) {
    vec3 towards;
    float light = lampAt(i, point, towards);
    sum += light * max(dot(normal, towards), 0.0);
  }
  return sum;
}

// Of all of them, as a vector: its dot product with a normal is light that comes from before a surface, less what comes
// from behind.
vec3 punctualLightVector(vec3 point) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < lights.length(); ++i) {
    vec3 towards;
    float light = lampAt(i, point, towards);
    sum += light * towards;
  }
  return sum;
}
#endif
