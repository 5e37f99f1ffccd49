// Example textures: what MetaTexture repeats. Some are built in, others are pictures that a look names.
#pragma once

#include <deque>

#include "base/example_pictures.h"
#include "gpu/pipeline.h"
#include "gpu/resources.h"
#include "look/look_data.h"
#include "world/histogram.h"

namespace scumble::world {

struct ExampleTexture {
  // Values as the file has them (no sRGB decoding), with mip levels.
  gpu::Image image;
  Statistics statistics;
  uint32_t width = 1, height = 1;
  bool isClear = false;  // it has transparency anywhere
  // The Gaussian twin and its inverse, where they were asked for; else they are empty.
  gpu::Image gaussian, inverse;
  Statistics gaussianStatistics;
};

class ExampleTextures {
 public:
  explicit ExampleTextures(gpu::Device& device) : device_(device) {}
  // Uploaded at its first use; stays.
  const ExampleTexture& get(const look::LookData& look, look::Picture picture) { return find(look, picture); }
  const ExampleTexture& getWithTwin(const look::LookData& look, look::Picture picture);

  // How they are sampled: repeating, between mip levels.
  static constexpr gpu::SamplerDesc kSampler{VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT,
                                             VK_SAMPLER_ADDRESS_MODE_REPEAT, true};
  static constexpr gpu::SamplerDesc kInverseSampler{VK_FILTER_LINEAR};

 private:
  struct Known {
    int builtIn;        // or -1
    uint64_t contents;  // of the file
    ExampleTexture texture;
  };
  ExampleTexture& find(const look::LookData& look, look::Picture picture);

  gpu::Device& device_;
  std::deque<Known> known_;  // they are referred to, and stay where they are
};

}  // namespace scumble::world
