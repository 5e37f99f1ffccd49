// Uniforms of paintings' shaders, from a look.
#pragma once

#include "features/painting/painting.shared.h"
#include "frame/pass.h"

namespace scumble::painting {

shared::PaintingUniforms uniformsOf(const frame::FrameInput& input);

}  // namespace scumble::painting
