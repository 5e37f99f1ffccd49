// The picture: the colour pass warped by the warp pass, with bloom (paper 000, Final Color).
#pragma once

#include "frame/pass.h"

namespace scumble::passes {

std::unique_ptr<frame::Pass> makeFinalColor();

}  // namespace scumble::passes
