#include "base/srgb.h"

#include <cmath>
#include <limits>

namespace scumble {

double srgbFromLinear(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double linearFromSrgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

const SrgbEncoder& SrgbEncoder::instance() {
  static const SrgbEncoder encoder;
  return encoder;
}

SrgbEncoder::SrgbEncoder() {
  for (int code = 0; code < 255; ++code) {
    const double exact = linearFromSrgb((code + 0.5) / 255);
    float least = float(exact);
    if (double(least) < exact) least = std::nextafter(least, 2.0f);
    threshold_[code] = least;
  }
  threshold_[255] = std::numeric_limits<float>::infinity();
  int code = 0;
  for (uint32_t slot = 0; slot < kSlots; ++slot) {
    const float begin = std::bit_cast<float>((slot + kFirst) << kShift);
    while (begin >= threshold_[code]) ++code;
    start_[slot] = uint8_t(code);
  }
}

uint8_t alphaCode(float alpha) {
  if (!(alpha > 0)) return 0;
  return alpha >= 1 ? 255 : uint8_t(std::lround(alpha * 255.0));
}

const std::array<float, 256>& linearFromSrgb8() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values;
    for (int code = 0; code < 256; ++code) values[code] = float(linearFromSrgb(code / 255.0));
    return values;
  }();
  return table;
}

}  // namespace scumble
