// Small scenes that move, for tests that draw: written as glTF and read back through the importer.
#pragma once

#include <string>
#include <vector>

#include "tests/support/test_scene.h"

namespace scumble::test {

struct AnimatedMesh {
  TestMesh shape;
  // Skinning, vertex-major: 4 or 8 joints and weights a vertex; joints in 16 bits where one is above 255.
  int influences = 0;
  std::vector<uint16_t> joints;
  std::vector<float> weights;
  struct Target {
    std::vector<glm::vec3> positions, normals;  // empty or one a vertex
    bool sparse = false;                        // written as a sparse accessor over zeros
  };
  std::vector<Target> targets;
  std::vector<float> defaultWeights;
};

// A bar along y from -1 to 1 whose vertices follow joints `first` to `first + influences - 1` of a skin, the
// nearest most: those stand for evenly spaced heights.
AnimatedMesh bendingBar(int influences, int first = 0);
// A target that swells a mesh along its normals by a different amount at each vertex, and tilts them.
AnimatedMesh::Target swelling(const TestMesh& mesh, float amount, const glm::vec3& tilt);

class AnimatedScene {
 public:
  AnimatedScene();

  // Indices are glTF's own; the importer sorts nodes by their parents.
  int material(const Json& json);
  int mesh(const AnimatedMesh& mesh, int material);
  int node(Json json, int parent = -1);
  int skin(const std::vector<int>& joints, const std::vector<glm::mat4>& inverseBind);
  void instances(int node, const std::vector<glm::vec3>& translations, const std::vector<glm::vec3>& scales);
  int clip(const std::string& name);
  void channel(int clip, int node, const std::string& path, const std::string& interpolation,
               const std::vector<float>& times, const std::vector<float>& values);

  Scene load() const;  // fails the test on a warning
  std::string text() const { return gltf_.gltf(); }

  Json& json() { return gltf_.json; }

 private:
  int addVectors(const std::vector<glm::vec3>& values, bool sparse);
  scene::TestGltf gltf_;
};

// Keys of a turn about an axis, in degrees.
std::vector<float> turns(const glm::vec3& axis, const std::vector<float>& degrees);

// One of each: things that are carried, turned and stretched, a chain of nodes, skins of four and of eight
// joints a vertex, morph targets with and without a skin, a camera and a light that move. The clip lasts two
// seconds.
AnimatedScene troupe();

}  // namespace scumble::test
