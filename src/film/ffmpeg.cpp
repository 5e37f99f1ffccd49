#include "film/ffmpeg.h"

#include <cstdint>
#include <sstream>

namespace scumble::film {

std::string lastLine(const std::string& said) {
  std::istringstream lines(said);
  std::string last;
  for (std::string line; std::getline(lines, line);) {
    while (!line.empty() && uint8_t(line.back()) <= ' ') line.pop_back();
    const size_t who = line.find("] ");
    if (line.starts_with('[') && who != std::string::npos) line.erase(0, who + 2);
    if (!line.empty() && line != "Conversion failed!") last = line;
  }
  return last;
}

}  // namespace scumble::film
