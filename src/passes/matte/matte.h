// Mattes of objects with the coverage of the picture: the numbers of the objects whose samples a pixel's
// colour comes from, wherever edges are torn, and how much of it each has. Drawn only when asked for.
#pragma once

#include "frame/pass.h"

namespace scumble::passes {

std::unique_ptr<frame::Pass> makeMatte();

}  // namespace scumble::passes
