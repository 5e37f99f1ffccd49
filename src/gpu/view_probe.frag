#version 450
#extension GL_EXT_multiview : require
layout(push_constant) uniform ViewBlock { int firstView; };
layout(location = 0) flat in float value;
layout(location = 0) out vec4 byVertexShader;
layout(location = 1) out vec4 byFragmentShader;

void main() {
  byVertexShader = vec4(value);
  byFragmentShader = vec4(firstView + gl_ViewIndex == 0 ? 204.0 / 255.0 : 51.0 / 255.0);
}
