struct SurfaceParams {
#define PARAM(type, name, defaultValue, low, high, unit, meaning) type name;
#include "surface.params"
#undef PARAM
};
struct SurfaceUniforms {
  float terminator;
  float terminatorSharpness;
};
