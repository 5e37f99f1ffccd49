// A run of ffmpeg that writes a film, into a file without a name, so that no kill of any process leaves one.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "film/child_process.h"
#include "scumble/film.h"

namespace scumble::film {

class FfmpegRun {
 public:
  // `path`: of the film that it is for. What is written lies in its folder, and errors name it.
  FfmpegRun(std::string path, FilmFormat format);
  ~FfmpegRun();
  FfmpegRun(const FfmpegRun&) = delete;
  FfmpegRun& operator=(const FfmpegRun&) = delete;

  // `words`: from ffmpeg's inputs on, without its output. `inputs`: descriptors of files that the words call
  // inputName(0), inputName(1), ... Fails, as all here, with ErrorKind::outputNotWritten.
  Status start(const std::vector<std::string>& words, const std::vector<int>& inputs = {});
  static std::string inputName(size_t index);

  // Gives it bytes on its standard input.
  Status send(const void* bytes, size_t size);
  // Ends that, and waits until everything is written.
  Status finish();

  // The descriptor of what it has written; open as long as this object lives.
  int written() const { return scratch_; }

  // That `problem` keeps the film from being written.
  Error lost(std::string problem, std::string advice) const;
  // Error for what ffmpeg has said, in our words where we know what it means; `how` it has ended.
  Error failed(const std::string& how) const;

 private:
  std::string writeSequence() const;
  const char* encoder() const;

  std::string path_;
  FilmFormat format_;
  int scratch_ = -1;
  ChildProcess process_;
};

}  // namespace scumble::film
