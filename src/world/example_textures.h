// Example textures: what MetaTexture repeats. Some are built in, others are pictures that a look names.
#pragma once

#include <deque>

#include "gpu/pipeline.h"
#include "gpu/resources.h"
#include "look/look_data.h"
#include "world/histogram.h"

namespace scumble::world {

// The built-in ones, in the order of the rows in .params files: "torn|strokes|paper|sea|foam|nested".
//   torn     red, green: two independent fields, rough down to a few texels, so that edges are torn and
//            not wavy; blue: palette-knife marks
//   strokes  the marks alone, grey, lying along u
//   paper    grain, grey
//   sea      red, green, blue: three patterns of brush strokes as of a sea, lying along u
//   foam     the amount of foam at which a place is covered, grey
constexpr uint32_t kBuiltInSize = 256;  // texels; one texel a pixel at the default size
Pixels builtInExample(int index);

struct ExampleTexture {
  // Values as the file has them (no sRGB decoding), with mip levels.
  gpu::Image image;
  Statistics statistics;
  uint32_t width = 1, height = 1;
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
