#include "scene/find_node.h"

#include <string_view>

namespace scumble::scene {

namespace {

// Takes the last of a path's names away if it is this one.
bool takeLast(std::string_view& path, const std::string& name) {
  if (name.empty() || path.size() <= name.size() + 1 || !path.ends_with(name) ||
      path[path.size() - name.size() - 1] != '/')
    return false;
  path.remove_suffix(name.size() + 1);
  return true;
}

bool isAt(const SceneData& scene, size_t node, std::string_view path) {
  if (!takeLast(path, scene.nodes[node].name)) return false;
  for (int above = scene.nodes[node].parent; above >= 0; above = scene.nodes[size_t(above)].parent) {
    const std::string& name = scene.nodes[size_t(above)].name;
    if (path == name) return true;
    takeLast(path, name);
  }
  return false;
}

}  // namespace

int findNode(const SceneData& scene, const std::string& name) {
  if (name.empty()) return -1;
  for (size_t n = 0; n < scene.nodes.size(); ++n)
    if (scene.nodes[n].name == name) return int(n);
  if (name.find('/') == std::string::npos) return -1;
  for (size_t n = 0; n < scene.nodes.size(); ++n)
    if (isAt(scene, n, name)) return int(n);
  return -1;
}

}  // namespace scumble::scene
