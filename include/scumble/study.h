// What a picture of a painting tells of how it was painted, in numbers that a painter would use, and a look
// that follows from them. Nothing is learned and nothing is guessed: docs/study.md says how each number is
// found, which knobs follow from it, and what a picture cannot tell. Functions here keep nothing between
// calls.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scumble/export.h"
#include "scumble/image.h"
#include "scumble/look.h"
#include "scumble/result.h"

namespace scumble {

// Pictures with more lines, or more pixels, are made smaller before they are looked at; lengths are told for
// 1080 lines, as knobs have them.
constexpr uint32_t kStudyLines = 540;
constexpr uint32_t kStudyPixels = 1 << 20;
constexpr uint32_t kLeastStudySide = 64;  // pixels, as it is looked at
// With fewer lines the raster is as coarse as what brushes leave: looks leave edges, strokes and widths out.
constexpr uint32_t kLeastLinesForMarks = 400;

// One side of the picture's main division of values. Lightness and chroma are OKLab's (Ottosson 2020).
struct ColorFamily {
  double share = 0;      // of the picture, 0 to 1
  double lightness = 0;  // mean, 0 to 1
  double chroma = 0;     // mean length of (a, b)
  double hue = 0;        // of the mean of (a, b): degrees, 0 to 360
  glm::vec3 color{0};    // the mean, linear RGB
  double agreement = 0;  // how far its hues are one: length of the mean of (a, b) in chromas, 0 to 1
};

struct PaletteColor {
  glm::vec3 color{0};  // linear RGB
  double share = 0;    // of what is even in the picture, 0 to 1
};

struct StudiedLines {
  // Share of the borders between areas that have a thin dark line on them, and lines that are on no border,
  // in parts of the borders (of a 500th of the picture where there are fewer): that may be more than 1.
  double onBorders = 0, offBorders = 0;
  bool isDrawn = false;        // whether their sum is more than kDrawnLines; else what follows is 0
  double thin = 0, thick = 0;  // widths of which a quarter of the lines is thinner, thicker; px at 1080
  glm::vec3 color{0};          // linear RGB
};
constexpr double kDrawnLines = 0.67;

// What a brush leaves on areas. Lengths are those of a picture of kStudyLines or more.
struct StudiedMarks {
  double grain = 0;  // deviation of lightness from its mean over some 4 px at 1080: paper, canvas, bristles
  double contrast = 0;   // deviation of lightness between that and 32 px at 1080: strokes
  double width = 0;      // of strokes across them, px at 1080
  double direction = 0;  // how far they lie along each other: 0 in no direction, 1 all alike
};

struct StudiedBorders {
  double counted = 0;     // pieces of a border that could be followed, 64 px long at 1080
  double raggedness = 0;  // rms distance from a smooth curve, px at 1080; the median of the pieces
  double width = 0;       // over which one area turns into the other, px at 1080; the median
};

struct PictureStudy {
  uint32_t width = 0, height = 0;  // as it was looked at
  // OKLab lightness that 1, 50 and 99 % of the picture, without lines, are below, and the one that parts the
  // two families: Otsu's threshold (1979).
  double darkest = 0, median = 0, lightest = 0, division = 0;
  ColorFamily light, dark;
  double chroma = 0;  // mean; of a picture on paper, of what is painted
  // Its colours without lines, the largest first: 1 to 16, no two nearer than kNearColors in OKLab.
  std::vector<PaletteColor> palette;
  double fewness = 0;  // share of what is even that is one of these colours, within kNearColors, 0 to 1
  // The outer parts of the picture: its top, the middle and the bottom.
  glm::vec3 above{0}, horizon{0}, below{0};  // linear RGB
  StudiedLines lines;
  StudiedBorders borders;
  StudiedMarks marks;
  // Whether its lightest colour is bare paper: light, a tenth of the picture or more, in three of the corners
  // or all, and the picture has a grain.
  bool isOnPaper = false;
  glm::vec3 paper{0};  // its colour, linear RGB; where it is bare
};
constexpr double kNearColors = 0.04;

// Looks at a picture of colours in floats, R, G, B and perhaps A. What is transparent counts as white paper,
// and what is brighter than white as white. Takes some 0.5 s. Fails with usage for other pictures, such as
// are smaller than kLeastStudySide or would be, and such with values that are not finite.
SCUMBLE_API Result<PictureStudy> studyPicture(const Image& picture);

// The look that follows from what studyPicture gave, as a look's file, with comments that tell which number
// each knob comes from. `name`: of the picture, for the description.
SCUMBLE_API std::string lookTextOf(const PictureStudy& study, const std::string& name);

}  // namespace scumble
