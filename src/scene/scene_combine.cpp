// Several scenes in one world: every list is the lists one after another, every index moves along.
#include <algorithm>

#include "scene/scene_data.h"
#include "scumble/scene.h"

namespace scumble {

namespace {

using namespace scene;

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

void addScene(SceneData& all, const SceneData& one) {
  const size_t images = all.images.size(), materials = all.materials.size(), meshes = all.meshes.size(),
               nodes = all.nodes.size(), cameras = all.cameras.size(), lights = all.lights.size(),
               skins = all.skins.size(), clips = all.clips.size();
  append(all.images, one.images);
  append(all.materials, one.materials);
  append(all.meshes, one.meshes);
  append(all.nodes, one.nodes);
  append(all.cameras, one.cameras);
  append(all.lights, one.lights);
  append(all.skins, one.skins);
  append(all.clips, one.clips);
  for (Material& material : Tail<Material>{all.materials, materials}) {
    for (TextureUse* use : {&material.baseColorTexture, &material.emissiveTexture, &material.litTexture,
                            &material.shadowedTexture})
      moveBy(use->image, images);
  }
  for (Mesh& mesh : Tail<Mesh>{all.meshes, meshes})
    for (Primitive& primitive : mesh.primitives) moveBy(primitive.material, materials);
  for (Node& node : Tail<Node>{all.nodes, nodes}) {
    moveBy(node.parent, nodes);
    moveBy(node.mesh, meshes);
    moveBy(node.camera, cameras);
    moveBy(node.light, lights);
    moveBy(node.skin, skins);
  }
  for (Skin& skin : Tail<Skin>{all.skins, skins})
    for (int& joint : skin.joints) moveBy(joint, nodes);
  const int files = clips > 0 ? all.clips[clips - 1].file + 1 : 0;
  for (Clip& clip : Tail<Clip>{all.clips, clips}) {
    clip.file += files;
    for (Channel& channel : clip.channels) moveBy(channel.node, nodes);
  }
  appendNew(all.extensionsUsed, one.extensionsUsed);
  appendNew(all.extensionsNotSupported, one.extensionsNotSupported);
  appendNew(all.files, one.files);
  appendNew(all.warnings, one.warnings);
  if (!one.bounds.empty) {
    all.bounds.add(one.bounds.min);
    all.bounds.add(one.bounds.max);
  }
}

}  // namespace

Scene Scene::combine(const std::vector<Scene>& scenes) {
  Scene combined;
  if (scenes.size() == 1 && scenes[0].data_) return scenes[0];
  auto data = std::make_shared<SceneData>();
  for (const Scene& scene : scenes) {
    if (!scene.data_) continue;
    if (data->name.empty()) data->name = scene.data_->name;
    addScene(*data, *scene.data_);
    combined.timings_.read += scene.timings_.read;
    combined.timings_.parse += scene.timings_.parse;
    combined.timings_.geometry += scene.timings_.geometry;
    combined.timings_.images += scene.timings_.images;
  }
  if (data->materials.empty()) data->materials.resize(1);
  combined.data_ = std::move(data);
  return combined;
}

}  // namespace scumble
