// A pass's knobs for every material: a storage buffer with one struct of a per-material block each.
#pragma once

#include "frame/pass.h"

namespace scumble::frame {

template <class Params>
class MaterialParams {
 public:
  void declare(FrameBuilder& frame) { slice_ = frame.uniform(frame.scene().materialCount() * sizeof(Params)); }
  void bind(gpu::DescriptorSets& sets, uint32_t binding) const {
    sets.writeBuffer(0, binding, slice_.buffer, slice_.offset, slice_.size);
  }
  void update(const FrameInput& input) const {
    for (size_t m = 0; m < input.scene.materialCount(); ++m) {
      const Params params = input.look.getForMaterial<Params>(input.scene.materialName(m));
      std::memcpy(slice_.mapped + m * sizeof(Params), &params, sizeof(Params));
    }
  }

 private:
  UniformSlice slice_;
};

}  // namespace scumble::frame
