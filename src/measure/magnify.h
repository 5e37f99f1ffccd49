// Magnifying a picture by its projection, around a place that stays where it is.
#pragma once

#include <glm/glm.hpp>

#include "measure/field.h"
#include "scumble/view.h"

namespace scumble::measuring {

// The place in the picture (x right, y down, -1 to 1) around which a magnification by `zoom`, above 1, shows
// as much of what is valid as possible; of equals the one nearest to the middle.
glm::vec2 zoomCentre(const Field& seen, int zoom);

View magnified(View view, float zoom, const glm::vec2& centre);

// Keeps of a field the part that `magnified` by so much shows.
void keepMagnified(Field& field, double zoom, const glm::vec2& centre);

}  // namespace scumble::measuring
