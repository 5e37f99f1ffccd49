// Whether a job runs on a tile, by the tile's flags.
#ifndef SCUMBLE_TILES_GLSL
#define SCUMBLE_TILES_GLSL
#extension GL_EXT_scalar_block_layout : require
#include "byte_bits.glsl"
#include "tiles.shared.h"

layout(push_constant, scalar) uniform TileBlock { TileRule rule; };

// `texel`: of an image of flags.
bool runsOn(vec4 texel) { return (bitsOf(texel.r) & rule.mask) == rule.value; }
#endif
