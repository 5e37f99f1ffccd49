// What the fuzz targets share: promises that must hold, and seeds that are written on demand
// (--write-seeds=FOLDER).
#pragma once

#include <string>

namespace scumble::fuzz {

void require(bool condition, const char* what);

void write(const std::string& folder, const char* name, const std::string& content);

// Each target's own: a few files that between them touch every part; mutations go further from there.
void writeSeeds(const std::string& folder);

}  // namespace scumble::fuzz
