// Between linear light and the sRGB transfer curve (IEC 61966-2-1), exactly rounded and by tables.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace scumble {

// The curve itself, in double precision: what the tables are made from and tested against.
double srgbFromLinear(double linear);
double linearFromSrgb(double encoded);

// Linear to 8 bit. Within one octave the float's upper 7 mantissa bits cut slots so narrow that the rounded
// code changes at most once inside a slot. So: the code at the slot's start, plus one if the value is past
// the next threshold.
class SrgbEncoder {
 public:
  static const SrgbEncoder& instance();

  // Negative values and NaN give 0, values above 1 give 255.
  uint8_t operator()(float linear) const {
    if (!(linear >= kLeast)) return 0;
    if (linear >= 1.0f) return 255;
    const uint8_t code = start_[(std::bit_cast<uint32_t>(linear) >> kShift) - kFirst];
    return uint8_t(code + (linear >= threshold_[code]));
  }

 private:
  SrgbEncoder();

  static constexpr float kLeast = 0x1p-13f;  // below the least value that rounds to code 1 (1.5e-4)
  static constexpr uint32_t kShift = 23 - 7;
  static constexpr uint32_t kFirst = std::bit_cast<uint32_t>(kLeast) >> kShift;
  static constexpr uint32_t kSlots = (std::bit_cast<uint32_t>(1.0f) >> kShift) - kFirst;

  std::array<uint8_t, kSlots> start_;
  std::array<float, 256> threshold_;  // [c]: the least float that rounds to a code above c
};

// Of what is no light: in proportion. NaN gives 0.
uint8_t alphaCode(float alpha);

// 8 bit to linear.
const std::array<float, 256>& linearFromSrgb8();

}  // namespace scumble
