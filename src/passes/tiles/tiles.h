// Which tiles of the picture have something to be done: an empty sky needs no surface, a tile that lies all
// in light or all in shadow, as far as the blur reaches, needs no shadow shapes, and colours that differ from
// none around them need not be torn. Found from the surfaces, for each view; steps choose by it where they
// run (frame/tile_flags.h).
#pragma once

#include <memory>

#include "frame/pass.h"

namespace scumble::passes {

std::unique_ptr<frame::Pass> makeTiles();

}  // namespace scumble::passes
