#ifndef SCUMBLE_INK_OVER_SHARED_H
#define SCUMBLE_INK_OVER_SHARED_H
#include "../../../shading/shared_types.h"

SHARED_BEGIN
// Lines that follow from the picture: around shadow shapes, and between steps of light; where objects end,
// where pieces of meshes meet, and where a texture cuts one out.
const int kInkOverShadows = 0, kInkOverSteps = 1, kInkOverObjects = 2, kInkOverIntersections = 3,
          kInkOverCutOuts = 4;
const int kInkOverKinds = 5;
struct InkOverKind {
  float radius;  // pixels; where widths are in metres, at a distance of one
  vec3 color;    // square root
};
struct InkOverUniforms {
  float warp;   // how far the warp moves ink, against other edges
  float steps;  // of light
  float least;  // half the width of lines, pixels, at least
  InkOverKind kinds[kInkOverKinds];
};
// Edges of light are about a pixel and a half wide: lines that are thinner than that are lighter instead, or
// where lines break and are not paler (ink.breaks), as wide as that.
const float kInkOverThinnest = 0.75f;
// How far from a pixel borders of pieces are looked for, at most: half the greatest width of their lines.
const int kInkOverReach = 4;
// Beyond such a slope two places are no longer on one surface, or touch.
const float kInkSteepest = 8.0f;
// Options that it is specialised to: edges are torn; ink is an overlay, with all lines; lines end where the
// painting does.
const int kInkOverTears = 1, kInkOverIsOverlay = 2, kInkOverEnds = 4;
const int kInkOverPicture = 1, kInkOverStrokes = 2, kInkOverWarp = 3, kInkOverTiles = 4, kInkOverLight = 5,
          kInkOverDepth = 6, kInkOverPieces = 7, kInkOverExtent = 8;
// Bindings of the overlay.
const int kInkOverlayStrokes = 1, kInkOverlayTiles = 2, kInkOverlayLight = 3, kInkOverlayDepth = 4,
          kInkOverlayPieces = 5, kInkOverlayNearness = 6;
SHARED_END
#endif
