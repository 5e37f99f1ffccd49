// The paper under a watercolour, as its shaders know it.
#pragma once

#include "features/watercolor/watercolor.shared.h"
#include "frame/pass.h"

namespace scumble::watercolor {

// Where the paper lies, its relief, its light and the painting's margin; the rest is 0.
shared::WashUniforms paperUniforms(const frame::FrameInput& input, const frame::Configuration& configuration);

// The mip level that has about a texel a pixel, since all of the picture has the same. `size`: of a copy,
// pixels.
gpu::SamplerDesc paperSampler(const frame::ExampleTexture& texture, float size);
// What is coarser.
inline constexpr gpu::SamplerDesc kBroadSampler{
    VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_REPEAT, true, false, 2};

}  // namespace scumble::watercolor
