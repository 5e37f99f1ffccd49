// Draws the frames of a plan, in order: two are under way on the device while earlier ones are written.
#pragma once

#include <functional>
#include <vector>

#include "progress.h"
#include "render_arguments.h"
#include "scumble/renderer.h"

namespace scumble::app {

// What `plan.args.picture` and its output ask of a renderer.
Result<std::unique_ptr<Renderer>> rendererFor(RenderPlan& plan);

// One frame for each of `times` (seconds); `take` gets them in this order. Once `ends` says so no further one
// is begun; it may be empty.
Status drawFrames(const RenderPlan& plan, Renderer& renderer, const std::vector<double>& times,
                  Progress& progress, const std::function<Status(size_t, Frame)>& take,
                  const std::function<bool()>& ends = {});

}  // namespace scumble::app
