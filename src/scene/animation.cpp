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

template <class Number>
glm::dquat quaternion(const Number* v) {
  return {double(v[3]), double(v[0]), double(v[1]), double(v[2])};
}

void store(const glm::dquat& q, double* out) {
  out[0] = q.x, out[1] = q.y, out[2] = q.z, out[3] = q.w;
}

// A weighted sum that may be short of the whole.
template <class T>
struct Mix {
  T sum{};
  double weight = 0;
  void add(const T& value, double share) {
    sum += value * share;
    weight += share;
  }
  T over(const T& rest) const {
    if (weight == 1) return sum;
    return weight > 1 ? sum / weight : sum + rest * (1 - weight);
  }
};

glm::dquat sameSide(const glm::dquat& q, const glm::dquat& as) {
  return glm::dot(q, as) < 0 ? -q : q;
}

// Opposite rotations may cancel out.
glm::dquat unit(const glm::dquat& q, const glm::dquat& instead) {
  const double length = glm::length(q);
  return length > 1e-6 ? q / length : instead;
}

// What clips make of one node's transform.
struct NodeMix {
  Mix<glm::dvec3> translation, scale;
  Mix<glm::dquat> rotation{glm::dquat(0, 0, 0, 0)};
  Mix<double> visible;

  void add(const Node& node, AnimatedProperty property, const double* v, double share) {
    switch (property) {
      case AnimatedProperty::translation:
        return translation.add({v[0], v[1], v[2]}, share);
      case AnimatedProperty::scale:
        return scale.add({v[0], v[1], v[2]}, share);
      case AnimatedProperty::visible:
        return visible.add(v[0] > 0.5 ? 1.0 : 0.0, share);
      default:
        return rotation.add(sameSide(quaternion(v), rotation.weight > 0 ? rotation.sum : node.local.rotation),
                            share);
    }
  }
  bool isVisible(const Node& node) const { return visible.over(node.visible ? 1.0 : 0.0) >= 0.5; }
  glm::dmat4 matrix(const Node& node) const {
    if (node.localMatrix) return *node.localMatrix;
    const glm::dquat& rest = node.local.rotation;
    Transform transform;
    transform.translation = translation.over(node.local.translation);
    transform.scale = scale.over(node.local.scale);
    transform.rotation = rotation.weight > 0 ? unit(rotation.over(sameSide(rest, rotation.sum)), rest) : rest;
    return transform.matrix();
  }
};

glm::dmat4 drawable(const glm::dmat4& world) {
  return isDrawable(world) ? world : glm::dmat4(0.0);
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

void sampleChannel(const Channel& channel, double time, double* out) {
  const Between at = findKeys(channel.times, time);
  const size_t n = size_t(channel.componentsPerKey);
  const bool cubic = channel.interpolation == ChannelInterpolation::cubicSpline;
  // Of a cubic key: in-tangent, value, out-tangent.
  const float* a = &channel.values[at.key * n * (cubic ? 3 : 1)];
  const bool rotates = channel.property == AnimatedProperty::rotation;
  if (at.part <= 0 || channel.interpolation == ChannelInterpolation::step) {
    std::copy_n(cubic ? a + n : a, n, out);
    return;
  }
  const double t = at.part;
  if (!cubic) {
    const float* b = a + n;
    if (rotates) {
      store(glm::normalize(glm::slerp(quaternion(a), quaternion(b), t)), out);
    } else {
      for (size_t i = 0; i < n; ++i) out[i] = double(a[i]) + t * (double(b[i]) - double(a[i]));
    }
    return;
  }
  const float *value = a + n, *leaving = a + 2 * n, *arriving = a + 3 * n, *next = a + 4 * n;
  const double t2 = t * t, t3 = t2 * t, seconds = at.seconds;
  for (size_t i = 0; i < n; ++i)
    out[i] = (2 * t3 - 3 * t2 + 1) * double(value[i]) + seconds * (t3 - 2 * t2 + t) * double(leaving[i]) +
             (3 * t2 - 2 * t3) * double(next[i]) + seconds * (t3 - t2) * double(arriving[i]);
  if (rotates) store(unit(quaternion(out), quaternion(value)), out);
}

Pose poseAt(const SceneData& scene, std::span<const PlayedClip> clips, const NodeTimes& times) {
  const size_t count = scene.nodes.size();
  std::vector<NodeMix> mixes(clips.empty() ? 0 : count);
  Pose pose;
  pose.morphWeights.resize(count);
  std::vector<std::vector<float>> morphShares(clips.empty() ? 0 : count);  // by node and weight
  std::vector<double> sampled;
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
        mixes[node].add(scene.nodes[node], channel.property, sampled.data(), double(played.weight));
        continue;
      }
      std::vector<float>&weights = pose.morphWeights[node], &shares = morphShares[node];
      const size_t first = channel.weight < 0 ? 0 : size_t(channel.weight);
      weights.resize(std::max(weights.size(), first + sampled.size()), 0.0f);
      shares.resize(weights.size(), 0.0f);
      for (size_t i = 0; i < sampled.size(); ++i) {
        weights[first + i] += played.weight * float(sampled[i]);
        shares[first + i] += played.weight;
      }
    }
  }

  pose.world.resize(count);
  const glm::dmat4 above = worldToOrigin(scene);
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
    const glm::dmat4 local = clips.empty() ? node.restTransform() : mixes[n].matrix(node);
    pose.world[n] = drawable((node.parent >= 0 ? pose.world[size_t(node.parent)] : above) * local);
  }
  return pose;
}

Pose poseAt(const SceneData& scene, std::span<const PlayedClip> clips, double time) {
  const std::vector<double> times(scene.nodes.size(), time);
  return poseAt(scene, clips, NodeTimes{times, times});
}

glm::dmat4 worldAt(const SceneData& scene, std::span<const PlayedClip> clips, size_t node, double time) {
  std::vector<int> above;  // itself too; sorted, as parents come first
  for (int n = int(node); n >= 0; n = scene.nodes[size_t(n)].parent) above.push_back(n);
  std::reverse(above.begin(), above.end());
  std::vector<NodeMix> mixes(above.size());
  double sampled[4];
  for (const PlayedClip& played : clips) {
    const Clip& clip = scene.clips[size_t(played.clip)];
    if (!(played.weight > 0)) continue;
    for (const Channel& channel : clip.channels) {
      const auto found = std::lower_bound(above.begin(), above.end(), channel.node);
      if (found == above.end() || *found != channel.node || channel.property == AnimatedProperty::weights)
        continue;
      sampleChannel(channel, clipTime(played, clip.duration, time), sampled);
      mixes[size_t(found - above.begin())].add(scene.nodes[size_t(channel.node)], channel.property, sampled,
                                               double(played.weight));
    }
  }
  glm::dmat4 world = worldToOrigin(scene);
  for (size_t i = 0; i < above.size(); ++i)
    world = drawable(world * mixes[i].matrix(scene.nodes[size_t(above[i])]));
  return world;
}

}  // namespace scumble::scene
