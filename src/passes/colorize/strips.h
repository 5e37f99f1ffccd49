// Which columns and rows of the picture may see which colorizers.
#pragma once

#include <cstdint>
#include <vector>

#include "frame/pass.h"
#include "passes/colorize/colorizers.h"

namespace scumble::passes {

// The picture's columns have a width, and its rows a height, of 2 to this power, in pixels.
uint32_t stripBits(uint32_t width, uint32_t height);

// Sets the bits of one view's columns and rows. A colorizer that has no bit in a pixel's column, or in its
// row, does nothing along that pixel's ray.
void markStrips(const std::vector<PlacedColorizer>& colorizers, const glm::dmat4& worldToClip, uint32_t width,
                uint32_t height, uint32_t view, shared::ColorizeUniforms& uniforms);

// Fills all that the shader reads of colorizers and views; returns what it has to be specialised to, bits of
// colorize.shared.h.
uint32_t fillUniforms(const std::vector<PlacedColorizer>& colorizers, const shared::FrameUniforms& frame,
                      uint32_t viewCount, uint32_t width, uint32_t height,
                      shared::ColorizeUniforms& uniforms);
// The same for the look's colorizers, where they are in the frame; and the air.
uint32_t fillUniforms(const frame::FrameInput& input, uint32_t viewCount, shared::ColorizeUniforms& uniforms);

}  // namespace scumble::passes
