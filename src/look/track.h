// A knob's value that changes with time: keys, and how to go from one to the next.
#pragma once

#include <vector>

#include "look/param.h"
#include "scumble/look.h"

namespace scumble::look {

constexpr size_t kMaxTrackKeys = 100000;
// Seconds, some 30 years: differences of times stay exact to a ten-thousandth of a frame.
constexpr double kMaxKeyTime = 1e9;

struct Key {
  double time;  // seconds
  Value value;
};

struct Track {
  std::vector<Key> keys;  // at least one; times strictly increase
  Interpolation interpolation = Interpolation::linear;
  bool repeat = false;  // with the period last - first key's time; otherwise the ends' values stand

  // The value at a time in seconds, in the row's range. `step`: that of the last key before. `linear`.
  // `cubic`: Hermite with Catmull-Rom's tangents, (v[i+1] - v[i-1]) / (t[i+1] - t[i-1]), one-sided at the
  // ends, of which a track that repeats and ends as it begins has none. `ease`: Hermite too, but at rest at
  // the ends and at keys from which the values turn back or stay, and between two keys never beyond their
  // values. Colours are mixed in OKLab, integers rounded to the nearest.
  Value at(const ParamRow& row, double time) const;
};

// Whether there is something between a kind's values.
bool isSmooth(ParamKind kind);

}  // namespace scumble::look
