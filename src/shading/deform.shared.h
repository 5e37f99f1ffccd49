#ifndef SCUMBLE_DEFORM_SHARED_H
#define SCUMBLE_DEFORM_SHARED_H
#include "shared_types.h"

SHARED_BEGIN
const int kDeformThreads = 64;
SHARED_END
#endif
