#ifndef SCUMBLE_ORDER_SHARED_H
#define SCUMBLE_ORDER_SHARED_H
#include "../../shading/shared_types.h"

SHARED_BEGIN
const int kOrderThreads = 64;
SHARED_END
#endif
