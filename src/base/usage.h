// Calls that make no sense.
#pragma once

#include <string>
#include <utility>

#include "scumble/result.h"

namespace scumble {

inline Error usage(std::string problem, std::string advice) {
  return {ErrorKind::usage, "", 0, "", std::move(problem), std::move(advice)};
}

}  // namespace scumble
