#include "scumble/check.h"

#include <algorithm>
#include <set>

#include "look/look_data.h"
#include "look/setting_path.h"
#include "passes/colorize/colorize_knobs.h"
#include "scene/find_node.h"
#include "stage/camera.h"
#include "world/ocean.h"

namespace scumble {

namespace {

using Kind = Finding::Kind;

// Findings, each setting once.
class Findings {
 public:
  void add(Kind kind, const std::string& setting, bool bySet) {
    const auto isSame = [&](const Finding& other) { return other.kind == kind && other.setting == setting; };
    if (const auto known = std::find_if(list.begin(), list.end(), isSame); known != list.end()) {
      known->bySet |= bySet;
      return;
    }
    static constexpr const char* kProblems[] = {
        "nothing in the scene has such a name (`scumble info` lists names)",
        "the scene has no node of that name (`scumble info` lists names)",
        "there is no ocean; --set ocean.mode=on puts one"};
    list.push_back({kind, setting, bySet, kProblems[size_t(kind)]});
  }
  std::vector<Finding> list;
};

void findNames(const scene::SceneData& scene, const look::LookData& look, bool isForScene, Findings& found) {
  for (const look::Assignment& setting : look.assignments) {
    if (setting.target == look::kScene) continue;
    if (!setting.byHand && (!isForScene || look::isPattern(setting.pattern))) continue;
    const auto matchesAny = [&](const auto& named) {
      return std::any_of(named.begin(), named.end(),
                         [&](const auto& one) { return look::matches(setting.pattern, one.name); });
    };
    const bool isThere = setting.target == look::kMaterials
                             ? matchesAny(scene.materials) || look::matches(setting.pattern, "Ground") ||
                                   look::matches(setting.pattern, "Ocean")
                         : setting.target == look::kNodes ? matchesAny(scene.nodes)
                         : setting.target == look::kClips ? matchesAny(scene.clips)
                                                          : true;
    if (!isThere)
      found.add(Kind::noSuchName,
                std::string(look::firstSection(setting.target).name) + "." + setting.pattern, setting.byHand);
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
    const auto check = [&](const look::ParamBlock& block, const char* row, look::Target target,
                           const std::string& name, look::Name named) {
      const std::string& node = now.text(named);
      if (node.empty() || scene::findNode(scene, node) >= 0) return;
      const bool bySet =
          std::any_of(look.assignments.begin(), look.assignments.end(), [&](const look::Assignment& setting) {
            return setting.byHand && setting.block == &block && setting.row->name == std::string(row) &&
                   setting.target == target &&
                   (target == look::kScene || look::matches(setting.pattern, name));
          });
      const std::string knob = std::string(block.path) + "." + row;
      found.add(Kind::noSuchNode,
                target == look::kScene
                    ? knob
                    : std::string(look::firstSection(target).name) + "." + name + "." + knob,
                bySet);
    };
    check(stage::CameraParams::block(), "target", look::kScene, "", now.get<stage::CameraParams>().target);
    for (const std::string& name : now.declared(look::kColorizers))
      check(passes::VolumeParams::block(), "node", look::kColorizers, name,
            now.getFor<passes::VolumeParams>(look::kColorizers, name).node);
    for (const std::string& name : now.declared(look::kDecorations))
      check(world::DecorationParams::block(), "node", look::kDecorations, name,
            now.getFor<world::DecorationParams>(look::kDecorations, name).node);
  }
}

void findOceans(const scene::SceneData& scene, const look::LookData& look, Findings& found) {
  if (world::oceanShape(scene, look.at(0)).isThere) return;
  std::vector<std::string> groups;
  for (const look::Assignment& setting : look.assignments) {
    const bool isMode =
        setting.block == &world::OceanParams::block() && setting.row->name == std::string("mode");
    if (isMode && setting.track) return;  // it comes and goes
    const std::string group = setting.block->path;
    const bool isOceans = group == "ocean" || group.starts_with("ocean.") || group == "float";
    if (setting.byHand && !isMode && isOceans) groups.push_back(group);
  }
  if (!look.declared(look::kDecorations).empty()) {
    const auto isByHand = [](const look::Assignment& setting) {
      return setting.target == look::kDecorations && setting.byHand;
    };
    found.add(Kind::noOcean, "decorations",
              std::any_of(look.assignments.begin(), look.assignments.end(), isByHand));
  }
  for (const std::string& group : groups) found.add(Kind::noOcean, group, true);
}

}  // namespace

std::vector<Finding> check(const Scene& scene, const Look& look, bool isForScene) {
  if (scene.empty()) return {};
  Findings found;
  findNames(scene.data(), look.data(), isForScene, found);
  findNodes(scene.data(), look.data(), found);
  findOceans(scene.data(), look.data(), found);
  return std::move(found.list);
}

}  // namespace scumble
