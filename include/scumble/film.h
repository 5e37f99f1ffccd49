// Films: pictures one after another into a file, encoded by the program ffmpeg; and the pictures of any film
// that ffmpeg reads.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "scumble/export.h"
#include "scumble/image.h"
#include "scumble/result.h"

namespace scumble {

// How two eyes lie in each picture. Players learn it from the file.
enum class FilmLayout {
  mono,
  sideBySide,  // the left eye's picture on the left
  overUnder    // the left eye's picture on top
};

// What part of what is around each eye's picture shows. Players learn it from an MP4; the others cannot say
// it.
enum class FilmProjection {
  flat,       // what a window shows
  sphere,     // all around: columns are longitudes, rows latitudes (scumble/panorama.h)
  halfSphere  // likewise, the half that lies ahead
};

enum class FilmFormat {
  mp4,   // H.264
  webm,  // VP9
  gif    // 256 colours a picture, dithered; repeats for ever. Times are whole hundredths of a second
};

struct FilmOptions {
  FilmFormat format = FilmFormat::mp4;

  // Pixels of each picture as it is added, with both eyes in it; 1 ... 16384. MP4 and WebM store even sizes:
  // an odd one grows by a column on the right or a row at the bottom that repeats the last one. Both eyes
  // must have one size: the width is even for side by side, the height for over under.
  uint32_t width = 0, height = 0;

  // Frames a second, 0.01 ... 1000; of a GIF, at most 50, since players slow down faster ones. Stored as a
  // fraction: whole numbers exactly, 23.976 or 23.98 as 24000/1001 and 29.97 as 30000/1001, others as the
  // nearest one whose denominator is at most 1001.
  double fps = 24;

  // Constant quality (CRF): lower is better and larger. MP4: 0 ... 51, default 16; WebM: 0 ... 63, default
  // 20; a GIF has none. 0 is lossless after the conversion to Y'CbCr, in a profile that not every player
  // knows.
  std::optional<int> quality;

  FilmLayout layout = FilmLayout::mono;              // a GIF cannot say it
  FilmProjection projection = FilmProjection::flat;  // others: each eye's width and height are even
};

// Writes one film. The file appears whole when finish() succeeds, and not at all otherwise.
//
// Colours are those of writePng: sRGB, 8 bit; of MP4 and WebM then Y'CbCr 4:2:0 (BT.709 matrix and primaries,
// limited range), and marked so. A film has no alpha: pictures with alpha (four channels) are put over black.
// The same pictures give the same bytes with one version of ffmpeg, whatever the number of processors.
//
// ffmpeg is looked for on the PATH and runs as a child process until finish(), or until the writer is
// destroyed; resume() also needs ffprobe. No signal state of this process is changed. One writer is used by
// one thread at a time; several writers are independent.
class SCUMBLE_API FilmWriter {
 public:
  // Fails with ErrorKind::usage for options that make no sense, and with ErrorKind::outputNotWritten where
  // the file cannot be written or ffmpeg cannot be started.
  static Result<std::unique_ptr<FilmWriter>> create(const std::string& path, const FilmOptions& options);

  // Goes on with the film that is at `path`, an MP4 or a WebM: what is added follows its pictures, which are
  // kept as they are encoded. It stays as it was until finish() has succeeded. Where there is none, this is
  // create(). Fails with ErrorKind::usage, too, where that film is not what these options write: where it has
  // another codec, size, frame rate, layout or projection, and an MP4 also where it has another quality or
  // comes from another version of the encoder. An MP4 costs the encoding of one picture.
  static Result<std::unique_ptr<FilmWriter>> resume(const std::string& path, const FilmOptions& options);

  // How many pictures the film has: those that were there and those that have been added.
  uint64_t frames() const;

  // An unfinished film leaves nothing behind, and what was there before as it was.
  ~FilmWriter();
  FilmWriter(const FilmWriter&) = delete;
  FilmWriter& operator=(const FilmWriter&) = delete;

  // Adds the next picture. ErrorKind::usage: it does not fit the options, and the film goes on without it.
  // ErrorKind::outputNotWritten: ffmpeg has ended (it may have done so some pictures ago), the disk is full;
  // the film is lost, and every later call gives the same error.
  Status add(const Image& picture);

  // Ends the film and puts the file in its place. A film needs at least one picture; one that is gone on with
  // and gets no more is left as it is.
  Status finish();

 private:
  struct State;
  explicit FilmWriter(std::unique_ptr<State> state);
  static Result<std::unique_ptr<FilmWriter>> make(const std::string& path, const FilmOptions& options,
                                                  bool goesOn);

  std::unique_ptr<State> state_;
};

// Reads the pictures of a film, by time.
//
// They are linear floats (R, G, B), from 8 bits a channel that are taken as sRGB, upright and with square
// pixels. Which picture belongs to a time, and its bytes, depend on the film and on ffmpeg's version only,
// not on what was read before.
//
// The programs ffmpeg and ffprobe are looked for on the PATH and run as child processes. While one picture is
// used, the next one is decoded. Times that grow are fast; for one that lies before the last, the film is
// decoded anew from its beginning. One reader is used by one thread at a time.
class SCUMBLE_API FilmReader {
 public:
  // Fails with ErrorKind::unusableFile where the file is no film or ffmpeg is not there.
  static Result<std::unique_ptr<FilmReader>> open(const std::string& path);
  ~FilmReader();
  FilmReader(const FilmReader&) = delete;
  FilmReader& operator=(const FilmReader&) = delete;

  // The picture that stands at a time in seconds: the last one whose time stamp is not later. Time 0 is that
  // of the first picture; it stands before that too, and the last one stands after the film's end. Time
  // stamps count as up to a millisecond earlier, since some containers round them to whole ones. The same
  // picture is the same object as long as times grow.
  Result<std::shared_ptr<const Image>> at(double time);

  // Time stamp of the last picture, seconds.
  double lastTime() const;

 private:
  struct State;
  explicit FilmReader(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

}  // namespace scumble
