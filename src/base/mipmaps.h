// Mip levels of colour textures, made on the CPU: no driver's blit filters sRGB and alpha as they should be,
// and on CPU drivers the first blit of each kind costs more than all of this.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace scumble {

// All levels below the largest one, down to 1 x 1: each pixel is the mean of (up to) 2 x 2 of the level
// above, in linear light and weighted by alpha. `rgba`: 4 bytes a pixel, sRGB colour, straight alpha.
std::vector<std::vector<uint8_t>> makeMipmaps(std::span<const uint8_t> rgba, uint32_t width, uint32_t height);

// The same of bytes that are values and not light: plain means, alpha like the others.
std::vector<std::vector<uint8_t>> makeValueMipmaps(std::span<const uint8_t> rgba, uint32_t width,
                                                   uint32_t height);

}  // namespace scumble
