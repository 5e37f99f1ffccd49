// What a brush, a pencil or a ballpoint leaves of a line.
//
// All of it follows from a place on the surface under the line, at rest, by noise in space: a walk along the line passes
// marks that are as long on the surface everywhere, whichever chain of edges the line is of and wherever that begins, and a
// turn of the form carries them along. Their size follows from the distance by MetaTexture's rule: the octave whose marks
// have the wanted size on the screen, blended with the next one.
#ifndef SCUMBLE_INK_TEXTURE_GLSL
#define SCUMBLE_INK_TEXTURE_GLSL

#include "../../../shading/noise.glsl"

// Share of a thin line that is drawn at a place, 0 or 1 but for the ends of its gaps: as much of its length as its radius
// has of half a pixel.
float unbroken(vec3 place, float size, float radius) {
  float slow = scaledNoise(place, 2.4 * size, vec3(13.0, 2.0, 6.0));
  float before = 1.0 / (1.0 + exp(-1.7 * slow));  // how much of the noise is less: from 0 to 1, evenly
  return clamp((2.0 * radius - before) * 12.0 + 0.5, 0.0, 1.0) * step(1e-4, radius);
}

// Whether a dash is there, 0 or 1 but for a pixel at its ends. `way`: along the line; `size`: of a dash, there; `pixels`: the same
// on the screen. Sizes are halves and doubles of each other, so that dashes stay on their line; between them they go over.
float dashAt(float way, float size, float pixels) {
  float level = log2(max(size, 1e-20)), octave = floor(level);
  vec2 at = way * exp2(vec2(-1.0, -2.0) - octave), apart = abs(fract(at) - 0.5);
  vec2 drawn = clamp((0.28 - apart) * pixels * vec2(2.0, 4.0) * exp2(octave - level) + 0.5, 0.0, 1.0);
  return mix(drawn.x, drawn.y, smoothstep(0.35, 0.65, level - octave));
}

// How much of a line with that radius is left `side` of its middle, pixels. `place`: of the line, `beside`: of the pixel, both on
// the surface at rest; `size`: of marks, there.
float strokeCoverage(vec3 place, vec3 beside, float size, float radius, float side) {
  float across = clamp(side / max(radius, 0.5), -1.0, 1.0);
  float slow = scaledNoise(place, 2.0 * size, vec3(0.0));
  float drawn;
  if (kTexture == kInkBrush) {
    // Bristles, each with ink for a while; the outer ones, and those of one side, run dry first.
    float bristles = clamp(radius / 0.9, 1.0, 12.0), bristle = (0.5 * across + 0.5) * bristles, first = floor(bristle);
    float one = scaledNoise(place, size, hashOf(ivec3(int(first), 7, 3)) * 64.0);
    float next = scaledNoise(place, size, hashOf(ivec3(int(first) + 1, 7, 3)) * 64.0);
    // Thin lines keep their ink.
    float wet = 1.5 + 1.5 / bristles + 0.8 * slow - 1.0 * across * across - 0.4 * across;
    drawn = smoothstep(-0.35, 0.35, mix(one, next, smoothstep(0.2, 0.8, bristle - first)) + wet);
  } else if (kTexture == kInkPencil) {
    // Lead stays on the tops of the paper's grain, more where it is pressed.
    float grain = 0.75 * scaledNoise(beside, 0.045 * size, vec3(11.0, 5.0, 3.0)) + 0.35 * scaledNoise(beside, 0.1 * size, vec3(3.0, 1.0, 7.0));
    float pressed = 0.75 + 0.35 * slow - 1.1 * across * across * across * across;
    drawn = 0.85 * smoothstep(-1.5, 1.3, grain + pressed);
  } else {
    // A ball that turns: a line of one width, a little paler in its middle, with a blot now and then and short gaps.
    float roll = scaledNoise(place, 0.25 * size, vec3(5.0, 2.0, 9.0));
    float width = 0.74 + 0.06 * slow + 0.26 * smoothstep(1.7, 2.4, roll);
    drawn = (0.95 - 0.2 * (1.0 - across * across) + 0.05 * slow) * (1.0 - 0.6 * smoothstep(1.9, 2.6, -roll));
    drawn *= clamp((width - abs(across)) * max(radius, 0.5) + 0.5, 0.0, 1.0);
  }
  // Half of the ink looks half as dark: roots of colours are what is even to the eye, and coverage is of linear ones.
  float bare = ink.texture * (1.0 - clamp(drawn, 0.0, 1.0));
  return 1.0 - bare * bare;
}
#endif
