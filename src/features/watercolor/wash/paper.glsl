// The paper under a watercolour: its heights, and how far the painting reaches on it. Includers declare `u`, `paper` and
// `broadly`.
#ifndef SCUMBLE_PAPER_GLSL
#define SCUMBLE_PAPER_GLSL

OnScreen placeOnPaper(vec2 place, vec2 beside, int layer) {
  return onScreen(place, beside, u.paperAt[min(layer, 1)], vec2(u.paperSize), u.eyeToPaper, layer);
}
float heightOf(OnScreen on) { return lookUp(paper, vec4(0.5), on, 1.0, vec2(0.0)).r; }
// A coarser part of the same relief, for what goes over larger stretches.
vec2 broadOf(OnScreen on) {
  return vec2(lookUp(broadly, vec4(0.5), on, 0.11, vec2(0.0)).r, lookUp(broadly, vec4(0.5), on, 0.11, vec2(0.37, 0.61)).r);
}

// How far within the painting's edge a place lies, in parts of the picture's height. `inFrame`: pixels.
float withinMargin(vec2 inFrame, vec2 broad, float height) {
  vec2 side = min(inFrame, frame.imageSize - inFrame) / frame.imageSize.y;
  float margin = max(u.margin, 1e-6);
  vec2 inner = max(vec2(3.2 * margin) - side, 0.0);
  return 2.2 * margin - length(inner) + 0.9 * margin * (2.2 * broad.x + 0.8 * broad.y + 0.6 * height);
}
#endif
