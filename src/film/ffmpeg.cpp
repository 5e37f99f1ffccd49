#include "film/ffmpeg.h"

#include <algorithm>
#include <cstdint>
#include <sstream>

#include "base/numbers.h"

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

std::string field(std::string_view line, std::string_view key) {
  while (!line.empty()) {
    const size_t end = std::min(line.find('|'), line.size());
    const std::string_view item = line.substr(0, end);
    if (item.size() > key.size() && item.starts_with(key) && item[key.size()] == '=')
      return std::string(item.substr(key.size() + 1));
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  return "";
}

std::optional<double> number(const std::string& text) {
  const std::optional<NumberAtStart> found = numberAtStart(text);
  return found ? std::optional(found->value) : std::nullopt;
}

double fraction(const std::string& text) {
  const size_t slash = text.find('/');
  const double below = slash == std::string::npos ? 1 : number(text.substr(slash + 1)).value_or(0);
  return below > 0 ? number(text).value_or(0) / below : 0;
}

}  // namespace scumble::film
