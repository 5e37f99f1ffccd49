// The one clip of the scene and its clock.
#pragma once

#include "mesh_kit/document.h"
#include "mesh_kit/timing.h"

namespace henry {

using meshkit::kFrameRate, meshkit::kLoop, meshkit::onTwos, meshkit::phase, meshkit::slowKeys;

// The start of the scene's clip, to which each part adds its channels.
inline meshkit::Clip& party(meshkit::Document& document) {
  if (document.clips.empty()) document.clips.push_back({"Party", {}});
  return document.clips.front();
}

}  // namespace henry
