#version 460
// Triangles of the interface; places in pixels.
layout(push_constant) uniform Push { vec2 size; } push;

layout(location = 0) in vec2 inPlace;
layout(location = 1) in vec2 inUv;
layout(location = 2) in vec4 inColor;

layout(location = 0) out vec2 outUv;
layout(location = 1) out vec4 outColor;

void main() {
  outUv = inUv;
  outColor = inColor;
  gl_Position = vec4(2.0 * inPlace / push.size - 1.0, 0.0, 1.0);
}
