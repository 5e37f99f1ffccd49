// Strokes of the lines of a view: what of them is seen, how wide, and in which order they follow each other.
#pragma once

#include "frame/feature_parts.h"

namespace scumble::ink {

frame::LineDrawing lineDrawing();

}  // namespace scumble::ink
