// Progress of long work on stderr: a bar on a terminal, else a plain line now and then; with the time left,
// as soon as it can be told.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "time_left.h"

namespace scumble::app {

class Progress {
 public:
  // Nothing is shown for a single step that is not told of by parts, or when `quiet`.
  Progress(int steps, bool quiet);
  ~Progress();  // ends the bar's line
  Progress(const Progress&) = delete;
  void done(const std::string& what);
  // Of the next step, a part has been done: from 0 to 1. With it a single step is shown as well.
  void part(double of);

 private:
  using Clock = std::chrono::steady_clock;
  void show(double done, const std::string& what);
  std::mutex mutex_;  // frames are drawn and written by several threads
  int steps_, done_ = 0;
  bool quiet_, terminal_, isOpen_ = false;  // a bar stands on the line
  Clock::time_point start_ = Clock::now(), lastLine_ = start_;
  TimeLeft timeLeft_{double(steps_)};
};

}  // namespace scumble::app
