#version 460
// One layer of a frame's image into a rectangle of somebody else's.
layout(constant_id = 0) const bool kEncodes = false;     // linear to sRGB's curve, for formats without one
layout(constant_id = 1) const bool kIsSquareRoot = false;  // what is there is the root of a colour
layout(set = 0, binding = 0) uniform sampler2DArray source;
layout(push_constant) uniform Where { uint layer; int x, y; };
layout(location = 0) out vec4 outputColor;

vec3 encoded(vec3 linear) {
  vec3 c = clamp(linear, 0.0, 1.0);
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

void main() {
  vec4 value = texelFetch(source, ivec3(ivec2(gl_FragCoord.xy) - ivec2(x, y), layer), 0);
  if (kIsSquareRoot) {
    // The root of a premultiplied colour's straight one, times coverage.
    float coverage = max(value.a, 1e-6);
    value.rgb = value.rgb * value.rgb / coverage;
  }
  if (kEncodes) value.rgb = encoded(value.rgb);
  outputColor = value;
}
