#include "scene/animation.h"

#include <algorithm>
#include <cmath>

#include "scene/prepare_mesh.h"

namespace scumble::scene {

namespace {

// Keys around a time: the one before, and how far it is to the next (0 to 1).
struct Between {
  size_t key;
  double part, seconds;  // length of the interval
};

Between findKeys(const std::vector<float>& times, double time) {
  if (!(time > times.front())) return {0, 0, 0};
  if (time >= times.back()) return {times.size() - 1, 0, 0};
  const size_t next = size_t(std::upper_bound(times.begin(), times.end(), time,
                                              [](double t, float key) { return t < double(key); }) -
                             times.begin());
  const double first = times[next - 1], seconds = times[next] - first;
  return {next - 1, (time - first) / seconds, seconds};
}

glm::quat quaternion(const float* v) {
  return {v[3], v[0], v[1], v[2]};
}

void store(const glm::quat& q, float* out) {
  out[0] = q.x, out[1] = q.y, out[2] = q.z, out[3] = q.w;
}

// A weighted sum that may be short of the whole.
template <class T>
struct Mix {
  T sum{};
  float weight = 0;
  void add(const T& value, float share) {
    sum += value * share;
    weight += share;
  }
  T over(const T& rest) const {
    if (weight == 1) return sum;
    return weight > 1 ? sum / weight : sum + rest * (1 - weight);
  }
};

glm::quat sameSide(const glm::quat& q, const glm::quat& as) {
  return glm::dot(q, as) < 0 ? -q : q;
}

// Opposite rotations may cancel out.
glm::quat unit(const glm::quat& q, const glm::quat& instead) {
  const float length = glm::length(q);
  return length > 1e-6f ? q / length : instead;
}

// What clips make of one node's transform.
struct NodeMix {
  Mix<glm::vec3> translation, scale;
  Mix<glm::quat> rotation{glm::quat(0, 0, 0, 0)};
  Mix<float> visible;

  void add(const Node& node, AnimatedProperty property, const float* v, float share) {
    switch (property) {
      case AnimatedProperty::translation:
        return translation.add({v[0], v[1], v[2]}, share);
      case AnimatedProperty::scale:
        return scale.add({v[0], v[1], v[2]}, share);
      case AnimatedProperty::visible:
        return visible.add(v[0] > 0.5f ? 1.0f : 0.0f, share);
      default:
        return rotation.add(sameSide(quaternion(v), rotation.weight > 0 ? rotation.sum : node.local.rotation),
                            share);
    }
  }
  bool isVisible(const Node& node) const { return visible.over(node.visible ? 1.0f : 0.0f) >= 0.5f; }
  glm::mat4 matrix(const Node& node) const {
    if (node.localMatrix) return *node.localMatrix;
    Transform transform;
    transform.translation = translation.over(node.local.translation);
    transform.scale = scale.over(node.local.scale);
    transform.rotation =
        rotation.weight > 0
            ? unit(rotation.over(sameSide(node.local.rotation, rotation.sum)), node.local.rotation)
            : node.local.rotation;
    return transform.matrix();
  }
};

glm::mat4 drawable(const glm::mat4& world) {
  return isDrawable(world) ? world : glm::mat4(0.0f);
}

}  // namespace

double clipTime(const PlayedClip& played, double duration, double time) {
  const double at = played.start + played.speed * time;
  if (!(duration > 0)) return 0;
  switch (played.repeat) {
    case Repeat::once:
      return std::clamp(at, 0.0, duration);
    case Repeat::pingPong: {
      const double phase = at - 2 * duration * std::floor(at / (2 * duration));
      return phase <= duration ? phase : 2 * duration - phase;
    }
    default:
      return at - duration * std::floor(at / duration);
  }
}

void sampleChannel(const Channel& channel, double time, float* out) {
  const Between at = findKeys(channel.times, time);
  const size_t n = size_t(channel.componentsPerKey);
  const bool cubic = channel.interpolation == Interpolation::cubicSpline;
  // Of a cubic key: in-tangent, value, out-tangent.
  const float* a = &channel.values[at.key * n * (cubic ? 3 : 1)];
  const bool rotates = channel.property == AnimatedProperty::rotation;
  if (at.part <= 0 || channel.interpolation == Interpolation::step) {
    std::copy_n(cubic ? a + n : a, n, out);
    return;
  }
  const float t = float(at.part);
  if (!cubic) {
    const float* b = a + n;
    if (rotates) {
      store(glm::normalize(glm::slerp(quaternion(a), quaternion(b), t)), out);
    } else {
      for (size_t i = 0; i < n; ++i) out[i] = a[i] + t * (b[i] - a[i]);
    }
    return;
  }
  const float *value = a + n, *leaving = a + 2 * n, *arriving = a + 3 * n, *next = a + 4 * n;
  const float t2 = t * t, t3 = t2 * t, seconds = float(at.seconds);
  for (size_t i = 0; i < n; ++i)
    out[i] = (2 * t3 - 3 * t2 + 1) * value[i] + seconds * (t3 - 2 * t2 + t) * leaving[i] +
             (3 * t2 - 2 * t3) * next[i] + seconds * (t3 - t2) * arriving[i];
  if (rotates) store(unit(quaternion(out), quaternion(value)), out);
}

Pose poseAt(const SceneData& scene, std::span<const PlayedClip> clips, const NodeTimes& times) {
  const size_t count = scene.nodes.size();
  std::vector<NodeMix> mixes(clips.empty() ? 0 : count);
  Pose pose;
  pose.morphWeights.resize(count);
  std::vector<std::vector<float>> morphShares(clips.empty() ? 0 : count);  // by node and weight
  std::vector<float> sampled;
  for (const PlayedClip& played : clips) {
    const Clip& clip = scene.clips[size_t(played.clip)];
    if (!(played.weight > 0)) continue;
    for (const Channel& channel : clip.channels) {
      const size_t node = size_t(channel.node);
      const bool morphs = channel.property == AnimatedProperty::weights;
      sampled.resize(size_t(channel.componentsPerKey));
      sampleChannel(channel,
                    clipTime(played, clip.duration, (morphs ? times.morphWeights : times.transforms)[node]),
                    sampled.data());
      if (!morphs) {
        mixes[node].add(scene.nodes[node], channel.property, sampled.data(), played.weight);
        continue;
      }
      std::vector<float>&weights = pose.morphWeights[node], &shares = morphShares[node];
      const size_t first = channel.weight < 0 ? 0 : size_t(channel.weight);
      weights.resize(std::max(weights.size(), first + sampled.size()), 0.0f);
      shares.resize(weights.size(), 0.0f);
      for (size_t i = 0; i < sampled.size(); ++i) {
        weights[first + i] += played.weight * sampled[i];
        shares[first + i] += played.weight;
      }
    }
  }

  pose.world.resize(count);
  pose.shown.resize(count);
  for (size_t n = 0; n < count; ++n) {
    const Node& node = scene.nodes[n];
    if (node.mesh >= 0) {
      const std::vector<float>& rest = restMorphWeights(scene, node);
      std::vector<float>& weights = pose.morphWeights[n];
      weights.resize(rest.size(), 0.0f);
      for (size_t i = 0; i < rest.size(); ++i) {
        const float share = !clips.empty() && i < morphShares[n].size() ? morphShares[n][i] : 0.0f;
        weights[i] = share > 1 ? weights[i] / share : weights[i] + (1 - share) * rest[i];
      }
    }
    const bool isVisible = clips.empty() ? node.visible : mixes[n].isVisible(node);
    pose.shown[n] = isVisible && (node.parent < 0 || pose.shown[size_t(node.parent)]);
    const glm::mat4 local = clips.empty() ? node.restTransform() : mixes[n].matrix(node);
    pose.world[n] = drawable(node.parent >= 0 ? pose.world[size_t(node.parent)] * local : local);
  }
  return pose;
}

Pose poseAt(const SceneData& scene, std::span<const PlayedClip> clips, double time) {
  const std::vector<double> times(scene.nodes.size(), time);
  return poseAt(scene, clips, NodeTimes{times, times});
}

glm::mat4 worldAt(const SceneData& scene, std::span<const PlayedClip> clips, size_t node, double time) {
  std::vector<int> above;  // itself too; sorted, as parents come first
  for (int n = int(node); n >= 0; n = scene.nodes[size_t(n)].parent) above.push_back(n);
  std::reverse(above.begin(), above.end());
  std::vector<NodeMix> mixes(above.size());
  float sampled[4];
  for (const PlayedClip& played : clips) {
    const Clip& clip = scene.clips[size_t(played.clip)];
    if (!(played.weight > 0)) continue;
    for (const Channel& channel : clip.channels) {
      const auto found = std::lower_bound(above.begin(), above.end(), channel.node);
      if (found == above.end() || *found != channel.node || channel.property == AnimatedProperty::weights)
        continue;
      sampleChannel(channel, clipTime(played, clip.duration, time), sampled);
      mixes[size_t(found - above.begin())].add(scene.nodes[size_t(channel.node)], channel.property, sampled,
                                               played.weight);
    }
  }
  glm::mat4 world(1.0f);
  for (size_t i = 0; i < above.size(); ++i)
    world = drawable(world * mixes[i].matrix(scene.nodes[size_t(above[i])]));
  return world;
}

}  // namespace scumble::scene
