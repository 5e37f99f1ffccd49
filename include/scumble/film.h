// Films: pictures one after another into an MP4 file, encoded as H.264 by the program ffmpeg.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "scumble/image.h"
#include "scumble/result.h"

namespace scumble {

// How two eyes lie in each picture. Players learn it from the file.
enum class FilmLayout {
  mono,
  sideBySide,  // the left eye's picture on the left
  overUnder    // the left eye's picture on top
};

struct FilmOptions {
  // Pixels of each picture as it is added, with both eyes in it; 1 ... 16384. H.264 stores even sizes: an odd
  // one grows by a column on the right or a row at the bottom that repeats the last one. Both eyes must have
  // one size: the width is even for side by side, the height for over under.
  uint32_t width = 0, height = 0;

  // Frames a second, 0.01 ... 1000. Stored as a fraction: whole numbers exactly, 23.976 or 23.98 as
  // 24000/1001 and 29.97 as 30000/1001, others as the nearest one whose denominator is at most 1001.
  double fps = 24;

  // Constant quality (x264's CRF), 0 ... 51: lower is better and larger. 0 is lossless after the conversion
  // to Y'CbCr, in a profile that not every player knows.
  int quality = 16;

  FilmLayout layout = FilmLayout::mono;
};

// Writes one film. The file appears whole when finish() succeeds, and not at all otherwise.
//
// Colours are those of writePng: sRGB, 8 bit, then Y'CbCr 4:2:0 (BT.709 matrix and primaries, limited range),
// and marked so. A film has no alpha: pictures with alpha (four channels) are put over black. The same
// pictures give the same bytes with one version of ffmpeg, whatever the number of processors.
//
// ffmpeg is looked for on the PATH and runs as a child process until finish(), or until the writer is
// destroyed. No signal state of this process is changed. One writer is used by one thread at a time; several
// writers are independent.
class FilmWriter {
 public:
  // Fails with ErrorKind::usage for options that make no sense, and with ErrorKind::outputNotWritten where
  // the file cannot be written or ffmpeg cannot be started.
  static Result<std::unique_ptr<FilmWriter>> create(const std::string& path, const FilmOptions& options);

  // An unfinished film leaves nothing behind.
  ~FilmWriter();
  FilmWriter(const FilmWriter&) = delete;
  FilmWriter& operator=(const FilmWriter&) = delete;

  // Adds the next picture. ErrorKind::usage: it does not fit the options, and the film goes on without it.
  // ErrorKind::outputNotWritten: ffmpeg has ended (it may have done so some pictures ago), the disk is full;
  // the film is lost, and every later call gives the same error.
  Status add(const Image& picture);

  // Ends the film and puts the file in its place. A film needs at least one picture.
  Status finish();

 private:
  struct State;
  explicit FilmWriter(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

}  // namespace scumble
