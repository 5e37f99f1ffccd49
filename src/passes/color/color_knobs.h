// Knobs of the background and the air, and what follows from them and others for the colours of surfaces.
#pragma once

#include <utility>
#include <vector>

#include "frame/pass.h"
#include "frame/tile_flags.h"
#include "shading/surface_color.shared.h"

namespace scumble::passes {

#define PARAMS_STRUCT BackgroundParams
#define PARAMS_FILE "passes/color/color.params"
#define PARAMS_PATH "background"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

// Where the air begins to count, and where nothing else is left: metres along the view axis, the same for all
// views.
glm::vec2 airDistances(const BackgroundParams& params, const shared::FrameUniforms& frame);

shared::SurfaceColors surfaceColors(const frame::FrameInput& input, frame::Layer layer);

// Which parts (shared::kPartAll ...) are made on which tiles of the first surfaces. `hasSamples`: pixels have
// several, which are looked at.
std::vector<std::pair<int, frame::TileChoice>> colorParts(const frame::FrameInput& input, bool hasSamples);

}  // namespace scumble::passes
