#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../shading/frame.glsl"
#include "../../shading/light_space.glsl"
#include "shadow_map.glsl"

layout(location = 0) in vec3 inPosition;

void main() { gl_Position = shadowMapPosition(inPosition); }
