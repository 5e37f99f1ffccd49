// Colours as people write them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace scumble {

// 0xRRGGBB, from "#RRGGBB", "#RGB" (each digit twice) or one of CSS's names (CSS Color Module Level 4, in
// small letters); nothing for other texts.
std::optional<uint32_t> parseColor(const std::string& text);

// CSS's names, in the order of the alphabet.
const std::vector<std::string>& colorNames();

}  // namespace scumble
