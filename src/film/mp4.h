// MP4 files (ISO/IEC 14496-12) as ffmpeg leaves them, and as they should be.
#pragma once

#include <cstdint>
#include <string>

#include "base/whole_file.h"
#include "scumble/film.h"

namespace scumble::film {

// Copies the film in `descriptor` to `out` with its index (moov) in front, so that it plays while it is still
// loading, and with the layout of the eyes (st3d, "Spherical Video V2 RFC") in its video's description.
// `frames`: how many it must have. Returns what is wrong with the film, or nothing; failures of writing are
// kept in `out`.
std::string rearrangeMp4(int descriptor, FilmLayout layout, uint64_t frames, WholeFile& out);

}  // namespace scumble::film
