// Measuring with whatever draws: the renderer, or in tests pictures whose numbers are known beforehand.
#pragma once

#include <functional>

#include "scumble/measure.h"

namespace scumble::measuring {

// A frame at time 0, as Renderer::render.
using Draw = std::function<Result<Frame>(const Scene& scene, const Look& look, const std::vector<View>& views,
                                         const RenderOptions& options)>;

// `options` are in range and the scene is not empty.
Result<Measurements> measureWith(const Draw& draw, const Scene& scene, const Look& look,
                                 const MeasureOptions& options);

}  // namespace scumble::measuring
