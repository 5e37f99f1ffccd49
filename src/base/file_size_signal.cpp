#include "base/file_size_signal.h"

#include <cerrno>
#include <ctime>

namespace scumble {

namespace {

sigset_t theSignal() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGXFSZ);
  return set;
}

}  // namespace

FileSizeSignalHeld::FileSizeSignalHeld() {
  const sigset_t held = theSignal();
  sigset_t pending;
  sigpending(&pending);
  wasPending_ = sigismember(&pending, SIGXFSZ) == 1;
  pthread_sigmask(SIG_BLOCK, &held, &before_);
}

FileSizeSignalHeld::~FileSizeSignalHeld() {
  const int code = errno;
  const sigset_t held = theSignal();
  const timespec now = {};
  while (!wasPending_ && sigtimedwait(&held, nullptr, &now) < 0 && errno == EINTR) {
  }
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  errno = code;
}

}  // namespace scumble
