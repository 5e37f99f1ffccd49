// Volumetric colorizers (paper 002, Henry): regions of space that grade the colours of what lies in them, or
// of what is seen through them.
#pragma once

#include "frame/pass.h"

namespace scumble::passes {

std::unique_ptr<frame::Pass> makeColorize(frame::Layer layer);
// The same of an overlay (frame::kOverlays) whose distance is known, and the air before it.
std::unique_ptr<frame::Pass> makeColorizeOverlay(frame::Layer layer);

}  // namespace scumble::passes
