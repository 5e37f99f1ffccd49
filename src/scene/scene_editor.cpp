#include "scumble/scene_editor.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <nlohmann/json.hpp>

#include "base/usage.h"
#include "scene/edited_parts.h"
#include "scene/extras.h"
#include "scene/find_node.h"
#include "scene/import_failure.h"
#include "scene/prepare_mesh.h"
#include "scene/scene_bounds.h"

namespace scumble {

namespace scene {

namespace {

uint64_t newFamily() {
  static std::atomic<uint64_t> last{0};
  return ++last;
}

Error noSuch(const char* what, int id) {
  return usage("there is no " + std::string(what) + " " + std::to_string(id),
               "use an id that this editor gave");
}

Error notAffine(const std::string& what) {
  return usage(what + " is not affine, or not finite", "give one whose last row is 0, 0, 0, 1");
}

bool isPlain(const Mesh& mesh) {
  return std::all_of(mesh.primitives.begin(), mesh.primitives.end(),
                     [](const Primitive& p) { return p.influences == 0 && p.morphTargets.empty(); });
}

// Whatever a check, or preparation, has to say against it.
Error asUsage(const ImportFailure& failure) {
  const std::string& where = failure.error.jsonPath;
  return usage((where.empty() ? "" : where + ": ") + failure.error.problem, failure.error.advice);
}

Error outOfMemory() {
  return usage("there is not enough memory", "use less");
}

template <class Body>
auto guarded(Body body) -> decltype(body()) {
  try {
    return body();
  } catch (const ImportFailure& failure) {
    return asUsage(failure);
  } catch (const std::bad_alloc&) {
    return outOfMemory();
  }
}

}  // namespace

class EditedScene {
 public:
  SceneData data;
  std::map<int, std::vector<std::string>> extrasWarnings;  // by nodes
  std::optional<Scene> present;

  // Changes the data by what gives a result; what there is now is another one where it is good.
  template <class Change>
  auto edit(Change change) -> decltype(change()) {
    auto result = guarded(change);
    if (result) present.reset();
    return result;
  }
};

}  // namespace scene

using namespace scene;

SceneEditor::SceneEditor(const std::string& name) : edited_(std::make_unique<EditedScene>()) {
  edited_->data.name = name;
  edited_->data.materials.resize(1);
  edited_->data.family = newFamily();
}

SceneEditor::SceneEditor(const Scene& scene) : SceneEditor() {
  if (scene.empty()) return;
  const uint64_t family = edited_->data.family;
  edited_->data = scene.data();
  edited_->data.keepsVertices = true;
  edited_->data.family = family;
}

SceneEditor::~SceneEditor() = default;
SceneEditor::SceneEditor(SceneEditor&&) noexcept = default;
SceneEditor& SceneEditor::operator=(SceneEditor&&) noexcept = default;

// -- Textures and materials

Result<TextureId> SceneEditor::addTexture(const TextureDesc& texture) {
  return edited_->edit([&]() -> Result<TextureId> {
    edited_->data.images.push_back(imageOf(texture));
    return TextureId(int(edited_->data.images.size()) - 1);
  });
}

Status SceneEditor::setTexture(TextureId id, const TextureDesc& texture) {
  if (!isIndex(id, edited_->data.images.size())) return noSuch("texture", int(id));
  return edited_->edit([&]() -> Status {
    edited_->data.images[size_t(id)] = imageOf(texture);
    return Done{};
  });
}

Result<MaterialId> SceneEditor::addMaterial(const MaterialDesc& material) {
  return edited_->edit([&]() -> Result<MaterialId> {
    edited_->data.materials.push_back(materialOf(material, edited_->data));
    return MaterialId(int(edited_->data.materials.size()) - 1);
  });
}

Status SceneEditor::setMaterial(MaterialId id, const MaterialDesc& material) {
  if (!isIndex(id, edited_->data.materials.size())) return noSuch("material", int(id));
  return edited_->edit([&]() -> Status {
    Material changed = materialOf(material, edited_->data);
    // Of what a description has no words for, a layer of paint stays one, as long as it blends.
    if (changed.alphaMode == AlphaMode::blend) changed.paint = edited_->data.materials[size_t(id)].paint;
    edited_->data.materials[size_t(id)] = std::move(changed);
    return Done{};
  });
}

Result<MaterialDesc> SceneEditor::material(MaterialId id) const {
  if (!isIndex(id, edited_->data.materials.size())) return noSuch("material", int(id));
  return descOf(edited_->data.materials[size_t(id)]);
}

std::optional<MaterialId> SceneEditor::findMaterial(const std::string& name) const {
  for (size_t m = 0; m < edited_->data.materials.size(); ++m)
    if (edited_->data.materials[m].name == name) return MaterialId(int(m));
  return std::nullopt;
}

// -- Meshes

Result<MeshId> SceneEditor::addMesh(const std::vector<MeshPart>& parts) {
  return edited_->edit([&]() -> Result<MeshId> {
    edited_->data.meshes.push_back(scene::meshOf(parts, edited_->data));
    return MeshId(int(edited_->data.meshes.size()) - 1);
  });
}

Status SceneEditor::setMesh(MeshId id, const std::vector<MeshPart>& parts) {
  if (!isIndex(id, edited_->data.meshes.size())) return noSuch("mesh", int(id));
  if (!isPlain(edited_->data.meshes[size_t(id)]))
    return usage("mesh " + std::to_string(int(id)) + " has joints or morph targets", "add another one");
  return edited_->edit([&]() -> Status {
    const scene::Mesh& before = edited_->data.meshes[size_t(id)];
    edited_->data.meshes[size_t(id)] = scene::meshOf(parts, edited_->data, &before);
    return Done{};
  });
}

// -- Nodes

Result<NodeId> SceneEditor::addNode(const NodeDesc& given) {
  SceneData& data = edited_->data;
  if (given.parent != NodeId::none && !isIndex(given.parent, data.nodes.size()))
    return noSuch("node", int(given.parent));
  if (given.mesh != MeshId::none && !isIndex(given.mesh, data.meshes.size()))
    return noSuch("mesh", int(given.mesh));
  if (!isAffine(given.transform)) return notAffine("the node's transform");
  return edited_->edit([&]() -> Result<NodeId> {
    Node node;
    node.name = given.name;
    node.parent = int(given.parent);
    node.localMatrix = given.transform;
    node.mesh = int(given.mesh);
    data.nodes.push_back(std::move(node));
    return NodeId(int(data.nodes.size()) - 1);
  });
}

NodeId SceneEditor::findNode(const std::string& name) const {
  return NodeId(scene::findNode(edited_->data, name));
}

std::string SceneEditor::nameOf(NodeId id) const {
  return isIndex(id, nodeCount()) ? edited_->data.nodes[size_t(id)].name : "";
}

MeshId SceneEditor::meshOf(NodeId id) const {
  return isIndex(id, edited_->data.nodes.size()) ? MeshId(edited_->data.nodes[size_t(id)].mesh)
                                                 : MeshId::none;
}

NodeId SceneEditor::carrierOf(NodeId id) const {
  const SceneData& data = edited_->data;
  if (!isIndex(id, data.nodes.size())) return NodeId::none;
  const int skin = data.nodes[size_t(id)].skin;
  if (skin < 0 || data.skins[size_t(skin)].joints.empty()) return id;
  const auto pathTo = [&](int node) {
    std::vector<int> path;
    for (; node >= 0; node = data.nodes[size_t(node)].parent) path.insert(path.begin(), node);
    return path;
  };
  std::vector<int> common = pathTo(data.skins[size_t(skin)].joints.front());
  const int first = common.back();
  for (const int joint : data.skins[size_t(skin)].joints) {
    const std::vector<int> path = pathTo(joint);
    common.erase(std::mismatch(common.begin(), common.end(), path.begin(), path.end()).first, common.end());
  }
  return NodeId(common.empty() ? first : common.back());
}

size_t SceneEditor::nodeCount() const {
  return edited_->data.nodes.size();
}

NodeId SceneEditor::parentOf(NodeId id) const {
  return isIndex(id, nodeCount()) ? NodeId(edited_->data.nodes[size_t(id)].parent) : NodeId::none;
}

glm::dmat4 SceneEditor::transformOf(NodeId id) const {
  return isIndex(id, nodeCount()) ? edited_->data.nodes[size_t(id)].restTransform() : glm::dmat4(1.0);
}

Status SceneEditor::setTransform(NodeId id, const glm::dmat4& transform) {
  SceneData& data = edited_->data;
  if (!isIndex(id, data.nodes.size())) return noSuch("node", int(id));
  if (!isAffine(transform)) return notAffine("the transform");
  for (const Clip& clip : data.clips)
    for (const Channel& channel : clip.channels)
      if (channel.node == int(id) && channel.property != AnimatedProperty::weights &&
          channel.property != AnimatedProperty::visible)
        return usage("the clip \"" + clip.name + "\" moves node " + std::to_string(int(id)),
                     "move a node above it; Scene::place puts one over a whole scene");
  return edited_->edit([&]() -> Status {
    data.nodes[size_t(id)].localMatrix = transform;
    return Done{};
  });
}

Status SceneEditor::setName(NodeId id, const std::string& name) {
  if (!isIndex(id, edited_->data.nodes.size())) return noSuch("node", int(id));
  return edited_->edit([&]() -> Status {
    edited_->data.nodes[size_t(id)].name = name;
    return Done{};
  });
}

Status SceneEditor::setVisible(NodeId id, bool visible) {
  if (!isIndex(id, edited_->data.nodes.size())) return noSuch("node", int(id));
  return edited_->edit([&]() -> Status {
    edited_->data.nodes[size_t(id)].visible = visible;
    return Done{};
  });
}

Status SceneEditor::setMesh(NodeId id, MeshId mesh) {
  SceneData& data = edited_->data;
  if (!isIndex(id, data.nodes.size())) return noSuch("node", int(id));
  if (mesh != MeshId::none && !isIndex(mesh, data.meshes.size())) return noSuch("mesh", int(mesh));
  Node& node = data.nodes[size_t(id)];
  if (node.mesh == int(mesh)) return Done{};
  if (node.skin >= 0 || !node.morphWeights.empty() ||
      (node.mesh >= 0 && !isPlain(data.meshes[size_t(node.mesh)])) ||
      (mesh != MeshId::none && !isPlain(data.meshes[size_t(mesh)])))
    return usage("meshes with joints or morph targets stay on their nodes",
                 "hide the node with setVisible()");
  return edited_->edit([&]() -> Status {
    node.mesh = int(mesh);
    return Done{};
  });
}

Status SceneEditor::setInstances(NodeId id, std::span<const glm::mat4> transforms) {
  SceneData& data = edited_->data;
  if (!isIndex(id, data.nodes.size())) return noSuch("node", int(id));
  if (data.nodes[size_t(id)].skin >= 0)
    return usage("a skinned mesh has no instances: its joints place it", "add a scene for each");
  for (const glm::mat4& transform : transforms)
    if (!isAffine(transform)) return notAffine("an instance's transform");
  return edited_->edit([&]() -> Status {
    data.nodes[size_t(id)].instances.assign(transforms.begin(), transforms.end());
    return Done{};
  });
}

Status SceneEditor::setLight(NodeId id, const std::optional<LightDesc>& light) {
  SceneData& data = edited_->data;
  if (!isIndex(id, data.nodes.size())) return noSuch("node", int(id));
  return edited_->edit([&]() -> Status {
    Node& node = data.nodes[size_t(id)];
    if (!light) {
      node.light = -1;
    } else {
      const Light made = lightOf(*light);
      const int had = node.light;
      // Its own, else one that nobody has any more.
      std::vector<size_t> users(data.lights.size(), 0);
      for (const Node& other : data.nodes)
        if (other.light >= 0) ++users[size_t(other.light)];
      if (had < 0 || users[size_t(had)] > 1)
        node.light = int(std::find(users.begin(), users.end(), size_t(0)) - users.begin());
      if (size_t(node.light) == data.lights.size()) data.lights.emplace_back();
      data.lights[size_t(node.light)] = made;
    }
    return Done{};
  });
}

Status SceneEditor::setExtras(NodeId id, const std::string& json) {
  SceneData& data = edited_->data;
  if (!isIndex(id, data.nodes.size())) return noSuch("node", int(id));
  const nlohmann::json given =
      json.empty() ? nlohmann::json::object() : nlohmann::json::parse(json, nullptr, false);
  if (!given.is_object()) return usage("extras are no JSON object", "give one, or nothing");
  return edited_->edit([&]() -> Status {
    Node& node = data.nodes[size_t(id)];
    ImportWarnings warnings;
    readExtras(given, node, [&](const std::string& path, const std::string& text) {
      warnings.add("extras" + path + " of \"" + node.name + "\"", text);
    });
    edited_->extrasWarnings[int(id)] = warnings.lines(data.name);
    return Done{};
  });
}

Result<Scene> SceneEditor::scene() const {
  if (edited_->present) return *edited_->present;
  return guarded([&]() -> Result<Scene> {
    auto data = std::make_shared<SceneData>(edited_->data);
    ImportWarnings warnings;
    placeScene(*data, warnings);
    for (std::string& line : warnings.lines(data->name))
      if (std::find(data->warnings.begin(), data->warnings.end(), line) == data->warnings.end())
        data->warnings.push_back(std::move(line));
    for (const auto& [node, lines] : edited_->extrasWarnings)
      data->warnings.insert(data->warnings.end(), lines.begin(), lines.end());
    Scene scene;
    scene.data_ = std::move(data);
    edited_->present = scene;
    return scene;
  });
}

}  // namespace scumble
