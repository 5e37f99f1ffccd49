// Pictures as film encoders take them.
#pragma once

#include <cstdint>
#include <vector>

#include "scumble/image.h"

namespace scumble::film {

// Y'CbCr 4:2:0 with 8 bits a sample: the planes Y, Cb, Cr, one after another. BT.709 matrix, limited range
// (16 ... 235, 16 ... 240), chroma samples on the left pixel of each pair and between the two rows. The
// values that are converted are the sRGB codes of a PNG; with exactly four channels the picture is put over
// black. Odd sizes grow by one column or row that repeats the last one. Integers only: the same on every
// machine.
std::vector<uint8_t> yuv420(const Image& image);

}  // namespace scumble::film
