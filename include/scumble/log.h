// What a renderer has to say beside its results.
#pragma once

#include <functional>
#include <string>

namespace scumble {

enum class LogLevel {
  information,  // what was chosen: the device, and how it is used
  warning,      // what works less well than it should: what a device gets wrong, a cache that cannot be used
  error         // messages of the Vulkan validation layers
};

// Called from whichever thread uses the renderer, and from threads of the driver's own: several may at once.
// `text` is one sentence or more, without a line feed at its end. It does not call the renderer.
using Log = std::function<void(LogLevel level, const std::string& text)>;

}  // namespace scumble
