// The order of all triangles of blended surfaces, of all objects: the farthest first. (Paper 002 orders
// each object for itself.)
#pragma once

#include <memory>

#include "frame/pass.h"

namespace scumble::passes {

std::unique_ptr<frame::Pass> makeOrder();

}  // namespace scumble::passes
