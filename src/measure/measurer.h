// Measuring with whatever draws: the renderer, or in tests pictures whose numbers are known beforehand.
#pragma once

#include <functional>
#include <glm/glm.hpp>

#include "scumble/measure.h"

namespace scumble::measuring {

// A frame at time 0, as Renderer::render.
using Draw = std::function<Result<Frame>(const Scene& scene, const Look& look, const std::vector<View>& views,
                                         const RenderOptions& options)>;

// `options` are in range and the scene is not empty.
Result<Measurements> measureWith(const Draw& draw, const Scene& scene, const Look& look,
                                 const MeasureOptions& options);

// Fails with usage where there is nothing to measure, or options are out of range.
Status checkMeasuring(const Scene& scene, const MeasureOptions& options);

const Image& layer(const Frame& frame, const char* name, size_t view = 0);
glm::vec3 centreOf(const Scene& scene);  // of its bounds, metres
// What turns a scene about the vertical through a place.
glm::mat4 turnAbout(const glm::vec3& place, float degrees);

}  // namespace scumble::measuring
