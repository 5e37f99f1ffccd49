// Which draws a frame's views see: of each bucket of the list those that are seen, the nearest first, and
// then such as draw nothing.
#pragma once

#include <memory>

#include "frame/pass.h"

namespace scumble::passes {

std::unique_ptr<frame::Pass> makeCull();

}  // namespace scumble::passes
