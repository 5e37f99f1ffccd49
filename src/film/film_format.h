// What the formats of films differ in.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/whole_file.h"
#include "scumble/film.h"

namespace scumble::film {

struct FormatFacts {
  const char *encoder, *codec;       // as ffmpeg calls them
  int defaultQuality, worstQuality;  // a GIF: -1
  double fastest;                    // frames a second
};
const FormatFacts& factsOf(FilmFormat format);

struct PixelSize {
  uint32_t width, height;
};
// Of one eye's part of each picture.
PixelSize eyeSizeOf(const FilmOptions& options);
// Of the pictures in the file.
PixelSize storedSizeOf(const FilmOptions& options);

// ffmpeg's words from its input on, which is raw pictures as rawPicture() makes them; without the output.
std::vector<std::string> encoderArguments(const FilmOptions& options);
// Those of them that say how the file is written, whoever has encoded what is in it.
std::vector<std::string> containerArguments(const FilmOptions& options);
std::vector<uint8_t> rawPicture(const Image& picture, FilmFormat format);

// Copies what ffmpeg wrote to `descriptor` into the film, put right where that is needed. `frames`: how many
// it must have, where the format says it. Returns what is wrong with it, or nothing; failures of writing are
// kept in `out`.
std::string completeFilm(int descriptor, const FilmOptions& options, uint64_t frames, WholeFile& out);

}  // namespace scumble::film
