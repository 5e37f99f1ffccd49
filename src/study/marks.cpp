#include "study/marks.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace scumble::study {

namespace {

// Deviations of Gaussians, pixels: what lies between two of them is an octave of sizes.
constexpr double kScales[] = {0.5, 1, 2, 4, 8, 16};
constexpr int kOctaves = int(std::size(kScales)) - 1;
constexpr int kTile = 24;  // pixels
// The deviation of a normal distribution whose size has the median 1.
constexpr double kOfMedian = 1.4826;

// The median is what most of the picture has: borders, which are in the lesser part, do not count.
double typical(const Plane& plane) {
  std::vector<float> sizes;
  sizes.reserve(plane.values.size());
  for (const float value : plane.values) sizes.push_back(std::abs(value));
  return kOfMedian * quantile(sizes, 0.5);
}

// How far gradients in one tile lie along each other: 0 in no direction, 1 all (the structure tensor's
// coherence, Bigun and Granlund 1987).
double directionIn(const Plane& marks, int left, int top) {
  double xx = 0, xy = 0, yy = 0;
  for (int y = top; y < top + kTile; ++y)
    for (int x = left; x < left + kTile; ++x) {
      const double dx = 0.5 * (marks.at(x + 1, y) - marks.at(x - 1, y)),
                   dy = 0.5 * (marks.at(x, y + 1) - marks.at(x, y - 1));
      xx += dx * dx, xy += dx * dy, yy += dy * dy;
    }
  return xx + yy > 0 ? std::hypot(xx - yy, 2 * xy) / (xx + yy) : 0;
}

}  // namespace

StudiedMarks marksOf(const LabPicture& picture) {
  StudiedMarks found;
  std::vector<Plane> scales;
  for (const double deviation : kScales) scales.push_back(blurred(picture.lightness, deviation));
  found.grain = typical(difference(picture.lightness, scales[1]));
  const Plane marks = difference(scales[1], scales[4]);
  found.contrast = typical(marks);
  // The octave that they are in, as the mean by power.
  double power = 0, octave = 0;
  for (int i = 0; i < kOctaves; ++i) {
    const double deviation = typical(difference(scales[size_t(i)], scales[size_t(i) + 1]));
    power += deviation * deviation, octave += i * deviation * deviation;
  }
  // A bar is strongest between two Gaussians whose deviations are half its width on the (geometric) mean.
  constexpr double kRounding = 1e-4;
  if (found.contrast > kRounding)
    found.width = 2 * kScales[0] * std::sqrt(2) * std::exp2(octave / power) * picture.pixelsAt1080;
  std::vector<float> directions;
  for (int top = 1; top + kTile < marks.height; top += kTile)
    for (int left = 1; left + kTile < marks.width; left += kTile)
      directions.push_back(float(directionIn(marks, left, top)));
  found.direction = quantile(directions, 0.5);
  return found;
}

}  // namespace scumble::study
