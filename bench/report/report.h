// What the benches of one technique have in common.
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scumble/image.h"

namespace scumble::bench {

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// The value; ends the program with a message where there is none.
template <class T>
T take(const char* program, Result<T> result) {
  if (!result) {
    std::fprintf(stderr, "%s: error: %s\n", program, result.error().message().c_str());
    std::exit(result.error().kind == ErrorKind::noUsableGpu ? 4 : 2);
  }
  return std::move(result).value();
}

// Writes a report where a file was asked for; the program's exit code.
inline int give(const char* program, const std::string& file, const nlohmann::ordered_json& report) {
  if (file.empty()) return 0;
  const Status written = writeText(file, report.dump(2) + "\n");
  if (written) return 0;
  std::fprintf(stderr, "%s: error: %s\n", program, written.error().message().c_str());
  return 5;
}

}  // namespace scumble::bench
