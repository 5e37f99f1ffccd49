// Blended surfaces of all objects and materials, which are drawn at once in one order.
#ifndef SCUMBLE_TRANSPARENT_SHARED_H
#define SCUMBLE_TRANSPARENT_SHARED_H
#include "frame.shared.h"

SHARED_BEGIN

struct TransparentTriangle {
  uvec3 vertices;  // numbers of final ones
  uint part;
};

// One object's triangles. What fragments know of them is one number: 1 where its triangles are mirrored, 2
// where vertex colours or textures vary the material's colour, and from bit 2 on the material.
struct TransparentPart {
  uint object;
  uint known;
  uint visible;     // 1: in one of the frame's views
  float fadeStart;  // of fins, as paintFade has it; else 0
  uint isCoat;      // 1: paint that is not seen from behind
};

// So many textures at once, that with a pass's own there are no more than any device has for a stage.
const int kTransparentTextures = 12;

// A material, with what is a pipeline's or a descriptor set's where surfaces are drawn one by one.
struct TransparentMaterial {
  MaterialData data;
  ivec4 slots;  // textures of base colour and emission, sets of colours for light and for shadow; -1: none
  uint group;   // with which others it is drawn
  uint single;  // 1: back faces are not seen
  vec2 fade;    // of fins: where they begin to show, and where all of them does (paintFade)
  uint varies;  // 1: its colour varies whatever its parts are: the look paints on it, or gives it colours
};

SHARED_END
#endif
