#version 460
// Round ends.
layout(location = 0) in vec2 inPlace;
layout(location = 1) flat in vec3 inForm;

void main() {
  float t = clamp(inPlace.x / max(inForm.x, 1e-20), 0.0, 1.0);
  if (length(inPlace - vec2(t * inForm.x, 0.0)) > mix(inForm.y, inForm.z, t)) discard;
}
