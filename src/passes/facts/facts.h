// Facts about every pixel's surface, unfiltered: depth, position, normal, uv and its gradients, what
// MetaTexture chose, motion and object. Drawn only when one of them is asked for.
#pragma once

#include "frame/pass.h"

namespace scumble::passes {

std::unique_ptr<frame::Pass> makeFacts();

}  // namespace scumble::passes
