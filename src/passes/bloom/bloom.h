// The glow around what acts on the lens, which leaves its silhouette (paper 000, section 5, "Final Color
// Pass").
#pragma once

#include "frame/pass.h"

namespace scumble::passes {

std::unique_ptr<frame::Pass> makeBloom();

}  // namespace scumble::passes
