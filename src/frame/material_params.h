// A pass's knobs for every material: uniforms with one struct of a per-material block each, at a dynamic
// offset that follows the material being drawn.
#pragma once

#include "frame/pass.h"

namespace scumble::frame {

template <class Params>
class MaterialParams {
 public:
  // No device wants dynamic offsets at larger steps than this.
  static constexpr uint32_t kStride = (sizeof(Params) + 255) / 256 * 256;

  void declare(FrameBuilder& frame) { slice_ = frame.uniform(frame.scene().materialCount() * kStride); }
  void bind(gpu::DescriptorSets& sets, uint32_t binding) const {
    sets.writeBuffer(0, binding, slice_.buffer, slice_.offset, sizeof(Params));
  }
  void update(const FrameInput& input) const {
    for (size_t m = 0; m < input.scene.materialCount(); ++m) {
      const Params params = input.look.getForMaterial<Params>(input.scene.materialName(m));
      std::memcpy(slice_.mapped + m * kStride, &params, sizeof(Params));
    }
  }

 private:
  UniformSlice slice_;
};

}  // namespace scumble::frame
