// The sky: from the colour at the horizon to that above, evenly or in tones whose borders are brush strokes. Whoever includes
// it has a SurfaceColors `colors`.
#ifndef SCUMBLE_SKY_GLSL
#define SCUMBLE_SKY_GLSL
#include "frame.glsl"
#include "noise.glsl"
#include "surface_color.shared.h"

// How much flatter strokes are than long, and the bristles that break their edges.
const float kSkyFlat = 6.0, kSkyBristles = 5.0;

// Which of the tones a stroke in a direction of the world has. `even`: how far the sky has gone over there, tones.
// `pixel`: what one turns by, radians.
float skyTone(float even, vec3 direction, float pixel, float parallel) {
  vec3 place = direction * vec3(1.0, kSkyFlat, 1.0);
  float size = colors.skyStrokeSize * pixel;
  float strokes = scaledNoise(place, size, vec3(4.0, 9.0, 2.0));
  float bristles = scaledNoise(place * vec3(1.0, 2.0, 1.0), size / kSkyBristles, vec3(8.0, 1.0, 5.0));
  float at = even + colors.skyStrokes * (0.42 * strokes + 0.13 * bristles) * (1.0 - parallel), before = floor(at);
  // Borders are a pixel wide where tones change as they do on the average.
  float soft = 0.5 * (colors.skyEven * pixel + colors.skyStrokes * kSkyFlat / colors.skyStrokeSize);
  return clamp(before + smoothstep(0.5 - soft, 0.5 + soft, at - before), 0.0, colors.skyTones);
}

// `place`: pixels. Premultiplied.
vec4 skyAt(vec2 place, int layer) {
  vec4 toRay = VIEW_FIELD(ndcToEyeRay, layer);
  vec2 ndc = place / frame.imageSize * 2.0 - 1.0;
  float parallel = VIEW_FIELD(orthographic, layer);
  vec3 ray = vec3((ndc * toRay.xy + toRay.zw) * (1.0 - parallel), -1.0);
  ray *= inversesqrt(dot(ray, ray));
  float t = clamp(dot(VIEW_FIELD(upInEye, layer), ray) / colors.height, 0.0, 1.0);  // by the sine of the elevation
  t = t * t * (3.0 - 2.0 * t);
  for (bool isPainted = colors.skyTones > 0.0; isPainted; isPainted = false)
    t = skyTone(t * colors.skyTones, ray * mat3(VIEW_FIELD(worldToEye, layer)), 2.0 * abs(toRay.y) / frame.imageSize.y, parallel) / colors.skyTones;
  return vec4(mix(colors.horizon, colors.zenith, t), 1.0) * (1.0 - colors.transparent);
}

// A premultiplied colour over the sky, which nobody asks for where that covers it.
vec4 overSky(vec4 color, vec2 place, int layer) {
  for (bool isOpen = color.a < 1.0; isOpen; isOpen = false) color += skyAt(place, layer) * (1.0 - color.a);
  return color;
}
#endif
