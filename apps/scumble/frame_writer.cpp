#include "frame_writer.h"

#include <chrono>

namespace scumble::app {

FrameWriter::FrameWriter(int threads, Write write, std::function<void(int)> written)
    : write_(std::move(write)), written_(std::move(written)) {
  for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
}

FrameWriter::~FrameWriter() {
  {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
  }
  stop();
}

Status FrameWriter::add(int number, Frame frame) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return failure_ || waiting_.size() < threads_.size(); });
  if (!failure_) waiting_.emplace_back(number, std::move(frame));
  changed_.notify_all();
  return outcome();
}

Status FrameWriter::finish() {
  stop();
  return outcome();
}

void FrameWriter::stop() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_)
    if (thread.joinable()) thread.join();
}

void FrameWriter::work() {
  using Clock = std::chrono::steady_clock;
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return ends_ || !waiting_.empty(); });
    if (waiting_.empty() || failure_) return;
    auto [number, frame] = std::move(waiting_.front());
    waiting_.pop_front();
    changed_.notify_all();
    lock.unlock();
    const Clock::time_point start = Clock::now();
    const Status status = write_(frame, number);
    const double elapsed = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    lock.lock();
    milliseconds_ += elapsed;
    if (!status && !failure_) failure_ = status.error();
    if (status) written_(number);
    changed_.notify_all();
  }
}

}  // namespace scumble::app
