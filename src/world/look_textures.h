// Pictures that a look names as colours (sRGB, with mip levels), in device memory.
#pragma once

#include <deque>

#include "look/look_data.h"
#include "world/scene_on_gpu.h"

namespace scumble::world {

class LookTextures {
 public:
  explicit LookTextures(gpu::Device& device) : device_(device) {}
  // One of the look's own pictures; uploaded at its first use, stays. It repeats.
  SetTexture get(const look::LookData& look, look::Picture picture);

 private:
  struct Known {
    uint64_t contents;
    gpu::Image image;
  };
  gpu::Device& device_;
  std::deque<Known> known_;
};

}  // namespace scumble::world
