// Writes the vertices of water that moves, after `deform` has written those of everything else.
#pragma once

#include "frame/pass.h"

namespace scumble::ocean {

std::unique_ptr<frame::Pass> makeOceanDeform();

}  // namespace scumble::ocean
