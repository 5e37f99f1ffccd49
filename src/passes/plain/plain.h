// The yardstick: the scene once, unlit, one target, the frame's samples. Everything else is measured against
// it.
#pragma once

#include "frame/pass.h"

namespace scumble::passes {
std::unique_ptr<frame::Pass> makePlain();
}
