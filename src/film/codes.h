// Pictures as 8-bit sRGB codes.
#pragma once

#include <cstdint>
#include <vector>

#include "scumble/image.h"

namespace scumble::film {

// One row of codes, three a pixel, with the last pixel repeated up to `padded` of them. One channel is grey,
// two are red and green; with exactly four the picture is put over black.
void encodeRow(const Image& image, uint32_t y, uint32_t padded, uint8_t* out);

// All rows, red, green and blue.
std::vector<uint8_t> rgbOverBlack(const Image& image);

// Rows `begin` to `end`, without the latter, as red, green, blue and straight alpha, four a pixel. Whether
// all of them are opaque.
bool encodeRgba(const Image& image, uint32_t begin, uint32_t end, uint8_t* out);

}  // namespace scumble::film
