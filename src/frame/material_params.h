// What a pass reads of every material: uniforms with one struct each, at a dynamic offset that follows the
// material being drawn.
#pragma once

#include "frame/pass.h"

namespace scumble::frame {

template <class Block>
class MaterialBlocks {
 public:
  static constexpr uint32_t kStride = uint32_t(gpu::uniformStride(sizeof(Block)));

  // `hasRows`: also as rows without gaps, for shaders that look materials up.
  void create(FrameBuilder& frame, bool hasRows = false) {
    slice_ = frame.uniform(frame.scene().materialCount() * kStride);
    if (hasRows) rows_ = frame.uniform(frame.scene().materialCount() * sizeof(Block));
  }
  void bind(gpu::DescriptorSets& sets, uint32_t binding, size_t set = 0) const {
    sets.writeBuffer(set, binding, slice_.buffer, slice_.offset, sizeof(Block));
  }
  void bindRows(gpu::DescriptorSets& sets, uint32_t binding, size_t set = 0) const {
    sets.writeBuffer(set, binding, rows_.buffer, rows_.offset, rows_.size);
  }
  void write(size_t material, const Block& block) const {
    std::memcpy(slice_.mapped + material * kStride, &block, sizeof(Block));
    if (rows_.mapped) std::memcpy(rows_.mapped + material * sizeof(Block), &block, sizeof(Block));
  }

 private:
  UniformSlice slice_, rows_;
};

}  // namespace scumble::frame
