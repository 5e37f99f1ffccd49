// MP4 files (ISO/IEC 14496-12) as ffmpeg leaves them, and as they should be.
#pragma once

#include <cstdint>
#include <string>

#include "base/whole_file.h"
#include "scumble/film.h"

namespace scumble::film {

// Copies the film in `descriptor` to `out` with its index (moov) in front, so that it plays while it is still
// loading, and with what players must know of it: in its video's description the layout of the eyes and the
// projection (st3d and sv3d, "Spherical Video V2 RFC"), and of a panorama the same once more, for older
// players, as XML in its track ("Spherical Video RFC"). `frames`: how many it must have. Returns what is
// wrong with the film, or nothing; failures of writing are kept in `out`.
std::string rearrangeMp4(int descriptor, const FilmOptions& options, uint64_t frames, WholeFile& out);

}  // namespace scumble::film
