// Lost and found edges (paper 000, section 2.1): where values meet, colours run into each other, and where
// they differ, an edge is crisp.
#pragma once

#include "frame/pass.h"

namespace scumble::passes {

std::unique_ptr<frame::Pass> makeLostEdges();

}  // namespace scumble::passes
