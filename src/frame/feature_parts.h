// All that a feature brings along (docs/features.md): one for each folder under src/features, given by its
// makeFeature().
#pragma once

#include <memory>
#include <vector>

#include "frame/pass.h"
#include "scene/extras.h"
#include "world/feature.h"

namespace scumble::frame {

struct FeatureParts {
  std::unique_ptr<world::Feature> feature;
  // Passes, each with the one that it comes after.
  struct PlacedPass {
    const char* after;
    std::unique_ptr<Pass> (*make)();
  };
  std::vector<PlacedPass> passes;
  std::vector<const look::ParamBlock*> blocks;  // of knobs
  std::vector<scene::ExtraRule> extras;         // what nodes may say to it
};

}  // namespace scumble::frame
