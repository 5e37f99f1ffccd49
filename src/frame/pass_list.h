// The passes of a frame, in order. To add a pass: a folder under src/passes, and one line here.
#pragma once

#include <memory>
#include <vector>

#include "frame/pass.h"

namespace scumble::frame {

std::vector<std::unique_ptr<Pass>> makePasses(const Configuration& configuration);

// Whether a draw casts shadows under a look; the light fits its shadow map to those.
std::vector<bool> shadowCasters(const SceneOnGpu& scene, const look::LookData& look);

}  // namespace scumble::frame
