// The picture in few colours: each pixel goes to the nearest colour of a palette; where it lies between two,
// palette-knife marks decide.
#pragma once

#include "frame/pass.h"

namespace scumble::passes {

std::unique_ptr<frame::Pass> makeLimit(frame::Layer layer);
// The same for an overlay (frame::kOverlays).
std::unique_ptr<frame::Pass> makeLimitOverlay(frame::Layer layer);

}  // namespace scumble::passes
