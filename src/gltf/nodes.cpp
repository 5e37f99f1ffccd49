#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "gltf/import.h"
#include "scene/extras.h"
#include "scene/prepare_mesh.h"

namespace scumble::gltf {

void warnIgnored(ImportWarnings& warnings, const ImportFailure& failure, const char* what) {
  warnings.add(failure.error.jsonPath, std::string(what) + " ignored: " + failure.error.problem);
}

namespace {

// The parent of every node of the file; fails unless they form trees.
std::vector<int> findParents(const JsonView& list) {
  std::vector<int> parents(list.size(), -1);
  for (size_t i = 0; i < list.size(); ++i) {
    const JsonView children = list.at(i).list("children");
    for (size_t k = 0; k < children.size(); ++k) {
      const size_t child = children.indexAt(k, list.size(), "node");
      if (parents[child] >= 0 || child == i)
        fail(children.path() + "[" + std::to_string(k) + "]",
             child == i ? "makes the node its own child"
                        : "gives node " + std::to_string(child) + " a second parent",
             "export the scene again");
      parents[child] = static_cast<int>(i);
    }
  }
  // With one parent each, what no root leads to is a cycle. Walk up from every node, marking what is known.
  std::vector<uint8_t> state(list.size(), 0);  // 1: on the present walk, 2: leads to a root
  std::vector<size_t> walk;
  for (size_t start = 0; start < list.size(); ++start) {
    walk.clear();
    int at = static_cast<int>(start);
    while (at >= 0 && state[at] == 0) {
      state[at] = 1;
      walk.push_back(static_cast<size_t>(at));
      at = parents[at];
    }
    if (at >= 0 && state[at] == 1)
      fail("nodes[" + std::to_string(at) + "]", "is its own ancestor: the nodes form a cycle",
           "export the scene again");
    for (const size_t i : walk) state[i] = 2;
  }
  return parents;
}

std::vector<size_t> findRoots(const Import& import, int wantedScene, const std::vector<int>& parents) {
  const JsonView scenes = import.document.list("scenes");
  std::vector<size_t> roots;
  if (scenes.size() == 0) {
    if (wantedScene >= 0) fail("scenes", "is empty, so there is no scene " + std::to_string(wantedScene));
    for (size_t i = 0; i < parents.size(); ++i)
      if (parents[i] < 0) roots.push_back(i);
    return roots;
  }
  int64_t chosen = wantedScene;
  if (wantedScene >= 0 && static_cast<size_t>(wantedScene) >= scenes.size())
    fail("scenes",
         "holds " + std::to_string(scenes.size()) + (scenes.size() == 1 ? " scene" : " scenes") +
             ", but scene " + std::to_string(wantedScene) + " was asked for",
         "they are counted from 0");
  if (chosen < 0)
    chosen = std::max<int64_t>(0, import.document.root().index("scene", scenes.size(), "scene"));
  const JsonView nodes = scenes.at(chosen).list("nodes");
  for (size_t i = 0; i < nodes.size(); ++i) {
    const size_t node = nodes.indexAt(i, parents.size(), "node");
    if (parents[node] >= 0)
      import.warnings.add(nodes.path(), "a node of the scene that has a parent is taken without it");
    roots.push_back(node);
  }
  return roots;
}

// Translation, rotation and scale of a matrix; false when it is no such composition.
bool decompose(const glm::dmat4& m, Transform& t) {
  const glm::dmat3 linear(m);
  glm::dvec3 scale(glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2]));
  if (!(scale.x > 1e-12 && scale.y > 1e-12 && scale.z > 1e-12)) return false;
  if (!(scale.x < 1e12 && scale.y < 1e12 && scale.z < 1e12)) return false;
  glm::dmat3 rotation(linear[0] / scale.x, linear[1] / scale.y, linear[2] / scale.z);
  if (glm::determinant(rotation) < 0.0) {
    scale.x = -scale.x;
    rotation[0] = -rotation[0];
  }
  t.translation = glm::dvec3(m[3]);
  t.rotation = glm::normalize(glm::quat_cast(rotation));
  t.scale = scale;
  const glm::dmat3 again(t.matrix());
  const double size = std::max({std::abs(scale.x), scale.y, scale.z});
  for (int c = 0; c < 3; ++c)
    if (!(glm::length(again[c] - linear[c]) < 1e-5 * size)) return false;
  return true;
}

glm::dquat unitQuaternion(const glm::dvec4& q, bool& broken) {
  const double largest = std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z), std::abs(q.w)});
  if (!(largest > 1e-20 && largest < 1e20)) {
    broken = true;
    return glm::dquat(1, 0, 0, 0);
  }
  const glm::dvec4 unit = glm::normalize(q / largest);
  return glm::dquat(unit.w, unit.x, unit.y, unit.z);
}

void readTransform(const JsonView& json, Node& node, ImportWarnings& warnings) {
  glm::dmat4 matrix(1.0);
  if (json.numbers("matrix", glm::value_ptr(matrix), 16)) {
    if (matrix[0].w != 0 || matrix[1].w != 0 || matrix[2].w != 0 || matrix[3].w != 1) {
      warnings.add(json.pathOf("matrix"), "the last row of a matrix, which is not 0 0 0 1, is ignored");
      for (int c = 0; c < 4; ++c) matrix[c].w = c == 3 ? 1.0 : 0.0;
    }
    if (!decompose(matrix, node.local)) {
      node.local = Transform();
      node.localMatrix = matrix;
    }
    return;
  }
  json.numbers("translation", &node.local.translation.x, 3);
  json.numbers("scale", &node.local.scale.x, 3);
  glm::dvec4 rotation(0.0);
  if (json.numbers("rotation", &rotation.x, 4)) {
    bool broken = false;
    node.local.rotation = unitQuaternion(rotation, broken);
    if (broken) warnings.add(json.pathOf("rotation"), "a rotation of length zero is ignored");
  }
}

// EXT_mesh_gpu_instancing: one transformation an instance, from up to three accessors.
std::vector<glm::mat4> readInstances(const Import& import, const JsonView& extension) {
  const JsonView attributes = extension.object("attributes");
  std::vector<glm::mat4> instances;
  if (!attributes) return instances;
  size_t count = 0;
  bool any = false;
  const auto read = [&](const char* semantic, int components, std::vector<float>& values) {
    const int64_t index = attributes.index(semantic, import.accessors.count(), "accessor");
    if (index < 0) return;
    const Accessor accessor = import.accessors.open(index);
    if (accessor.columns != 1 || accessor.rows != components)
      attributes.failAt(semantic, "has the wrong type");
    if (any && accessor.count != count)
      attributes.failAt(semantic, "has another count than the other attributes");
    any = true;
    count = accessor.count;
    import.budget.takeBytes(count * 80, accessor.path);
    values.resize(count * components);
    readFloats(accessor, {}, components, values.data());
  };
  std::vector<float> translations, rotations, scales;
  read("TRANSLATION", 3, translations);
  read("ROTATION", 4, rotations);
  read("SCALE", 3, scales);
  instances.reserve(count);
  bool broken = false;
  for (size_t i = 0; i < count; ++i) {
    Transform t;
    if (!translations.empty()) t.translation = glm::dvec3(glm::make_vec3(&translations[3 * i]));
    if (!rotations.empty()) t.rotation = unitQuaternion(glm::make_vec4(&rotations[4 * i]), broken);
    if (!scales.empty()) t.scale = glm::dvec3(glm::make_vec3(&scales[3 * i]));
    const glm::mat4 matrix(t.matrix());
    bool finite = true;
    for (int k = 0; k < 16; ++k) finite &= std::abs(glm::value_ptr(matrix)[k]) <= kMaxCoordinate;
    if (finite)
      instances.push_back(matrix);
    else
      broken = true;
  }
  if (broken) import.warnings.add(attributes.path(), "instances that are not finite are left out");
  if (any && instances.empty()) attributes.failAt("", "holds no instance that can be drawn");
  return instances;
}

// Numbers what is marked, in the file's order. Returns how many.
int numberMarked(std::vector<int>& map) {
  int next = 0;
  for (int& entry : map)
    if (entry >= 0) entry = next++;
  return next;
}

// An index of something optional: out of range is a warning and means none.
int optionalIndex(const Import& import, const JsonView& json, const char* key, size_t limit,
                  const char* what) {
  try {
    return json ? static_cast<int>(json.index(key, limit, what)) : -1;
  } catch (const ImportFailure& failure) {
    warnIgnored(import.warnings, failure, (std::string("a ") + what).c_str());
    return -1;
  }
}

void readExtras(const JsonView& json, Node& node, ImportWarnings& warnings) {
  const auto extras = json.json().find("extras");
  if (extras == json.json().end() || !extras->is_object()) return;
  scene::readExtras(*extras, node, [&](const std::string& path, const std::string& text) {
    warnings.add(json.pathOf("extras") + path, text);
  });
}

}  // namespace

void readNodes(const Import& import, int wantedScene, SceneData& scene, Maps& maps) {
  // Which nodes, and in which order.
  const JsonView list = import.document.list("nodes");
  const std::vector<int> parents = findParents(list);
  std::vector<size_t> order;
  maps.nodes.assign(list.size(), -1);
  const auto visit = [&](size_t i, int parent) {
    if (maps.nodes[i] >= 0) return;
    maps.nodes[i] = static_cast<int>(order.size());
    order.push_back(i);
    scene.nodes.emplace_back().parent = parent;
  };
  for (const size_t root : findRoots(import, wantedScene, parents)) visit(root, -1);
  // Breadth first: parents come before their children, and no recursion limits the depth.
  for (size_t at = 0; at < order.size(); ++at) {
    const JsonView children = list.at(order[at]).list("children");
    for (size_t k = 0; k < children.size(); ++k)
      visit(children.indexAt(k, list.size(), "node"), static_cast<int>(at));
  }

  // What they carry.
  const JsonView lights = import.document.root().extension("KHR_lights_punctual");
  maps.meshes.assign(import.document.list("meshes").size(), -1);
  maps.cameras.assign(import.document.list("cameras").size(), -1);
  maps.lights.assign(lights ? lights.list("lights").size() : 0, -1);
  maps.skins.assign(import.document.list("skins").size(), -1);
  for (size_t at = 0; at < order.size(); ++at) {
    const JsonView json = list.at(order[at]);
    Node& node = scene.nodes[at];
    try {
      node.name = json.text("name");
    } catch (const ImportFailure& failure) {
      warnIgnored(import.warnings, failure, "a name");
    }
    readTransform(json, node, import.warnings);
    readExtras(json, node, import.warnings);
    node.mesh = static_cast<int>(json.index("mesh", maps.meshes.size(), "mesh"));
    node.camera = optionalIndex(import, json, "camera", maps.cameras.size(), "camera");
    node.skin = optionalIndex(import, json, "skin", maps.skins.size(), "skin");
    const JsonView extensions = json.object("extensions");
    if (extensions) {
      if (extensions.has("KHR_lights_punctual"))
        node.light = optionalIndex(import, extensions.object("KHR_lights_punctual"), "light",
                                   maps.lights.size(), "light");
      if (const JsonView visibility = extensions.object("KHR_node_visibility"))
        node.visible = visibility.flag("visible", true);
      const JsonView instancing = extensions.object("EXT_mesh_gpu_instancing");
      if (instancing && node.mesh >= 0) node.instances = readInstances(import, instancing);
    }
    if (node.mesh < 0) node.skin = -1;
    if (node.mesh >= 0) {
      maps.meshes[node.mesh] = 0;
      if (const JsonView weights = json.list("weights")) {
        node.morphWeights.resize(weights.size());
        json.numbers("weights", node.morphWeights.data(), weights.size());
      }
    }
    if (node.camera >= 0) maps.cameras[node.camera] = 0;
    if (node.light >= 0) maps.lights[node.light] = 0;
    if (node.skin >= 0) maps.skins[node.skin] = 0;
  }
  // Meshes in use are numbered anew; cameras, lights and skins when they are read.
  scene.meshes.resize(static_cast<size_t>(numberMarked(maps.meshes)));
  for (Node& node : scene.nodes)
    if (node.mesh >= 0) node.mesh = maps.meshes[node.mesh];
}

}  // namespace scumble::gltf
