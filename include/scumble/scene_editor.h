// Scenes from arrays, and scenes that change: for programs that have meshes and objects of their own.
//
//   SceneEditor editor;
//   const MeshId mesh = *editor.addMesh({{.positions = positions, .indices = indices}});
//   const NodeId boat = *editor.addNode({.name = "Boat", .mesh = mesh});
//   renderer.render(*editor.scene(), look, 0, views, options);
//   editor.setTransform(boat, matrix);
//   renderer.render(*editor.scene(), look, 0, views, options);
//
// Scenes stay what they are: scene() gives the present one, which shares with those before it what did not
// change. A renderer that has drawn one of an editor's scenes puts only what differs on its device for the
// next: transforms, visibility and numbers of materials go with the frame; a texture or a mesh goes alone,
// where it has as many vertices and indices as before. The ground goes too, where the scene takes up another
// space; and all vertices, where that makes a warped shadow map (light.shadowWarp) split long triangles
// otherwise.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scumble/export.h"
#include "scumble/result.h"
#include "scumble/scene.h"

namespace scumble {

namespace scene {
class EditedScene;
}

// What an editor has; ids of one mean nothing to another. Those of a scene that it began with are numbers in
// that.
enum class TextureId : int { none = -1 };
enum class MaterialId : int { standard = 0 };  // white, opaque, single-sided; always there
enum class MeshId : int { none = -1 };
enum class NodeId : int { none = -1 };

// 4 bytes a pixel, row 0 at the top: colour in sRGB's curve, straight alpha. 1 to 16384 pixels a side.
struct TextureDesc {
  std::string name = {};
  uint32_t width = 0, height = 0;
  std::span<const uint8_t> rgba = {};
};

// A texture as a material uses it.
struct TextureSlot {
  enum class Wrap { repeat, mirroredRepeat, clampToEdge };
  TextureId texture = TextureId::none;
  Wrap wrapU = Wrap::repeat, wrapV = Wrap::repeat;
  bool nearest = false, mipmaps = true;
  int uvSet = 0;              // 0 or 1
  glm::mat3 transform{1.0f};  // uv' = transform * (u, v, 1)
};

// A line around what has the material, as MToon has it, where the look draws such lines.
struct OutlineDesc {
  enum class Unit {
    metres,
    pictureHeights
  } unit = Unit::metres;  // pictureHeights: parts of the picture's height
  float width = 0;        // in that unit, 0 to 1000; 0: none is drawn
  glm::vec3 color{0.0f};  // linear
  float lightingMix = 1;  // 0: the colour as it is; 1: times the surface's
  bool operator==(const OutlineDesc&) const = default;
};

struct MaterialDesc {
  enum class Alpha { opaque, mask, blend };
  std::string name = {};      // by which looks know it
  glm::vec4 baseColor{1.0f};  // linear; a factor on the texture, 0 to 1
  TextureSlot baseColorTexture = {};
  glm::vec3 emissive{0.0f};  // linear; a factor on the texture, from 0 on
  TextureSlot emissiveTexture = {};
  Alpha alpha = Alpha::opaque;
  float alphaCutoff = 0.5f;
  bool doubleSided = false, unlit = false;
  // Its own colour in shadow, linear; and whole sets of colours for light and for shadow, on the coordinates
  // of baseColorTexture (docs/scene.md).
  std::optional<glm::vec3> shadowedColor = {};
  TextureSlot litTexture = {}, shadowedTexture = {};
  std::optional<OutlineDesc> outline = {};
};

// Triangles with one material. Every array but the indices has an entry a vertex, or is empty. All numbers
// are finite, positions within +-1e15.
struct MeshPart {
  std::span<const glm::vec3> positions = {};      // metres
  std::span<const uint32_t> indices = {};         // three a triangle; empty: vertices as they come
  std::span<const glm::vec3> normals = {};        // empty: flat ones are made
  std::span<const glm::vec2> uv0 = {}, uv1 = {};  // uv0 empty: they are made, as large as the mesh
  std::span<const glm::u8vec4> colors = {};       // linear
  std::span<const float> warpScales = {};         // factors on the amount of Edge Breakup, 0 to 64
  std::span<const float> roundness = {};          // of the form, for weights of lines, 0 to 1
  MaterialId material = MaterialId::standard;
};

struct NodeDesc {
  std::string name = {};  // by which looks know it
  NodeId parent = NodeId::none;
  glm::dmat4 transform{1.0};  // to its parent's space; column-major, affine, finite
  MeshId mesh = MeshId::none;
};

// As KHR_lights_punctual has it; shines along the node's -Z.
struct LightDesc {
  enum class Kind { directional, point, spot };
  Kind kind = Kind::point;
  glm::vec3 color{1.0f};                       // linear
  float intensity = 1;                         // lux or candela, from 0 on
  float range = 0;                             // metres; 0: infinite
  float innerCone = 0, outerCone = 0.785398f;  // radians, 0 <= inner < outer <= pi / 2
};

// Everything fails with ErrorKind::usage for ids that there are not and for numbers that make no sense, and
// changes nothing then. Arrays are copied. One thread at a time uses an editor; its scenes are like all
// others.
class SCUMBLE_API SceneEditor {
 public:
  explicit SceneEditor(const std::string& name = "scene");  // nothing is there
  explicit SceneEditor(const Scene& scene);
  ~SceneEditor();
  SceneEditor(SceneEditor&&) noexcept;
  SceneEditor& operator=(SceneEditor&&) noexcept;

  Result<TextureId> addTexture(const TextureDesc& texture);
  Status setTexture(TextureId id, const TextureDesc& texture);

  Result<MaterialId> addMaterial(const MaterialDesc& material);
  Status setMaterial(MaterialId id, const MaterialDesc& material);
  Result<MaterialDesc> material(MaterialId id) const;
  std::optional<MaterialId> findMaterial(const std::string& name) const;  // the first of this name

  // At least one part. A mesh with joints or morph targets, which only files have, cannot be set.
  Result<MeshId> addMesh(const std::vector<MeshPart>& parts);
  Status setMesh(MeshId id, const std::vector<MeshPart>& parts);

  Result<NodeId> addNode(const NodeDesc& node);
  // The first of this name; "boat/Deck": one called Deck below one called boat.
  NodeId findNode(const std::string& name) const;
  std::string nameOf(NodeId id) const;  // empty of none
  MeshId meshOf(NodeId id) const;
  // The node that its mesh goes with: itself; of a mesh with joints the nearest one above all of them, or,
  // where there is none, the first of them.
  NodeId carrierOf(NodeId id) const;
  size_t nodeCount() const;                 // their ids are the numbers below that
  NodeId parentOf(NodeId id) const;         // none of those that stand in the world; less than the id itself
  glm::dmat4 transformOf(NodeId id) const;  // to its parent's space, at rest; the identity of none
  // To its parent's space. Nodes that a clip moves are the clip's, and are refused.
  Status setTransform(NodeId id, const glm::dmat4& transform);
  Status setName(NodeId id, const std::string& name);
  // Whether its mesh is drawn, and those of all nodes below it. What is not takes up no space either.
  Status setVisible(NodeId id, bool visible);
  Status setMesh(NodeId id, MeshId mesh);
  // Its mesh is drawn once for each, from instance to node space; none: once, where the node is.
  Status setInstances(NodeId id, std::span<const glm::mat4> transforms);
  Status setLight(NodeId id, const std::optional<LightDesc>& light);
  // What it says to features, as a glTF's node does in its extras (docs/sea.md): a JSON object, of which
  // names that features know count; empty: nothing. What they cannot read is left out, with one of the
  // scene's warnings.
  Status setExtras(NodeId id, const std::string& json);

  // What there is now; the same object until something changes. Fails with usage where transforms lead out of
  // what numbers can hold, or more than 2^28 triangles are drawn.
  Result<Scene> scene() const;

 private:
  std::unique_ptr<scene::EditedScene> edited_;
};

}  // namespace scumble
