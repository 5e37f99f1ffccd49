// Where looks come from: files, those that ship, and those that others extend.
#pragma once

#include "look/look_json.h"

namespace scumble::look {

struct LookSource {
  std::string file;  // what messages call it
  std::string text;
};

// Fails with unusableFile for files and with usage for unknown names.
Result<LookSource> findLook(const std::string& nameOrFile);

// Looks that are being read, each extended by the one before it.
using LookChain = std::vector<std::string>;
constexpr size_t kMostExtended = 16;

// Reads a look, and before it those that it extends.
Status readLook(const LookSource& source, LookChain chain, LookData& out);

// Reads what a look extends: a look that ships, or a file beside it or below. `place`: where it says so.
Status readExtended(const Json& name, const JsonPlace& place, const LookChain& chain, LookData& out);

}  // namespace scumble::look
