// Lines: what is drawn of the edges of meshes, in ink (paper 004, section 2).
#pragma once

#include <memory>

#include "frame/pass.h"

namespace scumble::ink {

inline constexpr const char* kName = "ink";

// Ink by itself. R, G, B: coverage x (1 - square root of the linear colour); A: coverage. Where several lines
// lie on one another each has the greatest, so that joints and crossings are as dark as what meets there, in
// whatever order they are drawn.
inline constexpr frame::Role kStrokes{"ink strokes"};

// How near strokes are, wherever something changes colours by that. R: coverage, times the scene's radius in
// metres, by metres along the view axis; G: coverage. Greatest ones, too, so that nearer lines count.
inline constexpr frame::Role kStrokesNearness{"nearness of ink strokes"};

// Of each pixel, one sample: R: which piece of a mesh, as PartsOnGpu numbers them, 0 where nothing is; G: the
// object, as the AOV `id` has it; B: 1 where it may have holes; A: metres along the view axis.
inline constexpr frame::Role kPieces{"ink pieces"};

// Lines as numbers (ink.shared.h), and kPieces: what drawings of them are made from.
inline constexpr const char *kLineTableAov = "ink-table", *kPiecesAov = "ink-pieces";

// Draws those, where lines follow from them.
std::unique_ptr<frame::Pass> makeParts();
// Draws ink.
std::unique_ptr<frame::Pass> makeLines();
// Finds what follows from the picture, and puts it with that, where something changes the colours of
// overlays.
std::unique_ptr<frame::Pass> makeOverlay();
// Lays it over the picture.
std::unique_ptr<frame::Pass> makeOver();

}  // namespace scumble::ink
