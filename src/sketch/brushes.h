// Which of our brushes stands for one of another program.
#pragma once

#include <algorithm>
#include <optional>
#include <string_view>

#include "base/srgb.h"
#include "scene/painting.h"

namespace scumble::sketch {

struct KnownBrush {
  const char* name;
  scene::Brush brush;
  // How wide and how opaque a stroke is where nothing presses the brush, as parts of what they are where it
  // is pressed as much as can be.
  float lightestWidth, lightestOpacity;
};

// By the GUID that Tilt Brush and Open Brush give it; nothing: they have none of that.
std::optional<KnownBrush> tiltBrush(std::string_view guid);
// By its name in A-Painter.
std::optional<KnownBrush> apainterBrush(std::string_view name);

// A channel of a colour as both programs store it, sRGB.
inline float linearOf(float srgb) {
  return float(linearFromSrgb(std::clamp(double(srgb), 0.0, 1.0)));
}

}  // namespace scumble::sketch
