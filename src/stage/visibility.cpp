#include "stage/visibility.h"

namespace scumble::stage {

bool mayBeSeen(const scene::Bounds& box, const glm::mat4& worldToClip, const glm::vec2& margin) {
  if (box.empty) return false;
  // Planes as rows of the matrix: what is seen has -w <= x, y <= w and 0 <= z <= w.
  const glm::mat4 rows = glm::transpose(worldToClip);
  const glm::vec4 planes[] = {(1 + margin.x) * rows[3] + rows[0],
                              (1 + margin.x) * rows[3] - rows[0],
                              (1 + margin.y) * rows[3] + rows[1],
                              (1 + margin.y) * rows[3] - rows[1],
                              rows[2],
                              rows[3] - rows[2]};
  const glm::vec3 center = box.center(), half = 0.5f * (box.max - box.min);
  for (const glm::vec4& plane : planes) {
    const glm::vec3 normal(plane);
    const float nearest = glm::dot(normal, center) + plane.w, reach = glm::dot(glm::abs(normal), half);
    // Written so that what is not finite is seen.
    if (nearest + reach < 0) return false;
  }
  return true;
}

}  // namespace scumble::stage
