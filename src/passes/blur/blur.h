// The shadow channels, blurred and at a quarter of the size (paper 000, "Blur Pass").
#pragma once

#include "frame/pass.h"

namespace scumble::passes {

std::unique_ptr<frame::Pass> makeBlur();

}  // namespace scumble::passes
