#include "study/lines.h"

#include <algorithm>
#include <cmath>

namespace scumble::study {

namespace {

constexpr int kReach = 2;  // pixels: what is thinner than 5 can be a line

// How wide a line is at a pixel, from what it covers of the row and of the column that go through: a line of
// width w at an angle covers w / sin and w / cos.
float widthAt(const Plane& drawn, int x, int y, float full) {
  const auto covered = [&](int dx, int dy) {
    float sum = 0;
    for (const int sign : {-1, 1})
      for (int k = sign < 0 ? 1 : 0; k < 4 * kReach; ++k) {
        const int atX = x + sign * k * dx, atY = y + sign * k * dy;
        if (atX < 0 || atY < 0 || atX >= drawn.width || atY >= drawn.height) break;
        const float part = drawn.at(atX, atY) / full;
        if (part < 0.1f) break;
        sum += std::min(1.0f, part);
      }
    return sum;
  };
  const float across = covered(1, 0), down = covered(0, 1);
  return across * down / std::hypot(across, down);
}

}  // namespace

Unlined withoutLines(const LabPicture& picture, double marks) {
  Unlined unlined;
  unlined.depth = std::max(0.12, 5 * marks);
  unlined.areas = closed(picture.lightness, kReach);
  unlined.drawn = difference(unlined.areas, picture.lightness);
  unlined.steep = steepness(blurred(unlined.areas, 1));
  const Plane nearLine = greatestWithin(unlined.drawn, 1);
  const size_t pixels = picture.lightness.values.size();
  unlined.isEven.resize(pixels);
  // Of a picture that is all strokes, these are its areas.
  const double even = std::max(kBorderSlope, marks);
  for (size_t i = 0; i < pixels; ++i)
    unlined.isEven[i] = nearLine.values[i] < 0.5 * unlined.depth && unlined.steep.values[i] < even;
  // Of noise nothing is: it is all that there is.
  if (std::none_of(unlined.isEven.begin(), unlined.isEven.end(), [](bool is) { return is; }))
    unlined.isEven.assign(pixels, true);
  return unlined;
}

StudiedLines linesOf(const LabPicture& picture, const Unlined& unlined) {
  const Plane& drawn = unlined.drawn;
  const Plane around = greatestWithin(drawn, 2);
  // A line's middle tells its colour and its width.
  std::vector<size_t> middles;
  std::vector<float> widths, depths;
  for (int y = 0; y < drawn.height; ++y)
    for (int x = 0; x < drawn.width; ++x) {
      const float deep = drawn.at(x, y);
      if (deep <= unlined.depth || deep < 0.999f * around.at(x, y)) continue;
      middles.push_back(size_t(y) * size_t(drawn.width) + size_t(x));
      depths.push_back(deep);
      widths.push_back(widthAt(drawn, x, y, deep));
    }
  StudiedLines lines;
  if (middles.empty()) return lines;

  // Thin lines are mixed with what they lie on; the deepest are not.
  const double deepest = quantile(depths, 0.8);
  glm::dvec3 color(0);
  double count = 0, squares = 0;
  for (const size_t middle : middles)
    if (drawn.values[middle] >= deepest) {
      const glm::dvec3 here = picture.at(middle);
      color += here, squares += here.x * here.x, count += 1;
    }
  color /= count;

  // Black areas need no line around them, and show none: with black lines, borders count where both sides are
  // lighter.
  const double deviation = std::sqrt(std::max(0.0, squares / count - color.x * color.x));
  const bool isOneBlack = deviation < 0.025 && std::hypot(color.y, color.z) < 0.03 && color.x < 0.4;
  const double visibleFrom = isOneBlack ? color.x + 0.12 : 0;
  const Plane darkest = leastWithin(unlined.areas, 2);
  double borders = 0, onBorders = 0, offBorders = 0;
  for (size_t i = 0; i < drawn.values.size(); ++i) {
    if (unlined.steep.values[i] <= kBorderSlope) {
      offBorders += drawn.values[i] > unlined.depth;
      continue;
    }
    if (darkest.values[i] < visibleFrom) continue;
    borders += 1;
    onBorders += around.values[i] > unlined.depth;
  }
  lines.onBorders = borders > 0 ? onBorders / borders : 0;
  // Of a picture with hardly a border, specks are no drawing.
  lines.offBorders = offBorders / std::max(borders, 0.002 * double(drawn.values.size()));
  lines.isDrawn = lines.onBorders + lines.offBorders > kDrawnLines;
  if (!lines.isDrawn) return lines;
  lines.thin = quantile(widths, 0.25) * picture.pixelsAt1080;
  lines.thick = quantile(widths, 0.75) * picture.pixelsAt1080;
  lines.color = rgbOf(color);
  return lines;
}

}  // namespace scumble::study
