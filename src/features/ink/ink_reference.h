// What lines of single edges look like, in double precision: every edge of a list of triangles is looked at,
// and a capsule drawn around it where it is a line.
#pragma once

#include <functional>

#include "tests/support/aov.h"
#include "tests/support/render_test.h"
#include "tests/support/test_scene.h"

namespace scumble::ink {

// Nothing but lines of one width (pixels at 1080 lines), centred, whole at their ends and not torn; then the
// given knobs.
test::Knobs linesOfWidth(const std::string& width, const test::Knobs& more);

struct ReferenceEdge {
  glm::dvec3 a, b;
  glm::dvec3 left, right;  // unit normals of its triangles
  bool isOpen = false;
  // One of its triangles faces the eye, and the other one does not.
  bool isSilhouette(const glm::dvec3& eye) const;
  // Either faces it.
  bool isSeen(const glm::dvec3& eye) const;
  double angle() const;  // degrees
};
// Each once; places that differ by less than a millionth are one.
std::vector<ReferenceEdge> referenceEdges(const std::vector<test::WorldTriangle>& triangles);

// Coverage in x: the greatest of capsules around those that `radiusOf` (pixels) gives one above 0.
test::Texels referenceLines(const std::vector<ReferenceEdge>& edges, const View& view, int width, int height,
                            const std::function<double(const ReferenceEdge&)>& radiusOf);

}  // namespace scumble::ink
