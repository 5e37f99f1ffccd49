// What ink's shaders are specialised to.
#ifndef SCUMBLE_INK_CHOICES_GLSL
#define SCUMBLE_INK_CHOICES_GLSL
#include "../../shading/geometry_constants.shared.h"
#include "ink.shared.h"

layout(constant_id = kPassId) const int kChoices = 0;
const int kUnit = kChoices >> kInkUnitBit & 3, kWeights = kChoices >> kInkWeightsBit & 3;
const int kPlacement = kChoices >> kInkPlacementBit & 1;
const bool kDoubled = (kChoices >> kInkDoubledBit & 1) != 0;
const int kTexture = kChoices >> kInkTextureBit & 3;
const bool kLamps = (kChoices >> kInkLampsBit & 1) != 0;  // point and spot lights count
const bool kBreaks = (kChoices >> kInkBreaksBit & 1) != 0;
const bool kHidden = (kChoices >> kInkHiddenBit & 1) != 0;  // what something hides is dashed
const bool kCovers = (kChoices >> kInkCoversBit & 1) != 0;  // nearer lines cover farther ones
const bool kCyclopean = (kChoices >> kInkCyclopeanBit & 1) != 0;
bool isShown(int kind) { return (kChoices >> (kInkKindsBit + kind) & 1) != 0; }
#endif
