#version 450
#extension GL_EXT_multiview : require
// A triangle over the lower left of the picture; each view has a depth and a value of its own.
layout(push_constant) uniform ViewBlock { int firstView; };
layout(location = 0) flat out float value;

void main() {
  const int view = firstView + gl_ViewIndex;
  value = view == 0 ? 51.0 / 255.0 : 204.0 / 255.0;
  // Corners at pixels (0, 0), (2 * reach, 0), (0, 2 * reach), with reach in NDC; its long side is x + y = 160 of 96.
  const float reach = 2.0 * 160.0 / 96.0;
  gl_Position = vec4(-1.0 + (gl_VertexIndex == 1 ? reach : 0.0), -1.0 + (gl_VertexIndex == 2 ? reach : 0.0),
                     view == 0 ? 0.25 : 0.75, 1.0);
}
