// Whether a caller's view is one that can be drawn from (see View).
#pragma once

#include <string>

#include "scumble/view.h"

namespace scumble::stage {

// What is wrong with its matrices; empty: nothing.
std::string problemWith(const View& view);

}  // namespace scumble::stage
