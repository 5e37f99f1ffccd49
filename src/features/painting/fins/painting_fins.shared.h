#ifndef SCUMBLE_PAINTING_FINS_SHARED_H
#define SCUMBLE_PAINTING_FINS_SHARED_H
#include "../../../shading/shared_types.h"

SHARED_BEGIN
struct FinsUniforms {
  float opacity;
};
const int kFinsBlock = 0;
SHARED_END
#endif
