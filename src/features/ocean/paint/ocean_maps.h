// The maps that the ocean is painted with (paper 000, figure 19), in device memory: those that ship, painted
// by features/ocean/waves, and pictures that a look names.
#pragma once

#include <deque>

#include "gpu/resources.h"
#include "look/look_data.h"

namespace scumble::ocean {

class OceanMaps {
 public:
  explicit OceanMaps(gpu::Device& device) : device_(device) {}
  // Uploaded at its first use; stays.
  const gpu::Image& bathic(const look::LookData& look, look::Picture picture) {
    return find(look, picture, false);
  }
  const gpu::Image& sky(const look::LookData& look, look::Picture picture) {
    return find(look, picture, true);
  }

 private:
  struct Known {
    int builtIn;        // row of the knob, or -1
    bool isSky;         // of built-in ones
    uint64_t contents;  // of the file
    gpu::Image image;
  };
  const gpu::Image& find(const look::LookData& look, look::Picture picture, bool isSky);

  gpu::Device& device_;
  std::deque<Known> known_;  // they are referred to, and stay where they are
};

}  // namespace scumble::ocean
