// Strokes of paintings in space: LINE_STRIP primitives that say how wide they are.
#pragma once

#include <string>
#include <vector>

#include "gltf/import.h"
#include "scene/painting.h"

namespace scumble::gltf {

struct ReadStroke {
  std::vector<StrokePoint> points;
  Brush brush = Brush::plain;
  std::string brushName;
};

// Whether a primitive is one: a LINE_STRIP with _RADIUS.
bool isStroke(const JsonView& primitive);

// An accessor of points, of `least` to `most` components and of `count` of them (0: of as many as there are);
// fails where it is another one.
Accessor openPoints(const Import& import, const JsonView& attributes, const char* semantic, int least,
                    int most, size_t count);

// Its attributes: POSITION and _RADIUS (metres); COLOR_0, linear, A: opacity; _ORIENTATION, a quaternion, by
// which the brush faces along its z; _TIME, seconds. Its brush, by name, in extras: {"scumble_brush":
// "bristles"}. What is broken besides position and radius is left out with a warning.
ReadStroke readStroke(const Import& import, const JsonView& primitive, ImportWarnings& warnings);

// One stroke after the other to a mesh.
class StrokeCollector {
 public:
  void add(ReadStroke stroke, const std::string& path, ImportWarnings& warnings);
  // Gaussians, each a stroke by itself, in the file's order.
  void add(const std::vector<StrokePoint>& gaussians, const std::string& path, ImportWarnings& warnings);
  // Null where there were none.
  std::shared_ptr<const Painting> finish();

 private:
  Painting painting_;
};

}  // namespace scumble::gltf
