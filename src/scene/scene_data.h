// The scene as plain data: what the importer makes and what everything behind it reads.
// Conventions are glTF's: right-handed, +Y up, metres, radians, column vectors; colours are linear
// unless a name says sRGB. Every index in here has been checked; every number is finite.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/pixels.h"
#include "base/shared.h"

namespace scumble::scene {

// One texture.
struct TextureImage : Pixels {
  std::string name;
  bool standIn = false;  // true where the file could not be used and a visible pattern stands in
};

enum class Wrap : uint8_t { repeat, mirroredRepeat, clampToEdge };

struct Sampler {
  Wrap wrapU = Wrap::repeat, wrapV = Wrap::repeat;
  bool nearest = false;  // magnification and minification without interpolation
  bool mipmaps = true;
};

// A texture as a material uses it.
struct TextureUse {
  int image = -1;  // index into SceneData::images; -1: none
  Sampler sampler;
  int uvSet = 0;  // 0 or 1
  // KHR_texture_transform: uv' = transform * (u, v, 1).
  glm::mat3 transform{1.0f};
};

enum class AlphaMode : uint8_t { opaque, mask, blend };

// A material's own outline, as MToon has it (VRM 0 and 1).
struct Outline {
  // In metres of the world, or in parts of the picture's height.
  enum class Unit : uint8_t { metres, pictureHeights } unit = Unit::metres;
  float width = 0.0f;        // 0: none is drawn
  glm::vec3 color{0.0f};     // linear
  float lightingMix = 1.0f;  // 0: the colour as it is; 1: times the surface's
};

// Paint that lies over other surfaces (docs/fins.md): it is seen and casts shadows, and is nothing else. It
// has no edges, and is in no facts.
struct PaintLayer {
  bool fades = false;  // a fin, which fades as it turns away from the viewer
  // As BakePart has them.
  float fadeStart = 0.5f, fadeEnd = 0.2f;
};

struct Material {
  std::string name;
  glm::vec4 baseColor{1.0f};  // linear; a factor on the texture
  TextureUse baseColorTexture;
  glm::vec3 emissive{0.0f};  // linear; a factor on the texture
  TextureUse emissiveTexture;
  float metallic = 0.0f, roughness = 1.0f;
  AlphaMode alphaMode = AlphaMode::opaque;
  float alphaCutoff = 0.5f;
  bool doubleSided = false;
  bool unlit = false;
  // The material's own colour in shadow, linear, from extras: {"scumble_shadowed": "#8E93AC"} or an array of
  // three sRGB numbers in [0, 1]. Where absent, the look derives one.
  std::optional<glm::vec3> shadowedColor;
  // Whole sets of colours for light and for shadow, from extras as well (docs/scene.md). They lie on the
  // coordinates of baseColorTexture, and no factor acts on them.
  TextureUse litTexture, shadowedTexture;
  std::optional<Outline> outline;
  // From extras: {"scumble_paint": {"fadeStart": 0.5, "fadeEnd": 0.2}}; without numbers it does not fade.
  std::optional<PaintLayer> paint;
  bool isFin() const { return paint && paint->fades; }
};

constexpr int kMaxMorphTargets = 64;

// Displacements at weight 1; each list is empty or has one a vertex. Between weights they are linear, also
// those of normals and tangents, which is an approximation.
struct MorphTarget {
  std::vector<glm::vec3> positions, normals, smoothNormals, dPdu, dPdv;
};

struct Bounds {
  glm::vec3 min{0.0f}, max{0.0f};
  bool empty = true;
  void add(const glm::vec3& p);
  void add(const Bounds& other);
  glm::vec3 center() const { return 0.5f * (min + max); }
  // One of eight; a bit of `i` an axis.
  glm::vec3 corner(int i) const {
    return {i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z};
  }
  float radius() const { return empty ? 1.0f : 0.5f * glm::length(max - min); }
  // Wide and low, as what one stands on is.
  bool isLow() const { return max.y - min.y <= 0.12f * glm::max(max.x - min.x, max.z - min.z); }
};

// What the box of a primitive in any pose is found from, without its vertices.
struct PrimitiveExtent {
  Bounds box;  // all vertices, at rest, in mesh space
  struct Joint {
    uint16_t joint;
    Bounds box;  // those that it moves
  };
  std::vector<Joint> joints;    // of skinned primitives
  std::vector<Bounds> targets;  // by morph target: displacements
  // Its outermost vertices, in mesh space, where nothing bends it: nearer to what an eye sees than the box
  // is. In place: what lies between large arrays for good keeps their memory from being given back.
  std::array<glm::vec3, 48> outermost{};
  size_t outermostCount = 0;
  float longestEdge2 = 0;  // the square of its length, metres
};

constexpr size_t kMaxLevels = 6;  // of detail, beside the whole

// Fewer triangles of a primitive's vertices.
struct DetailLevel {
  uint32_t firstIndex = 0, indexCount = 0;  // in levelIndices
  // How far what is drawn has moved from where the whole has it, how far textures have (by the file's own
  // coordinates), and how far what casts shadows has: metres, in mesh space.
  float error = 0, textureError = 0, shadowError = 0;
  float longestEdge = 0;  // metres
};

// Triangles with one material. All non-empty vertex arrays have vertexCount() entries. What is mutable may go
// from one that is shared, and else does not change, once it is on a device (drop_vertices.h,
// SceneOptions::keepsVertices).
struct Primitive {
  mutable std::vector<glm::vec3> positions;
  mutable std::vector<glm::vec3>
      normals;  // unit length; always there (made from the faces when the file has none)
  // Normal shared by all vertices at the same position: where edge inflation moves the vertex, so that the
  // seams of split vertices do not open. Unit length.
  mutable std::vector<glm::vec3> smoothNormals;
  mutable std::vector<glm::vec2> uv0;  // always there: unfold() makes them when the file has none
  mutable std::vector<glm::vec2> uv1;  // may be empty
  // Coordinates for patterns that need the surface's own extent (MetaTexture), from unfold(). Empty: uv0
  // serves. There where uv0 maps a tenth of the surface or more to points and lines, as atlases of plain
  // colours do, and where it is cut or uneven much more than these are (PatternCoordinates).
  mutable std::vector<glm::vec2> patternUv;
  // Whether patternCoordinates() close on themselves after one unit of u or v, as around a cylinder.
  bool wrapsU = false, wrapsV = false;
  std::vector<glm::u8vec4> colors;  // linear, may be empty
  // Factors on the amount of Edge Breakup (the attribute _WARP), 0 to 64; may be empty.
  std::vector<float> warpScales;
  // How much the surface is part of a round form, for the weights of its lines (the attribute _ROUND), 0 to
  // 1; may be empty.
  std::vector<float> roundness;
  // Factors on the width of the material's own outline, 0 to 1; may be empty.
  std::vector<float> outlineWidths;
  // Tangent vectors dP/du and dP/dv of patternUv (else uv0) in object space (metres per unit of u and v),
  // area-weighted over the triangles at a vertex. Paper 000 eq. 9 and 10 need |grad_w u| = 1/|dP/du|; carried
  // as vectors they follow any deformation by its stretch. Zero where the mapping is degenerate.
  mutable std::vector<glm::vec3> dPdu, dPdv;
  mutable std::vector<uint32_t> indices;  // three a triangle, each < vertexCount()
  int material = 0;                       // index into SceneData::materials (index 0 exists always)
  bool isPaint = false;                   // that is a PaintLayer
  // Whether its triangles close around what is within, as they are wound: from outside nobody sees a back.
  bool isClosed = false;
  // From the finest to the coarsest (makeLevels); none for what was made to be changed.
  std::vector<DetailLevel> levels;
  mutable std::vector<uint32_t> levelIndices;
  // Skinning: `influences` joints and weights a vertex (0, 4 or 8), vertex-major. Weights sum to one.
  int influences = 0;
  std::vector<uint16_t> joints;
  std::vector<float> weights;
  std::vector<MorphTarget> morphTargets;
  // Vertices that unfold() has added, the last ones: which of the others each of them is.
  mutable std::vector<uint32_t> addedFrom;
  bool generatedUvs = false, generatedNormals = false, ownPattern = false;
  PrimitiveExtent extent;  // extentOf() it

  // What it had, where its vertices have been dropped (drop_vertices.h); else 0.
  mutable size_t droppedVertices = 0, droppedIndices = 0;

  size_t vertexCount() const { return std::max(positions.size(), droppedVertices); }
  size_t indexCount() const { return std::max(indices.size(), droppedIndices); }
  const std::vector<glm::vec2>& patternCoordinates() const { return patternUv.empty() ? uv0 : patternUv; }
};

struct Painting;

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
  std::vector<float> morphWeights;  // defaults
  // Strokes on it and around it (painting.h); null: none.
  std::shared_ptr<const Painting> painting = nullptr;
};

// Double precision: nodes may stand on a planet's surface, and their parents in its middle.
struct Transform {
  glm::dvec3 translation{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
  glm::dvec3 scale{1.0};
  glm::dmat4 matrix() const;
};

struct Node {
  std::string name;
  int parent = -1;  // always smaller than the node's own index: nodes are sorted, parents first
  Transform local;
  // A matrix that is no composition of translation, rotation and scale (it shears); wins over `local`.
  std::optional<glm::dmat4> localMatrix;
  glm::dmat4 restTransform() const { return localMatrix ? *localMatrix : local.matrix(); }
  int mesh = -1, camera = -1, light = -1, skin = -1;
  std::vector<glm::mat4> instances;  // EXT_mesh_gpu_instancing; empty: drawn once
  std::vector<float> morphWeights;   // of this node; empty: the mesh's defaults
  // What it says to features (scene/extras.h), by name, as the file has it; and what metres there are to be
  // multiplied by, since the scene has been placed in another size.
  std::map<std::string, std::shared_ptr<const nlohmann::json>> extras;
  float extrasScale = 1;
  // At rest: whether it and all nodes below it are seen, and their lights shine (KHR_node_visibility).
  bool visible = true;
};

struct Camera {
  std::string name;
  bool perspective = true;
  float verticalFov = 0.8f;        // radians, perspective
  float aspect = 0.0f;             // 0: that of the image
  float halfHeight = 1.0f;         // metres, orthographic
  float near = 0.01f, far = 0.0f;  // metres; far 0: infinite
};

enum class LightKind : uint8_t { directional, point, spot };

// How many nodes with point and spot lights are used; the first ones.
constexpr size_t kMaxPunctualLights = 256;

// KHR_lights_punctual; shines along the node's -Z.
struct Light {
  std::string name;
  LightKind kind = LightKind::directional;
  glm::vec3 color{1.0f};
  float intensity = 1.0f;                      // lux or candela
  float range = 0.0f;                          // metres; 0: infinite
  float innerCone = 0.0f, outerCone = 0.785f;  // radians
};

struct Skin {
  std::string name;
  std::vector<int> joints;                     // node indices
  std::vector<glm::mat4> inverseBindMatrices;  // one a joint
};

enum class ChannelInterpolation : uint8_t { linear, step, cubicSpline };
// `visible` has one number a key, which is above a half where the node is visible.
enum class AnimatedProperty : uint8_t { translation, rotation, scale, weights, visible };

struct Channel {
  int node = -1;
  AnimatedProperty property = AnimatedProperty::translation;
  ChannelInterpolation interpolation = ChannelInterpolation::linear;
  std::vector<float> times;  // seconds, strictly increasing
  std::vector<float>
      values;  // componentsPerKey floats a key (three times as many for cubicSpline: in, value, out)
  int componentsPerKey = 3;
  int weight = -1;  // of `weights`: the one that it animates; -1: all
};

struct Clip {
  std::string name;       // never empty
  float duration = 0.0f;  // seconds
  int file = 0;           // which of the files that were combined it comes from
  std::vector<Channel> channels;
};

// What of a primitive its material lets be seen (scene/seen.h).
struct SeenPart {
  bool isSeen = true;  // any of it
  // Where some of its triangles are not seen: the extent of the others, and the vertices of those. Else null
  // and empty.
  std::shared_ptr<const PrimitiveExtent> extent;
  std::vector<uint32_t> vertices;
};

struct SceneData {
  std::string name;  // the file's name without folder and extension
  std::string path;  // of the file; empty: in memory, or several
  // Scenes of one family are one that changes (SceneEditor): nodes, meshes and materials of one are those of
  // the others too, as far as both have them. 0: nobody's.
  uint64_t family = 0;
  bool keepsVertices = true;  // SceneOptions::keepsVertices
  bool facesBack = false;     // its front is towards -Z (VRM 0), and not +Z
  std::vector<Shared<TextureImage>> images;
  std::vector<Material> materials;  // index 0 is glTF's default material
  std::vector<Shared<Mesh>> meshes;
  std::vector<std::vector<SeenPart>> seen;  // by mesh and primitive; findSeen() fills it
  std::vector<Node> nodes;                  // those reachable from the chosen scene, parents first
  std::vector<Camera> cameras;
  std::vector<Light> lights;
  std::vector<Skin> skins;
  std::vector<Clip> clips;
  std::vector<std::string> extensionsUsed, extensionsNotSupported;
  std::vector<std::string> files;     // that its URIs name
  std::vector<std::string> warnings;  // what was ignored or replaced, each once, one line each
  // Origin of the scene's coordinates in the world, metres (Scene::origin()): "world" in all modules behind
  // this one is relative to it. Transforms of nodes are not. Set by findOrigin().
  glm::dvec3 origin{0.0};
  // World space, of what is seen in the rest pose; where that is nothing, while clips play.
  Bounds bounds;
};

// Matrix from the world to the scene's coordinates: the parent of nodes without a parent.
glm::dmat4 worldToOrigin(const SceneData& scene);

// World matrix of every node in the rest pose.
std::vector<glm::dmat4> worldMatrices(const SceneData& scene);

// Morph weights in the rest pose of a node that has a mesh.
const std::vector<float>& restMorphWeights(const SceneData& scene, const Node& node);

}  // namespace scumble::scene
