// The features that the program was built with: the folders under src/features but for those that were left
// out (cmake -DSCUMBLE_WITHOUT=NAME;NAME).
#pragma once

#include <vector>

#include "frame/feature_parts.h"

namespace scumble::renderer {

const std::vector<frame::FeatureParts>& features();

// What each of them builds for a scene under a look, which is one at a time.
std::vector<world::PlannedFeature> plannedFeatures(const scene::SceneData& scene, const look::LookData& look);

// Names of AOVs that drawings under a look, at its time, are made from; none where it draws no lines.
std::vector<std::string> aovsOfDrawings(const scene::SceneData& scene, const look::LookData& look);
// What to do where a look draws none.
std::string adviceForDrawings();

}  // namespace scumble::renderer
