#include "scumble/result.h"

namespace scumble {

std::string Error::message() const {
  std::string text = file;
  if (line > 0) text += ":" + std::to_string(line);
  if (!jsonPath.empty()) text += (text.empty() ? "(" : " (") + jsonPath + ")";
  if (!text.empty()) text += ": ";
  text += problem;
  if (!advice.empty()) text += "; " + advice;
  // A file name or a quoted token may carry control characters: an error stays one line of text.
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
}

}  // namespace scumble
