// The shadow channels and both colours of every surface, in one geometry pass (paper 000, Shadow Pass and the
// geometry half of the Color Pass; FORMULAS 14).
#pragma once

#include "frame/pass.h"

namespace scumble::passes {

// Behind the first surfaces light is thresholded without a blur.
std::unique_ptr<frame::Pass> makeSurface(frame::Layer layer);

}  // namespace scumble::passes
