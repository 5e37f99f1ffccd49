// The text of a look's file as JSON, with what only its lines can tell.
#pragma once

#include "look/look_json.h"

namespace scumble::look {

// Fails with unusableFile and the line. Keys that stand twice in one object get a warning each, for JSON lets
// the last one win.
Result<Json> parseText(const std::string& text, const std::string& file, std::vector<std::string>& warnings);

// The line of what a path leads to ("materials.Sail.warp.amount.keys[2]"), or of the last thing on its way
// that is there; 0: nothing is. Of a text that parseText() has taken.
int lineOfPath(const std::string& text, const std::string& path);

}  // namespace scumble::look
