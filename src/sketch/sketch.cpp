#include "sketch/sketch.h"

#include <string_view>

namespace scumble::sketch {

namespace {

constexpr std::string_view kApainterBegins =
    "\x08"
    "apainter";

bool begins(Bytes bytes, std::string_view with) {
  return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()).starts_with(with);
}

// A-Painter's JSON has strokes and brushes, and what a glTF must have it does not. Words are looked for as
// text: it is parsed once, later. Those of a glTF come first, which most have near their beginning, so that a
// large one is not read for this.
bool isApainterJson(Bytes bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const size_t first = text.find_first_not_of(" \t\r\n");
  return first != text.npos && text[first] == '{' && text.find("\"asset\"") == text.npos &&
         text.find("\"scenes\"") == text.npos && text.find("\"strokes\"") != text.npos &&
         text.find("\"brushes\"") != text.npos;
}

}  // namespace

bool isSketch(Bytes bytes) {
  return isTiltFile(bytes) || begins(bytes, kApainterBegins) || isApainterJson(bytes);
}

scene::Painting readSketch(Bytes bytes, scene::ImportWarnings& warnings) {
  if (isTiltFile(bytes)) return readTiltFile(bytes, warnings);
  if (begins(bytes, kApainterBegins)) return readApainter(bytes, warnings);
  return readApainterJson(bytes, warnings);
}

}  // namespace scumble::sketch
