// Depth from the light in sigmoid-warped light space, once a frame (paper 000, "Depth Pass").
#pragma once

#include "frame/pass.h"

namespace scumble::passes {

std::unique_ptr<frame::Pass> makeShadowMap();

}  // namespace scumble::passes
