#ifndef SCUMBLE_WATERCOLOR_SHARED_H
#define SCUMBLE_WATERCOLOR_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN

// A point on a surface (scene/surface_anchors.h).
struct DrawnAnchor {
  uint a, b, c;  // final vertices, counted from where the object's begin
  float toB, toC;
  float spacing;  // metres in mesh space
  float area;     // of the triangle there, square metres
  uint seed;
};
// An object that is painted. Its anchors lie one after the other; its number is the instance that they are
// drawn as.
struct PaintedObject {
  uint firstAnchor;
  uint firstVertex;
  uint object;
  uint seed;     // what is painted alike elsewhere has another one
  uint isSided;  // 1: its back is never seen, so that what turns away is hidden
};

struct PigmentUniforms {
  float spacing;   // pixels
  float size;      // of stamps, in spacings
  float backruns;  // part of stamps
  uint seed;
  vec4 byOpacity;  // of each brush, 1: its picture has transparency, which says where it paints; else 0
  uint brushes;    // of which stamps take any
  float sizes;     // how far they differ in size
  float turns;     // how far they are turned
};
// What stamps are like on a material.
struct PigmentMaterial {
  float strength, density;
  uint brush;  // 0: any
  vec3 color;
  float colorAmount;
};
const int kPigmentBrushes = 4;
const int kPigmentBlock = 0, kPigmentAnchors = 1, kPigmentObjects = 2, kPigmentVertices = 3,
          kPigmentDepth = 4, kPigmentPlaces = 5, kPigmentMaterials = 6, kPigmentBrush = 7, kPigmentSecond = 8,
          kPigmentThird = 9, kPigmentFourth = 10;

// Pigment is laid down at a quarter of the size, since stamps are large and soft.
const int kPigmentScale = 4;

struct WashUniforms {
  vec3 white;
  float paperSize;  // pixels
  float relief, wobble, strength, edges, edgeWidth, granulation, dryBrush, bleeding, bare, bareFrom, margin,
      turbulence, hue, glazing;
  float slopeStep;  // pixels, over which the relief's slope is taken
  vec2 paperAt[2];  // of each view, where the paper's origin lies, pixels
  mat3 eyeToPaper;  // on a sphere: turns directions to that of the paper
  vec3 paperLight;  // where the light is that falls on the paper: x, y from -1 to 1 over the picture, z
                    // towards the viewer
};
const int kWashPicture = 1, kWashDensity = 2, kWashPigment = 3, kWashLight = 4, kWashTint = 5, kWashPaper = 6,
          kWashBroad = 7, kWashNormals = 8;
const int kWashBlurred = 1;
// The paper's slopes, for specialisation constant 0: of the relief, none, or of a normal map.
const int kSlopesOfRelief = 0, kNoSlopes = 1, kSlopesOfNormals = 2;
const int kExtentPaper = 1, kExtentBroad = 2;

SHARED_END
#endif
