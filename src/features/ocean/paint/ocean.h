// The painterly ocean (paper 000, section 6.1): its colours in light and in shadow, once a pixel, for the
// surface pass to take. A dithering pattern by MetaTexture is an index into the bathic map, foam lies on
// up-wind faces, and the sky is mirrored in hand-cut shapes. Only where the scene has an ocean.
#pragma once

#include "frame/pass.h"

namespace scumble::ocean {

std::unique_ptr<frame::Pass> makeOcean();

}  // namespace scumble::ocean
