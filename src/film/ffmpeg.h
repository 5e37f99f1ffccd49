// What the programs ffmpeg and ffprobe say.
#pragma once

#include <string>

namespace scumble::film {

// The last line that says something, without the address of who says it ("[libx264 @ 0x55d0c8a4] ").
std::string lastLine(const std::string& said);

}  // namespace scumble::film
