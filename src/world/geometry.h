// From scene nodes to what is drawn: one item for each primitive and instance, with a ground if there is to
// be one.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "scene/posed_bounds.h"
#include "shading/frame.shared.h"
#include "stage/node_settings.h"
#include "world/feature.h"

namespace scumble::world {

using namespace stage;

// What of the look goes into a scene's geometry.
struct GeometryOptions {
  bool ground = false;
  bool groundStrokes = false;  // on it
  float shadowWarp = 0;        // strength of the shadow map's sigmoid, which long triangles cannot follow
  std::vector<bool> casts;     // by material: whether it casts shadows
  float indirectReach = 0;     // scene radii: how far surfaces give each other light; 0: they do not
  std::vector<int> clips;      // those that play at any time: they tell what space the scene takes up
  NodeSettings nodes;
  std::vector<PlannedFeature> features;  // all that there are
  bool operator==(const GeometryOptions&) const = default;
};

struct GeometryItem {
  const scene::Primitive* primitive;
  size_t node = 0;            // kNoNode for the ground
  size_t instanceOfNode = 0;  // which one
  glm::mat4 instance{1.0f};   // to the node's space
  glm::mat4 model{1.0f};      // to the world, at rest; ignored where `skin` is set
  int skin = -1;
  uint32_t material = 0;
  uint32_t id = 0;    // whole number from 1, one a node
  bool casts = true;  // shadows
  bool shown = true;
  int feature = -1;                 // index of the one that it belongs to
  uint32_t kind = 0, detail = 0;    // what they are is the feature's own
  bool isWrittenByFeature = false;  // its final vertices; else `deform` writes them
  glm::vec2 patternShift{0.0f};     // added to pattern coordinates
  bool dropsVertices = false;       // of the primitive, as soon as they are on the device
  const scene::PrimitiveExtent* extent = nullptr;
  scene::Bounds reach;  // in the world: where clips take it, as far as is known before
  static constexpr size_t kNoNode = ~size_t(0);
};

// Primitives that a scene does not have: subdivided ones, the ground, those of features. What is asked for
// again is the same object, so that nobody takes it for a new one.
class MadePrimitives {
 public:
  // What is made for a kind, whose name begins with that of the feature, and a key, numbers that say all
  // about it.
  const scene::Primitive& get(const std::string& kind, const std::vector<double>& key,
                              const std::function<scene::Primitive()>& make);
  // What a primitive of the scene becomes.
  const scene::Primitive& splitOf(const scene::Primitive& source, scene::Primitive&& result);
  // Forgets what was not asked for since the last time.
  void sweep();

 private:
  struct Entry {
    std::unique_ptr<scene::Primitive> primitive;
    bool isUsed = false;
  };
  std::map<std::pair<std::string, std::vector<double>>, Entry> made_;
  std::map<const scene::Primitive*, Entry> split_;
  std::vector<std::unique_ptr<scene::Primitive>> replaced_;  // until the next sweep
};

struct Geometry {
  // Also what is not shown, so that showing it changes nothing else.
  std::vector<GeometryItem> items;
  scene::Bounds bounds;         // of all that clips do, without the ground
  float longestCasterEdge = 0;  // metres; longer ones have been split
};

// `groundMaterials`: by tone, those that there are. `featureMaterials`: -1 where there is none.
Geometry collectGeometry(const scene::SceneData& scene, const GeometryOptions& options,
                         const std::vector<int>& groundMaterials, const std::vector<int>& featureMaterials,
                         MadePrimitives& made);

// How much longer a matrix makes what lies along an axis, at most.
float largestScale(const glm::mat3& m);

// Longest edge, as a part of the shadow map's half width, that a sigmoid of this strength bends by less than
// a texel: an edge of length L strays from its curve by L^2 f'' / 8.
float longestEdge(float shadowWarp);

}  // namespace scumble::world
