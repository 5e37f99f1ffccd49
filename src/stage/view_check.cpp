#include "stage/view_check.h"

#include <cmath>

#include "scene/prepare_mesh.h"

namespace scumble::stage {

namespace {

bool isFinite(const glm::mat4& m) {
  for (int i = 0; i < 16; ++i)
    if (!std::isfinite(m[i / 4][i % 4])) return false;
  return true;
}

// Of directions, whatever their scale: 0 where they lie in a plane.
double volume(const glm::dmat3& m) {
  const double lengths = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
  return lengths > 0 ? std::abs(glm::determinant(m)) / lengths : 0;
}

}  // namespace

std::string problemWith(const View& view) {
  if (!isFinite(view.worldToEye) || !isFinite(view.eyeToClip)) return "a view is not finite";
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(view.origin[axis]) <= double(scene::kMaxCoordinate)))
      return "a view's origin is out of range";
  const glm::dmat4 w(view.worldToEye), p(view.eyeToClip);
  // Inverses are not exact.
  const glm::dvec4 lastRow(w[0][3], w[1][3], w[2][3], w[3][3]);
  if (!(glm::length(lastRow - glm::dvec4(0, 0, 0, 1)) < 1e-4) || !(volume(glm::dmat3(w)) > 1e-9))
    return "a view's worldToEye places no eye in the world";
  // What lies at a distance d before the eye has the clip coordinates w = a + b d and depth (e + f d) / w.
  const double a = p[3][3], b = -p[2][3], e = p[3][2], f = -p[2][2];
  if (!(b > 0 || (b == 0 && a > 0))) return "a view's eyeToClip shows nothing that is before the eye";
  if (!(f * a - e * b < 0)) return "a view's eyeToClip has a depth that does not fall with the distance";
  const double turn = p[0][0] * p[1][1] - p[1][0] * p[0][1];
  if (!(turn < 0)) return "a view's eyeToClip does not map y up to y down";
  return "";
}

}  // namespace scumble::stage
