#include "tests/support/animated_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace scumble::test {

namespace {

std::vector<float> flat(const std::vector<glm::vec3>& v) {
  std::vector<float> numbers;
  for (const glm::vec3& p : v) numbers.insert(numbers.end(), {p.x, p.y, p.z});
  return numbers;
}
std::vector<float> flat(const std::vector<glm::vec2>& v) {
  std::vector<float> numbers;
  for (const glm::vec2& p : v) numbers.insert(numbers.end(), {p.x, p.y});
  return numbers;
}

}  // namespace

AnimatedMesh bendingBar(int influences, int first) {
  AnimatedMesh bar;
  bar.influences = influences;
  for (int i = 0; i < 10; ++i)
    append(bar.shape, boxMesh({-0.25f, 0.2f * float(i) - 1, -0.25f}, {0.25f, 0.2f * float(i + 1) - 1, 0.25f}),
           glm::vec4(1.0f));
  bar.shape.colors.clear();
  for (const glm::vec3& p : bar.shape.positions) {
    std::vector<float> weights;
    float sum = 0;
    for (int k = 0; k < influences; ++k) {
      const float height = -1 + 2 * float(k) / float(influences - 1);
      weights.push_back(std::max(0.0f, 1 - std::abs(p.y - height)));
      sum += weights.back();
    }
    for (int k = 0; k < influences; ++k) {
      bar.joints.push_back(uint16_t(first + k));
      bar.weights.push_back(weights[size_t(k)] / sum);
    }
  }
  return bar;
}

AnimatedMesh::Target swelling(const TestMesh& mesh, float amount, const glm::vec3& tilt) {
  AnimatedMesh::Target target;
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    target.positions.push_back(amount * (1.2f + mesh.positions[v].y) * mesh.normals[v]);
    target.normals.push_back(tilt);
  }
  return target;
}

AnimatedScene::AnimatedScene() {
  json()["scenes"] = Json::array({{{"nodes", Json::array()}}});
  json()["scene"] = 0;
  json()["nodes"] = Json::array();
}

int AnimatedScene::material(const Json& material) {
  json()["materials"].push_back(material);
  return int(json()["materials"].size()) - 1;
}

int AnimatedScene::addVectors(const std::vector<glm::vec3>& values, bool sparse) {
  if (!sparse) return gltf_.addFloats(flat(values), 3);
  std::vector<uint16_t> indices;
  std::vector<glm::vec3> some;
  for (size_t v = 0; v < values.size(); ++v) {
    if (values[v] == glm::vec3(0.0f)) continue;
    indices.push_back(uint16_t(v));
    some.push_back(values[v]);
  }
  const int indexView = gltf_.addView(indices), valueView = gltf_.addView(flat(some)),
            accessor = gltf_.addAccessor(-1, 5126, "VEC3", values.size());
  json()["accessors"].back()["sparse"] = {{"count", indices.size()},
                                          {"indices", {{"bufferView", indexView}, {"componentType", 5123}}},
                                          {"values", {{"bufferView", valueView}}}};
  return accessor;
}

int AnimatedScene::mesh(const AnimatedMesh& mesh, int material) {
  Json attributes = {{"POSITION", gltf_.addFloats(flat(mesh.shape.positions), 3)},
                     {"NORMAL", gltf_.addFloats(flat(mesh.shape.normals), 3)},
                     {"TEXCOORD_0", gltf_.addFloats(flat(mesh.shape.uvs), 2)}};
  const size_t vertices = mesh.shape.positions.size(), influences = size_t(mesh.influences);
  const bool wide = std::any_of(mesh.joints.begin(), mesh.joints.end(), [](uint16_t j) { return j > 255; });
  for (size_t set = 0; 4 * set < influences; ++set) {
    std::vector<uint16_t> joints;
    std::vector<float> weights;
    for (size_t v = 0; v < vertices; ++v)
      for (size_t k = 0; k < 4; ++k) {
        joints.push_back(mesh.joints[v * influences + 4 * set + k]);
        weights.push_back(mesh.weights[v * influences + 4 * set + k]);
      }
    const std::string number = std::to_string(set);
    attributes["JOINTS_" + number] =
        wide ? gltf_.add(joints, 5123, "VEC4", 4)
             : gltf_.add(std::vector<uint8_t>(joints.begin(), joints.end()), 5121, "VEC4", 4);
    attributes["WEIGHTS_" + number] = gltf_.addFloats(weights, 4);
  }
  Json primitive = {{"attributes", attributes},
                    {"indices", gltf_.add(mesh.shape.indices, 5125, "SCALAR", 1)}};
  if (material >= 0) primitive["material"] = material;
  for (const AnimatedMesh::Target& target : mesh.targets) {
    Json json = Json::object();
    if (!target.positions.empty()) json["POSITION"] = addVectors(target.positions, target.sparse);
    if (!target.normals.empty()) json["NORMAL"] = addVectors(target.normals, target.sparse);
    primitive["targets"].push_back(json);
  }
  Json whole = {{"primitives", Json::array({primitive})}};
  if (!mesh.defaultWeights.empty()) whole["weights"] = mesh.defaultWeights;
  json()["meshes"].push_back(whole);
  return int(json()["meshes"].size()) - 1;
}

int AnimatedScene::node(Json node, int parent) {
  json()["nodes"].push_back(std::move(node));
  const int index = int(json()["nodes"].size()) - 1;
  if (parent < 0)
    json()["scenes"][0]["nodes"].push_back(index);
  else
    json()["nodes"][size_t(parent)]["children"].push_back(index);
  return index;
}

int AnimatedScene::skin(const std::vector<int>& joints, const std::vector<glm::mat4>& inverseBind) {
  std::vector<float> numbers;
  for (const glm::mat4& m : inverseBind) numbers.insert(numbers.end(), &m[0][0], &m[0][0] + 16);
  json()["skins"].push_back(
      {{"joints", joints}, {"inverseBindMatrices", gltf_.add(numbers, 5126, "MAT4", 16)}});
  return int(json()["skins"].size()) - 1;
}

void AnimatedScene::instances(int node, const std::vector<glm::vec3>& translations,
                              const std::vector<glm::vec3>& scales) {
  json()["extensionsUsed"].push_back("EXT_mesh_gpu_instancing");
  json()["nodes"][size_t(node)]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", gltf_.addFloats(flat(translations), 3)}, {"SCALE", gltf_.addFloats(flat(scales), 3)}};
}

int AnimatedScene::clip(const std::string& name) {
  json()["animations"].push_back({{"name", name}, {"channels", Json::array()}, {"samplers", Json::array()}});
  return int(json()["animations"].size()) - 1;
}

void AnimatedScene::channel(int clip, int node, const std::string& path, const std::string& interpolation,
                            const std::vector<float>& times, const std::vector<float>& values) {
  Json& animation = json()["animations"][size_t(clip)];
  const int input = gltf_.addFloats(times, 1), output = gltf_.addFloats(values, path == "weights"    ? 1
                                                                                : path == "rotation" ? 4
                                                                                                     : 3);
  animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
  animation["channels"].push_back(
      {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
}

Scene AnimatedScene::load() const {
  const std::string text = gltf_.gltf();
  Result<Scene> scene = Scene::loadFromMemory(text.data(), text.size(), "test.gltf", "");
  if (!scene) throw std::runtime_error(scene.error().message());
  for (const std::string& warning : scene->warnings()) ADD_FAILURE() << warning;
  return std::move(scene).value();
}

std::vector<float> turns(const glm::vec3& axis, const std::vector<float>& degrees) {
  std::vector<float> values;
  for (const float angle : degrees) {
    const glm::quat q = glm::angleAxis(glm::radians(angle), glm::normalize(axis));
    values.insert(values.end(), {q.x, q.y, q.z, q.w});
  }
  return values;
}

AnimatedScene troupe() {
  AnimatedScene s;
  const auto colored = [&](const char* name, float r, float g, float b) {
    return s.material(TestScene::colored(name, {r, g, b, 1}));
  };
  const int red = colored("Red", 0.7f, 0.12f, 0.08f), blue = colored("Blue", 0.1f, 0.25f, 0.6f),
            sand = colored("Sand", 0.6f, 0.5f, 0.3f), green = colored("Green", 0.2f, 0.5f, 0.2f);
  const int clip = s.clip("Play");
  // A floor that stands still.
  s.node({{"name", "Floor"},
          {"mesh", s.mesh({gridMesh({-3, -1.2f, 2}, {6, 0, 0}, {0, 0, -4}, 4), 0, {}, {}, {}, {}}, sand)}});
  // A carried box, and one that goes around it.
  const int box = s.mesh({boxMesh({-0.3f, -0.2f, -0.4f}, {0.35f, 0.45f, 0.2f}), 0, {}, {}, {}, {}}, red);
  const int carried = s.node({{"name", "Carried"}, {"mesh", box}});
  const int moon = s.node(
      {{"name", "Moon"}, {"mesh", box}, {"translation", {0.8, 0, 0}}, {"scale", {-0.5, 0.5, 0.5}}}, carried);
  s.channel(clip, carried, "translation", "LINEAR", {0, 1, 2}, {-2, 0.6f, 0, -1.3f, 1.1f, 0.4f, -2, 0.6f, 0});
  s.channel(clip, carried, "rotation", "LINEAR", {0, 0.7f, 2}, turns({0.2f, 1, 0}, {0, 160, 360}));
  s.channel(clip, moon, "scale", "STEP", {0, 0.5f, 1.5f},
            {-0.5f, 0.5f, 0.5f, -0.3f, 0.8f, 0.4f, 0.5f, 0.5f, 0.5f});
  // Bars of four and of eight joints a vertex; the second swells too.
  for (const int influences : {4, 8}) {
    AnimatedMesh bar = bendingBar(influences);
    if (influences == 8) bar.targets.push_back(swelling(bar.shape, 0.15f, {0.2f, 0.3f, 0}));
    const float x = influences == 4 ? -0.4f : 0.7f;
    std::vector<int> joints;
    std::vector<glm::mat4> binds;
    int parent = s.node({{"name", "Root" + std::to_string(influences)}, {"translation", {x, 0, 0}}});
    float height = 0;
    for (int k = 0; k < influences; ++k) {
      const float y = -1 + 2 * float(k) / float(influences - 1);
      parent = s.node({{"translation", {0, y - height, 0}}}, parent);
      height = y;
      joints.push_back(parent);
      glm::mat4 bind(1.0f);
      bind[3] = {0, -y, 0, 1};
      binds.push_back(bind);
      const float bend = 80 / float(influences);
      s.channel(clip, parent, "rotation", "LINEAR", {0, 1, 2}, turns({0.3f, 0, 1}, {-bend, bend, -bend}));
    }
    const int skinned = s.node({{"name", "Bar" + std::to_string(influences)},
                                {"mesh", s.mesh(bar, influences == 4 ? blue : green)},
                                {"skin", s.skin(joints, binds)}});
    if (influences == 8) s.channel(clip, skinned, "weights", "LINEAR", {0, 1, 2}, {0, 1, 0});
  }
  // A ball that swells.
  AnimatedMesh ball{sphereMesh({0, 0, 0}, 0.5f, 16), 0, {}, {}, {}, {0.2f, 0}};
  ball.targets = {swelling(ball.shape, 0.3f, {0, 0.3f, 0}), swelling(ball.shape, -0.2f, {0.2f, 0, 0})};
  const int swells = s.node({{"name", "Ball"}, {"mesh", s.mesh(ball, red)}, {"translation", {2, 0, 0.2}}});
  s.channel(clip, swells, "weights", "CUBICSPLINE", {0, 1, 2},
            {0, 0, 0, 1, 1, 0, 0, 0.5f, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0});
  // A camera and a light.
  s.json()["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
  const int camera = s.node({{"name", "Eye"}, {"camera", 0}, {"translation", {0, 0.6, 6}}});
  s.channel(clip, camera, "translation", "LINEAR", {0, 2}, {0, 0.6f, 6, 0.8f, 1, 5.5f});
  s.channel(clip, camera, "rotation", "LINEAR", {0, 2}, turns({0, 1, 0}, {-2, 6}));
  s.json()["extensionsUsed"].push_back("KHR_lights_punctual");
  s.json()["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({{{"type", "directional"}}});
  const int light = s.node({{"name", "Sun"}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  s.channel(clip, light, "rotation", "LINEAR", {0, 2}, turns({1, 0.4f, 0}, {-50, -70}));
  return s;
}

}  // namespace scumble::test
