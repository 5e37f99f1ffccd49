// The palettes that are built in.
#include <array>

#include "passes/limit/limit_knobs.h"

namespace scumble::passes {

namespace {

// A day at sea in four blues, the warm white of the board, and one accent.
constexpr std::array<uint32_t, 6> kFourBlues{0x12233B, 0x2A557A, 0x6F9FB5, 0xBCD3D2, 0xF4EBD6, 0xC8553A};

// Wine and plum in the shadows, apricot in what light is left.
constexpr std::array<uint32_t, 11> kDusk{0x1E1B33, 0x3B2F55, 0x5E4468, 0x8A5A78, 0xB9788A, 0xE39C7E,
                                         0xF5C89A, 0xFBE8C8, 0x3E5A78, 0x7E8FAE, 0xC25B45};

// Blue-greens close to each other, a pale moon, and a lantern.
constexpr std::array<uint32_t, 10> kGouacheNight{0x0B1526, 0x14283F, 0x1F4155, 0x2F6270, 0x5B8C8E,
                                                 0x9FBFB2, 0xE9DFB4, 0xF2C25C, 0x4A3B4F, 0x7A5A4E};

// Warm earths on cool stone.
constexpr std::array<uint32_t, 10> kOchreAndSlate{0x1F2428, 0x3B454D, 0x66747C, 0x9AA5A6, 0xD0CDBF,
                                                  0xF1E7CF, 0xC9973F, 0xAD7636, 0x7A4E2A, 0x4E3426};

}  // namespace

std::span<const uint32_t> builtInPalette(int palette) {
  const std::span<const uint32_t> all[] = {kFourBlues, kDusk, kGouacheNight, kOchreAndSlate};
  return all[palette - kFirstBuiltIn];
}

}  // namespace scumble::passes
