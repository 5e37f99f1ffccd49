// Which view is being drawn. With multiview the driver counts; drivers whose multiview cannot be trusted draw one view at
// a time, and are told which (docs/gpu.md).
#ifndef SCUMBLE_VIEW_INDEX_GLSL
#define SCUMBLE_VIEW_INDEX_GLSL
#extension GL_EXT_multiview : require

layout(push_constant) uniform ViewBlock { int firstView; };
int viewIndex() { return firstView + gl_ViewIndex; }
#endif
