// What the programs ffmpeg and ffprobe say.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace scumble::film {

// The last line that says something, without the address of who says it ("[libx264 @ 0x55d0c8a4] ").
std::string lastLine(const std::string& said);

// The value of "key=..." in a line whose fields are parted by '|'; empty where there is none.
std::string field(std::string_view line, std::string_view key);
std::optional<double> number(const std::string& text);
// "24000/1001"; 0 where it is none.
double fraction(const std::string& text);

}  // namespace scumble::film
