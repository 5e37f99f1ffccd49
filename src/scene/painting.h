// Paintings in space: strokes of a brush, as the importers make them and everything behind reads them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "scene/scene_data.h"

namespace scumble::scene {

class ImportWarnings;

// What a brush lays down. Brushes of other programs become one of these.
enum class Brush : uint8_t {
  plain,     // a clean edge, all of one colour
  bristles,  // streaks along the stroke, and dry ends
  wash,      // soft and thin
  spatter,   // drops
  light,     // soft, and light is added to what is behind it
  gaussian,  // an ellipsoid that fades from its middle, by itself: no stroke names it
};
constexpr size_t kBrushes = 5;  // that strokes may name
const char* nameOf(Brush brush);

struct StrokePoint {
  glm::vec3 position{0.0f};  // metres, in the mesh's space
  float radius = 0.0f;       // metres: half of how wide the stroke is there; above 0
  // Of the brush: it faces along its z. Unit length.
  glm::quat orientation{1.0f, 0.0f, 0.0f, 0.0f};
  glm::vec4 color{1.0f};  // linear; A: how opaque, in [0, 1]
  float time = 0.0f;      // seconds since the painting was begun
  // Two standard deviations of a Gaussian along the axes of `orientation`, as parts of the radius.
  glm::vec3 shape{1.0f};
};

struct Stroke {
  uint32_t firstPoint = 0, pointCount = 0;  // at least one
  Brush brush = Brush::plain;
};

// Strokes in the order in which they were painted.
struct Painting {
  std::vector<Stroke> strokes;
  std::vector<StrokePoint> points;   // of one stroke after the other
  std::vector<std::string> brushes;  // as the file calls those that its strokes use
  float duration = 0;                // seconds: the latest time of a point
  // For who asks where it is: points that lie outermost, without triangles. Its box has all that strokes
  // cover.
  Primitive hull;

  // Adds a stroke with all points that number something; what is wrong with the others is warned of.
  void add(Brush brush, std::vector<StrokePoint> points, const std::string& path, ImportWarnings& warnings);
  // Lets times begin at 0.
  void beginAtZero();
  // Once all are there: the hull, and how long it took.
  void finish();
};

}  // namespace scumble::scene
