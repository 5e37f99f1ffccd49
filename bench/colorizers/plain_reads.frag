#version 460
// The yardstick of colorizers: colour and depth are read, and something is written.
layout(set = 1, binding = 1) uniform sampler2DArray color;
layout(set = 1, binding = 2) uniform sampler2DArray depth;
layout(location = 0) out vec4 outColor;

void main() {
  ivec3 at = ivec3(gl_FragCoord.xy, 0);
  outColor = texelFetch(color, at, 0) * texelFetch(depth, at, 0).r;
}
