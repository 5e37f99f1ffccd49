#include "scumble/scene_editor.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "scene/find_node.h"
#include "scene/import_failure.h"
#include "scene/parallel.h"
#include "scene/prepare_mesh.h"
#include "scene/scene_bounds.h"

namespace scumble {

namespace scene {

class EditedScene {
 public:
  SceneData data;
  std::optional<Scene> present;
};

namespace {

uint64_t newFamily() {
  static std::atomic<uint64_t> last{0};
  return ++last;
}

Error usage(std::string problem, std::string advice) {
  return {ErrorKind::usage, "", 0, "", std::move(problem), std::move(advice)};
}

template <class T>
bool isIndex(T id, size_t count) {
  return int(id) >= 0 && size_t(id) < count;
}

Error noSuch(const char* what, int id) {
  return usage("there is no " + std::string(what) + " " + std::to_string(id),
               "use an id that this editor gave");
}

// Ends in a failure where something is wrong; `what` names it.
class Check {
 public:
  explicit Check(std::string what) : what_(std::move(what)) {}
  void require(bool isRight, const std::string& problem, const std::string& advice) const {
    if (!isRight) fail(what_, problem, advice);
  }
  template <class Vector>
  void finite(std::span<const Vector> values, const std::string& name) const {
    for (size_t i = 0; i < values.size(); ++i)
      for (int c = 0; c < Vector::length(); ++c)
        require(std::isfinite(values[i][c]), name + "[" + std::to_string(i) + "] is not finite",
                "give finite numbers");
  }
  template <class T>
  void perVertex(std::span<const T> values, size_t count, const std::string& name) const {
    require(values.empty() || values.size() == count,
            "there are " + std::to_string(values.size()) + " " + name + " for " + std::to_string(count) +
                " vertices",
            "give one a vertex, or none");
  }

 private:
  std::string what_;
};

bool isAffine(const glm::mat4& m) {
  return isDrawable(m) && m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1;
}

Image imageOf(const TextureDesc& texture) {
  const Check check("texture");
  check.require(texture.width >= 1 && texture.height >= 1 && texture.width <= kMaxImageSide &&
                    texture.height <= kMaxImageSide,
                "a size of " + std::to_string(texture.width) + "x" + std::to_string(texture.height) +
                    " is out of range",
                "use 1 to 16384 a side");
  check.require(texture.rgba.size() == size_t(4) * texture.width * texture.height,
                "there are " + std::to_string(texture.rgba.size()) + " bytes for " +
                    std::to_string(texture.width) + "x" + std::to_string(texture.height) + " pixels",
                "give four a pixel");
  Image image;
  image.name = texture.name;
  image.width = texture.width, image.height = texture.height;
  image.rgba.assign(texture.rgba.begin(), texture.rgba.end());
  return image;
}

TextureUse useOf(const TextureSlot& slot, const SceneData& scene, const Check& check) {
  TextureUse use;
  if (slot.texture == TextureId::none) return use;
  check.require(isIndex(slot.texture, scene.images.size()),
                "there is no texture " + std::to_string(int(slot.texture)), "add it first");
  check.require(slot.uvSet == 0 || slot.uvSet == 1, "uvSet is neither 0 nor 1", "use 0 or 1");
  for (int i = 0; i < 9; ++i)
    check.require(std::isfinite(slot.transform[i / 3][i % 3]), "a texture's transform is not finite",
                  "give finite numbers");
  use.image = int(slot.texture);
  use.sampler = {Wrap(slot.wrapU), Wrap(slot.wrapV), slot.nearest, slot.mipmaps};
  use.uvSet = slot.uvSet;
  use.transform = slot.transform;
  return use;
}

TextureSlot slotOf(const TextureUse& use) {
  return {TextureId(use.image),
          TextureSlot::Wrap(use.sampler.wrapU),
          TextureSlot::Wrap(use.sampler.wrapV),
          use.sampler.nearest,
          use.sampler.mipmaps,
          use.uvSet,
          use.transform};
}

Material materialOf(const MaterialDesc& given, const SceneData& scene) {
  const Check check("material");
  const auto inUnit = [](float x) { return x >= 0 && x <= 1; };
  for (int c = 0; c < 4; ++c)
    check.require(inUnit(given.baseColor[c]), "its base colour is out of range", "use 0 to 1");
  for (int c = 0; c < 3; ++c)
    check.require(given.emissive[c] >= 0 && std::isfinite(given.emissive[c]), "what it emits is out of range",
                  "use numbers from 0 on");
  check.require(std::isfinite(given.alphaCutoff) && given.alphaCutoff >= 0,
                "its alpha cutoff is out of range", "use 0 to 1");
  if (given.shadowedColor)
    for (int c = 0; c < 3; ++c)
      check.require(inUnit((*given.shadowedColor)[c]), "its colour in shadow is out of range", "use 0 to 1");
  Material material;
  material.name = given.name;
  material.baseColor = given.baseColor;
  material.baseColorTexture = useOf(given.baseColorTexture, scene, check);
  material.emissive = given.emissive;
  material.emissiveTexture = useOf(given.emissiveTexture, scene, check);
  material.alphaMode = AlphaMode(given.alpha);
  material.alphaCutoff = given.alphaCutoff;
  material.doubleSided = given.doubleSided;
  material.unlit = given.unlit;
  material.shadowedColor = given.shadowedColor;
  material.litTexture = useOf(given.litTexture, scene, check);
  material.shadowedTexture = useOf(given.shadowedTexture, scene, check);
  return material;
}

Primitive primitiveOf(const MeshPart& part, const SceneData& scene, const Check& check,
                      ImportWarnings& warnings) {
  const size_t count = part.positions.size();
  check.require(count > 0, "it has no positions", "give some");
  check.require(count <= ~uint32_t(0), "it has too many vertices", "split it");
  check.finite(part.positions, "positions");
  for (size_t i = 0; i < count; ++i)
    check.require(isDrawable(part.positions[i]), "positions[" + std::to_string(i) + "] is out of range",
                  "use metres within +-1e15");
  check.perVertex(part.normals, count, "normals"), check.finite(part.normals, "normals");
  check.perVertex(part.uv0, count, "uv0"), check.finite(part.uv0, "uv0");
  check.perVertex(part.uv1, count, "uv1"), check.finite(part.uv1, "uv1");
  check.perVertex(part.colors, count, "colors");
  check.perVertex(part.warpScales, count, "warpScales");
  for (const float scale : part.warpScales)
    check.require(scale >= 0 && scale <= 64, "a warp scale is out of range", "use 0 to 64");
  check.require(isIndex(part.material, scene.materials.size()),
                "there is no material " + std::to_string(int(part.material)), "add it first");
  const size_t corners = part.indices.empty() ? count : part.indices.size();
  check.require(corners % 3 == 0, std::to_string(corners) + " corners make no triangles",
                "give three a triangle");
  for (size_t i = 0; i < part.indices.size(); ++i)
    check.require(part.indices[i] < count, "indices[" + std::to_string(i) + "] is no vertex",
                  "use 0 to " + std::to_string(count - 1));

  Primitive primitive;
  const auto copy = [](auto& to, const auto& from) { to.assign(from.begin(), from.end()); };
  copy(primitive.positions, part.positions);
  copy(primitive.normals, part.normals);
  copy(primitive.uv0, part.uv0);
  copy(primitive.uv1, part.uv1);
  copy(primitive.colors, part.colors);
  copy(primitive.warpScales, part.warpScales);
  copy(primitive.indices, part.indices);
  for (uint32_t i = 0; part.indices.empty() && i < count; ++i) primitive.indices.push_back(i);
  primitive.material = int(part.material);
  cleanPrimitive(primitive, "", warnings);
  return primitive;
}

Mesh meshOf(const std::vector<MeshPart>& parts, const SceneData& scene) {
  if (parts.empty()) fail("mesh", "it has no parts", "give one at least");
  Mesh mesh;
  ImportWarnings warnings;
  for (size_t i = 0; i < parts.size(); ++i) {
    const Check check("part " + std::to_string(i) + " of the mesh");
    mesh.primitives.push_back(primitiveOf(parts[i], scene, check, warnings));
  }
  // What has no area takes up no space.
  std::erase_if(mesh.primitives, [](const Primitive& p) { return p.indices.empty(); });
  weldSmoothNormals(mesh);
  const float radius = boundingRadius(mesh);
  parallelFor(mesh.primitives.size(), mesh.primitives.size() > 1 ? threadCount(0) : 1,
              [&](size_t p) { finishPrimitive(mesh.primitives[p], radius); });
  return mesh;
}

bool isPlain(const Mesh& mesh) {
  return std::all_of(mesh.primitives.begin(), mesh.primitives.end(),
                     [](const Primitive& p) { return p.influences == 0 && p.morphTargets.empty(); });
}

Light lightOf(const LightDesc& given) {
  const Check check("light");
  for (const float number : {given.color.r, given.color.g, given.color.b, given.intensity, given.range})
    check.require(number >= 0 && std::isfinite(number), "its colour, intensity or range is out of range",
                  "use numbers from 0 on");
  check.require(given.innerCone >= 0 && given.innerCone < given.outerCone &&
                    given.outerCone <= glm::half_pi<float>() + 1e-6f,
                "its cones are out of range", "use 0 <= inner < outer <= pi / 2");
  Light light;
  light.kind = LightKind(given.kind);
  light.color = given.color;
  light.intensity = given.intensity;
  light.range = given.range;
  light.innerCone = given.innerCone, light.outerCone = given.outerCone;
  return light;
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
  edited_->data.family = family;
}

SceneEditor::~SceneEditor() = default;
SceneEditor::SceneEditor(SceneEditor&&) noexcept = default;
SceneEditor& SceneEditor::operator=(SceneEditor&&) noexcept = default;

// -- Textures and materials

Result<TextureId> SceneEditor::addTexture(const TextureDesc& texture) {
  return guarded([&]() -> Result<TextureId> {
    edited_->data.images.push_back(imageOf(texture));
    edited_->present.reset();
    return TextureId(int(edited_->data.images.size()) - 1);
  });
}

Status SceneEditor::setTexture(TextureId id, const TextureDesc& texture) {
  if (!isIndex(id, edited_->data.images.size())) return noSuch("texture", int(id));
  return guarded([&]() -> Status {
    edited_->data.images[size_t(id)] = imageOf(texture);
    edited_->present.reset();
    return Done{};
  });
}

Result<MaterialId> SceneEditor::addMaterial(const MaterialDesc& material) {
  return guarded([&]() -> Result<MaterialId> {
    edited_->data.materials.push_back(materialOf(material, edited_->data));
    edited_->present.reset();
    return MaterialId(int(edited_->data.materials.size()) - 1);
  });
}

Status SceneEditor::setMaterial(MaterialId id, const MaterialDesc& material) {
  if (!isIndex(id, edited_->data.materials.size())) return noSuch("material", int(id));
  return guarded([&]() -> Status {
    edited_->data.materials[size_t(id)] = materialOf(material, edited_->data);
    edited_->present.reset();
    return Done{};
  });
}

Result<MaterialDesc> SceneEditor::material(MaterialId id) const {
  if (!isIndex(id, edited_->data.materials.size())) return noSuch("material", int(id));
  const Material& material = edited_->data.materials[size_t(id)];
  MaterialDesc desc;
  desc.name = material.name;
  desc.baseColor = material.baseColor;
  desc.baseColorTexture = slotOf(material.baseColorTexture);
  desc.emissive = material.emissive;
  desc.emissiveTexture = slotOf(material.emissiveTexture);
  desc.alpha = MaterialDesc::Alpha(material.alphaMode);
  desc.alphaCutoff = material.alphaCutoff;
  desc.doubleSided = material.doubleSided;
  desc.unlit = material.unlit;
  desc.shadowedColor = material.shadowedColor;
  desc.litTexture = slotOf(material.litTexture);
  desc.shadowedTexture = slotOf(material.shadowedTexture);
  return desc;
}

std::optional<MaterialId> SceneEditor::findMaterial(const std::string& name) const {
  for (size_t m = 0; m < edited_->data.materials.size(); ++m)
    if (edited_->data.materials[m].name == name) return MaterialId(int(m));
  return std::nullopt;
}

// -- Meshes

Result<MeshId> SceneEditor::addMesh(const std::vector<MeshPart>& parts) {
  return guarded([&]() -> Result<MeshId> {
    edited_->data.meshes.push_back(scene::meshOf(parts, edited_->data));
    edited_->present.reset();
    return MeshId(int(edited_->data.meshes.size()) - 1);
  });
}

Status SceneEditor::setMesh(MeshId id, const std::vector<MeshPart>& parts) {
  if (!isIndex(id, edited_->data.meshes.size())) return noSuch("mesh", int(id));
  if (!isPlain(edited_->data.meshes[size_t(id)]))
    return usage("mesh " + std::to_string(int(id)) + " has joints or morph targets", "add another one");
  return guarded([&]() -> Status {
    edited_->data.meshes[size_t(id)] = scene::meshOf(parts, edited_->data);
    edited_->present.reset();
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
  if (!isAffine(given.transform))
    return usage("the node's transform is not affine, or not finite",
                 "give one whose last row is 0, 0, 0, 1");
  return guarded([&]() -> Result<NodeId> {
    Node node;
    node.name = given.name;
    node.parent = int(given.parent);
    node.localMatrix = given.transform;
    node.mesh = int(given.mesh);
    data.nodes.push_back(std::move(node));
    edited_->present.reset();
    return NodeId(int(data.nodes.size()) - 1);
  });
}

NodeId SceneEditor::findNode(const std::string& name) const {
  return NodeId(scene::findNode(edited_->data, name));
}

MeshId SceneEditor::meshOf(NodeId id) const {
  return isIndex(id, edited_->data.nodes.size()) ? MeshId(edited_->data.nodes[size_t(id)].mesh)
                                                 : MeshId::none;
}

Status SceneEditor::setTransform(NodeId id, const glm::mat4& transform) {
  SceneData& data = edited_->data;
  if (!isIndex(id, data.nodes.size())) return noSuch("node", int(id));
  if (!isAffine(transform))
    return usage("the transform is not affine, or not finite", "give one whose last row is 0, 0, 0, 1");
  for (const Clip& clip : data.clips)
    for (const Channel& channel : clip.channels)
      if (channel.node == int(id) && channel.property != AnimatedProperty::weights)
        return usage("the clip \"" + clip.name + "\" moves node " + std::to_string(int(id)),
                     "move a node above it; Scene::place puts one over a whole scene");
  data.nodes[size_t(id)].localMatrix = transform;
  edited_->present.reset();
  return Done{};
}

Status SceneEditor::setVisible(NodeId id, bool visible) {
  if (!isIndex(id, edited_->data.nodes.size())) return noSuch("node", int(id));
  edited_->data.nodes[size_t(id)].visible = visible;
  edited_->present.reset();
  return Done{};
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
  node.mesh = int(mesh);
  edited_->present.reset();
  return Done{};
}

Status SceneEditor::setInstances(NodeId id, std::span<const glm::mat4> transforms) {
  SceneData& data = edited_->data;
  if (!isIndex(id, data.nodes.size())) return noSuch("node", int(id));
  if (data.nodes[size_t(id)].skin >= 0)
    return usage("a skinned mesh has no instances: its joints place it", "add a scene for each");
  for (const glm::mat4& transform : transforms)
    if (!isAffine(transform))
      return usage("an instance's transform is not affine, or not finite",
                   "give one whose last row is 0, 0, 0, 1");
  return guarded([&]() -> Status {
    data.nodes[size_t(id)].instances.assign(transforms.begin(), transforms.end());
    edited_->present.reset();
    return Done{};
  });
}

Status SceneEditor::setLight(NodeId id, const std::optional<LightDesc>& light) {
  SceneData& data = edited_->data;
  if (!isIndex(id, data.nodes.size())) return noSuch("node", int(id));
  return guarded([&]() -> Status {
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
    edited_->present.reset();
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
    Scene scene;
    scene.data_ = std::move(data);
    edited_->present = scene;
    return scene;
  });
}

}  // namespace scumble
