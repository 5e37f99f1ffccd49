#include "study/families.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace scumble::study {

double divisionOf(const Plane& lightness) {
  constexpr int kBins = 256;
  const auto [least, greatest] = std::minmax_element(lightness.values.begin(), lightness.values.end());
  const double from = *least, span = *greatest - from;
  if (span < 1e-6) return from;
  std::array<double, kBins> counts{};
  for (const float value : lightness.values)
    counts[size_t(std::min(kBins - 1, int((value - from) / span * kBins)))] += 1;
  double all = 0, sum = 0;
  for (int i = 0; i < kBins; ++i) all += counts[size_t(i)], sum += i * counts[size_t(i)];
  double below = 0, sumBelow = 0, best = -1;
  // Where nothing lies between the two sides, any value there parts them alike: the middle one.
  int first = 0, last = 0;
  for (int i = 0; i < kBins - 1; ++i) {
    below += counts[size_t(i)], sumBelow += i * counts[size_t(i)];
    if (below == 0 || below == all) continue;
    const double apart = sumBelow / below - (sum - sumBelow) / (all - below);
    const double between = below * (all - below) * apart * apart;
    if (between > best * (1 + 1e-12)) best = between, first = i;
    if (between >= best * (1 - 1e-12)) last = i;
  }
  return from + span * (0.5 * (first + last) + 1) / kBins;
}

ColorFamily familyOf(const LabPicture& picture, double division, bool isLight) {
  ColorFamily family;
  double count = 0;
  glm::dvec3 sum(0);
  const size_t pixels = picture.lightness.values.size();
  for (size_t i = 0; i < pixels; ++i) {
    const glm::dvec3 color = picture.at(i);
    if ((color.x > division) != isLight) continue;
    ++count;
    sum += color;
    family.chroma += std::hypot(color.y, color.z);
  }
  if (count == 0) return family;
  sum /= count;
  family.color = rgbOf(sum);
  family.share = count / double(pixels);
  family.lightness = sum.x;
  family.chroma /= count;
  family.hue = std::atan2(sum.z, sum.y) * 180 / std::numbers::pi;
  if (family.hue < 0) family.hue += 360;
  // Of greys, whose chroma is rounding, no hue is meant.
  if (family.chroma > 1e-3) family.agreement = std::hypot(sum.y, sum.z) / family.chroma;
  return family;
}

}  // namespace scumble::study
