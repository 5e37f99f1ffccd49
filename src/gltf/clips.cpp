#include <algorithm>
#include <cmath>
#include <numeric>

#include "gltf/import.h"
#include "scene/prepare_mesh.h"

namespace scumble::gltf {

namespace {

size_t morphTargetsOf(const SceneData& scene, const Node& node) {
  return node.mesh < 0 ? 0 : scene.meshes[node.mesh]->morphWeights.size();
}

std::vector<float> readTimes(const Import& import, const Accessor& accessor) {
  if (accessor.components() != 1 || accessor.type != ComponentType::f32)
    fail(accessor.path, "is no accessor of float scalars, as times must be");
  import.budget.takeBytes(accessor.count * 4, accessor.path);
  std::vector<float> times(accessor.count);
  readFloats(accessor, {}, 1, times.data());
  return times;
}

// Keeps keys that are finite, in the order of time, one a time. `perKey` numbers belong to each.
void cleanKeys(Channel& channel, size_t perKey, const std::string& path, ImportWarnings& warnings) {
  const size_t count = channel.times.size();
  std::vector<uint32_t> order;
  order.reserve(count);
  bool broken = false, unsorted = false;
  for (size_t i = 0; i < count; ++i) {
    bool finite = std::abs(channel.times[i]) < 1e9f;
    for (size_t k = 0; k < perKey && finite; ++k)
      finite = std::abs(channel.values[i * perKey + k]) < kMaxCoordinate;
    if (finite) order.push_back(static_cast<uint32_t>(i));
    broken |= !finite;
  }
  for (size_t i = 1; i < order.size(); ++i)
    unsorted |= !(channel.times[order[i]] > channel.times[order[i - 1]]);
  // Where none is left, the channel's own warning says so.
  if (broken && !order.empty()) warnings.add(path, "keys that are not finite are left out");
  if (!broken && !unsorted) return;
  if (unsorted) {
    warnings.add(path, "keys are sorted by time, and those at a time that is taken are left out");
    const auto& times = channel.times;
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return times[a] < times[b]; });
    order.erase(
        std::unique(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return times[a] == times[b]; }),
        order.end());
  }
  std::vector<float> times, values;
  for (const uint32_t i : order) {
    times.push_back(channel.times[i]);
    values.insert(values.end(), channel.values.begin() + static_cast<ptrdiff_t>(i * perKey),
                  channel.values.begin() + static_cast<ptrdiff_t>((i + 1) * perKey));
  }
  channel.times = std::move(times);
  channel.values = std::move(values);
}

void normalizeRotations(Channel& channel) {
  const bool cubic = channel.interpolation == Interpolation::cubicSpline;
  const size_t step = cubic ? 12 : 4, first = cubic ? 4 : 0;
  for (size_t i = first; i + 3 < channel.values.size(); i += step) {
    float* q = &channel.values[i];
    const float length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (length > 1e-12f && std::isfinite(length)) {
      for (int k = 0; k < 4; ++k) q[k] /= length;
    } else {
      q[0] = q[1] = q[2] = 0.0f;
      q[3] = 1.0f;
    }
  }
}

// Drops the numbers of morph targets beyond those that the mesh keeps.
void trimWeights(Channel& channel, size_t have, size_t keep) {
  if (have == keep) return;
  std::vector<float> values;
  for (size_t i = 0; i + have <= channel.values.size(); i += have)
    values.insert(values.end(), channel.values.begin() + static_cast<ptrdiff_t>(i),
                  channel.values.begin() + static_cast<ptrdiff_t>(i + keep));
  channel.values = std::move(values);
}

bool propertyOf(const std::string& path, AnimatedProperty& property) {
  constexpr std::pair<const char*, AnimatedProperty> kPaths[] = {
      {"translation", AnimatedProperty::translation},
      {"rotation", AnimatedProperty::rotation},
      {"scale", AnimatedProperty::scale},
      {"weights", AnimatedProperty::weights}};
  for (const auto& [name, value] : kPaths)
    if (path == name) {
      property = value;
      return true;
    }
  return false;
}

// False when the channel moves nothing in this scene.
bool readChannel(const Import& import, const Maps& maps, const SceneData& scene, const JsonView& json,
                 const JsonView& samplers, Channel& channel) {
  // What it moves.
  const JsonView target = json.object("target");
  if (!target) json.failAt("target", "is missing");
  const int64_t node = target.index("node", maps.nodes.size(), "node");
  if (node < 0 || maps.nodes[node] < 0) return false;
  channel.node = maps.nodes[node];
  if (scene.nodes[channel.node].localMatrix)
    target.failAt("node", "names a node whose matrix is no composition of translation, rotation and scale");
  if (!propertyOf(target.text("path"), channel.property)) target.failAt("path", "is not a known property");

  // When, and how it goes from key to key.
  const JsonView sampler =
      samplers.at(static_cast<size_t>(json.requiredIndex("sampler", samplers.size(), "sampler")));
  const std::string interpolation = sampler.text("interpolation", "LINEAR");
  if (interpolation == "STEP")
    channel.interpolation = Interpolation::step;
  else if (interpolation == "CUBICSPLINE")
    channel.interpolation = Interpolation::cubicSpline;
  else if (interpolation != "LINEAR")
    sampler.failAt("interpolation", "is not a known interpolation");

  const size_t accessors = import.accessors.count();
  channel.times =
      readTimes(import, import.accessors.open(sampler.requiredIndex("input", accessors, "accessor")));
  const Accessor output = import.accessors.open(sampler.requiredIndex("output", accessors, "accessor"));
  if (channel.times.empty()) sampler.failAt("input", "holds no times");

  // As many values as the keys ask for.
  const size_t tangents = channel.interpolation == Interpolation::cubicSpline ? 3 : 1;
  const bool weights = channel.property == AnimatedProperty::weights;
  const int shape = weights ? 1 : channel.property == AnimatedProperty::rotation ? 4 : 3;
  if (output.columns != 1 || output.rows != shape)
    sampler.failAt("output", "has the wrong type for what it animates");
  size_t perKey = static_cast<size_t>(shape);
  if (weights) {
    perKey = output.count / (channel.times.size() * tangents);
    const size_t targets = morphTargetsOf(scene, scene.nodes[channel.node]);
    if (perKey == 0 || targets == 0 || perKey < targets)
      sampler.failAt("output", "does not fit the mesh's morph targets");
  }
  const size_t elements = channel.times.size() * tangents * (weights ? perKey : 1);
  if (output.count != elements)
    sampler.failAt("output", "holds " + std::to_string(output.count) + " elements where the times ask for " +
                                 std::to_string(elements));
  // The values.
  import.budget.takeBytes(elements * shape * 4, output.path);
  channel.values.resize(elements * shape);
  readFloats(output, {}, shape, channel.values.data());
  if (weights) {
    const size_t targets = morphTargetsOf(scene, scene.nodes[channel.node]);
    trimWeights(channel, perKey, targets);
    perKey = targets;
  }
  channel.componentsPerKey = static_cast<int>(perKey);
  cleanKeys(channel, perKey * tangents, json.path(), import.warnings);
  if (channel.times.empty()) json.failAt("sampler", "holds no usable key");
  if (channel.property == AnimatedProperty::rotation) normalizeRotations(channel);
  return true;
}

}  // namespace

void readClips(const Import& import, const Maps& maps, SceneData& scene) {
  JsonView list;
  try {
    list = import.document.list("animations");
  } catch (const ImportFailure& failure) {
    warnIgnored(import.warnings, failure, "the animations are");
  }
  for (size_t i = 0; i < list.size(); ++i) {
    Clip clip;
    try {
      const JsonView json = list.at(i), channels = json.list("channels"), samplers = json.list("samplers");
      clip.name = json.text("name");
      if (clip.name.empty()) clip.name = "clip " + std::to_string(i);
      for (size_t k = 0; k < channels.size(); ++k) {
        try {
          Channel channel;
          if (readChannel(import, maps, scene, channels.at(k), samplers, channel)) {
            clip.duration = std::max(clip.duration, channel.times.back());
            clip.channels.push_back(std::move(channel));
          }
        } catch (const ImportFailure& failure) {
          warnIgnored(import.warnings, failure, "an animation channel is");
        }
      }
    } catch (const ImportFailure& failure) {
      warnIgnored(import.warnings, failure, "an animation is");
    }
    if (!clip.channels.empty()) scene.clips.push_back(std::move(clip));
  }
}

}  // namespace scumble::gltf
