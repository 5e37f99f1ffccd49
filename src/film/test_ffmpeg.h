// For tests that need ffmpeg: to write films, or to look into them.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace scumble::film {

inline bool hasFfmpeg() {
  static const bool has = system("ffmpeg -version >/dev/null 2>&1 && ffprobe -version >/dev/null 2>&1") == 0;
  return has;
}
#define NEEDS_FFMPEG() \
  if (!scumble::film::hasFfmpeg()) GTEST_SKIP() << "ffmpeg or ffprobe is not installed"

// What a program writes on its standard output.
inline std::string outputOf(const std::string& command) {
  FILE* pipe = popen(command.c_str(), "r");
  std::string output;
  char bytes[4096];
  while (const size_t count = fread(bytes, 1, sizeof bytes, pipe)) output.append(bytes, count);
  EXPECT_EQ(pclose(pipe), 0) << command;
  return output;
}

}  // namespace scumble::film
