// What a write beyond a limit on the sizes of files (`ulimit -f`) does besides failing with EFBIG: it raises
// SIGXFSZ, which ends a process that does not expect it.
#pragma once

#include <signal.h>

namespace scumble {

// While one lives, writes of this thread beyond the limit only fail. Signal state that other threads see is
// not touched, for it is the host's; errno stays as it is.
class FileSizeSignalHeld {
 public:
  FileSizeSignalHeld();
  ~FileSizeSignalHeld();
  FileSizeSignalHeld(const FileSizeSignalHeld&) = delete;
  FileSizeSignalHeld& operator=(const FileSizeSignalHeld&) = delete;

 private:
  sigset_t before_;
  bool wasPending_;  // the host's own, which stays
};

}  // namespace scumble
