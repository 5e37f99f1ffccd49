// Progress of long work on stderr: a bar with the time left on a terminal, else a plain line now and then.
#pragma once

#include <chrono>
#include <string>

namespace scumble::app {

class Progress {
 public:
  // Nothing is shown for a single step, or when `quiet`.
  Progress(int steps, bool quiet);
  ~Progress();  // ends the bar's line
  Progress(const Progress&) = delete;
  void done(const std::string& what);

 private:
  using Clock = std::chrono::steady_clock;
  int steps_, done_ = 0;
  bool shown_, terminal_;
  Clock::time_point start_ = Clock::now(), lastLine_ = start_;
};

}  // namespace scumble::app
