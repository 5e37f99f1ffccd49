#include "scumble/study.h"

#include <algorithm>
#include <cmath>

#include "base/usage.h"
#include "study/borders.h"
#include "study/families.h"
#include "study/lines.h"
#include "study/marks.h"
#include "study/palette.h"

namespace scumble {

namespace {

using namespace study;

// The middle colour of a picture's outer quarters, left and right, between two shares of its height. What a
// picture is about stands between them more often than not.
glm::vec3 outerColor(const LabPicture& picture, double from, double to) {
  const int width = picture.lightness.width, height = picture.lightness.height;
  std::vector<float> parts[3];
  for (int y = int(from * height); y < int(std::ceil(to * height)) && y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (4 * x >= width && 4 * (width - 1 - x) >= width) continue;
      const glm::dvec3 color = picture.at(size_t(y) * size_t(width) + size_t(x));
      for (int k = 0; k < 3; ++k) parts[k].push_back(float(color[k]));
    }
  return rgbOf({quantile(parts[0], 0.5), quantile(parts[1], 0.5), quantile(parts[2], 0.5)});
}

// The palette's lightest colour, if that is bare paper.
const LabColor* paperIn(const Palette& palette, const LabPicture& picture, double grain) {
  constexpr double kLight = 0.85, kShare = 0.1, kGrain = 0.004, kCorner = 0.04;
  if (palette.colors.empty() || grain < kGrain) return nullptr;
  const LabColor& paper =
      *std::max_element(palette.colors.begin(), palette.colors.end(),
                        [](const LabColor& a, const LabColor& b) { return a.lab.x < b.lab.x; });
  if (paper.lab.x < kLight || paper.share < kShare) return nullptr;
  const int width = picture.lightness.width, height = picture.lightness.height;
  const int side = std::max(1, int(kCorner * std::min(width, height)));
  int bare = 0;
  for (const int left : {0, width - side})
    for (const int top : {0, height - side}) {
      glm::dvec3 mean(0);
      for (int y = top; y < top + side; ++y)
        for (int x = left; x < left + side; ++x)
          mean += picture.at(size_t(y) * size_t(width) + size_t(x)) / double(side * side);
      bare += glm::distance(mean, paper.lab) < kNearColors;
    }
  return bare >= 3 ? &paper : nullptr;
}

// The mean; of a picture on paper, of what is painted.
double chromaOf(const LabPicture& picture, const LabColor* paper) {
  double sum = 0, count = 0;
  for (size_t i = 0; i < picture.lightness.values.size(); ++i) {
    const glm::dvec3 color = picture.at(i);
    if (paper && glm::distance(color, paper->lab) < kNearColors) continue;
    sum += std::hypot(color.y, color.z), count += 1;
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace

Result<PictureStudy> studyPicture(const Image& picture) {
  const std::vector<std::string>& names = picture.channels;
  const bool isRgb = (names.size() == 3 || (names.size() == 4 && names[3] == "A")) && names[0] == "R" &&
                     names[1] == "G" && names[2] == "B";
  if (!isRgb || !picture.isColor || picture.format != PixelFormat::float32 ||
      picture.pixels.size() != size_t(picture.width) * picture.height * picture.channels.size())
    return usage("what is studied is no picture of colours in floats", "read one with readPicture()");
  if (std::any_of(picture.pixels.begin(), picture.pixels.end(), [](float v) { return !std::isfinite(v); }))
    return usage("the picture has values that are not finite", "give one without");

  const double most = std::sqrt(double(kStudyPixels) * picture.height / picture.width);
  if (picture.width == 0 || picture.height == 0)
    return usage("the picture has no pixels", "give one with some");
  const LabPicture lab = labOf(picture, uint32_t(std::clamp(most, 1.0, double(kStudyLines))));
  PictureStudy found;
  found.width = uint32_t(lab.lightness.width), found.height = uint32_t(lab.lightness.height);
  if (std::min(found.width, found.height) < kLeastStudySide)
    return usage("a picture of " + std::to_string(picture.width) + " x " + std::to_string(picture.height) +
                     " pixels is too small or too narrow to see how it was painted",
                 "give one of " + std::to_string(kLeastStudySide) + " pixels a side or more");
  found.division = divisionOf(lab.lightness);
  found.light = familyOf(lab, found.division, true);
  found.dark = familyOf(lab, found.division, false);

  found.marks = marksOf(lab);
  const Unlined unlined = withoutLines(lab, found.marks.contrast);
  std::vector<float> values = unlined.areas.values;
  found.darkest = quantile(values, 0.01);
  found.median = quantile(values, 0.5);
  found.lightest = quantile(values, 0.99);
  const Palette palette = paletteOf(lab, unlined.isEven);
  for (const LabColor& color : palette.colors) found.palette.push_back({rgbOf(color.lab), color.share});
  found.fewness = palette.fewness;
  found.above = outerColor(lab, 0, 0.125);
  found.horizon = outerColor(lab, 0.375, 0.5);
  found.below = outerColor(lab, 0.875, 1);
  found.lines = linesOf(lab, unlined);
  // Without lines the notches of torn edges are whole.
  found.borders = bordersOf(found.lines.isDrawn ? unlined.areas : lab.lightness, lab.pixelsAt1080);
  const LabColor* const paper = paperIn(palette, lab, found.marks.grain);
  found.isOnPaper = paper != nullptr;
  if (paper) found.paper = rgbOf(paper->lab);
  found.chroma = chromaOf(lab, paper);
  return found;
}

}  // namespace scumble
