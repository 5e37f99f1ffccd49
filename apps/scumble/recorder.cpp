#include "recorder.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace scumble::app {

namespace {

constexpr size_t kMostBytes = size_t(1) << 28;  // of pictures that wait
constexpr size_t kLeastWaiting = 2;             // however large they are

}  // namespace

Result<std::unique_ptr<Recorder>> Recorder::create(const std::string& path, const FilmOptions& options) {
  Result<std::unique_ptr<FilmWriter>> film = FilmWriter::create(path, options);
  if (!film) return film.error();
  return std::unique_ptr<Recorder>(new Recorder(std::move(film).value(), options.fps));
}

Recorder::Recorder(std::unique_ptr<FilmWriter> film, double fps)
    : film_(std::move(film)), fps_(fps), thread_([this] { run(); }) {}

Recorder::~Recorder() {
  end();
}

void Recorder::end() {
  {
    const std::lock_guard lock(mutex_);
    isEnding_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

Status Recorder::see(std::shared_ptr<const Image> picture, double seconds) {
  // What stood until now has pictures of the film that begin before this one does.
  uint64_t times = 0;
  for (; double(next_) / fps_ < seconds - 1e-9; ++next_) ++times;
  const std::shared_ptr<const Image> stood = std::exchange(standing_, std::move(picture));
  const std::lock_guard lock(mutex_);
  if (!status_ || !stood || times == 0) return status_;
  if (waiting_.size() >= std::max(kLeastWaiting, kMostBytes / std::max<size_t>(stood->codes.size(), 1))) {
    waiting_.back().times += times, report_.leftOut += times;
    return status_;
  }
  waiting_.push_back({stood, times});
  changed_.notify_all();
  return status_;
}

void Recorder::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return isEnding_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const Waiting one = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    uint64_t added = 0;
    Status status = Done{};
    try {
      for (; added < one.times && status; ++added) status = film_->add(*one.picture);
    } catch (const std::exception& failure) {
      status = Error{ErrorKind::outputNotWritten, "", 0, "", failure.what(), "use a smaller --size"};
    }
    lock.lock();
    report_.pictures += added;
    if (!status && status_) status_ = status;
    if (!status_) waiting_.clear();
  }
}

Result<Recorder::Report> Recorder::finish() {
  if (standing_) {
    const std::lock_guard lock(mutex_);
    waiting_.push_back({standing_});
  }
  end();
  if (!status_) return status_.error();
  if (Status status = film_->finish(); !status) return status.error();
  return report_;
}

}  // namespace scumble::app
