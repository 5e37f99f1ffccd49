// Several scenes in one world: every list is the lists one after another, every index moves along.
#include <algorithm>

#include "scene/scene_bounds.h"
#include "scene/scene_place.h"

namespace scumble {

namespace scene {

namespace {

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

void appendNew(std::vector<std::string>& to, const std::vector<std::string>& from) {
  for (const std::string& text : from)
    if (std::find(to.begin(), to.end(), text) == to.end()) to.push_back(text);
}

void moveBy(int& index, size_t offset) {
  if (index >= 0) index += static_cast<int>(offset);
}

// Elements of `list` that came with the last scene.
template <class T>
struct Tail {
  std::vector<T>& list;
  size_t first;
  auto begin() { return list.begin() + static_cast<ptrdiff_t>(first); }
  auto end() { return list.end(); }
};

}  // namespace

void appendScene(SceneData& all, const SceneData& one, size_t firstNode, const Appended* shared) {
  const size_t cameras = all.cameras.size(), lights = all.lights.size(), skins = all.skins.size(),
               clips = all.clips.size();
  const Appended at = shared ? *shared : Appended{all.images.size(), all.materials.size(), all.meshes.size()};
  all.keepsVertices |= one.keepsVertices;
  if (!shared) {
    append(all.images, one.images);
    append(all.materials, one.materials);
    append(all.meshes, one.meshes);
    all.seen.resize(at.meshes);
    append(all.seen, one.seen);
    for (Material& material : Tail<Material>{all.materials, at.materials})
      for (TextureUse* use : {&material.baseColorTexture, &material.emissiveTexture, &material.litTexture,
                              &material.shadowedTexture})
        moveBy(use->image, at.images);
    if (at.materials > 0)
      for (Shared<Mesh>& mesh : Tail<Shared<Mesh>>{all.meshes, at.meshes})
        for (Primitive& primitive : mesh.own().primitives) moveBy(primitive.material, at.materials);
  }
  append(all.cameras, one.cameras);
  append(all.lights, one.lights);
  append(all.skins, one.skins);
  append(all.clips, one.clips);
  for (size_t n = 0; n < one.nodes.size(); ++n) {
    Node& node = all.nodes[firstNode + n] = one.nodes[n];
    moveBy(node.parent, firstNode);
    moveBy(node.mesh, at.meshes);
    moveBy(node.camera, cameras);
    moveBy(node.light, lights);
    moveBy(node.skin, skins);
  }
  for (Skin& skin : Tail<Skin>{all.skins, skins})
    for (int& joint : skin.joints) moveBy(joint, firstNode);
  const int files = clips > 0 ? all.clips[clips - 1].file + 1 : 0;
  for (Clip& clip : Tail<Clip>{all.clips, clips}) {
    clip.file += files;
    for (Channel& channel : clip.channels) moveBy(channel.node, firstNode);
  }
  appendNew(all.extensionsUsed, one.extensionsUsed);
  appendNew(all.extensionsNotSupported, one.extensionsNotSupported);
  if (!one.path.empty()) appendNew(all.files, {one.path});
  appendNew(all.files, one.files);
  appendNew(all.warnings, one.warnings);
}

}  // namespace scene

namespace {

void add(SceneTimings& all, const SceneTimings& one) {
  all.read += one.read;
  all.parse += one.parse;
  all.geometry += one.geometry;
  all.images += one.images;
}

}  // namespace

Scene Scene::combine(const std::vector<Scene>& scenes) {
  Scene combined;
  if (scenes.size() == 1 && scenes[0].data_) return scenes[0];
  auto data = std::make_shared<scene::SceneData>();
  data->keepsVertices = false;  // unless one of them does
  for (const Scene& one : scenes) {
    if (!one.data_) continue;
    if (data->name.empty()) data->name = one.data_->name;
    const size_t firstNode = data->nodes.size();
    data->nodes.resize(firstNode + one.data_->nodes.size());
    scene::appendScene(*data, *one.data_, firstNode, nullptr);
    add(combined.timings_, one.timings_);
  }
  scene::findOrigin(*data);
  for (const Scene& one : scenes) {
    if (!one.data_ || one.data_->bounds.empty) continue;
    const glm::dvec3 between = one.data_->origin - data->origin;
    for (const glm::vec3& corner : {one.data_->bounds.min, one.data_->bounds.max})
      data->bounds.add(glm::vec3(glm::dvec3(corner) + between));
  }
  if (data->materials.empty()) data->materials.resize(1);
  combined.data_ = std::move(data);
  return combined;
}

Result<Scene> Scene::place(const std::vector<PlacedScene>& scenes) {
  std::vector<PlacedScene> named = scenes;
  scene::PlacementProblem problem;
  Scene placed;
  placed.data_ = scene::placeScenes(named, problem);
  if (!placed.data_) {
    const std::string who = problem.scene < named.size() ? "'" + named[problem.scene].name + "': " : "";
    return Error{ErrorKind::usage, "", 0, "", who + problem.problem, problem.advice};
  }
  std::vector<const scene::SceneData*> counted;
  for (const PlacedScene& one : scenes)
    if (std::find(counted.begin(), counted.end(), one.scene.data_.get()) == counted.end()) {
      counted.push_back(one.scene.data_.get());
      add(placed.timings_, one.scene.timings_);
    }
  return placed;
}

}  // namespace scumble
