struct SurfaceParams {
#define PARAM(type, name, defaultValue, low, high, unit, meaning) type name;
#include "surface.params"
#undef PARAM
};
// What a material has where the look paints a texture on it.
struct PaintedMaterial {
  MetaTexture meta;
  float amount;
};
struct SurfaceUniforms {
  float terminator;
  float terminatorSharpness;
};
