// What calls share that make a file of another one: how they end, and how the file is put in its place.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "scene/import_warnings.h"
#include "scumble/result.h"

namespace scumble::gltf {

// Runs `make`, which reads the file at `path`. What it throws becomes an error: scene::ImportFailure of that
// file, unless it was cancelled; too little memory, with what helps; and whatever else, by what it was
// `doing`, as in "baking".
Status guarded(const std::string& path, const char* doing, const char* remedy,
               const std::function<Status()>& make);

// The file appears whole or not at all.
Status putWhole(const std::string& out, const std::vector<uint8_t>& bytes);

// Adds what a file's import warns of and nobody has said yet.
void addNew(std::vector<std::string>& said, const scene::ImportWarnings& warnings, const std::string& path);

}  // namespace scumble::gltf
