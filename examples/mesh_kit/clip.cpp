#include "mesh_kit/clip.h"

namespace meshkit {
namespace {

template <class T>
void append(std::vector<float>& values, const T& v) {
  for (int i = 0; i < v.length(); ++i) values.push_back(v[i]);
}

glm::vec4 asVector(glm::quat q) {
  return {q.x, q.y, q.z, q.w};
}

// A quaternion and its negative are the same turn, but halfway between them lies none: neighbouring keys
// take the one that is nearer.
std::function<glm::vec4(float)> withoutJumps(const std::function<glm::quat(float)>& turn) {
  return [turn, last = glm::quat(1, 0, 0, 0)](float time) mutable {
    glm::quat q = turn(time);
    if (glm::dot(q, last) < 0.0f) q = -q;
    last = q;
    return asVector(q);
  };
}

template <class F>
Channel keys(int node, Path path, const std::vector<float>& times, F value) {
  Channel channel{node, path, Interpolation::linear, times, {}};
  for (float time : times) append(channel.values, value(time));
  return channel;
}

template <class F>
Channel spline(int node, Path path, const std::vector<float>& times, F value) {
  constexpr float kStep = 1.0f / 256.0f;  // seconds to both sides, for the slope
  Channel channel{node, path, Interpolation::cubicSpline, times, {}};
  for (float time : times) {
    const auto before = value(time - kStep), now = value(time), after = value(time + kStep);
    const auto slope = (after - before) / (2.0f * kStep);
    append(channel.values, slope);
    append(channel.values, now);
    append(channel.values, slope);
  }
  return channel;
}

}  // namespace

std::vector<float> evenTimes(float length, int count) {
  std::vector<float> times;
  for (int i = 0; i <= count; ++i) times.push_back(length * float(i) / float(count));
  return times;
}

Channel translationKeys(int node, const std::vector<float>& times,
                        const std::function<glm::vec3(float)>& position) {
  return keys(node, Path::translation, times, position);
}

Channel rotationKeys(int node, const std::vector<float>& times, const std::function<glm::quat(float)>& turn) {
  return keys(node, Path::rotation, times, withoutJumps(turn));
}

Channel scaleKeys(int node, const std::vector<float>& times, const std::function<glm::vec3(float)>& scale) {
  return keys(node, Path::scale, times, scale);
}

Channel weightKeys(int node, const std::vector<float>& times,
                   const std::function<std::vector<float>(float)>& weights) {
  Channel channel{node, Path::weights, Interpolation::linear, times, {}};
  for (float time : times)
    for (float weight : weights(time)) channel.values.push_back(weight);
  return channel;
}

Channel smoothTranslation(int node, const std::vector<float>& times,
                          const std::function<glm::vec3(float)>& position) {
  return spline(node, Path::translation, times, position);
}

Channel smoothRotation(int node, const std::vector<float>& times,
                       const std::function<glm::quat(float)>& turn) {
  return spline(node, Path::rotation, times, withoutJumps(turn));
}

}  // namespace meshkit
