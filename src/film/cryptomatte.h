// Cryptomatte (specification 1.2.0): mattes of named objects, found again by a hash of the name.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scumble/image.h"

namespace scumble::film {

// MurmurHash3_x86_32 (Appleby), which the specification calls MurmurHash3_32.
uint32_t murmurHash3(std::string_view bytes, uint32_t seed = 0);

// "uint32_to_float32": the bits of the number that stands for a name in pixels. The exponent is clamped to
// 1 ... 254, as zeros, denormals, infinities and NaN do not survive every program.
uint32_t cryptomatteBits(std::string_view name);

// A JSON object: from names to the numbers' bits as 8 hexadecimal digits.
std::string cryptomatteManifest(const std::vector<std::string>& objects);

// Header attributes that describe the layers `name`00, `name`01 ..., as pairs of name and text.
std::vector<std::pair<std::string, std::string>> cryptomatteAttributes(
    const std::string& name, const std::vector<std::string>& objects);

// Empty when `image` has pairs of channels whose first one counts `objects`; otherwise what is wrong.
std::string problemWithCryptomatte(const Image& image, const std::vector<std::string>& objects);

// Those layers, without their names: R, G, B, A = number and coverage of two ranks each.
std::vector<Image> cryptomatteLayers(const Image& image, const std::vector<std::string>& objects);

}  // namespace scumble::film
