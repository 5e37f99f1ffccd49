// The picture as a watercolour (paper 004, sections 3 and 4): pigment that is laid down around anchors on the
// surfaces, and washes of it on paper.
#pragma once

#include <memory>

#include "frame/pass.h"

namespace scumble::watercolor {

inline constexpr const char* kName = "watercolor";

// At a quarter of the size. R: how much more pigment there is than elsewhere, G: how much warmer it is, both
// around 1/2; B: how wet it is.
inline constexpr frame::Role kPigment{"pigment"};
// Colours that stamps have of their own, premultiplied, where any have.
inline constexpr frame::Role kTints{"pigment tints"};

std::unique_ptr<frame::Pass> makePigment();
// Gives frame::kPaintedExtent.
std::unique_ptr<frame::Pass> makeExtent();
std::unique_ptr<frame::Pass> makeWash();

}  // namespace scumble::watercolor
