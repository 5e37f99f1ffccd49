#version 460
// One layer of a frame's depth buffer into a rectangle of somebody else's.
layout(set = 0, binding = 0) uniform sampler2DArray source;
layout(push_constant) uniform Where { uint layer; int x, y; };

void main() { gl_FragDepth = texelFetch(source, ivec3(ivec2(gl_FragCoord.xy) - ivec2(x, y), layer), 0).r; }
