// Example pictures that are built in.
#pragma once

#include "base/pixels.h"

namespace scumble {

// In the order of the rows in .params files: "torn|strokes|paper|sea|foam|nested".
//   torn     red, green: two independent fields, rough down to a few texels, so that edges are torn and
//            not wavy; blue: palette-knife marks
//   strokes  the marks alone, grey, lying along u
//   paper    grain, grey
//   sea      red, green, blue: three patterns of brush strokes as of a sea, lying along u
//   foam     the amount of foam at which a place is covered, grey
constexpr uint32_t kBuiltInSize = 256;  // texels; one texel a pixel at the default size
Pixels builtInExample(int index);

}  // namespace scumble
