// Which marks come and go while a picture is magnified.
#pragma once

#include <glm/glm.hpp>

#include "measure/field.h"

namespace scumble::measuring {

// Marks are 12 pixels or more above `level` that touch each other; those at the border of what counts are
// left out. One is there where a pixel at its middle, by up to a quarter of its reach, is above `level`.
struct MarkCount {
  size_t marksBefore = 0, died = 0;  // of those, which are not there afterwards
  size_t marksAfter = 0, born = 0;   // of those, which were not there before
};

// `after` shows `zoom` times as large, around a place (x right, y down, -1 to 1), what `before` shows.
MarkCount countMarks(const Field& before, const Field& after, double zoom, const glm::vec2& centre,
                     float level);

}  // namespace scumble::measuring
