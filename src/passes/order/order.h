// The order of all triangles of blended surfaces, of all objects: the farthest first (FORMULAS 19).
#pragma once

#include <memory>

#include "frame/pass.h"

namespace scumble::passes {

std::unique_ptr<frame::Pass> makeOrder();

}  // namespace scumble::passes
