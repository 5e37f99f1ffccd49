#include "scumble/check.h"

#include <algorithm>
#include <set>

#include "look/look_data.h"
#include "look/setting_path.h"
#include "renderer/feature_list.h"
#include "scene/find_node.h"

namespace scumble {

namespace {

using Kind = Finding::Kind;

// Findings, each setting once.
class Findings {
 public:
  void add(Kind kind, const std::string& setting, bool bySet, const char* problem) {
    const auto isSame = [&](const Finding& other) { return other.kind == kind && other.setting == setting; };
    if (const auto known = std::find_if(list.begin(), list.end(), isSame); known != list.end()) {
      known->bySet |= bySet;
      return;
    }
    list.push_back({kind, setting, bySet, problem});
  }
  std::vector<Finding> list;
};

void findNames(const scene::SceneData& scene, const look::LookData& look, bool isForScene, Findings& found) {
  const auto isOfFeature = [](const std::string& pattern) {
    return std::any_of(renderer::features().begin(), renderer::features().end(),
                       [&](const frame::FeatureParts& parts) {
                         const std::string material(parts.feature->material());
                         return !material.empty() && look::matches(pattern, material);
                       });
  };
  for (const look::Assignment& setting : look.assignments) {
    if (setting.target == look::kScene) continue;
    if (!setting.byHand && (!isForScene || look::isPattern(setting.pattern))) continue;
    const auto matchesAny = [&](const auto& named) {
      return std::any_of(named.begin(), named.end(),
                         [&](const auto& one) { return look::matches(setting.pattern, one.name); });
    };
    const bool isThere = setting.target == look::kMaterials
                             ? matchesAny(scene.materials) || look::matches(setting.pattern, "Ground") ||
                                   isOfFeature(setting.pattern)
                         : setting.target == look::kNodes ? matchesAny(scene.nodes)
                         : setting.target == look::kClips ? matchesAny(scene.clips)
                                                          : true;
    if (!isThere)
      found.add(Kind::noSuchName,
                std::string(look::firstSection(setting.target).name) + "." + setting.pattern, setting.byHand,
                "nothing in the scene has such a name (`scumble info` lists names)");
  }
}

void findNodes(const scene::SceneData& scene, const look::LookData& look, Findings& found) {
  // When a node is named anew.
  std::set<double> times{0};
  for (const look::Assignment& setting : look.assignments)
    if (setting.track && setting.row->kind == look::ParamKind::name)
      for (const look::Key& key : setting.track->keys) times.insert(key.time);
  for (const double time : times) {
    const look::LookData now = look.at(time);
    // Knobs that are names name nodes.
    const auto check = [&](const look::ParamBlock& block, const look::ParamRow& row, look::Target target,
                           const std::string& name) {
      const std::string& node = now.text(look::Name(now.valueOf(row, block, target, name).number));
      if (node.empty() || scene::findNode(scene, node) >= 0) return;
      const bool bySet =
          std::any_of(look.assignments.begin(), look.assignments.end(), [&](const look::Assignment& setting) {
            return setting.byHand && setting.block == &block && setting.row == &row &&
                   setting.target == target &&
                   (target == look::kScene || look::matches(setting.pattern, name));
          });
      const std::string knob = std::string(block.path) + "." + row.name;
      found.add(Kind::noSuchNode,
                target == look::kScene
                    ? knob
                    : std::string(look::firstSection(target).name) + "." + name + "." + knob,
                bySet, "the scene has no node of that name (`scumble info` lists names)");
    };
    for (const look::ParamBlock* const block : look::allBlocks())
      for (const look::ParamRow& row : block->rows) {
        if (row.kind != look::ParamKind::name) continue;
        if (block->targets & look::kScene) check(*block, row, look::kScene, "");
        for (const look::Section& section : look::kSections)
          if (section.most > 0 && block->targets & section.target)
            for (const std::string& name : now.declared(section.target))
              check(*block, row, section.target, name);
      }
  }
}

// Settings of a feature that is not there.
void findAbsent(const frame::FeatureParts& parts, const scene::SceneData& scene, const look::LookData& look,
                Findings& found) {
  if (parts.feature->plan(scene, look.at(0))) return;
  const world::Feature::Switch onOff = parts.feature->onOff();
  const auto isOfFeature = [&](const look::ParamBlock* block) {
    return std::find(parts.blocks.begin(), parts.blocks.end(), block) != parts.blocks.end();
  };
  std::vector<std::string> groups;
  for (const look::Assignment& setting : look.assignments) {
    const bool isSwitch = setting.block == onOff.block && setting.row->name == std::string(onOff.row);
    if (isSwitch && setting.track) return;  // it comes and goes
    if (setting.byHand && !isSwitch && isOfFeature(setting.block) && setting.target != look::kDecorations)
      groups.push_back(setting.block->path);
  }
  // What looks declare for it.
  const auto isDeclared = [](const look::ParamBlock* block) { return block->targets == look::kDecorations; };
  if (std::any_of(parts.blocks.begin(), parts.blocks.end(), isDeclared) &&
      !look.declared(look::kDecorations).empty()) {
    const auto isByHand = [](const look::Assignment& setting) {
      return setting.target == look::kDecorations && setting.byHand;
    };
    found.add(Kind::notThere, look::firstSection(look::kDecorations).name,
              std::any_of(look.assignments.begin(), look.assignments.end(), isByHand), onOff.absence);
  }
  for (const std::string& group : groups) found.add(Kind::notThere, group, true, onOff.absence);
}

}  // namespace

std::vector<Finding> check(const Scene& scene, const Look& look, bool isForScene) {
  if (scene.empty()) return {};
  Findings found;
  findNames(scene.data(), look.data(), isForScene, found);
  findNodes(scene.data(), look.data(), found);
  for (const frame::FeatureParts& parts : renderer::features())
    findAbsent(parts, scene.data(), look.data(), found);
  return std::move(found.list);
}

}  // namespace scumble
