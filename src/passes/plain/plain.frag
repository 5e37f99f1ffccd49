#version 460
layout(constant_id = 0) const int kAlphaMode = 0;
layout(constant_id = 1) const int kTextured = 0;

layout(set = 1, binding = 0) uniform sampler2D baseTexture;

layout(location = 0) in vec2 inUv;
layout(location = 1) in vec4 inColor;
layout(location = 2) flat in float inCutoff;
layout(location = 0) out vec4 outColor;

void main() {
  vec4 color = inColor;
  if (kTextured != 0) color *= texture(baseTexture, inUv);
  if (kAlphaMode == 1 && color.a < inCutoff) discard;
  outColor = vec4(color.rgb, kAlphaMode == 2 ? color.a : 1.0);
}
