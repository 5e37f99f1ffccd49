// Where a scene's triangles are while clips play, in double precision and after the words of the glTF 2.0
// specification (3.7.2 meshes, 3.7.3 skins, appendix C), for what the product draws to be compared with.
#pragma once

#include <vector>

#include "scene/scene_data.h"
#include "tests/support/test_scene.h"

namespace scumble::test {

// A clip at a time of its own, from 0 to its duration; the shares of several sum to at most one, and the rest
// pose has what is missing.
struct ClipMoment {
  size_t clip = 0;
  double seconds = 0, share = 1;
};
using Moments = std::vector<ClipMoment>;

// A channel's numbers at a time in its clip: before the first and after the last key those of that key.
std::vector<double> channelAt(const scene::Channel& channel, double seconds);

// World matrices of the nodes.
std::vector<glm::dmat4> posedNodes(const scene::SceneData& scene, const Moments& moments);

// A primitive where a node, or one of its instances, draws it.
struct PosedPrimitive {
  const scene::Mesh* mesh = nullptr;
  const scene::Primitive* primitive = nullptr;
  int id = 0;                        // of the node, from 1
  std::vector<double> morphWeights;  // one a target
  std::vector<glm::dmat4> toWorld;   // one a vertex
  double mirror = 1;                 // -1 where the node turns triangles inside out (3.7.4)
};
std::vector<PosedPrimitive> posedPrimitives(const scene::SceneData& scene, const Moments& moments);

// Everything that is drawn; ids count nodes from 1. The order does not depend on the pose. What a
// double-sided material covers is there twice, once for either side.
std::vector<WorldTriangle> posedTriangles(const scene::SceneData& scene, const Moments& moments);

}  // namespace scumble::test
