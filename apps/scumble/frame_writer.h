// Writes finished frames on threads of its own, so that drawing never waits for encoders and disks.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "scumble/renderer.h"

namespace scumble::app {

class FrameWriter {
 public:
  using Write = std::function<Status(const Frame& frame, int number)>;

  // `write` runs on `threads` threads at once; on one, in the order of add(). `written` is called after each
  // frame, never from two threads at a time.
  FrameWriter(int threads, Write write, std::function<void(int number)> written);
  ~FrameWriter();  // what still waits is dropped
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  // Takes a frame; waits while as many frames wait as there are threads, since pictures are large. Both fail
  // with the first error of `write`.
  Status add(int number, Frame frame);
  // Ends when everything is written.
  Status finish();

  // Spent in `write`, on all threads together.
  double milliseconds() const { return milliseconds_; }

 private:
  void work();
  void stop();
  Status outcome() const { return failure_ ? Status(*failure_) : Status(Done{}); }

  const Write write_;
  const std::function<void(int)> written_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::pair<int, Frame>> waiting_;
  std::optional<Error> failure_;
  bool ends_ = false;
  double milliseconds_ = 0;
  std::vector<std::thread> threads_;
};

}  // namespace scumble::app
