#include "stage/playing.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace scumble::stage {

namespace {

using look::LookData;

bool isNamed(const LookData& look, const scene::Clip& clip) {
  return look.names(PlayParams::block(), "weight", look::kClips, clip.name);
}

bool namesAnyClip(const scene::SceneData& scene, const LookData& look) {
  return look.setsAny(PlayParams::block(), "weight", look::kClips) &&
         std::any_of(scene.clips.begin(), scene.clips.end(),
                     [&](const scene::Clip& clip) { return isNamed(look, clip); });
}

// Whether a clip is the first of its file.
bool isFirst(const scene::SceneData& scene, size_t clip) {
  return clip == 0 || scene.clips[clip].file != scene.clips[clip - 1].file;
}

}  // namespace

double heldTime(double time, int frames) {
  if (frames <= 0) return time;
  // A ten-thousandth of a frame keeps n / 24 seconds from falling short of frame n.
  return std::floor(std::floor(time * 24 + 1e-4) / frames) * frames / 24;
}

std::vector<scene::PlayedClip> playedClips(const scene::SceneData& scene, const LookData& look) {
  const bool named = namesAnyClip(scene, look);
  std::vector<scene::PlayedClip> played;
  for (size_t i = 0; i < scene.clips.size(); ++i) {
    const PlayParams params = look.getFor<PlayParams>(look::kClips, scene.clips[i].name);
    const float weight = named ? params.weight : isFirst(scene, i) ? 1.0f : 0.0f;
    // The knob's names are in the order of scene::Repeat.
    if (weight > 0)
      played.push_back({int(i), weight, params.speed, params.start, scene::Repeat(int(params.repeat))});
  }
  return played;
}

std::vector<int> everPlayed(const scene::SceneData& scene, const LookData& look) {
  if (!look.isAnimated()) {
    std::vector<int> played;
    for (const scene::PlayedClip& clip : playedClips(scene, look)) played.push_back(clip.clip);
    return played;
  }
  // Weights between keys lie above zero where one of the keys does. Of the look, only what clips are told.
  LookData told;
  std::set<double> times{0};
  for (const look::Assignment& setting : look.assignments) {
    if (setting.block != &PlayParams::block()) continue;
    told.assignments.push_back(setting);
    if (setting.track)
      for (const look::Key& key : setting.track->keys) times.insert(key.time);
  }
  std::set<int> played;
  for (const double time : times)
    for (const scene::PlayedClip& clip : playedClips(scene, told.at(time))) played.insert(clip.clip);
  return {played.begin(), played.end()};
}

std::vector<int> namedHolds(const scene::SceneData& scene, const LookData& whole) {
  std::vector<int> holds(scene.nodes.size(), -1);
  const look::ParamBlock& block = AnimationParams::block();
  // Of a large look little is about this.
  LookData look;
  for (const look::Assignment& setting : whole.assignments)
    if (setting.block == &block) look.assignments.push_back(setting);
  const bool byNode = look.setsAny(block, "hold", look::kNodes);
  const bool byMaterial = look.setsAny(block, "hold", look::kMaterials);
  if (!byNode && !byMaterial) return holds;
  std::vector<int> inherited(scene.nodes.size(), -1);
  for (size_t n = 0; n < scene.nodes.size(); ++n) {
    const scene::Node& node = scene.nodes[n];
    if (byNode && look.names(block, "hold", look::kNodes, node.name))
      inherited[n] = look.getFor<AnimationParams>(look::kNodes, node.name).hold;
    else if (node.parent >= 0)
      inherited[n] = inherited[size_t(node.parent)];
    holds[n] = inherited[n];
    if (holds[n] >= 0 || !byMaterial || node.mesh < 0) continue;
    for (const scene::Primitive& primitive : scene.meshes[size_t(node.mesh)]->primitives) {
      const std::string& material = scene.materials[size_t(primitive.material)].name;
      if (!look.names(block, "hold", look::kMaterials, material)) continue;
      holds[n] = look.getFor<AnimationParams>(look::kMaterials, material).hold;
      break;
    }
  }
  return holds;
}

}  // namespace scumble::stage
