// Ctrl-C and SIGTERM while something is made that is worth keeping: it is ended, and not cut off.
#pragma once

namespace scumble::app {

// As long as it lives the first signal is noted, and a second one ends the program as usual. One at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  // True once a signal has come; false where none lives.
  static bool came();
  // Exit code that shells expect of a program that the signal has ended: 130 or 143; 0 without a signal.
  static int exitCode();
  // "Ctrl-C" or "SIGTERM".
  static const char* name();
};

}  // namespace scumble::app
