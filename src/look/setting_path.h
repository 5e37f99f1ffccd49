// Paths of settings: which section of a look they stand in, and for which names.
#pragma once

#include "look/look_data.h"

namespace scumble::look {

// A section of a look for settings that hold only for what a pattern of names matches.
struct Section {
  Target target;
  const char *name, *one;
  // Of a setting in it, for advice; one that ends with a dot goes on with the first knob that the section
  // has.
  const char* example;
  size_t most = 0;  // how many names it may declare; 0: it declares none, they are the scene's
};
inline constexpr Section kSections[] = {
    {kMaterials, "materials", "material", "materials.Sail*.warp.amount"},
    {kNodes, "nodes", "node", "nodes.Gull*.animation.hold"},
    {kClips, "clips", "clip", "clips.Walk.play.weight"},
    {kColorizers, "colorizers", "colorizer", "colorizers.Glow.volume.density", 64},
    {kDecorations, "decorations", "decoration", "decorations.Wake.", 16}};

// The section of this name, or nullptr.
const Section* findSection(const std::string& name);

// The first section in which these may be set; there must be one.
const Section& firstSection(Targets targets);

// "the whole scene or materials"
std::string listed(Targets targets);

// Reads "shadow.threshold" or "materials.Sail*.warp.amount": an assignment without its value. Names may
// contain dots, so the knob is the shortest tail that is one. Fails with ErrorKind::usage.
Result<Assignment> parseSettingPath(const std::string& path);

}  // namespace scumble::look
