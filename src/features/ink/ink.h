// Lines: what is drawn of the edges of meshes, in ink (paper 004, section 2).
#pragma once

#include <memory>

#include "frame/pass.h"

namespace scumble::ink {

inline constexpr const char* kName = "ink";

// Ink by itself. R, G, B: coverage x (1 - square root of the linear colour); A: coverage. Where several lines
// lie on one another each has the greatest, so that joints and crossings are as dark as what meets there, in
// whatever order they are drawn.
inline constexpr frame::Role kStrokes{"ink strokes"};

// Draws it.
std::unique_ptr<frame::Pass> makeLines();
// Lays it over the picture.
std::unique_ptr<frame::Pass> makeOver();

}  // namespace scumble::ink
