// A film of pictures as they come, whenever that is.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "scumble/film.h"

namespace scumble::app {

class Recorder {
 public:
  static Result<std::unique_ptr<Recorder>> create(const std::string& path, const FilmOptions& options);
  ~Recorder();  // a film that was not finished leaves nothing behind
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // A picture that stands from a moment on, in seconds, which grow. The film's own pictures stand as long as
  // its rate says: each shows what stands when it begins. Never waits for the film; what that has no time for
  // is left out, and what stood before stands on.
  // Fails, as every later call does, once the film is lost.
  Status see(std::shared_ptr<const Image> picture, double seconds);
  // Its end, once. Fails as FilmWriter does.
  struct Report {
    uint64_t pictures = 0, leftOut = 0;
  };
  Result<Report> finish();

 private:
  // Pictures that wait for the film, as many as there is room for.
  struct Waiting {
    std::shared_ptr<const Image> picture;
    uint64_t times = 1;
  };
  Recorder(std::unique_ptr<FilmWriter> film, double fps);
  void run();
  void end();

  std::unique_ptr<FilmWriter> film_;
  const double fps_;
  uint64_t next_ = 0;  // picture of the film
  std::shared_ptr<const Image> standing_;
  Report report_;
  Status status_ = Done{};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Waiting> waiting_;
  bool isEnding_ = false;
  std::thread thread_;
};

}  // namespace scumble::app
