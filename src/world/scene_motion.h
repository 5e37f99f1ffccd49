// What moves in a scene: where objects and joints are at a frame's time and how far morph targets are in, in
// device memory, and which vertices have to be written anew for that.
#pragma once

#include "gpu/frames_in_flight.h"
#include "look/look_data.h"
#include "scene/posed_bounds.h"
#include "shading/frame.shared.h"
#include "stage/knob_table.h"
#include "world/geometry_on_gpu.h"

namespace scumble::world {

using namespace stage;

// One drawn thing as far as it moves.
struct MovingObject {
  size_t node = 0;  // kNoNode: it stands still, as the ground does
  glm::mat4 instance{1.0f};
  size_t instanceOfNode = 0;  // which one it is
  int skin = -1;              // -1: rigid
  int mesh = -1;
  uint32_t material = 0;
  uint32_t firstChunk = 0, chunkCount = 0;  // of its vertices
  const scene::PrimitiveExtent* extent = nullptr;
  bool morphs = false;
  bool casts = false;  // shadows
  int feature = -1;    // index of the one that it belongs to
  uint32_t kind = 0, detail = 0;
  bool isWrittenByFeature = false;
  static constexpr size_t kNoNode = GeometryItem::kNoNode;
};

class SceneMotion {
 public:
  // `objects` with all that does not move (material, id ...); matrices, joints and weights are filled in
  // here. `moving` and `geometry` stay alive as long as this does.
  SceneMotion(gpu::Device& device, const scene::SceneData& scene, const std::vector<MovingObject>& moving,
              const std::vector<shared::ObjectData>& objects, const GeometryOnGpu& geometry);

  // What it was made for has become another; what does not move because of that is not written anew. False,
  // and nothing is done, where the buffers have other sizes than that takes.
  bool follow(const scene::SceneData& scene, const std::vector<shared::ObjectData>& objects);
  // An object's vertices at rest are others.
  void touch(size_t object) { touched_[object] = 1; }

  // The pose at a time, in seconds; the knobs are those of that time, and so are the features. `scene`: the
  // one that it follows, or as it was at that time, with the same nodes. False where all is as it was.
  // `hides`: what is not seen shrinks to a point; else it is where it would be, for who follows back what has
  // just appeared.
  bool pose(const scene::SceneData& scene, const KnobTable& knobs, double time,
            const FeatureMoments& features, bool hides = true);

  // World bounds of each object in the pose.
  const std::vector<scene::Bounds>& bounds() const { return bounds_; }
  // Whether triangles are turned inside out, by object.
  const std::vector<uint8_t>& mirrored() const { return mirrored_; }
  // Metres for each one of the object's mesh, at most.
  const std::vector<float>& scales() const { return scales_; }
  // Matrix of an object to the world in the pose, and of its joints: those of a skinned one go from where its
  // vertices are at rest to the world.
  const glm::mat4& model(size_t object) const { return objects_.as<shared::ObjectData>()[object].model; }
  const glm::mat4* joints(size_t object) const {
    return joints_.as<glm::mat4>() + objects_.as<shared::ObjectData>()[object].firstJoint;
  }
  // World matrices of nodes at the time itself, and which of them are shown: what holds poses does not hold
  // lights and cameras.
  const std::vector<glm::dmat4>& world() const { return world_; }
  const std::vector<bool>& shown() const { return shown_; }
  // The same as they are drawn where no material says how long poses stand: what hangs on a held node is held
  // with it.
  const std::vector<glm::dmat4>& worldAsDrawn() const { return worldAsDrawn_; }
  const std::vector<bool>& shownAsDrawn() const { return shownAsDrawn_; }

  // What features move a node by, from where it is without them.
  glm::mat4 movedBy(size_t node) const {
    return movedBy_.empty() || !movedBy_[node] ? glm::mat4(1.0f) : *movedBy_[node];
  }

  // Chunks of vertices whose final ones are out of date, in moved(); the next pose starts from these being
  // written. Of a page, and of who writes them: kDeform, or a feature's index.
  static constexpr int kDeform = -1;
  struct Moved {
    uint32_t first = 0, count = 0;
  };
  Moved moved(size_t page, int writer) const { return moved_[page * writers_ + size_t(writer + 1)]; }
  // Counts up whenever what casts shadows has moved; or anything.
  uint32_t castersVersion() const { return castersVersion_; }
  uint32_t version() const { return version_; }
  // Forgets what was written before: everything has moved.
  void touchAll() { written_ = isAtRest_ = false; }

  VkBuffer objects() const { return objects_.handle(); }
  VkBuffer joints() const { return joints_.handle(); }
  VkBuffer morphWeights() const { return morphWeights_.handle(); }
  VkBuffer moved() const { return movedChunks_.handle(); }
  void addUploads(std::vector<gpu::PerFrameBuffer*>& uploads);

 private:
  struct SkinUse {
    int skin;
    uint32_t material, firstJoint;
  };
  // Who uses which part of the buffers; also in `objects`.
  struct Layout {
    std::vector<bool> isJoint;        // by node
    std::vector<SkinUse> skinUses;    // a skin is posed once for each material that is drawn with it
    std::vector<uint32_t> skinUseOf;  // by object
    size_t joints = 0, weights = 0;
  };
  // Who writes an object's vertices.
  static int writerOf(const MovingObject& object) {
    return object.isWrittenByFeature ? object.feature : kDeform;
  }
  Layout layOut(const scene::SceneData& scene, std::vector<shared::ObjectData>& objects) const;

  const std::vector<MovingObject>& moving_;
  Layout layout_;
  const GeometryOnGpu& geometry_;
  uint32_t chunkCount_;
  gpu::PerFrameBuffer objects_, joints_, morphWeights_, movedChunks_;
  std::vector<scene::Bounds> bounds_;
  std::vector<uint8_t> mirrored_;
  std::vector<float> scales_;
  std::vector<uint8_t> touched_;
  std::vector<int> writerOf_;         // by object: who writes its vertices
  std::vector<uint32_t> influences_;  // by object, where it is seen
  std::vector<glm::dmat4> world_, worldAsDrawn_;
  std::vector<bool> shown_, shownAsDrawn_;
  std::vector<std::optional<glm::mat4>> movedBy_;  // by node; empty: features move nothing
  size_t writers_ = 1;
  std::vector<Moved> moved_;  // by page, then by writer
  const scene::SceneData* followed_;
  uint32_t castersVersion_ = 0, version_ = 0;
  bool written_ = false, isAtRest_ = false;
};

}  // namespace scumble::world
