// The yardstick: what any renderer must do at least. Machines and their load differ, so that costs of
// scumble's frames are stated in yardsticks of the same scene, size and moment, measured beside them.
#pragma once

#include <vector>

#include "scumble/export.h"
#include "scumble/renderer.h"

namespace scumble {

// Renders the scene once, in its base colours, unlit, in one pass, and nothing else. Its time is that of the
// pass "plain" in Frame::stats. `options` as Renderer::render takes them, without AOVs; background and
// transparency mean nothing. The renderer keeps images and pipelines of one kind of frame: give the yardstick
// one of its own, where both are to be measured in turns. Fails as Renderer::render does, on the same
// threads.
SCUMBLE_API Result<Frame> renderYardstick(Renderer& renderer, const Scene& scene, const Look& look,
                                          double time, const std::vector<View>& views,
                                          const RenderOptions& options);

}  // namespace scumble
