// Paintings made of strokes in space, as splats (paper 003, section 3; the model of a stroke is that of
// Schmid et al. 2011): splats lie along each stroke, are sorted by depth, and blended.
#pragma once

#include <memory>

#include "frame/pass.h"

namespace scumble::painting {

inline constexpr const char* kName = "painting";

// Strokes and layers of paint alone. R, G, B: square roots of colours, times coverage; A: coverage.
inline constexpr frame::Role kPaint{"paint"};

std::unique_ptr<frame::Pass> makeSplats();
std::unique_ptr<frame::Pass> makeOver();

// How many places of paintings a scene has that are drawn under a look.
uint32_t shownPaintings(const scene::SceneData& scene, const look::LookData& look);
// Whether it has layers of paint that are.
bool showsLayers(const scene::SceneData& scene, const look::LookData& look);

}  // namespace scumble::painting
