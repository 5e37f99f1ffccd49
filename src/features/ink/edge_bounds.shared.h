// What is known of a word of edges without looking at them: whether any of them may be a line. C++ and GLSL
// compile the same text, so that tests can put edges to it.
#ifndef SCUMBLE_INK_EDGE_BOUNDS_SHARED_H
#define SCUMBLE_INK_EDGE_BOUNDS_SHARED_H
#include "../../shading/shared_types.h"

#ifdef __cplusplus
namespace scumble::shared {
using glm::dot;
using glm::max;
using glm::sqrt;
}  // namespace scumble::shared
#endif

SHARED_BEGIN

// Of as many edges as a word has bits, of a form that nothing bends; in mesh space.
struct EdgeBounds {
  vec3 middle;  // of all their ends
  float radius;
  vec3 axis;                 // of a cone around the normals of their triangles
  float cosAngle, sinAngle;  // of half of it; cosAngle below 0: nothing is known
  float cosBend;             // of the sharpest angle between two of their triangles
  uint kinds;                // which there are: kEdgeMaterialBorder, kEdgeColorBorder, and kEdgeOpen
};
const uint kEdgeOpen = 1u;

// Whether all triangles face an eye, or none does. `eye`: as eyeOf() has it, in mesh space.
SHARED_FUNCTION bool allFaceAlike(EdgeBounds bounds, vec4 eye) {
  vec3 toEye = vec3(eye.x, eye.y, eye.z) - eye.w * bounds.middle;
  float size2 = dot(toEye, toEye), along = dot(toEye, bounds.axis);
  float across = sqrt(max(size2 - along * along, 0.0f));
  // What rounding may do is some millionths of all of these.
  float margin = eye.w * bounds.radius + 1e-4f * (sqrt(size2) + eye.w * bounds.radius);
  float least = along * bounds.cosAngle - across * bounds.sinAngle;
  float most = along * bounds.cosAngle + across * bounds.sinAngle;
  return bounds.cosAngle > 0.0f && (least > margin || most < -margin);
}

SHARED_END
#endif
