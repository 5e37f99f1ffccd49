// The text of a look's file as JSON, with what only its lines can tell.
#pragma once

#include "look/look_json.h"

namespace scumble::look {

// Fails with unusableFile and the line. Keys that stand twice in one object get a warning each, for JSON lets
// the last one win.
Result<Json> parseText(const std::string& text, const std::string& file, std::vector<std::string>& warnings);

}  // namespace scumble::look
