// All that a feature brings along (docs/features.md): one for each folder under src/features, given by its
// makeFeature().
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "frame/pass.h"
#include "scene/extras.h"
#include "scumble/drawing.h"
#include "scumble/image.h"
#include "world/feature.h"

namespace scumble::frame {

// A feature's lines as strokes (RenderOptions::drawing).
struct LineDrawing {
  // What they are made from; nothing where the look, at its time, draws no lines.
  std::vector<const char*> (*aovs)(const scene::SceneData& scene, const look::LookData& look) = nullptr;
  // Adds those of a view, lines that lie above others after those. `aov`: of the view, floats; null where it
  // was none of aovs().
  using AovOfView = std::function<const Image*(const char* name)>;
  void (*add)(const AovOfView& aov, const look::LookData& look, Drawing& drawing) = nullptr;
};

struct FeatureParts {
  std::unique_ptr<world::Feature> feature;
  // Passes, each with the one that it comes after. Of several features' that come after the same one: also
  // after those of the features that `above` names, which need not be built; what that leaves open goes by
  // the features' names. Of one feature, they come as they stand.
  struct PlacedPass {
    const char* after;
    std::unique_ptr<Pass> (*make)();
    std::vector<std::string_view> above = {};
  };
  std::vector<PlacedPass> passes;
  std::vector<const look::ParamBlock*> blocks;  // of knobs
  std::vector<scene::ExtraRule> extras;         // what nodes may say to it
  LineDrawing drawing;                          // empty where it draws no lines
};

}  // namespace scumble::frame
