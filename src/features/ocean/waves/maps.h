// The maps that the ocean is painted with (Age of Sail, section 6.1, figure 19), each painted by code.
// Integers only: the bytes are the same on every machine.
#pragma once

#include "base/pixels.h"

namespace scumble::ocean {

enum class Mood { calmMorning, openSea, storm, evening };
constexpr Mood kMoods[] = {Mood::calmMorning, Mood::openSea, Mood::storm, Mood::evening};
// As users write it, e.g. "calm-morning".
const char* nameOf(Mood mood);

// The water's colours: u is the depth index, from the deep trough (0) to the thin sunlit crest (1); v the
// illumination, from shadow (0, the first row) to full light (1). Gets lighter along both. 128 x 64, sRGB.
Pixels bathic(Mood mood);

// The sky as the water shows it: u is the azimuth away from the sun, towards it (0) to the other side (1); v
// the elevation of the reflected ray, from horizon (0, the first row) to zenith (1). Alpha, straight: the
// part of the water that shows it where it faces that way; it holds what a Fresnel term would say. 64 x 64,
// sRGB.
Pixels sky(Mood mood);

}  // namespace scumble::ocean
