#include "surface.shared.h"
// What a material has where the look paints a texture on it.
struct PaintedMaterial {
  MetaTexture meta;
  float amount;
};
