// Shadow shapes: threshold, inner glow, indication (paper 000, section 5.1).
#pragma once

#include "frame/pass.h"

namespace scumble::passes {

std::unique_ptr<frame::Pass> makeFinalShadow();

}  // namespace scumble::passes
