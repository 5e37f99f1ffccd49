// How many colours a limited palette has at most (passes/limit), for whoever is painted with it.
#ifndef SCUMBLE_PALETTE_SHARED_H
#define SCUMBLE_PALETTE_SHARED_H
#include "shared_types.h"

SHARED_BEGIN
const int kMaxPaletteColors = 16;
SHARED_END
#endif
