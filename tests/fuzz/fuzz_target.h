// What the fuzz targets share: promises that must hold, and seeds that are written on demand. Included once a
// program.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

namespace scumble::fuzz {

inline void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

inline void write(const std::string& folder, const char* name, const std::string& content) {
  std::ofstream(folder + "/" + name, std::ios::binary) << content;
}

// Each target's own: a few files that between them touch every part; mutations go further from there.
void writeSeeds(const std::string& folder);

}  // namespace scumble::fuzz

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  for (int i = 1; i < *count; ++i) {
    const char* option = "--write-seeds=";
    if (std::strncmp((*arguments)[i], option, std::strlen(option)) != 0) continue;
    scumble::fuzz::writeSeeds((*arguments)[i] + std::strlen(option));
    std::exit(0);
  }
  return 0;
}
