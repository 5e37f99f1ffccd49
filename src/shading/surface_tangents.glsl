// The projected tangents of a surface, as MetaTexture wants them. Needs frame.glsl and metatexture.glsl.
//
// Two eyes that chose scales by their own screens would disagree, and the pattern shimmer (paper 000, section 3.2). So in
// stereo one view between them, the cyclopean one, counts for both.
#ifndef SCUMBLE_SURFACE_TANGENTS_GLSL
#define SCUMBLE_SURFACE_TANGENTS_GLSL
#include "surface_tangents.shared.h"

// What a vertex shader passes on. A tangent: x, y, w of its clip space, in pixels.
vec3 tangentToClip(mat4 worldToClip, vec3 tangent) {
  return vec3(0.5 * frame.imageSize, 1.0) * (worldToClip * vec4(tangent, 0.0)).xyw;
}
mat4 tangentView(int options, mat4 worldToClip) {
  return kViewCount > 1 && (options & kCyclopean) != 0 ? frame.worldToCyclopean : worldToClip;
}
// The point itself in that view, in pixels from the middle of the screen times w; in mono gl_FragCoord says the same.
vec3 pointInTangentView(int options, mat4 worldToClip, vec3 position) {
  return kViewCount > 1 ? vec3(0.5 * frame.imageSize, 1.0) *
                              (tangentView(options, worldToClip) * vec4(position, 1.0)).xyw
                        : vec3(0.0);
}
#endif
