// Small scenes for tests that draw: meshes made by code, written as glTF and read back through the importer,
// and the same triangles, placed in double precision, for what the CPU expects to see.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "scumble/image.h"
#include "scumble/scene.h"
#include "tests/support/test_gltf.h"

namespace scumble::test {

using Json = nlohmann::json;

struct TestMesh {
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec2> uvs;
  std::vector<glm::vec4> colors;  // linear RGBA; empty or one a vertex
  std::vector<float> warpScales;  // the attribute _WARP; empty or one a vertex
  std::vector<float> roundness;   // the attribute _ROUND; the same
  std::vector<uint32_t> indices;
  // Skinning: both empty, or one a vertex.
  std::vector<glm::u8vec4> joints;
  std::vector<glm::vec4> weights;
};

// A parallelogram that faces cross(alongU, alongV), of so many cells; uv goes from (0, 0) at `corner` to
// `uvs`.
TestMesh gridMesh(const glm::vec3& corner, const glm::vec3& alongU, const glm::vec3& alongV, int cells = 1,
                  const glm::vec2& uvs = {1, 1});
TestMesh sphereMesh(const glm::vec3& center, float radius, int segments = 32);
TestMesh boxMesh(const glm::vec3& low, const glm::vec3& high);
// Adds `part` to `mesh` in one colour, linear; `mesh` has colours only if all its parts do.
void append(TestMesh& mesh, const TestMesh& part, const glm::vec4& color);

// A stroke in space; colours and radii are the same all along it.
struct TestStroke {
  std::vector<glm::vec3> points;
  float radius = 0.1f;            // metres
  glm::vec4 color{1.0f};          // linear
  std::string brush = {};         // empty: none is named
  std::vector<float> times = {};  // seconds; empty: none are given
};

// A triangle where the world has it.
struct WorldTriangle {
  glm::dvec3 positions[3], normals[3];
  glm::dvec3 outward;  // of its face; not unit
  int id = 0;
};

class TestScene {
 public:
  TestScene();

  // glTF's own words for a material, whose extensions are declared; the index is for add().
  int material(const Json& json);
  static Json colored(const std::string& name, const glm::vec4& linear);
  static Json unlit(const std::string& name, const glm::vec4& linear);
  // A texture of this picture (linear, straight alpha), not interpolated; the index is for baseColorTexture.
  int texture(const Image& image);
  int textureFile(const std::vector<uint8_t>& bytes, const std::string& mimeType);

  // Each is one node of its own; ids count them from 1.
  void add(const TestMesh& mesh, int material, const glm::mat4& matrix = glm::mat4(1.0f));
  void addInstances(const TestMesh& mesh, int material, const std::vector<glm::vec3>& translations,
                    const std::vector<glm::quat>& rotations, const std::vector<glm::vec3>& scales);
  // Joints are nodes with these matrices, in the world; bind poses likewise.
  void addSkinned(const TestMesh& mesh, int material, const std::vector<glm::mat4>& joints,
                  const std::vector<glm::mat4>& inverseBind);
  // Strokes as a node of their own, and on the mesh that was added last.
  void addStrokes(const std::vector<TestStroke>& strokes, const glm::mat4& matrix = glm::mat4(1.0f));
  void paint(const std::vector<TestStroke>& strokes);
  // A directional light that comes from there.
  void light(const glm::vec3& towards);
  // All that is there so far below one node, whose index it gives.
  size_t putBelow(Json node);
  // A clip that moves what was added last, which must lie where its mesh has it, along these places. Not in
  // triangles().
  void clip(const std::string& name, const std::vector<float>& times, const std::vector<glm::vec3>& places);

  Scene load() const;  // fails the test on a warning
  std::string text() const { return gltf_.gltf(); }
  // Everything that was added, in the world.
  const std::vector<WorldTriangle>& triangles() const { return triangles_; }

  Json& json() { return gltf_.json; }

 private:
  int addMesh(const TestMesh& mesh, int material);
  Json primitiveOf(const TestStroke& stroke);
  int addNode(Json node);
  void place(const TestMesh& mesh, const std::vector<glm::dmat4>& vertexMatrices, int id);

  scene::TestGltf gltf_;
  std::vector<WorldTriangle> triangles_;
};

// Sphere, box and a wall on a ground that ends before the picture does: light, shadow, depth edges and sky in
// one.
TestScene stillLife();

}  // namespace scumble::test
