// Scenes from arrays, and scenes that change.
#include <pybind11/stl.h>

#include <algorithm>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"
#include "scumble/scene_editor.h"

using namespace scumble;
using namespace pybind11::literals;

namespace scumble_python {
namespace {

[[noreturn]] void refuseKey(const std::string& what, const std::string& key, const std::string& known) {
  raiseUsage(what + " has no '" + key + "'", "it has " + known);
}

TextureSlot toSlot(const py::handle& value, const std::string& what) {
  TextureSlot slot;
  if (value.is_none()) return slot;
  if (!py::isinstance<py::dict>(value)) {
    slot.texture = TextureId(as<int>(value, what, "a texture's number, or a dict"));
    return slot;
  }
  const std::vector<std::string> wraps = {"repeat", "mirrored-repeat", "clamp-to-edge"};
  for (const auto& [key, item] : py::reinterpret_borrow<py::dict>(value)) {
    const std::string name = py::str(key);
    if (name == "texture") {
      slot.texture = TextureId(as<int>(item, name));
    } else if (name == "wrap_u") {
      slot.wrapU = TextureSlot::Wrap(wordOf(item, name, wraps));
    } else if (name == "wrap_v") {
      slot.wrapV = TextureSlot::Wrap(wordOf(item, name, wraps));
    } else if (name == "nearest") {
      slot.nearest = as<bool>(item, name);
    } else if (name == "mipmaps") {
      slot.mipmaps = as<bool>(item, name);
    } else if (name == "uv_set") {
      slot.uvSet = as<int>(item, name);
    } else if (name == "transform") {
      slot.transform = toMatrix3(item, "the transform of a texture");
    } else {
      refuseKey(what, name, "texture, wrap_u, wrap_v, nearest, mipmaps, uv_set and transform");
    }
  }
  return slot;
}

OutlineDesc toOutline(const py::handle& value, const std::string& what) {
  OutlineDesc outline;
  for (const auto& [key, item] : as<py::dict>(value, what, "a dict")) {
    const std::string name = py::str(key);
    if (name == "unit")
      outline.unit = OutlineDesc::Unit(wordOf(item, name, {"metres", "picture-heights"}));
    else if (name == "width")
      outline.width = as<float>(item, name);
    else if (name == "color")
      outline.color = toVec3(item, name);
    else if (name == "lighting_mix")
      outline.lightingMix = as<float>(item, name);
    else
      refuseKey(what, name, "unit, width, color and lighting_mix");
  }
  return outline;
}

void change(MaterialDesc& material, const py::kwargs& settings) {
  for (const auto& [key, value] : settings) {
    const std::string name = py::str(key);
    if (name == "name") {
      material.name = as<std::string>(value, name);
    } else if (name == "base_color") {
      const auto numbers = as<std::vector<float>>(value, name, "3 or 4 linear numbers from 0 to 1");
      if (numbers.size() != 3 && numbers.size() != 4) refuse(value, name, "3 or 4 linear numbers");
      material.baseColor = {numbers[0], numbers[1], numbers[2], numbers.size() == 4 ? numbers[3] : 1.0f};
    } else if (name == "base_color_texture") {
      material.baseColorTexture = toSlot(value, name);
    } else if (name == "emissive") {
      material.emissive = toVec3(value, name);
    } else if (name == "emissive_texture") {
      material.emissiveTexture = toSlot(value, name);
    } else if (name == "alpha") {
      material.alpha = MaterialDesc::Alpha(wordOf(value, name, {"opaque", "mask", "blend"}));
    } else if (name == "alpha_cutoff") {
      material.alphaCutoff = as<float>(value, name);
    } else if (name == "double_sided") {
      material.doubleSided = as<bool>(value, name);
    } else if (name == "unlit") {
      material.unlit = as<bool>(value, name);
    } else if (name == "shadowed_color") {
      material.shadowedColor = value.is_none() ? std::optional<glm::vec3>() : toVec3(value, name);
    } else if (name == "lit_texture") {
      material.litTexture = toSlot(value, name);
    } else if (name == "shadowed_texture") {
      material.shadowedTexture = toSlot(value, name);
    } else if (name == "outline") {
      material.outline = value.is_none() ? std::optional<OutlineDesc>() : toOutline(value, name);
    } else {
      refuseKey("a material", name,
                "name, base_color, base_color_texture, emissive, emissive_texture, alpha, alpha_cutoff, "
                "double_sided, unlit, "
                "shadowed_color, lit_texture, shadowed_texture and outline");
    }
  }
}

// Parts of a mesh, with the arrays that they lie in.
struct Parts {
  std::vector<MeshPart> parts;
  std::vector<py::array> arrays;

  template <class Vector>
  std::span<const Vector> keep(Rows<Vector> rows) {
    arrays.push_back(rows.array);
    return rows.span;
  }

  void add(const py::dict& settings) {
    MeshPart part;
    for (const auto& [key, value] : settings) {
      const std::string name = py::str(key);
      const py::object item = py::reinterpret_borrow<py::object>(value);
      if (name == "positions")
        part.positions = keep(toVec3s(item, name));
      else if (name == "indices")
        part.indices = keep(toIndices(item, name));
      else if (name == "normals")
        part.normals = keep(toVec3s(item, name));
      else if (name == "uv")
        part.uv0 = keep(toVec2s(item, name));
      else if (name == "uv1")
        part.uv1 = keep(toVec2s(item, name));
      else if (name == "colors")
        part.colors = keep(toColors(item, name));
      else if (name == "warp_scales")
        part.warpScales = keep(toFloats(item, name));
      else if (name == "roundness")
        part.roundness = keep(toFloats(item, name));
      else if (name == "material")
        part.material = MaterialId(as<int>(item, name));
      else
        refuseKey("a mesh", name,
                  "positions, indices, normals, uv, uv1, colors, warp_scales, roundness and material");
    }
    parts.push_back(part);
  }
};

// One part, given by name, or several as parts=[{...}, ...].
Parts toParts(const py::kwargs& settings) {
  Parts parts;
  if (!settings.contains("parts")) {
    parts.add(settings);
    return parts;
  }
  if (py::len(settings) > 1)
    raiseUsage("parts stands beside other settings of a mesh", "give each part its own");
  for (const py::handle part : py::iterable(settings["parts"]))
    parts.add(as<py::dict>(part, "a part", "a dict of arrays"));
  return parts;
}

TextureDesc toTexture(const py::array_t<uint8_t, py::array::c_style>& pixels, const std::string& name) {
  if (pixels.ndim() != 3 || pixels.shape(2) != 4)
    raiseUsage("a texture's pixels are neither RGB nor RGBA", "give height by width by 3 or 4, uint8");
  return {name, uint32_t(pixels.shape(1)), uint32_t(pixels.shape(0)), {pixels.data(), size_t(pixels.size())}};
}
// RGB is opaque.
py::array_t<uint8_t, py::array::c_style> toRgba(const py::object& given) {
  const py::array pixels = py::array::ensure(given);
  if (!pixels) refuse(given, "a texture", "height by width by 3 or 4, uint8");
  if (pixels.dtype().kind() != 'u' || pixels.itemsize() != 1)
    raiseUsage("a texture has numbers of the kind " + std::string(py::str(pixels.dtype())),
               "give uint8 (sRGB)");
  if (pixels.ndim() != 3 || pixels.shape(2) != 3) return pixels;
  const py::array_t<uint8_t, py::array::c_style | py::array::forcecast> rgb(pixels);
  py::array_t<uint8_t, py::array::c_style> rgba({pixels.shape(0), pixels.shape(1), py::ssize_t(4)});
  uint8_t* out = rgba.mutable_data();
  const uint8_t* in = rgb.data();
  for (py::ssize_t i = 0; i < pixels.shape(0) * pixels.shape(1); ++i, in += 3, out += 4) {
    std::copy_n(in, 3, out);
    out[3] = 255;
  }
  return rgba;
}

// Of a node that there is.
NodeId nodeOf(const SceneEditor& editor, int id) {
  if (id < 0 || size_t(id) >= editor.nodeCount())
    raiseUsage("there is no node " + std::to_string(id), "ids are what add_node or find_node gave");
  return NodeId(id);
}

}  // namespace

void addEditor(py::module_& module) {
  py::class_<SceneEditor>(module, "SceneEditor",
                          "Scenes from arrays, and scenes that change. Ids are whole numbers; those of a "
                          "scene that it began with are\n"
                          "numbers in that. scene() gives the present one, and a renderer that drew the one "
                          "before sends only what differs.")
      .def(py::init<const std::string&>(), "name"_a = "scene")
      .def(py::init<const Scene&>(), "scene"_a)
      .def(
          "add_texture",
          [](SceneEditor& editor, const py::object& pixels, const std::string& name) {
            const auto rgba = toRgba(pixels);
            return int(valueOf(editor.addTexture(toTexture(rgba, name))));
          },
          "pixels"_a, "name"_a = "",
          "pixels: height by width by 3 or 4, uint8 (sRGB, straight alpha). Gives its id.")
      .def(
          "set_texture",
          [](SceneEditor& editor, int id, const py::object& pixels, const std::string& name) {
            const auto rgba = toRgba(pixels);
            done(editor.setTexture(TextureId(id), toTexture(rgba, name)));
          },
          "id"_a, "pixels"_a, "name"_a = "", "Puts another one in its place, as add_texture takes it.")
      .def(
          "add_material",
          [](SceneEditor& editor, const py::kwargs& settings) {
            MaterialDesc material;
            change(material, settings);
            return int(valueOf(editor.addMaterial(material)));
          },
          "Settings by name: name, base_color (linear RGB or RGBA), base_color_texture, emissive, "
          "emissive_texture, alpha\n"
          "('opaque', 'mask', 'blend'), alpha_cutoff, double_sided, unlit, shadowed_color, lit_texture, "
          "shadowed_texture. A texture\n"
          "is an id, or a dict of texture, wrap_u, wrap_v ('repeat', 'mirrored-repeat', 'clamp-to-edge'), "
          "nearest, mipmaps, uv_set\n"
          "and transform (3 by 3); outline is None or a dict of unit ('metres', 'picture-heights'), width, "
          "color "
          "and\n"
          "lighting_mix. Gives its id; 0 is a white one that is always there.")
      .def(
          "set_material",
          [](SceneEditor& editor, int id, const py::kwargs& settings) {
            MaterialDesc material = valueOf(editor.material(MaterialId(id)));
            change(material, settings);
            done(editor.setMaterial(MaterialId(id), material));
          },
          "id"_a, "Changes what is given by name, as add_material takes it.")
      .def(
          "find_material",
          [](const SceneEditor& editor, const std::string& name) -> std::optional<int> {
            const std::optional<MaterialId> id = editor.findMaterial(name);
            return id ? std::optional<int>(int(*id)) : std::nullopt;
          },
          "name"_a, "The first of this name, or None.")
      .def(
          "add_mesh",
          [](SceneEditor& editor, const py::kwargs& settings) {
            return int(valueOf(editor.addMesh(toParts(settings).parts)));
          },
          "Triangles, by name: positions (n by 3, metres), indices (three a triangle, any shape; without "
          "them vertices as they\n"
          "come), normals (n by 3), uv and uv1 (n by 2), colors (n by 3 or 4: uint8, or floats from 0 to 1; "
          "linear),\n"
          "warp_scales (n, factors on Edge Breakup, 0 to 64), roundness (n, 0 to 1), material (an id). Or "
          "parts=[{...}, ...] of\n"
          "several materials. Arrays are copied. Gives its id.")
      .def(
          "set_mesh",
          [](SceneEditor& editor, int id, const py::kwargs& settings) {
            done(editor.setMesh(MeshId(id), toParts(settings).parts));
          },
          "id"_a, "Puts others in its place, as add_mesh takes them.")
      .def(
          "add_node",
          [](SceneEditor& editor, const std::string& name, int parent, const py::object& transform,
             int mesh) {
            return int(valueOf(editor.addNode(
                {name, NodeId(parent), transform.is_none() ? glm::dmat4(1) : toMatrix(transform, "transform"),
                 MeshId(mesh)})));
          },
          py::kw_only(), "name"_a = "", "parent"_a = -1, "transform"_a = py::none(), "mesh"_a = -1,
          "transform: 4 by 4, to its parent's space. Gives its id.")
      .def(
          "find_node",
          [](const SceneEditor& editor, const std::string& name) -> std::optional<int> {
            const NodeId id = editor.findNode(name);
            return id == NodeId::none ? std::nullopt : std::optional<int>(int(id));
          },
          "name"_a, "The first of this name ('boat/Deck': one called Deck below one called boat), or None.")
      .def(
          "name_of", [](const SceneEditor& editor, int node) { return editor.nameOf(nodeOf(editor, node)); },
          "node"_a)
      .def(
          "mesh_of",
          [](const SceneEditor& editor, int node) { return int(editor.meshOf(nodeOf(editor, node))); },
          "node"_a, "-1: none.")
      .def(
          "parent_of",
          [](const SceneEditor& editor, int node) { return int(editor.parentOf(nodeOf(editor, node))); },
          "node"_a, "-1: the world.")
      .def(
          "transform_of",
          [](const SceneEditor& editor, int node) {
            return toArray(editor.transformOf(nodeOf(editor, node)));
          },
          "node"_a, "To its parent's space, at rest: 4 by 4.")
      .def_property_readonly("node_count", &SceneEditor::nodeCount)
      .def(
          "set_transform",
          [](SceneEditor& editor, int node, const py::object& transform) {
            done(editor.setTransform(NodeId(node), toMatrix(transform, "transform")));
          },
          "node"_a, "transform"_a, "4 by 4, to its parent's space.")
      .def(
          "set_name",
          [](SceneEditor& editor, int node, const std::string& name) {
            done(editor.setName(NodeId(node), name));
          },
          "node"_a, "name"_a)
      .def(
          "set_extras",
          [](SceneEditor& editor, int node, const py::dict& extras) {
            const py::object text = py::module_::import("json").attr("dumps")(extras);
            done(editor.setExtras(NodeId(node), text.cast<std::string>()));
          },
          "node"_a, "extras"_a, "What it says to features, as a glTF's node in its extras.")
      .def(
          "set_visible",
          [](SceneEditor& editor, int node, bool visible) { done(editor.setVisible(NodeId(node), visible)); },
          "node"_a, "visible"_a, "Whether its mesh and all below it are drawn.")
      .def(
          "set_node_mesh",
          [](SceneEditor& editor, int node, int mesh) { done(editor.setMesh(NodeId(node), MeshId(mesh))); },
          "node"_a, "mesh"_a)
      .def(
          "set_instances",
          [](SceneEditor& editor, int node, const py::object& transforms) {
            done(editor.setInstances(NodeId(node), toMatrices(transforms, "transforms")));
          },
          "node"_a, "transforms"_a,
          "Its mesh is drawn once for each: n by 4 by 4, from instance to node space.")
      .def(
          "set_light",
          [](SceneEditor& editor, int node, const py::object& kind, const py::object& color, float intensity,
             float range, float innerCone, float outerCone) {
            std::optional<LightDesc> light;
            if (!kind.is_none())
              light = LightDesc{
                  .kind = LightDesc::Kind(wordOf(kind, "a light", {"directional", "point", "spot"})),
                  .color = toVec3(color, "color"),
                  .intensity = intensity,
                  .range = range,
                  .innerCone = innerCone,
                  .outerCone = outerCone};
            done(editor.setLight(NodeId(node), light));
          },
          "node"_a, "kind"_a, py::kw_only(), "color"_a = py::make_tuple(1.0, 1.0, 1.0), "intensity"_a = 1.0f,
          "range"_a = 0.0f, "inner_cone"_a = 0.0f, "outer_cone"_a = 0.785398f,
          "A light that shines along the node's -Z: 'directional', 'point', 'spot', or None to take it away. "
          "intensity: lux or\n"
          "candela; range: metres, 0 without end; cones: radians.")
      .def(
          "scene", [](const SceneEditor& editor) { return valueOf(editor.scene()); }, "What there is now.");
}

}  // namespace scumble_python
