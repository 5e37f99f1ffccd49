#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <optional>
#include <string_view>

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
  const bool cubic = channel.interpolation == ChannelInterpolation::cubicSpline;
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

constexpr const char* kPointer = "KHR_animation_pointer";

// A file that requires KHR_animation_pointer animates what we do not: without that it is not itself.
struct Refusal {
  ImportFailure failure;
};

// What a channel moves.
struct Target {
  std::vector<int> nodes;  // ours; none where this scene has none of them
  AnimatedProperty property = AnimatedProperty::translation;
  int weight = -1;  // as Channel has it
};

std::optional<AnimatedProperty> propertyOf(std::string_view path) {
  constexpr std::pair<std::string_view, AnimatedProperty> kPaths[] = {
      {"translation", AnimatedProperty::translation},
      {"rotation", AnimatedProperty::rotation},
      {"scale", AnimatedProperty::scale},
      {"weights", AnimatedProperty::weights}};
  for (const auto& [name, property] : kPaths)
    if (path == name) return property;
  return std::nullopt;
}

// The steps of a JSON pointer; none where it is none.
std::vector<std::string_view> stepsOf(std::string_view pointer) {
  std::vector<std::string_view> steps;
  if (!pointer.starts_with('/')) return steps;
  while (!pointer.empty()) {
    pointer.remove_prefix(1);
    const size_t end = std::min(pointer.find('/'), pointer.size());
    steps.push_back(pointer.substr(0, end));
    pointer.remove_prefix(end);
  }
  return steps;
}

// An index of a list, as JSON pointers write it.
std::optional<size_t> indexIn(std::string_view step, size_t limit) {
  size_t index = 0;
  const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
  if (error != std::errc() || end != step.data() + step.size() || index >= limit) return std::nullopt;
  return index;
}

// What a pointer of KHR_animation_pointer names; nothing where that is none of what we animate.
std::optional<Target> namedBy(std::string_view pointer, const Import& import, const Maps& maps,
                              const SceneData& scene) {
  const std::vector<std::string_view> steps = stepsOf(pointer);
  if (steps.size() < 3) return std::nullopt;
  const bool isNode = steps[0] == "nodes", isMesh = steps[0] == "meshes";
  const std::vector<int>& map = isNode ? maps.nodes : maps.meshes;
  const std::optional<size_t> index = isNode || isMesh ? indexIn(steps[1], map.size()) : std::nullopt;
  if (!index) return std::nullopt;
  Target target;
  const int ours = map[*index];
  if (isNode && ours >= 0) target.nodes.push_back(ours);
  // A mesh's own weights are those of nodes that have none.
  if (isMesh)
    for (size_t file = 0; file < maps.nodes.size(); ++file)
      if (const int n = maps.nodes[file]; n >= 0 && ours >= 0 && scene.nodes[size_t(n)].mesh == ours &&
                                          !import.document.list("nodes").at(file).has("weights"))
        target.nodes.push_back(n);

  if (isNode && steps.size() == 5 && steps[2] == "extensions" && steps[3] == "KHR_node_visibility" &&
      steps[4] == "visible") {
    target.property = AnimatedProperty::visible;
    return target;
  }
  const std::optional<AnimatedProperty> property = propertyOf(steps[2]);
  if (!property || (isMesh && *property != AnimatedProperty::weights)) return std::nullopt;
  target.property = *property;
  if (steps.size() == 3) return target;
  // One of the weights.
  const std::optional<size_t> weight = indexIn(steps[3], kMaxMorphTargets);
  if (steps.size() != 4 || *property != AnimatedProperty::weights || !weight) return std::nullopt;
  target.weight = int(*weight);
  std::erase_if(target.nodes,
                [&](int n) { return *weight >= morphTargetsOf(scene, scene.nodes[size_t(n)]); });
  return target;
}

Target targetOf(const Import& import, const Maps& maps, const SceneData& scene, const JsonView& json) {
  const JsonView target = json.object("target");
  if (!target) json.failAt("target", "is missing");
  Target found;
  if (target.text("path") == "pointer") {
    const JsonView extension = target.extension(kPointer);
    const std::string pointer = extension ? extension.text("pointer") : "";
    const std::optional<Target> named = namedBy(pointer, import, maps, scene);
    if (!named) {
      const ImportFailure failure{Error{ErrorKind::unusableFile, "", 0,
                                        (extension ? extension : target).pathOf("pointer"),
                                        "animates \"" + pointer.substr(0, 80) + "\", which scumble does not",
                                        "export the scene without that animation"}};
      if (import.document.isRequired(kPointer)) throw Refusal{failure};
      throw failure;
    }
    found = *named;
  } else {
    const std::optional<AnimatedProperty> property = propertyOf(target.text("path"));
    const int64_t node = target.index("node", maps.nodes.size(), "node");
    if (node >= 0 && maps.nodes[size_t(node)] >= 0) found.nodes.push_back(maps.nodes[size_t(node)]);
    if (!property && !found.nodes.empty()) target.failAt("path", "is not a known property");
    found.property = property.value_or(AnimatedProperty::translation);
  }
  const bool moves =
      found.property != AnimatedProperty::weights && found.property != AnimatedProperty::visible;
  for (const int node : found.nodes)
    if (moves && scene.nodes[size_t(node)].localMatrix)
      target.failAt("node", "names a node whose matrix is no composition of translation, rotation and scale");
  return found;
}

// Numbers of one key of a property; of weights, one of them.
int shapeOf(AnimatedProperty property) {
  switch (property) {
    case AnimatedProperty::weights:
    case AnimatedProperty::visible:
      return 1;
    case AnimatedProperty::rotation:
      return 4;
    default:
      return 3;
  }
}

// For the node, property and weight that `channel` has already.
Channel readChannel(const Import& import, const SceneData& scene, const JsonView& json,
                    const JsonView& samplers, Channel channel) {
  // When, and how it goes from key to key.
  const JsonView sampler =
      samplers.at(static_cast<size_t>(json.requiredIndex("sampler", samplers.size(), "sampler")));
  const std::string interpolation = sampler.text("interpolation", "LINEAR");
  if (interpolation == "STEP" || channel.property == AnimatedProperty::visible)
    channel.interpolation = ChannelInterpolation::step;
  else if (interpolation == "CUBICSPLINE")
    channel.interpolation = ChannelInterpolation::cubicSpline;
  else if (interpolation != "LINEAR")
    sampler.failAt("interpolation", "is not a known interpolation");

  const size_t accessors = import.accessors.count();
  channel.times =
      readTimes(import, import.accessors.open(sampler.requiredIndex("input", accessors, "accessor")));
  const Accessor output = import.accessors.open(sampler.requiredIndex("output", accessors, "accessor"));
  if (channel.times.empty()) sampler.failAt("input", "holds no times");

  // As many values as the keys ask for.
  const size_t tangents = channel.interpolation == ChannelInterpolation::cubicSpline ? 3 : 1;
  const bool weights = channel.property == AnimatedProperty::weights && channel.weight < 0;
  const int shape = shapeOf(channel.property);
  if (output.columns != 1 || output.rows != shape)
    sampler.failAt("output", "has the wrong type for what it animates");
  size_t perKey = static_cast<size_t>(shape);
  const size_t targets = morphTargetsOf(scene, scene.nodes[channel.node]);
  if (weights) {
    perKey = output.count / (channel.times.size() * tangents);
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
    trimWeights(channel, perKey, targets);
    perKey = targets;
  }
  channel.componentsPerKey = static_cast<int>(perKey);
  cleanKeys(channel, perKey * tangents, json.path(), import.warnings);
  if (channel.times.empty()) json.failAt("sampler", "holds no usable key");
  if (channel.property == AnimatedProperty::rotation) normalizeRotations(channel);
  return channel;
}

// All that a channel of the file moves.
void readChannels(const Import& import, const Maps& maps, const SceneData& scene, const JsonView& json,
                  const JsonView& samplers, Clip& clip) {
  const Target target = targetOf(import, maps, scene, json);
  for (const int node : target.nodes) {
    Channel channel;
    channel.node = node;
    channel.property = target.property;
    channel.weight = target.weight;
    channel = readChannel(import, scene, json, samplers, std::move(channel));
    clip.duration = std::max(clip.duration, channel.times.back());
    clip.channels.push_back(std::move(channel));
  }
}

}  // namespace

void readClips(const Import& import, const Maps& maps, SceneData& scene) try {
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
          readChannels(import, maps, scene, channels.at(k), samplers, clip);
        } catch (const ImportFailure& failure) {
          warnIgnored(import.warnings, failure, "an animation channel is");
        }
      }
    } catch (const ImportFailure& failure) {
      warnIgnored(import.warnings, failure, "an animation is");
    }
    if (!clip.channels.empty()) scene.clips.push_back(std::move(clip));
  }
} catch (const Refusal& refusal) {
  throw refusal.failure;
}

}  // namespace scumble::gltf
