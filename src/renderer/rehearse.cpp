// Renderer::prepare: frames are gone through, and not drawn, so that pipelines are compiled before they are
// needed.
#include <algorithm>
#include <cmath>
#include <set>

#include "renderer/feature_list.h"
#include "renderer/impl.h"

namespace scumble {

using namespace renderer;

namespace {

// Times between which tracks do not pass a key, and some in between.
std::vector<double> timesOf(const look::LookData& look, double start) {
  constexpr int kBetween = 8;
  std::set<double> keys;
  for (const look::Assignment& assignment : look.assignments)
    if (assignment.track)
      for (const look::Key& key : assignment.track->keys) keys.insert(key.time);
  std::vector<double> times{start};
  for (auto key = keys.begin(); key != keys.end(); ++key) {
    times.push_back(*key);
    const auto next = std::next(key);
    for (int i = 1; next != keys.end() && i < kBetween; ++i)
      times.push_back(*key + (*next - *key) * i / kBetween);
  }
  std::erase_if(times, [](double time) { return std::abs(time) >= Renderer::kMaxTime; });
  return times;
}

// A knob's values at which it may take other pipelines: its ends, off, and all choices.
std::set<double> valuesOf(const look::ParamRow& row) {
  switch (row.kind) {
    case look::ParamKind::toggle:
      return {0, 1};
    case look::ParamKind::choice: {
      std::set<double> values;
      for (size_t i = 0; i < look::choiceNames(row).size(); ++i) values.insert(double(i));
      return values;
    }
    case look::ParamKind::integer: {
      if (row.max - row.min > 64) return {row.min, row.defaultValue, row.max};
      std::set<double> values;
      for (double value = row.min; value <= row.max; ++value) values.insert(value);
      return values;
    }
    case look::ParamKind::number:
      return {row.min, std::clamp(0.0, row.min, row.max), row.defaultValue, 0.5 * (row.min + row.max),
              row.max};
    default:
      return {};
  }
}

// Settings by hand for the whole scene, of every knob.
std::vector<look::Assignment> everySetting() {
  std::vector<look::Assignment> settings;
  for (const look::ParamBlock* const block : look::allBlocks())
    for (const look::ParamRow& row : block->rows)
      for (const double value : valuesOf(row)) {
        if (!(block->targets & look::kScene)) continue;
        look::Assignment& setting = settings.emplace_back();
        setting.block = block, setting.row = &row;
        setting.value.number = value;
        setting.byHand = true;
      }
  return settings;
}

// "warp" of "warp.metatexture.skew".
std::string groupOf(const look::Assignment& setting) {
  const std::string path = setting.block->path;
  return path.substr(0, path.find('.'));
}

// The same setting, for what is called so alone.
look::Assignment settingFor(look::Assignment setting, look::Target target, const std::string& name) {
  setting.target = target;
  setting.pattern = name;
  return setting;
}

}  // namespace

Status Renderer::Impl::prepare(const Request& request, Rehearsal extent) {
  // Frames at all times of the look itself.
  Request rehearsal = request;
  rehearsal.isRehearsal = true;
  const bool isWhole = extent == Rehearsal::tracks;
  const std::vector<double> times = timesOf(request.look, request.time);
  for (size_t i = 0; i < times.size(); ++i) {
    rehearsal.time = times[i];
    rehearsal.progressFrom = isWhole ? double(i) / double(times.size()) : 0;
    rehearsal.progressTo = isWhole ? double(i + 1) / double(times.size()) : 0;
    if (Status status = begin(rehearsal); !status) return status;
  }
  if (isWhole) return Done{};

  // A frame with settings besides; whether it has compiled anything. Where features come or go, it is another
  // scene.
  const scene::SceneData& scene = request.scene.data();
  const auto whichFeatures = [&](const look::LookData& look) {
    std::vector<bool> there;
    for (const world::PlannedFeature& planned : plannedFeatures(scene, look.at(request.time)))
      there.push_back(bool(planned.plan));
    return there;
  };
  const std::vector<bool> features = whichFeatures(request.look);
  bool hasCompiled = false;
  const auto rehearse = [&](std::initializer_list<look::Assignment> settings, double part) -> Status {
    look::LookData look = request.look;
    look.assignments.insert(look.assignments.end(), settings);
    if (whichFeatures(look) != features) return Done{};
    Request changed{request.scene, look, request.time, request.views, request.options};
    changed.isRehearsal = true;
    changed.progressFrom = changed.progressTo = part;
    const uint32_t before = device->pipelines().made();
    Status status = begin(changed);
    hasCompiled = device->pipelines().made() > before;
    return status;
  };

  // Each knob alone, of the whole scene; those that compile something, of one material and of one node, too.
  const double alone = extent == Rehearsal::knobs ? 1 : 0.2;
  const std::vector<look::Assignment> settings = everySetting();
  const auto isStructural = [&](const look::Assignment& setting) {
    return std::any_of(structural.begin(), structural.end(), [&](const look::Assignment& known) {
      return known.row == setting.row && known.value.number == setting.value.number;
    });
  };
  const auto drawn = std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                  [](const scene::Node& node) { return node.mesh >= 0; });
  for (size_t i = 0; i < settings.size(); ++i) {
    const look::Assignment& setting = settings[i];
    const double part = alone * double(i) / double(settings.size());
    if (Status status = rehearse({setting}, part); !status) return status;
    if (!hasCompiled) continue;
    if (!isStructural(setting)) structural.push_back(setting);
    if (drawn == scene.nodes.end()) continue;
    const scene::Mesh& mesh = scene.meshes[size_t(drawn->mesh)];
    if ((setting.block->targets & look::kMaterials) && !mesh.primitives.empty()) {
      const std::string& name = scene.materials[size_t(mesh.primitives[0].material)].name;
      if (Status status = rehearse({settingFor(setting, look::kMaterials, name)}, part); !status)
        return status;
    }
    if (setting.block->targets & look::kNodes)
      if (Status status = rehearse({settingFor(setting, look::kNodes, drawn->name)}, part); !status)
        return status;
  }

  // Those in pairs, and with whatever is in their own group: it may mean nothing without them.
  for (size_t a = 0; a < structural.size() && extent == Rehearsal::pairs; ++a) {
    const look::Assignment first = structural[a];
    const double part = alone + (1 - alone) * double(a) / double(structural.size());
    for (const look::Assignment& second : settings)
      if (first.row != second.row && (groupOf(first) == groupOf(second) || isStructural(second)))
        if (Status status = rehearse({first, second}, part); !status) return status;
  }
  rehearsal.time = request.time;
  rehearsal.progressFrom = rehearsal.progressTo = 1;
  return begin(rehearsal);
}

}  // namespace scumble
