// Knobs of the warp pass, one entry a material.
struct WarpParams {
#define PARAM(type, name, defaultValue, low, high, unit, meaning) type name;
#include "warp.params"
#undef PARAM
};
layout(set = 1, binding = 0, scalar) readonly buffer WarpBlock { WarpParams warpParams[]; };
layout(set = 1, binding = 1, scalar) readonly buffer MetaTextureBlock { MetaTextureParams metaTextureParams[]; };
