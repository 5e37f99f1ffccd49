// The flags of tiles (shading/tiles.shared.h), as what runs on some tiles reads them.
#pragma once

#include "frame/pass.h"
#include "shading/tiles.shared.h"

namespace scumble::frame {

// Where something runs: on tiles whose flags under `mask` are `value`; everywhere, as long as `mask` is 0.
struct TileChoice {
  uint32_t mask = 0, value = 0;
};

class TileFlags {
 public:
  // A use of the step that is being declared, by vertex shaders or by compute.
  void declare(FrameBuilder& frame, gpu::Handle tiles, bool byCompute);
  void create(FrameBuilder& frame);
  void bind(const gpu::GraphResources& resources);

  explicit operator bool() const { return bool(tiles_); }
  // A descriptor set with the flags alone.
  const gpu::SetLayout& layout() const { return layout_; }
  VkDescriptorSet set() const { return set_[0]; }
  // For an output of that size, the frame's over `over`.
  shared::TileRule rule(TileChoice where, uint32_t firstView, glm::uvec2 size, glm::uvec2 over) const;
  // Of a draw with tiles.vert.
  uint32_t vertexCount() const { return 6 * count_.x * count_.y; }

 private:
  gpu::Handle tiles_{};
  bool byCompute_ = false;
  gpu::Samplers* samplers_ = nullptr;
  gpu::SetLayout layout_;
  gpu::DescriptorSets set_;
  glm::uvec2 count_{0};
};

// A depth image in which the tiles that a choice leaves out are as near as can be, so that nothing is drawn
// there.
class TileMask {
 public:
  // A step of its own. Gives the depth image, in which other steps then draw without clearing it.
  gpu::Handle declare(FrameBuilder& frame, const std::string& step, const std::string& image,
                      TileChoice left);
  void create(FrameBuilder& frame);
  void bind(const gpu::GraphResources& resources);
  // Nothing is left out.
  void setWhole(bool isWhole) { isWhole_ = isWhole; }

 private:
  void record(VkCommandBuffer commands) const;

  TileChoice left_;
  bool isWhole_ = false;
  gpu::Views views_;
  gpu::Handle depth_{};
  const gpu::GraphResources* resources_ = nullptr;
  TileFlags flags_;
  gpu::Pipeline pipeline_;
};

}  // namespace scumble::frame
