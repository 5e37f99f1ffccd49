// Warp vectors on the inflated surface (paper 000, section 4).
#pragma once

#include "frame/pass.h"

namespace scumble::passes {

std::unique_ptr<frame::Pass> makeWarp();

}  // namespace scumble::passes
