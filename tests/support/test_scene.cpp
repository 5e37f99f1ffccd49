#include "tests/support/test_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <stdexcept>

#include "base/test_folder.h"

namespace scumble::test {

TestMesh gridMesh(const glm::vec3& corner, const glm::vec3& alongU, const glm::vec3& alongV, int cells,
                  const glm::vec2& uvs) {
  TestMesh mesh;
  const glm::vec3 normal = glm::normalize(glm::cross(alongU, alongV));
  for (int y = 0; y <= cells; ++y)
    for (int x = 0; x <= cells; ++x) {
      const glm::vec2 t = glm::vec2(x, y) / float(cells);
      mesh.positions.push_back(corner + t.x * alongU + t.y * alongV);
      mesh.normals.push_back(normal);
      mesh.uvs.push_back(t * uvs);
    }
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x) {
      const uint32_t a = uint32_t(y * (cells + 1) + x), b = a + 1, c = a + uint32_t(cells) + 1, d = c + 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
    }
  return mesh;
}

TestMesh sphereMesh(const glm::vec3& center, float radius, int segments) {
  TestMesh mesh;
  const int rings = segments / 2;
  for (int r = 0; r <= rings; ++r)
    for (int s = 0; s <= segments; ++s) {
      const float polar = 3.14159265f * float(r) / float(rings),
                  around = 6.28318531f * float(s) / float(segments);
      const glm::vec3 n(std::sin(polar) * std::sin(around), std::cos(polar),
                        std::sin(polar) * std::cos(around));
      mesh.positions.push_back(center + radius * n);
      mesh.normals.push_back(n);
      mesh.uvs.push_back({float(s) / float(segments), float(r) / float(rings)});
    }
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < segments; ++s) {
      const uint32_t a = uint32_t(r * (segments + 1) + s), b = a + 1, c = a + uint32_t(segments) + 1,
                     d = c + 1;
      if (r > 0) mesh.indices.insert(mesh.indices.end(), {a, d, b});
      if (r < rings - 1) mesh.indices.insert(mesh.indices.end(), {a, c, d});
    }
  return mesh;
}

void append(TestMesh& mesh, const TestMesh& part, const glm::vec4& color) {
  const uint32_t first = uint32_t(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
  mesh.normals.insert(mesh.normals.end(), part.normals.begin(), part.normals.end());
  mesh.uvs.insert(mesh.uvs.end(), part.uvs.begin(), part.uvs.end());
  mesh.colors.insert(mesh.colors.end(), part.positions.size(), color);
  for (const uint32_t i : part.indices) mesh.indices.push_back(first + i);
}

TestMesh boxMesh(const glm::vec3& low, const glm::vec3& high) {
  TestMesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      glm::vec3 corner = low, u(0.0f), v(0.0f);
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      u[a] = high[a] - low[a], v[b] = high[b] - low[b];
      if (side) corner[axis] = high[axis];
      const TestMesh face = side ? gridMesh(corner, u, v) : gridMesh(corner, v, u);
      const uint32_t first = uint32_t(mesh.positions.size());
      mesh.positions.insert(mesh.positions.end(), face.positions.begin(), face.positions.end());
      mesh.normals.insert(mesh.normals.end(), face.normals.begin(), face.normals.end());
      mesh.uvs.insert(mesh.uvs.end(), face.uvs.begin(), face.uvs.end());
      for (const uint32_t i : face.indices) mesh.indices.push_back(first + i);
    }
  return mesh;
}

namespace {

std::vector<float> floats(const std::vector<glm::vec2>& v) {
  return {&v[0].x, &v[0].x + v.size() * 2};
}
std::vector<float> floats(const std::vector<glm::vec3>& v) {
  return {&v[0].x, &v[0].x + v.size() * 3};
}
std::vector<float> floats(const std::vector<glm::vec4>& v) {
  return {&v[0].x, &v[0].x + v.size() * 4};
}

Json numbers(const glm::mat4& m) {
  Json list = Json::array();
  for (int i = 0; i < 16; ++i) list.push_back(m[i / 4][i % 4]);
  return list;
}

}  // namespace

TestScene::TestScene() {
  json()["scenes"] = Json::array({{{"nodes", Json::array()}}});
  json()["scene"] = 0;
  json()["nodes"] = Json::array();
}

int TestScene::material(const Json& material) {
  if (material.contains("extensions")) {
    Json& used = json()["extensionsUsed"];
    for (const auto& [name, extension] : material["extensions"].items())
      if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
  }
  json()["materials"].push_back(material);
  return int(json()["materials"].size()) - 1;
}

Json TestScene::colored(const std::string& name, const glm::vec4& linear) {
  return {{"name", name},
          {"pbrMetallicRoughness", {{"baseColorFactor", {linear.r, linear.g, linear.b, linear.a}}}}};
}

Json TestScene::unlit(const std::string& name, const glm::vec4& linear) {
  Json json = colored(name, linear);
  json["extensions"]["KHR_materials_unlit"] = Json::object();
  return json;
}

int TestScene::texture(const Image& image) {
  const TestFolder folder;
  const std::string path = folder.file("texture.png");
  if (const Status written = writePng(path, image); !written)
    throw std::runtime_error(written.error().message());
  const std::string content = contentOf(path);
  return textureFile({content.begin(), content.end()}, "image/png");
}

int TestScene::textureFile(const std::vector<uint8_t>& bytes, const std::string& mimeType) {
  json()["images"].push_back({{"bufferView", gltf_.addView(bytes)}, {"mimeType", mimeType}});
  if (!json().contains("samplers"))
    json()["samplers"] = Json::array({{{"magFilter", 9728}, {"minFilter", 9728}}});
  json()["textures"].push_back({{"source", json()["images"].size() - 1}, {"sampler", 0}});
  return int(json()["textures"].size()) - 1;
}

int TestScene::addMesh(const TestMesh& mesh, int material) {
  Json attributes = {{"POSITION", gltf_.addFloats(floats(mesh.positions), 3)},
                     {"NORMAL", gltf_.addFloats(floats(mesh.normals), 3)},
                     {"TEXCOORD_0", gltf_.addFloats(floats(mesh.uvs), 2)}};
  if (!mesh.colors.empty()) attributes["COLOR_0"] = gltf_.addFloats(floats(mesh.colors), 4);
  if (!mesh.roundness.empty()) attributes["_ROUND"] = gltf_.addFloats(mesh.roundness, 1);
  if (!mesh.warpScales.empty()) attributes["_WARP"] = gltf_.addFloats(mesh.warpScales, 1);
  if (!mesh.joints.empty()) {
    std::vector<uint8_t> joints;
    for (const glm::u8vec4& j : mesh.joints) joints.insert(joints.end(), {j.x, j.y, j.z, j.w});
    attributes["JOINTS_0"] = gltf_.add(joints, 5121, "VEC4", 4);
    attributes["WEIGHTS_0"] = gltf_.addFloats(floats(mesh.weights), 4);
  }
  Json primitive = {{"attributes", attributes}, {"indices", gltf_.add(mesh.indices, 5125, "SCALAR", 1)}};
  if (material >= 0) primitive["material"] = material;
  json()["meshes"].push_back({{"primitives", Json::array({primitive})}});
  return int(json()["meshes"].size()) - 1;
}

Json TestScene::primitiveOf(const TestStroke& stroke) {
  std::vector<glm::vec4> colors(stroke.points.size(), stroke.color);
  Json attributes = {
      {"POSITION", gltf_.addFloats(floats(stroke.points), 3)},
      {"COLOR_0", gltf_.addFloats(floats(colors), 4)},
      {"_RADIUS", gltf_.addFloats(std::vector<float>(stroke.points.size(), stroke.radius), 1)}};
  if (!stroke.times.empty()) attributes["_TIME"] = gltf_.addFloats(stroke.times, 1);
  Json primitive = {{"attributes", attributes}, {"mode", 3}};
  if (!stroke.brush.empty()) primitive["extras"]["scumble_brush"] = stroke.brush;
  return primitive;
}

void TestScene::addStrokes(const std::vector<TestStroke>& strokes, const glm::mat4& matrix) {
  json()["meshes"].push_back({{"primitives", Json::array()}});
  paint(strokes);
  addNode({{"mesh", int(json()["meshes"].size()) - 1}, {"matrix", numbers(matrix)}});
}

void TestScene::paint(const std::vector<TestStroke>& strokes) {
  for (const TestStroke& stroke : strokes)
    json()["meshes"].back()["primitives"].push_back(primitiveOf(stroke));
}

int TestScene::addNode(Json node) {
  json()["nodes"].push_back(std::move(node));
  const int index = int(json()["nodes"].size()) - 1;
  json()["scenes"][0]["nodes"].push_back(index);
  return index;
}

void TestScene::place(const TestMesh& mesh, const std::vector<glm::dmat4>& vertexMatrices, int id) {
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    WorldTriangle t;
    t.id = id;
    glm::dvec3 rest[3];
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t v = mesh.indices[i + k];
      const glm::dmat4& m = vertexMatrices[vertexMatrices.size() == 1 ? 0 : v];
      rest[k] = glm::dvec3(mesh.positions[v]);
      t.positions[k] = glm::dvec3(m * glm::dvec4(rest[k], 1));
      t.normals[k] =
          glm::normalize(glm::inverse(glm::transpose(glm::dmat3(m))) * glm::dvec3(mesh.normals[v]));
    }
    // glTF: a mirrored node's triangles keep their outside.
    const double mirror = glm::determinant(glm::dmat3(vertexMatrices[0])) < 0 ? -1 : 1;
    t.outward = mirror * glm::cross(t.positions[1] - t.positions[0], t.positions[2] - t.positions[0]);
    triangles_.push_back(t);
  }
}

void TestScene::add(const TestMesh& mesh, int material, const glm::mat4& matrix) {
  const int node = addNode({{"mesh", addMesh(mesh, material)}, {"matrix", numbers(matrix)}});
  place(mesh, {glm::dmat4(matrix)}, node + 1);
}

void TestScene::addInstances(const TestMesh& mesh, int material, const std::vector<glm::vec3>& translations,
                             const std::vector<glm::quat>& rotations, const std::vector<glm::vec3>& scales) {
  json()["extensionsUsed"].push_back("EXT_mesh_gpu_instancing");
  std::vector<float> turns;
  for (const glm::quat& q : rotations) turns.insert(turns.end(), {q.x, q.y, q.z, q.w});
  const Json attributes = {{"TRANSLATION", gltf_.addFloats(floats(translations), 3)},
                           {"ROTATION", gltf_.addFloats(turns, 4)},
                           {"SCALE", gltf_.addFloats(floats(scales), 3)}};
  const int node = addNode({{"mesh", addMesh(mesh, material)},
                            {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}}}});
  for (size_t i = 0; i < translations.size(); ++i)
    place(mesh,
          {glm::translate(glm::dmat4(1.0), glm::dvec3(translations[i])) *
           glm::mat4_cast(glm::dquat(rotations[i])) * glm::scale(glm::dmat4(1.0), glm::dvec3(scales[i]))},
          node + 1);
}

void TestScene::addSkinned(const TestMesh& mesh, int material, const std::vector<glm::mat4>& joints,
                           const std::vector<glm::mat4>& inverseBind) {
  const int node = addNode({{"mesh", addMesh(mesh, material)}, {"skin", 0}});
  Json jointNodes = Json::array();
  std::vector<float> binds;
  for (size_t j = 0; j < joints.size(); ++j) {
    jointNodes.push_back(addNode({{"matrix", numbers(joints[j])}}));
    binds.insert(binds.end(), &inverseBind[j][0][0], &inverseBind[j][0][0] + 16);
  }
  json()["skins"] =
      Json::array({{{"joints", jointNodes}, {"inverseBindMatrices", gltf_.add(binds, 5126, "MAT4", 16)}}});
  // Linear blend skinning.
  std::vector<glm::dmat4> matrices;
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    glm::dmat4 sum(0.0);
    for (int k = 0; k < 4; ++k)
      sum += double(mesh.weights[v][k]) * glm::dmat4(joints[mesh.joints[v][k]]) *
             glm::dmat4(inverseBind[mesh.joints[v][k]]);
    matrices.push_back(sum);
  }
  place(mesh, matrices, node + 1);
}

void TestScene::light(const glm::vec3& towards) {
  json()["extensionsUsed"].push_back("KHR_lights_punctual");
  Json& lights = json()["extensions"]["KHR_lights_punctual"]["lights"];
  lights.push_back({{"type", "directional"}});
  // Lights shine along their -Z.
  const glm::vec3 z = glm::normalize(towards),
                  up = std::abs(z.y) > 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  const glm::vec3 x = glm::normalize(glm::cross(up, z));
  const glm::mat4 matrix(glm::vec4(x, 0), glm::vec4(glm::cross(z, x), 0), glm::vec4(z, 0),
                         glm::vec4(0, 0, 0, 1));
  addNode({{"matrix", numbers(matrix)},
           {"extensions", {{"KHR_lights_punctual", {{"light", lights.size() - 1}}}}}});
}

size_t TestScene::putBelow(Json node) {
  const size_t index = json()["nodes"].size();
  node["children"] = json()["scenes"][0]["nodes"];
  json()["scenes"][0]["nodes"] = {index};
  json()["nodes"].push_back(std::move(node));
  return index;
}

void TestScene::clip(const std::string& name, const std::vector<float>& times,
                     const std::vector<glm::vec3>& places) {
  const size_t node = json()["nodes"].size() - 1;
  json()["nodes"][node].erase("matrix");  // glTF animates no matrices
  json()["animations"].push_back(
      {{"name", name},
       {"samplers", Json::array({{{"input", gltf_.addFloats(times, 1)},
                                  {"output", gltf_.addFloats(floats(places), 3)}}})},
       {"channels", Json::array({{{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}}})}});
}

Scene TestScene::load() const {
  const std::string text = gltf_.gltf();
  Result<Scene> scene = Scene::loadFromMemory(text.data(), text.size(), "test.gltf", "");
  if (!scene) throw std::runtime_error(scene.error().message());
  for (const std::string& warning : scene->warnings()) ADD_FAILURE() << warning;
  return std::move(scene).value();
}

TestScene stillLife() {
  TestScene s;
  const int red = s.material(TestScene::colored("Red", {0.7f, 0.12f, 0.08f, 1}));
  const int blue = s.material(TestScene::colored("Blue", {0.1f, 0.25f, 0.6f, 1}));
  Json glowing = TestScene::colored("Lamp", {0.8f, 0.6f, 0.2f, 1});
  glowing["emissiveFactor"] = {0.5, 0.4, 0.1};
  const int lamp = s.material(glowing);
  const int sand = s.material(TestScene::colored("Sand", {0.6f, 0.5f, 0.3f, 1}));
  s.add(gridMesh({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}, 4, {6, 6}), sand);
  s.add(sphereMesh({-0.7f, 0.8f, 0.4f}, 0.8f, 24), red);
  s.add(boxMesh({0.5f, 0, -0.4f}, {1.5f, 1.7f, 0.6f}), blue);
  s.add(boxMesh({-2.2f, 0, -1.6f}, {-1.4f, 2.4f, -1.2f}), lamp);
  s.light({-0.6f, 1.0f, 0.8f});
  return s;
}

}  // namespace scumble::test
