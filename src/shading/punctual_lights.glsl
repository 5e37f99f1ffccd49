// Light of the scene's point and spot lights on a surface: Lambert's term, the distance and the cone as
// KHR_lights_punctual has them, summed over all lights. Their colour does not count.
#ifndef SCUMBLE_PUNCTUAL_LIGHTS_GLSL
#define SCUMBLE_PUNCTUAL_LIGHTS_GLSL

float punctualLight(vec3 point, vec3 normal) {
  float sum = 0.0;
  for (int i = 0; i < lights.length(); ++i) {
    vec3 away = lights[i].position - point;
    float squared = max(dot(away, away), 1e-12);
    vec3 towards = away * inversesqrt(squared);
    float part = squared * lights[i].inverseRangeSquared;
    float window = clamp(1.0 - part * part, 0.0, 1.0);
    float cone = clamp(lights[i].coneOffset - lights[i].coneScale * dot(towards, lights[i].direction), 0.0, 1.0);
    sum += lights[i].strength * max(dot(normal, towards), 0.0) * window * cone * cone / squared;
  }
  return sum;
}
#endif
