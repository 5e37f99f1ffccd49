// Knobs of the warp pass, one entry a material.
struct WarpParams {
#define PARAM(type, name, defaultValue, low, high, unit, meaning) type name;
#include "warp.params"
#undef PARAM
};
layout(set = 2, binding = 0, scalar) uniform WarpBlock { WarpParams warp; };
layout(set = 2, binding = 1, scalar) uniform MetaTextureBlock { MetaTextureParams meta; };
