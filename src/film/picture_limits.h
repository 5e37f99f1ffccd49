// What readers of pictures share: how large one may be, and how they say that a file is none.
#pragma once

#include <cstdint>
#include <string>

#include "scumble/result.h"

namespace scumble::film {

// 2 GiB of floats; the largest power-of-two panorama (16384 x 8192) still fits.
constexpr uint64_t kMostPixels = uint64_t(1) << 27;

inline Error unusable(const std::string& path, const std::string& problem, const std::string& advice) {
  return {ErrorKind::unusableFile, path, 0, "", problem, advice};
}

}  // namespace scumble::film
