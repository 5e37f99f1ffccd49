// What a feature adds to a scene beyond what its file holds: objects with a material of their own, vertices
// that it writes itself, nodes that it moves. A feature is a folder under src/features (docs/features.md); it
// plans what it builds for a scene and a look, and what it has built follows from moment to moment.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/frames_in_flight.h"
#include "look/look_data.h"
#include "scene/scene_data.h"
#include "stage/knob_table.h"

namespace scumble::world {

using namespace stage;

struct Geometry;
struct GeometryItem;
struct GeometryPlace;
class FeaturePlan;
class MadePrimitives;
class SceneMotion;

// A feature of one scene, at a moment, on the CPU and on the device.
class FeatureMoment {
 public:
  virtual ~FeatureMoment() = default;
  // The scene, which stays until another one is followed, or the plan has become another. False, and nothing
  // is done, where that takes another moment; never for the plan that it was made for.
  virtual bool follow(const scene::SceneData& scene, const FeaturePlan& plan) = 0;
  // Whatever it makes of the meshes of all that is drawn: what it needs of their vertices, which may be gone
  // afterwards; then, with where they lie on the device, its own buffers. True where those are others;
  // `settle` is called before the old ones go. Primitives that are the same objects as before have not
  // changed.
  virtual void find(const std::vector<GeometryItem>& /*items*/) {}
  virtual bool place(gpu::Uploader& /*uploader*/, const std::vector<GeometryItem>& /*items*/,
                     const std::vector<GeometryPlace>& /*places*/, const std::function<void()>& /*settle*/) {
    return false;
  }
  // A time, in seconds. `look` has its tracks; `now` are its knobs at that time. `present`: of a moment
  // before the frame's own that of the frame, whose vertices are followed back; else null.
  virtual void pose(const look::LookData& look, const KnobTable& now, double time,
                    const FeatureMoment* present) = 0;

  // By node, what it is moved by, from where it is without that; a node that another feature has moved
  // already is left alone. What hangs on a node that is moved goes along with that one, and is not moved by
  // itself. `world`: all nodes' matrices.
  virtual void moveNodes(const scene::SceneData&, std::span<const glm::dmat4> /*world*/,
                         std::vector<std::optional<glm::mat4>>& /*moved*/) const {}

  // Where objects of its own are moved to, by their kind.
  struct Place {
    glm::vec3 offset{0.0f};        // metres
    glm::vec2 patternShift{0.0f};  // added to pattern coordinates
  };
  virtual Place placeOf(uint32_t /*kind*/) const { return {}; }
  // What one takes up, asked for in each pose; `posed`: what it would if only its matrix moved it.
  virtual scene::Bounds boundsOf(uint32_t /*kind*/, uint32_t /*detail*/, const scene::Bounds& posed) const {
    return posed;
  }
  virtual void addUploads(std::vector<gpu::PerFrameBuffer*>&) {}
  // After all objects are where the frame draws them.
  virtual void posed(const SceneMotion& /*motion*/) {}
  // What cuts holes into all that it draws: shared::Cutouts, and the words of their points. None: nothing
  // does. Its place() tells where they are others.
  struct CutoutBuffers {
    VkBuffer cutouts, points;
  };
  virtual std::optional<CutoutBuffers> cutouts() const { return std::nullopt; }
  // Boxes of what casts shadows beside objects, world: what each reaches at any time.
  virtual void addCasters(std::vector<scene::Bounds>& /*boxes*/) const {}
};

// What a feature builds for a scene and a look. Does not change; another scene or look has another plan, and
// where that is equal, nothing is built anew.
class FeaturePlan {
 public:
  virtual ~FeaturePlan() = default;
  // To another one of the same feature.
  virtual bool equals(const FeaturePlan& other) const = 0;

  // The scene's node whose own mesh it stands for, and is drawn instead of; -1: none.
  int replacedNode = -1;
  // Nodes whose meshes say something to it, and are not drawn.
  std::vector<int> hiddenNodes;
  // Without it there may be a ground; with it there is one where the look says so.
  bool replacesGround = false;
  // A pass of its own paints its surfaces, once a pixel (kPrepaintedLit, kPrepaintedShadowed). One feature of
  // a frame may: there is one pair of these.
  bool isPrepainted = false;
  // Metres at which its edges are torn half as much as near by, at most; 0: as the look has it.
  float quietDistance = 0;

  // Of the scene's own meshes, by node and material: the kind of what the feature writes the vertices of
  // instead of `deform`, from where they are before features move nodes; none: `deform` does.
  virtual std::optional<uint32_t> kindOf(size_t /*node*/, size_t /*material*/) const { return std::nullopt; }
  // Adds what is drawn to `geometry`. `item` has all that its items have in common. Not asked of a feature
  // without a material.
  virtual void addItems(const GeometryItem& /*item*/, MadePrimitives& /*made*/,
                        Geometry& /*geometry*/) const {}
  virtual std::unique_ptr<FeatureMoment> makeMoment(gpu::Device& device,
                                                    const scene::SceneData& scene) const = 0;
};

class Feature {
 public:
  virtual ~Feature() = default;
  // As its folder is called.
  virtual const char* name() const = 0;
  // By which looks know the material of what it draws, and AOVs its object; empty where it draws no surfaces.
  virtual std::string_view material() const = 0;
  // Null where the scene has no such thing under a look, which is one at a time.
  virtual std::shared_ptr<const FeaturePlan> plan(const scene::SceneData& scene,
                                                  const look::LookData& look) const = 0;
  // The setting that decides whether it is there, and what to say where it is not.
  struct Switch {
    const look::ParamBlock* block = nullptr;
    const char* row = "";
    const char* absence = "";
  };
  virtual Switch onOff() const = 0;
};

// Of one feature, of all that there are; part of what a scene's geometry follows from.
struct PlannedFeature {
  const Feature* feature = nullptr;
  std::shared_ptr<const FeaturePlan> plan;  // null: it is not there
  bool operator==(const PlannedFeature& other) const {
    return feature == other.feature &&
           (plan == other.plan || (plan && other.plan && plan->equals(*other.plan)));
  }
};

// By feature; null where one is not there.
using FeatureMoments = std::vector<std::unique_ptr<FeatureMoment>>;

}  // namespace scumble::world
