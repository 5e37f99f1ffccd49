// Pigment on paper: light goes through it twice, so that amounts of pigment add up in the logarithm.
#ifndef SCUMBLE_WASH_GLSL
#define SCUMBLE_WASH_GLSL
vec3 densityOf(vec3 color, vec3 white) { return -log(clamp(color / max(white, 0.01), 0.004, 1.0)); }
// Where there is nothing, there is paper. `color` is premultiplied.
vec3 onPaper(vec4 color, vec3 white) { return color.rgb + (1.0 - clamp(color.a, 0.0, 1.0)) * white; }
#endif
