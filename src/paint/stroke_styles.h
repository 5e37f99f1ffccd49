// Ways of laying strokes: layers, each of one kind, the lowest first.
#pragma once

#include <string>
#include <vector>

#include "scene/painting.h"

namespace scumble::paint {

struct StrokeLayer {
  scene::Brush brush = scene::Brush::bristles;
  float share = 1;         // of all splats, against the other layers'
  float width = 1;         // half of it, in parts of the style's size
  float length = 8;        // in half widths
  float from = 0, to = 0;  // height of its beginning and its end, in parts of the style's height
  float tapersIn = 0.1f, tapersOut = 0.3f;  // over so much of its length
  float stands = 0;               // how much it goes away from the surface instead of along it: 0 to 1
  float lighter = 0, warmer = 0;  // than the surface; squares of square roots
  float opacity = 1;
  float wanders = 0.15f;  // how much directions vary, and turn along a stroke
};

struct StrokeStyle {
  const char* name;
  const char* meaning;
  float size, height;  // in parts of a mesh's radius
  std::vector<StrokeLayer> layers;
};

const std::vector<StrokeStyle>& strokeStyles();

}  // namespace scumble::paint
