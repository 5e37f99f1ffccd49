// An output file that appears whole or not at all: it is written as a passing file (passing_file.h) in its
// target's folder and put in its place at the end. Whatever goes wrong on the way, the target stays as it was
// and the passing file is removed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

#include "scumble/result.h"

namespace scumble {

class WholeFile {
 public:
  // Opens the passing file. A failure is kept and comes out of commit(), so writers need no check of their
  // own.
  explicit WholeFile(const std::string& path);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  bool ok() const { return errno_ == 0; }
  void write(const void* bytes, size_t size);
  void seek(uint64_t position);
  uint64_t position() const { return position_; }

  // Puts the file in its place. The only way to learn whether everything before succeeded.
  Status commit();

 private:
  int openPassing();
  void fail(int code);

  std::string path_;     // as the user named it
  std::string target_;   // with symbolic links resolved, so that a link stays a link
  std::string passing_;  // the passing name; empty where there is none to remove
  FILE* file_ = nullptr;
  uint64_t position_ = 0;
  int errno_ = 0;  // last: opening fills the members above
};

}  // namespace scumble
