// Statistics of fields over the pixels that count. Where several fields are given they are samples of one
// thing, e.g. of a texture at several offsets, and are taken together; channels are taken together as a
// vector.
#pragma once

#include <span>
#include <vector>

#include "measure/field.h"

namespace scumble::measuring {

// Of each channel; 0 where nothing is valid.
std::vector<double> meanOf(std::span<const Field> fields);

// Root of the summed variances of the channels; the mean is that of all fields. 0 where nothing is valid.
double spread(std::span<const Field> fields);

struct FieldDifference {
  double rms = 0;       // in the field's unit
  double relative = 0;  // rms / (sqrt(2) spread): 0 for the same field, 1 for two unrelated ones
  size_t pixels = 0;    // that count in both
};
FieldDifference difference(const Field& a, const Field& b);

// Frequency at which a field mostly varies, in cycles a pixel: that of the cosine whose autocorrelation falls
// to a half at the same lag, f = 1 / (6 lag); the lag is the mean of those along x and along y. Works on any
// mask. White noise gives 1/4; finer than that a picture cannot tell. 0 where the correlation stays above a
// half as far as the mask reaches.
double dominantFrequency(std::span<const Field> fields);

}  // namespace scumble::measuring
