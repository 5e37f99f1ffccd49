// What a pass reads of every material: uniforms with one struct each, at a dynamic offset that follows the
// material being drawn.
#pragma once

#include "frame/pass.h"

namespace scumble::frame {

template <class Block>
class MaterialBlocks {
 public:
  static constexpr uint32_t kStride = uint32_t(gpu::uniformStride(sizeof(Block)));

  void create(FrameBuilder& frame) { slice_ = frame.uniform(frame.scene().materialCount() * kStride); }
  void bind(gpu::DescriptorSets& sets, uint32_t binding, size_t set = 0) const {
    sets.writeBuffer(set, binding, slice_.buffer, slice_.offset, sizeof(Block));
  }
  void write(size_t material, const Block& block) const {
    std::memcpy(slice_.mapped + material * kStride, &block, sizeof(Block));
  }

 private:
  UniformSlice slice_;
};

// The same for a pass that reads its knobs as they are.
template <class Params>
class MaterialParams : public MaterialBlocks<Params> {
 public:
  void update(const FrameInput& input) const {
    for (size_t m = 0; m < input.scene.materialCount(); ++m)
      this->write(m, input.scene.knobs<Params>(input.look, m));
  }
};

}  // namespace scumble::frame
