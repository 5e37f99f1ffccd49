// All draws of a scene, in device memory. They lie in buckets: what is drawn with the same state, one bucket
// after the other, so that one indirect call draws a bucket, however many objects there are. Which of its
// draws are seen, and in which order they come, is the device's to find out, in every frame (passes/cull).
#pragma once

#include <compare>
#include <functional>
#include <vector>

#include "gpu/frames_in_flight.h"
#include "scene/scene_data.h"
#include "shading/draws.shared.h"

namespace scumble::world {

// Cut: opaque, with holes where volumes cut it (FeatureMoment::cutouts).
enum class AlphaMode : uint8_t { opaque, mask, blend, cut };

// What draws of a bucket have in common, in the order in which buckets lie.
struct DrawState {
  AlphaMode alpha = AlphaMode::opaque;
  uint32_t material = 0;
  bool cullsBack = true;  // single-sided
  bool mirrored = false;  // matrices turn triangles inside out, in the frame's pose
  bool varied = false;    // vertex colours or textures vary the material's colour
  bool textured = false;
  bool casts = true;  // shadows
  // Opaque, and its triangles close around what is within. The sides that face the light cast all of its
  // shadow, and from outside nobody sees a back.
  bool isClosed = false;
  bool castsAlone = false;  // shadows, and is drawn by nobody else here: paint
  auto operator<=>(const DrawState&) const = default;
};

struct Draw {
  DrawState state;  // but for `mirrored`, which poses decide
  uint32_t firstIndex = 0, indexCount = 0;
  int32_t vertexOffset = 0;
  uint32_t object = 0;
  uint32_t firstLevel = 0, levels = 0;  // of those that the list is given
  uint32_t textures = 0;                // shared::kTexturesColor ...
};

struct DrawBucket {
  DrawState state;
  uint32_t first = 0, count = 0;  // commands
};

class DrawList {
 public:
  // All draws that there are; place() comes after it, and finds out which are mirrored. Where there is more
  // room for them than before, the buffers have other names, which is told by true, and `settle` is called
  // before the old ones go.
  bool update(gpu::Device& device, std::vector<Draw> draws, const std::vector<shared::DrawLevel>& levels,
              size_t objects, const std::function<void()>& settle);
  // Where objects are, whether they are mirrored, and how much larger than their meshes; all by object.
  void place(const std::vector<scene::Bounds>& bounds, const std::vector<uint8_t>& mirrored,
             const std::vector<float>& scales);

  const std::vector<Draw>& draws() const { return draws_; }
  const std::vector<DrawBucket>& buckets() const { return buckets_; }
  // Counts up whenever states of buckets are others.
  uint32_t statesVersion() const { return statesVersion_; }
  uint32_t count() const { return uint32_t(draws_.size()); }
  // How many fit into the buffers.
  uint32_t room() const { return room_; }

  // shared::DrawCommand, all with one instance and all triangles, and shared::DrawPlace; both by bucket.
  VkBuffer commands() const { return commands_.handle(); }
  VkBuffer places() const { return places_.handle(); }
  VkBuffer levels() const { return levels_.handle(); }  // shared::DrawLevel
  // shared::DrawCommand that the device writes, of the level of detail that a frame takes. Seen: within each
  // bucket those that are seen, then such as draw nothing. Torn: the same, for the surface that tears edges.
  // Casters: all, as commands() has them. May be copied from.
  VkBuffer seen() const { return seen_.handle(); }
  VkBuffer torn() const { return torn_.handle(); }
  VkBuffer casters() const { return casters_.handle(); }
  VkBuffer drawn() const { return drawn_.handle(); }  // shared::DrawnObject for each object, of seen()
  uint64_t bytes() const {
    return commands_.size() + places_.size() + levels_.size() + seen_.size() + torn_.size() +
           casters_.size() + drawn_.size();
  }
  void addUploads(std::vector<gpu::PerFrameBuffer*>& uploads);

 private:
  void sortIntoBuckets();

  std::vector<Draw> draws_;
  std::vector<DrawBucket> buckets_;
  std::vector<uint32_t> commandOf_;  // by draw
  std::vector<uint8_t> mirrored_;    // by draw
  uint32_t statesVersion_ = 0, room_ = 0, roomForLevels_ = 0, roomForObjects_ = 0;
  gpu::PerFrameBuffer commands_, places_, levels_;
  gpu::Buffer seen_, torn_, casters_, drawn_;
};

}  // namespace scumble::world
