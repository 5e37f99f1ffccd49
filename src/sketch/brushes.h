// Which of our brushes stands for one of another program.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/srgb.h"
#include "scene/import_warnings.h"
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

// Of a painting whose brushes these are: tells their names, and warns once of all that are not known.
struct UsedBrush {
  std::string name;
  bool isKnown = true;
};
void tellBrushes(const std::vector<UsedBrush>& used, scene::Painting& painting,
                 scene::ImportWarnings& warnings);

// A channel of a colour as both programs store it, sRGB.
inline float linearOf(float srgb) {
  return float(linearFromSrgb(std::clamp(double(srgb), 0.0, 1.0)));
}

}  // namespace scumble::sketch
