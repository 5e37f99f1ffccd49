// What a look sets that a scene knows nothing of.
#include <algorithm>
#include <set>

#include "frame/camera.h"
#include "frame/ocean.h"
#include "look/look_data.h"
#include "look/setting_path.h"
#include "passes/colorize/colorize.h"
#include "scene/find_node.h"
#include "scumble/renderer.h"

namespace scumble {

std::vector<std::string> settingsWithoutEffect(const Scene& scene, const Look& look, bool fileToo) {
  if (scene.empty()) return {};
  const scene::SceneData& data = scene.data();
  std::vector<std::string> idle;
  std::set<std::string> told;
  for (const look::Assignment& setting : look.data().assignments) {
    if (setting.target == look::kScene) continue;
    if (!setting.byHand && (!fileToo || look::isPattern(setting.pattern))) continue;
    const auto matchesAny = [&](const auto& named) {
      return std::any_of(named.begin(), named.end(),
                         [&](const auto& one) { return look::matches(setting.pattern, one.name); });
    };
    const bool found = setting.target == look::kMaterials
                           ? matchesAny(data.materials) || look::matches(setting.pattern, "Ground") ||
                                 look::matches(setting.pattern, "Ocean")
                       : setting.target == look::kNodes ? matchesAny(data.nodes)
                       : setting.target == look::kClips ? matchesAny(data.clips)
                                                        : true;
    const std::string path = std::string(look::firstSection(setting.target).name) + "." + setting.pattern;
    if (!found && told.insert(path).second) idle.push_back(path);
  }
  return idle;
}

std::vector<std::string> settingsWithoutNode(const Scene& scene, const Look& look) {
  if (scene.empty()) return {};
  const look::LookData& data = look.data();
  // When a node is named anew.
  std::set<double> times{0};
  for (const look::Assignment& setting : data.assignments)
    if (setting.track && setting.row->kind == look::ParamKind::name)
      for (const look::Key& key : setting.track->keys) times.insert(key.time);
  std::vector<std::string> idle;
  for (const double time : times) {
    const look::LookData now = data.at(time);
    const auto check = [&](const std::string& path, look::Name named) {
      const std::string& node = now.text(named);
      if (!node.empty() && scene::findNode(scene.data(), node) < 0 &&
          std::find(idle.begin(), idle.end(), path) == idle.end())
        idle.push_back(path);
    };
    check("camera.target", now.get<frame::CameraParams>().target);
    for (const std::string& name : now.declared(look::kColorizers))
      check("colorizers." + name + ".volume.node",
            now.getFor<passes::VolumeParams>(look::kColorizers, name).node);
    for (const std::string& name : now.declared(look::kDecorations))
      check("decorations." + name + ".water.node",
            now.getFor<frame::DecorationParams>(look::kDecorations, name).node);
  }
  return idle;
}

std::vector<std::string> settingsWithoutOcean(const Scene& scene, const Look& look) {
  if (scene.empty()) return {};
  const look::LookData& data = look.data();
  std::vector<std::string> idle;
  if (!data.declared(look::kDecorations).empty()) idle.emplace_back("decorations");
  for (const look::Assignment& setting : data.assignments) {
    const bool isMode =
        setting.block == &frame::OceanParams::block() && setting.row->name == std::string("mode");
    if (isMode && setting.track) return {};  // it comes and goes
    const std::string group = setting.block->path;
    const bool isOceans = group == "ocean" || group.starts_with("ocean.") || group == "float";
    if (setting.byHand && !isMode && isOceans && std::find(idle.begin(), idle.end(), group) == idle.end())
      idle.push_back(group);
  }
  return frame::oceanShape(scene.data(), data.at(0)).isThere ? std::vector<std::string>() : idle;
}

}  // namespace scumble
