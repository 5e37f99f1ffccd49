// Which draws a frame's views see: of each bucket of the list those that are seen, the nearest first, and
// then such as draw nothing. And with how many triangles: for them, and for all that cast shadows.
#pragma once

#include <memory>

#include "frame/pass.h"

namespace scumble::passes {

std::unique_ptr<frame::Pass> makeCull();
// The same with all triangles, as a renderer without levels of detail has it.
std::unique_ptr<frame::Pass> makeCullOfWholes();

}  // namespace scumble::passes
