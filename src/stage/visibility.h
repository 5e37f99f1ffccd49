// What views can see.
#pragma once

#include <glm/glm.hpp>

#include "scene/scene_data.h"

namespace scumble::stage {

// Whether a box may reach into a view, or beyond its borders by `margin` (in normalised device coordinates,
// where the view is 2 wide). Never false for what can be seen.
bool mayBeSeen(const scene::Bounds& box, const glm::mat4& worldToClip, const glm::vec2& margin);

}  // namespace scumble::stage
