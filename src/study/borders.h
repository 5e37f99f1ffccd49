// Borders between areas: how ragged, and how soft.
#pragma once

#include "scumble/study.h"
#include "study/plane.h"

namespace scumble::study {

// Follows pieces of borders. A piece is a square of kPiece pixels that one border crosses from one side to
// the other, once in each row (or column) and less steeply than 45 degrees; what else a square may show is
// not counted. `pixelsAt1080`: of one of the plane's.
StudiedBorders bordersOf(const Plane& areas, double pixelsAt1080);
constexpr int kPiece = 32;

}  // namespace scumble::study
