// Paintings made of strokes in space, as splats (paper 003, section 3; the model of a stroke is that of
// Schmid et al. 2011): splats lie along each stroke, are sorted by depth, and blended.
#pragma once

#include <memory>

#include "frame/pass.h"

namespace scumble::painting {

inline constexpr const char* kName = "painting";

// Where the points of strokes are in the frame: shared::PlacedPoint.
inline constexpr frame::Role kPlacedPoints{"placed points"};

// Places points, and casts the shadows of strokes.
std::unique_ptr<frame::Pass> makePoints();
std::unique_ptr<frame::Pass> makeSplats();
std::unique_ptr<frame::Pass> makeOver();

// For how many places of paintings there has to be room that a scene has and a look draws: in powers of two,
// so that few that come and go make nothing anew. 0: for none.
uint32_t drawnPaintings(const scene::SceneData& scene, const look::LookData& look);
// Whether it has layers of paint that are.
bool showsLayers(const scene::SceneData& scene, const look::LookData& look);

}  // namespace scumble::painting
