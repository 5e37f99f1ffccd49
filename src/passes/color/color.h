// Lit and shadowed colours mixed by the final shadow, in the air, over the sky (paper 000, Color Pass).
#pragma once

#include "frame/pass.h"

namespace scumble::passes {

std::unique_ptr<frame::Pass> makeColor(frame::Layer layer);

}  // namespace scumble::passes
