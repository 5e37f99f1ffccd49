#ifndef SCUMBLE_PAINTING_SHARED_H
#define SCUMBLE_PAINTING_SHARED_H
#include "../../shading/brush.shared.h"
#include "../../shading/frame.shared.h"

SHARED_BEGIN

// A point of a stroke, as it was painted.
const uint kFirstOfStroke = 1u, kLastOfStroke = 2u;
const uint kUnbound = 0xFFFFFFFFu;
struct StrokePoint {
  vec3 position;  // in the mesh's space; of one that a surface carries: from there, in its frame
  float radius;
  uint normal;         // octahedral; in the same space or frame
  uint color;          // square roots, unorm8 RGBA; A: opacity
  float time;          // seconds
  float order;         // of its stroke, from 0 to 1
  float along, whole;  // from the stroke's beginning, and of the whole stroke, radii
  uint flags;   // whether it is the first or last one; from bit 8 on the brush, from bit 16 on a chance
  uint object;  // whose matrix places it
  // The triangle that carries it: final vertices; x: kUnbound where none does.
  uvec3 vertices;
  vec2 at;     // its part of the second and of the third corner
  float size;  // of that triangle at rest: the square root of twice its area
  // First axis of a Gaussian, octahedral (the normal is its third one), and its extents along the three axes,
  // parts of the radius, unorm8.
  uint axis, shape;
};

// The same where it is in a frame, world.
struct PlacedPoint {
  vec3 position;
  float radius;
  vec3 tangent;  // along the stroke, or a Gaussian's first axis, unit length
  uint normal;
};

// A place on a stroke where a splat may lie.
struct Splat {
  uint point;     // the one before it
  float toNext;   // its part of the next one
  float spacing;  // radii to the next splat that counts at least as much: a power of two times the least
};

struct PaintingUniforms {
  float width, opacity, spacing, streaks, dryEnds, variation, order, sunken, light;
  float until;  // seconds; what was painted later is not there
  float terminator, terminatorSharpness;
  ColorMap lit, shadowed;
  vec3 tintDown, tintUp;
};
const int kPaintingBlock = 0, kPaintingMatrices = 1, kPaintingPoints = 2, kPaintingPlaced = 3,
          kPaintingSplats = 4, kPaintingOrder = 5, kPaintingKeys = 6, kPaintingVertices = 7;
const int kPaintingBindings = 8;
// Of what draws them.
const int kPaintingDepth = 0, kPaintingBristles = 1, kPaintingShadowMap = 2;

const int kPaintingThreads = 64;

SHARED_END
#endif
