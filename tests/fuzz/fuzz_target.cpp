#include "tests/fuzz/fuzz_target.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

namespace scumble::fuzz {

void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

void write(const std::string& folder, const char* name, const std::string& content) {
  std::ofstream(folder + "/" + name, std::ios::binary) << content;
}

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
