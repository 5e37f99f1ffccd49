#include "renderer/feature_list.h"

#include <algorithm>

// Of each feature's folder, by its name.
#define FEATURE(name)                \
  namespace scumble::name {          \
  frame::FeatureParts makeFeature(); \
  }
#include "feature_names.inc"
#undef FEATURE

namespace scumble {

namespace scene {

const std::vector<ExtraRule>& extraRules() {
  static const std::vector<ExtraRule> all = [] {
    std::vector<ExtraRule> rules;
    for (const frame::FeatureParts& parts : renderer::features())
      rules.insert(rules.end(), parts.extras.begin(), parts.extras.end());
    return rules;
  }();
  return all;
}

}  // namespace scene

namespace renderer {

const std::vector<frame::FeatureParts>& features() {
  static const std::vector<frame::FeatureParts> all = [] {
    std::vector<frame::FeatureParts> made;
#define FEATURE(name) made.push_back(name::makeFeature());
#include "feature_names.inc"
#undef FEATURE
    return made;
  }();
  return all;
}

std::vector<world::PlannedFeature> plannedFeatures(const scene::SceneData& scene,
                                                   const look::LookData& look) {
  std::vector<world::PlannedFeature> planned;
  for (const frame::FeatureParts& parts : features())
    planned.push_back({parts.feature.get(), parts.feature->plan(scene, look)});
  return planned;
}

std::vector<std::string> aovsOfDrawings(const scene::SceneData& scene, const look::LookData& look) {
  std::vector<std::string> names;
  for (const frame::FeatureParts& parts : features())
    if (parts.drawing.aovs)
      for (const char* const name : parts.drawing.aovs(scene, look))
        if (std::find(names.begin(), names.end(), name) == names.end()) names.emplace_back(name);
  return names;
}

std::string adviceForDrawings() {
  for (const frame::FeatureParts& parts : features())
    if (parts.drawing.aovs) return parts.feature->onOff().absence;
  return "this program was built without lines";
}

}  // namespace renderer
}  // namespace scumble
