// How light colours are: ITU-R BT.709, of linear RGB.
#ifndef SCUMBLE_LUMINANCE_SHARED_H
#define SCUMBLE_LUMINANCE_SHARED_H
#include "shared_types.h"

SHARED_BEGIN
const vec3 kLuminance = vec3(0.2126, 0.7152, 0.0722);
// 1 where a colour's luminance is clearly less than `blacks`, 0 where it is more, and where `blacks` is 0.
SHARED_FUNCTION float blackness(float luminance, float blacks) {
  return float(blacks > 0.0f) * (1.0f - smoothstep(0.995f * blacks, 1.005f * max(blacks, 1e-6f), luminance));
}
SHARED_END
#endif
