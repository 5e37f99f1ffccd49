// Blended surfaces and what shows through them, which are at two distances and have become one colour.
#ifndef SCUMBLE_BLENDED_PARTS_GLSL
#define SCUMBLE_BLENDED_PARTS_GLSL
#include "frame.glsl"

// Square roots of straight colours, as which they were mixed.
struct BlendedParts {
  float share;  // of what is before
  vec3 before, behind;
};

// `root`: of the picture; `own` and `covered`: of the blended surfaces alone, and of the pixel what they cover.
BlendedParts blendedParts(vec3 root, float coverage, vec3 own, float covered) {
  BlendedParts parts;
  parts.share = clamp(covered / max(coverage, 1e-6), 0.0, 1.0);
  // What is opaque has its colour in the picture alone.
  float opaque = smoothstep(0.5, 1.0, parts.share);
  parts.before = mix(own, root, opaque);
  parts.behind = mix(max(root - parts.share * parts.before, 0.0) / max(1.0 - parts.share, 1e-3), root, opaque);
  return parts;
}

vec3 mixedColor(BlendedParts parts) {
  vec3 mixed = mix(parts.behind, parts.before, parts.share);
  return mixed * mixed;
}

// Metres along the view axis, where there are any.
float blendedDistanceOf(vec4 distances) {
  return distances.r / max(distances.g, 1e-6) * frame.sceneRadius;
}
#endif
