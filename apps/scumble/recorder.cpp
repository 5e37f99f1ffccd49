#include "recorder.h"

#include <utility>

namespace scumble::app {

namespace {

constexpr size_t kMostWaiting = 60;  // pictures: some hundred megabytes of a screen's size

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

void Recorder::see(std::shared_ptr<const Image> picture, double seconds) {
  // What stood until now has pictures of the film that begin before this one does.
  uint64_t times = 0;
  for (; double(next_) / fps_ < seconds - 1e-9; ++next_) ++times;
  const std::shared_ptr<const Image> stood = std::exchange(standing_, std::move(picture));
  if (!stood || times == 0) return;
  const std::lock_guard lock(mutex_);
  if (waiting_.size() >= kMostWaiting) {
    owed_ += times, report_.leftOut += times;
    return;
  }
  waiting_.push_back({stood, times + std::exchange(owed_, 0)});
  changed_.notify_all();
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
    for (; added < one.times && status; ++added) status = film_->add(*one.picture);
    lock.lock();
    report_.pictures += added;
    if (!status && status_) status_ = status;
  }
}

Result<Recorder::Report> Recorder::finish() {
  if (standing_) {
    const std::lock_guard lock(mutex_);
    waiting_.push_back({standing_, 1 + owed_});
  }
  end();
  if (!status_) return status_.error();
  if (Status status = film_->finish(); !status) return status.error();
  return report_;
}

}  // namespace scumble::app
