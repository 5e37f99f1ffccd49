// How light colours are: ITU-R BT.709, of linear RGB.
#ifndef SCUMBLE_LUMINANCE_SHARED_H
#define SCUMBLE_LUMINANCE_SHARED_H
#include "shared_types.h"

SHARED_BEGIN
const vec3 kLuminance = vec3(0.2126, 0.7152, 0.0722);
SHARED_END
#endif
