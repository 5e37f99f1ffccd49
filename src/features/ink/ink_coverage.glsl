// How much of a pixel a line covers.
#ifndef SCUMBLE_INK_COVERAGE_GLSL
#define SCUMBLE_INK_COVERAGE_GLSL

// Of half its width, and how far away its middle is, pixels. Lines that are thinner than a pixel are lighter instead.
float coverageOf(float radius, float away) {
  float drawn = max(radius, 0.5);
  return radius / drawn * clamp(drawn - away + 0.5, 0.0, 1.0);
}
#endif
