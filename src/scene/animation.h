// Clips that play: where nodes are, and how far morph targets are in, at a time.
#pragma once

#include <span>

#include "scene/scene_data.h"

namespace scumble::scene {

// What comes after a clip's end.
enum class Repeat : uint8_t { loop, once, pingPong };

struct PlayedClip {
  int clip = 0;      // index into SceneData::clips
  float weight = 1;  // share in the pose, from 0 on
  double speed = 1;
  double start = 0;  // seconds in the clip at time 0
  Repeat repeat = Repeat::loop;
};

// Seconds in the clip, from 0 to its duration, at a time of the world.
double clipTime(const PlayedClip& played, double duration, double time);

// A channel's value at a time in its clip (glTF 2.0, appendix C); before the first and after the last key
// those stand. `out`: componentsPerKey numbers; rotations have unit length.
void sampleChannel(const Channel& channel, double time, double* out);

// Every node's transform is that of its own time, so that some of them can be held while others move. In
// seconds; one a node.
struct NodeTimes {
  std::vector<double> transforms, morphWeights;
};

struct Pose {
  std::vector<glm::dmat4> world;                 // by node
  std::vector<std::vector<float>> morphWeights;  // by node: as many as its mesh has targets
  std::vector<bool> shown;                       // by node: whether it and all nodes above it are visible
};

// What several clips do to one property is averaged by their weights, rotations on the shorter arc; where the
// weights sum to less than one, the rest pose has what is missing. A node is visible where that average is a
// half or more. Matrices that lead out of what numbers can
// hold become zero: nothing is drawn there.
Pose poseAt(const SceneData& scene, std::span<const PlayedClip> clips, const NodeTimes& times);

// All nodes at one time.
Pose poseAt(const SceneData& scene, std::span<const PlayedClip> clips, double time);

// The world matrix of one node at a time, as poseAt has it.
glm::dmat4 worldAt(const SceneData& scene, std::span<const PlayedClip> clips, size_t node, double time);

}  // namespace scumble::scene
