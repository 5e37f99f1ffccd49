#include "served_scene.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

namespace scumble::serve {

namespace {

using nlohmann::json;

const std::vector<std::string> kKinds = {"texture", "material", "mesh", "node"};

template <class Item>
const Item& itemOf(const std::map<std::string, Item>& items, const std::string& key, const std::string& what,
                   const std::string& where) {
  const auto found = items.find(key);
  if (found == items.end()) refuse(where, "there is no " + what + " '" + key + "'", "set it first");
  return found->second;
}

OutlineDesc outlineOf(const json& given, const std::string& where) {
  Members members(given, where);
  OutlineDesc outline;
  outline.unit = OutlineDesc::Unit(members.word("unit", {"metres", "picture-heights"}).value_or(0));
  outline.width = float(members.number("width").value_or(0));
  if (const auto color = members.vector("color")) outline.color = *color;
  outline.lightingMix = float(members.number("lightingMix").value_or(1));
  members.end();
  return outline;
}

std::optional<LightDesc> lightOf(const json& given, const std::string& where) {
  Members members(given, where);
  members.require("kind");
  const size_t kind = *members.word("kind", {"none", "directional", "point", "spot"});
  LightDesc light;
  if (const auto color = members.vector("color")) light.color = *color;
  light.intensity = float(members.number("intensity").value_or(light.intensity));
  light.range = float(members.number("range").value_or(light.range));
  light.innerCone = float(members.number("innerCone").value_or(light.innerCone));
  light.outerCone = float(members.number("outerCone").value_or(light.outerCone));
  members.end();
  if (kind == 0) return std::nullopt;
  light.kind = LightDesc::Kind(kind - 1);
  return light;
}

// A part's arrays, in which its spans lie.
struct PartArrays {
  std::vector<glm::vec3> positions, normals;
  std::vector<uint32_t> indices;
  std::vector<glm::vec2> uv0, uv1;
  std::vector<glm::u8vec4> colors;
  std::vector<float> warpScales, roundness;
};

template <class T>
std::span<const T> arrayOf(Members& members, const char* name, const ClientMemory& memory,
                           std::vector<T>& into) {
  if (const json* reference = members.find(name)) into = memory.read<T>(*reference, members.place(name));
  return into;
}

// What stands for what was removed, as small as can be.
Status shrink(SceneEditor& editor, MeshId id) {
  const std::vector<glm::vec3> corners = {{0, 0, 0}, {1e-3f, 0, 0}, {0, 1e-3f, 0}};
  return editor.setMesh(id, {{.positions = corners}});
}

Status shrink(SceneEditor& editor, TextureId id) {
  const std::vector<uint8_t> white(4, 255);
  return editor.setTexture(id, {.width = 1, .height = 1, .rgba = white});
}

}  // namespace

template <class Item, class Set, class Add>
auto ServedScene::put(Kind<Item>& kind, const std::string& key, const std::string& where, Set set, Add add) {
  const auto found = kind.items.find(key);
  if (found == kind.items.end() && kind.free.empty()) return valueOf(add(), where);
  const auto id = (found != kind.items.end() ? found->second : kind.free.back()).id;
  valueOf(set(id), where);
  if (found == kind.items.end()) kind.free.pop_back();
  return id;
}

TextureSlot ServedScene::slotOf(Members& members, const char* name, std::set<std::string>& used) const {
  TextureSlot slot;
  const json* given = members.find(name);
  if (!given) return slot;
  Members own(*given, members.place(name));
  const std::string key = own.requireText("texture");
  slot.texture = itemOf(textures_.items, key, "texture", own.place("texture")).id;
  used.insert(key);
  const std::vector<std::string> wraps = {"repeat", "mirrored-repeat", "clamp-to-edge"};
  slot.wrapU = TextureSlot::Wrap(own.word("wrapU", wraps).value_or(0));
  slot.wrapV = TextureSlot::Wrap(own.word("wrapV", wraps).value_or(0));
  slot.nearest = own.flag("nearest").value_or(false);
  slot.mipmaps = own.flag("mipmaps").value_or(true);
  slot.uvSet = int(own.whole("uvSet", 1).value_or(0));
  if (const auto matrix = own.numbers("transform", 9)) slot.transform = glm::make_mat3(matrix->data());
  own.end();
  return slot;
}

void ServedScene::setTexture(Members& members, const std::string& key, const ClientMemory& memory) {
  constexpr uint64_t kMostSide = 16384;
  TextureDesc desc;
  desc.name = members.text("name").value_or(key);
  desc.width = uint32_t(members.requireWhole("width", kMostSide));
  desc.height = uint32_t(members.requireWhole("height", kMostSide));
  if (desc.width == 0 || desc.height == 0)
    refuse(members.place("width"), "a texture has no pixels", "use 1 or more");
  const std::vector<uint8_t> rgba = memory.read<uint8_t>(members.require("rgba"), members.place("rgba"),
                                                         uint64_t(4) * desc.width * desc.height);
  desc.rgba = rgba;
  members.end();
  const TextureId id = put(
      textures_, key, members.place(""), [&](TextureId known) { return editor_.setTexture(known, desc); },
      [&] { return editor_.addTexture(desc); });
  textures_.items[key] = {id};
}

void ServedScene::setMaterial(Members& members, const std::string& key) {
  MaterialDesc desc;
  std::set<std::string> used;
  desc.name = members.text("name").value_or(key);
  if (const auto color = members.numbers("baseColor", 4)) desc.baseColor = glm::make_vec4(color->data());
  desc.baseColorTexture = slotOf(members, "baseColorTexture", used);
  if (const auto color = members.vector("emissive")) desc.emissive = *color;
  desc.emissiveTexture = slotOf(members, "emissiveTexture", used);
  desc.alpha = MaterialDesc::Alpha(members.word("alpha", {"opaque", "mask", "blend"}).value_or(0));
  desc.alphaCutoff = float(members.number("alphaCutoff").value_or(desc.alphaCutoff));
  desc.doubleSided = members.flag("doubleSided").value_or(false);
  desc.unlit = members.flag("unlit").value_or(false);
  desc.shadowedColor = members.vector("shadowedColor");
  desc.litTexture = slotOf(members, "litTexture", used);
  desc.shadowedTexture = slotOf(members, "shadowedTexture", used);
  if (const json* outline = members.find("outline"))
    desc.outline = outlineOf(*outline, members.place("outline"));
  members.end();
  const MaterialId id = put(
      materials_, key, members.place(""), [&](MaterialId known) { return editor_.setMaterial(known, desc); },
      [&] { return editor_.addMaterial(desc); });
  materials_.items[key] = {id, std::move(used)};
}

void ServedScene::setMesh(Members& members, const std::string& key, const ClientMemory& memory) {
  std::set<std::string> used;
  const json& given = members.list("parts");
  std::vector<PartArrays> arrays(given.size());
  std::vector<MeshPart> parts;
  for (size_t i = 0; i < given.size(); ++i) {
    Members own(given[i], members.place("parts") + "[" + std::to_string(i) + "]");
    MeshPart part;
    PartArrays& in = arrays[i];
    own.require("positions");
    part.positions = arrayOf(own, "positions", memory, in.positions);
    part.indices = arrayOf(own, "indices", memory, in.indices);
    part.normals = arrayOf(own, "normals", memory, in.normals);
    part.uv0 = arrayOf(own, "uv0", memory, in.uv0);
    part.uv1 = arrayOf(own, "uv1", memory, in.uv1);
    part.colors = arrayOf(own, "colors", memory, in.colors);
    part.warpScales = arrayOf(own, "warpScales", memory, in.warpScales);
    part.roundness = arrayOf(own, "roundness", memory, in.roundness);
    if (const auto material = own.text("material"); material && !material->empty()) {
      part.material = itemOf(materials_.items, *material, "material", own.place("material")).id;
      used.insert(*material);
    }
    own.end();
    parts.push_back(part);
  }
  members.end();
  const MeshId id = put(
      meshes_, key, members.place("parts"), [&](MeshId known) { return editor_.setMesh(known, parts); },
      [&] { return editor_.addMesh(parts); });
  meshes_.items[key] = {id, std::move(used)};
}

void ServedScene::setNode(Members& members, const std::string& key, const ClientMemory& memory) {
  const auto found = nodes_.items.find(key);
  const bool isNew = found == nodes_.items.end();
  Node node = isNew ? Node{NodeId::none, "", ""} : found->second;
  const std::optional<std::string> name = members.text("name");
  const std::string parent = members.text("parent").value_or(node.parent);
  if (!isNew && parent != node.parent)
    refuse(members.place("parent"), "a node keeps its parent", "remove it, and set it anew");
  node.parent = parent;
  const NodeId above =
      parent.empty() ? NodeId::none : itemOf(nodes_.items, parent, "node", members.place("parent")).id;

  // All is read before anything is changed.
  const auto transform = members.matrix("transform");
  const auto mesh = members.text("mesh");
  MeshId meshId = MeshId::none;
  if (mesh && !mesh->empty()) meshId = itemOf(meshes_.items, *mesh, "mesh", members.place("mesh")).id;
  const auto visible = members.flag("visible");
  std::optional<std::vector<glm::mat4>> instances;
  if (const json* reference = members.find("instances"))
    instances = memory.read<glm::mat4>(*reference, members.place("instances"));
  const json* givenLight = members.find("light");
  std::optional<LightDesc> light;
  if (givenLight) light = lightOf(*givenLight, members.place("light"));
  const json* extras = members.find("extras");
  if (extras && !extras->is_object())
    refuse(members.place("extras"), "this is no object", "write it in braces");
  members.end();

  if (isNew) {
    const auto free = std::find_if(nodes_.free.begin(), nodes_.free.end(),
                                   [&](const Node& other) { return editor_.parentOf(other.id) == above; });
    if (free != nodes_.free.end()) {
      node.id = free->id;
      nodes_.free.erase(free);
      valueOf(editor_.setVisible(node.id, true), members.place(""));
      valueOf(editor_.setTransform(node.id, glm::mat4(1.0f)), members.place(""));
    } else {
      node.id = valueOf(editor_.addNode({.parent = above}), members.place(""));
    }
    valueOf(editor_.setName(node.id, name.value_or(key)), members.place(""));
    nodes_.items[key] = node;
  } else if (name) {
    valueOf(editor_.setName(node.id, *name), members.place("name"));
  }
  try {
    if (transform) valueOf(editor_.setTransform(node.id, *transform), members.place("transform"));
    if (mesh) {
      valueOf(editor_.setMesh(node.id, meshId), members.place("mesh"));
      node.mesh = *mesh;
    }
    if (visible) valueOf(editor_.setVisible(node.id, *visible), members.place("visible"));
    if (instances) valueOf(editor_.setInstances(node.id, *instances), members.place("instances"));
    if (givenLight) valueOf(editor_.setLight(node.id, light), members.place("light"));
    if (extras) valueOf(editor_.setExtras(node.id, extras->dump()), members.place("extras"));
  } catch (const Refusal&) {
    if (isNew) remove(3, key, members.place(""));
    throw;
  }
  nodes_.items[key] = node;
}

void ServedScene::remove(size_t kind, const std::string& key, const std::string& where) {
  const auto refuseUsed = [&](const std::string& what, const std::string& user) {
    refuse(where, what + " '" + key + "' belongs to '" + user + "'", "change or remove that first");
  };
  if (kind == 0) {
    const Texture texture = itemOf(textures_.items, key, "texture", where);
    for (const auto& [user, material] : materials_.items)
      if (material.textures.count(key)) refuseUsed("the texture", user);
    valueOf(shrink(editor_, texture.id), where);
    textures_.free.push_back(texture), textures_.items.erase(key);
  } else if (kind == 1) {
    const Material material = itemOf(materials_.items, key, "material", where);
    for (const auto& [user, mesh] : meshes_.items)
      if (mesh.materials.count(key)) refuseUsed("the material", user);
    valueOf(editor_.setMaterial(material.id, {}), where);
    materials_.free.push_back({material.id, {}}), materials_.items.erase(key);
  } else if (kind == 2) {
    const Mesh mesh = itemOf(meshes_.items, key, "mesh", where);
    for (const auto& [user, node] : nodes_.items)
      if (node.mesh == key) refuseUsed("the mesh", user);
    valueOf(shrink(editor_, mesh.id), where);
    meshes_.free.push_back({mesh.id, {}}), meshes_.items.erase(key);
  } else {
    const Node node = itemOf(nodes_.items, key, "node", where);
    for (const auto& [user, other] : nodes_.items)
      if (other.parent == key) refuseUsed("the node", user);
    valueOf(editor_.setVisible(node.id, false), where);
    valueOf(editor_.setName(node.id, ""), where);
    valueOf(editor_.setMesh(node.id, MeshId::none), where);
    valueOf(editor_.setInstances(node.id, {}), where);
    valueOf(editor_.setLight(node.id, std::nullopt), where);
    valueOf(editor_.setExtras(node.id, ""), where);
    nodes_.free.push_back(node), nodes_.items.erase(key);
  }
}

void ServedScene::edit(const json& edit, const std::string& where, const ClientMemory& memory) {
  Members members(edit, where);
  const std::string key = members.requireText("key");
  if (key.empty()) refuse(members.place("key"), "a key is empty", "give a name of your own");
  if (const auto kind = members.word("remove", kKinds)) {
    members.end();
    return remove(*kind, key, where);
  }
  members.require("set");
  switch (*members.word("set", kKinds)) {
    case 0:
      return setTexture(members, key, memory);
    case 1:
      return setMaterial(members, key);
    case 2:
      return setMesh(members, key, memory);
    default:
      return setNode(members, key, memory);
  }
}

NodeId ServedScene::nodeOf(const std::string& key, const std::string& where) const {
  return itemOf(nodes_.items, key, "node", where).id;
}

void ServedScene::clear() {
  *this = ServedScene();
}

json ServedScene::counts() const {
  return {{"textures", textures_.items.size()},
          {"materials", materials_.items.size()},
          {"meshes", meshes_.items.size()},
          {"nodes", nodes_.items.size()},
          {"nodesEver", editor_.nodeCount()}};
}

}  // namespace scumble::serve
