// Final vertices of everything, once a frame (compute).
#pragma once

#include "frame/pass.h"

namespace scumble::passes {
std::unique_ptr<frame::Pass> makeDeform();
}
