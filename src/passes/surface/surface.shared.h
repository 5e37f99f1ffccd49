#ifndef SCUMBLE_SURFACE_SHARED_H
#define SCUMBLE_SURFACE_SHARED_H
#include "../../shading/shared_types.h"
#ifdef __cplusplus
#include "passes/surface/surface_knobs.h"
#include "stage/light.h"
#endif

SHARED_BEGIN
#ifdef __cplusplus
using passes::SurfaceParams;
using stage::LightParams;
#else
struct SurfaceParams {
#include "surface.params"
};
struct LightParams {
#include "../../stage/light.params"
};
#endif

// Bindings of set 2.
const int kSurfaceKnobs = 0, kSurfacePainted = 1, kSurfaceLight = 2, kSurfaceShadowMap = 3,
          kSurfaceExample = 4, kSurfaceInverse = 5, kSurfaceFirstDepth = 6, kSurfacePrepaintedLit = 7,
          kSurfacePrepaintedShadowed = 8, kSurfaceObjects = 9, kSurfaceVeils = 10, kBlendedVeils = 6;
// Bits of what its shaders are specialised to (kOptions): light between surfaces, which has a stream of its
// own or is in vertex colours; and from a bit on its steps.
const int kSurfaceIndirect = 16, kSurfaceIndirectColors = 32, kSurfaceStepsBit = 6;
SHARED_END
#endif
