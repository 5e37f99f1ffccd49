// A film that is there already, and that a writer goes on with. Its pictures are kept as they are encoded.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "film/ffmpeg_run.h"
#include "scumble/film.h"

namespace scumble::film {

class EarlierFilm {
 public:
  // Opens the film at `path`; null where there is none. Fails with ErrorKind::usage where it is not one that
  // a FilmWriter with these options writes, and with ErrorKind::outputNotWritten where ffmpeg fails.
  static Result<std::unique_ptr<EarlierFilm>> open(const std::string& path, const FilmOptions& options);
  ~EarlierFilm();
  EarlierFilm(const EarlierFilm&) = delete;
  EarlierFilm& operator=(const EarlierFilm&) = delete;

  // How many pictures it has.
  uint64_t frames() const { return frames_; }

  // Starts `joined` and waits for it: the pictures of this film, then those of the one in the descriptor
  // `rest`, which an encoder with the same options has written.
  Status joinTo(int rest, FfmpegRun& joined) const;

 private:
  EarlierFilm(int descriptor, const FilmOptions& options) : descriptor_(descriptor), options_(options) {}

  int descriptor_;
  FilmOptions options_;
  uint64_t frames_ = 0;
};

}  // namespace scumble::film
