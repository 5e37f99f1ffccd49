// What JPEG and WebP files have in common: a quality, a largest side, and an encoder that works in memory.
#pragma once

#include <functional>
#include <string>

#include "base/whole_file.h"
#include "scumble/image.h"

namespace scumble::film {

struct Lossy {
  int leastQuality;  // the most is 100
  std::string aboutQuality, name;
  uint32_t largestSide;  // pixels
};

// Checks what is given, then has `encode` write the file, which appears whole or not at all. `encode` is
// false, or throws, where there is not enough memory. A picture that is none, and a quality out of range, are
// the caller's mistake (usage).
Status writeLossy(const std::string& path, const Image& image, int quality, const Lossy& format,
                  const std::function<bool(WholeFile&)>& encode);

}  // namespace scumble::film
