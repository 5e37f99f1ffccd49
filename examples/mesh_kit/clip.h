// Animation as glTF has it: clips of channels, and skins. And ways to make channels from functions of time.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

namespace meshkit {

enum class Path { translation, rotation, scale, weights };
enum class Interpolation { linear, step, cubicSpline };

// One property of one node over time.
struct Channel {
  int node = -1;
  Path path = Path::translation;
  Interpolation interpolation = Interpolation::linear;
  std::vector<float> times;  // seconds, rising
  // Flat: 3, 4 (x, y, z, w), 3, or one for each morph target. A cubic spline has three for each time:
  // in-tangent, value, out-tangent.
  std::vector<float> values;
};

struct Clip {
  std::string name;
  std::vector<Channel> channels;
};

// Vertices name joints by their place in `joints`.
struct Skin {
  std::string name;
  std::vector<int> joints;              // nodes
  std::vector<glm::mat4> inverseBinds;  // from the mesh's space to the joint's, one for each joint
};

// Moments from 0 to `length`, both included, `count` + 1 of them.
std::vector<float> evenTimes(float length, int count);

// A key at every time, straight lines between them.
Channel translationKeys(int node, const std::vector<float>& times,
                        const std::function<glm::vec3(float)>& position);
Channel rotationKeys(int node, const std::vector<float>& times, const std::function<glm::quat(float)>& turn);
Channel scaleKeys(int node, const std::vector<float>& times, const std::function<glm::vec3(float)>& scale);
Channel weightKeys(int node, const std::vector<float>& times,
                   const std::function<std::vector<float>(float)>& weights);

// The same motion as a cubic spline, whose tangents are the function's own: few keys for what moves smoothly.
// The function must be defined a little before the first time and after the last.
Channel smoothTranslation(int node, const std::vector<float>& times,
                          const std::function<glm::vec3(float)>& position);
Channel smoothRotation(int node, const std::vector<float>& times,
                       const std::function<glm::quat(float)>& turn);

}  // namespace meshkit
