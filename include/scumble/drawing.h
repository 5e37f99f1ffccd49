// Drawings: the lines of a frame as strokes, for plotters and for editors of vector graphics.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "scumble/export.h"
#include "scumble/result.h"

namespace scumble {

// The strokes of one view, those of a layer one after the other; later ones lie above. The same frame has the
// same strokes in the same order.
struct Drawing {
  // Where a stroke passes: pixels from the picture's upper left corner, pixel (0, 0) reaching from 0 to 1;
  // and half its width there, pixels.
  struct Point {
    float x = 0, y = 0, radius = 0;
  };

  struct Stroke {
    std::string layer;          // its kind, as the look's knobs call it, e.g. "silhouettes"
    glm::vec3 color{0.0f};      // linear
    bool isHidden = false;      // something is before it
    bool isClosed = false;      // the last point leads back to the first one
    std::vector<Point> points;  // two or more
  };

  uint32_t width = 0, height = 0;  // pixels
  std::vector<Stroke> strokes;
  uint32_t leftOut = 0;  // lines that there was no room for
};

struct SvgOptions {
  // Whether a stroke is its middle line, of one width, for plotters; else it is a filled shape, which is as
  // wide as it is drawn.
  bool centerlines = false;
  bool hidden = false;  // hidden strokes too, dashed, in layers of their own
};

// An SVG 1.1 document: a group for each kind of lines, which Inkscape shows as a layer.
SCUMBLE_API std::string svgOf(const Drawing& drawing, const SvgOptions& options = {});

// The same as a file, which appears whole or not at all. Fails with ErrorKind::outputNotWritten.
SCUMBLE_API Status writeSvg(const std::string& path, const Drawing& drawing, const SvgOptions& options = {});

// Two drawings in one: left | right, or left over right.
SCUMBLE_API Drawing sideBySide(const Drawing& left, const Drawing& right);
SCUMBLE_API Drawing overUnder(const Drawing& left, const Drawing& right);

}  // namespace scumble
