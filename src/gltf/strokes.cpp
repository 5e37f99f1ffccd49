#include "gltf/strokes.h"

#include <algorithm>
#include <string_view>

namespace scumble::gltf {

namespace {

constexpr uint64_t kLineStrip = 3;
constexpr const char* kBrush = "scumble_brush";

}  // namespace

Accessor openPoints(const Import& import, const JsonView& attributes, const char* semantic, int least,
                    int most, size_t count) {
  Accessor accessor =
      import.accessors.open(size_t(attributes.requiredIndex(semantic, import.accessors.count(), "accessor")));
  accessor.path = attributes.pathOf(semantic);
  if (accessor.columns != 1 || accessor.rows < least || accessor.rows > most)
    fail(accessor.path, "is not of the type that strokes need", "docs/paintings.md has the types");
  if (count > 0 && accessor.count != count)
    fail(accessor.path, "has another number of elements than POSITION", "export the scene again");
  return accessor;
}

namespace {

// One number or more a point, where the attribute is there and sound; false where not.
bool readOptional(const Import& import, const JsonView& attributes, const char* semantic, int least, int most,
                  size_t count, std::vector<float>& numbers, float otherwise, ImportWarnings& warnings) {
  if (!attributes.has(semantic)) return false;
  try {
    Accessor accessor = openPoints(import, attributes, semantic, least, most, count);
    // Whole numbers are colours of which the largest is 1, whether or not the file says so.
    if (std::string_view(semantic) == "COLOR_0") accessor.normalized |= accessor.type != ComponentType::f32;
    numbers.assign(count * size_t(most), otherwise);
    readFloats(accessor, {}, most, numbers.data());
    return true;
  } catch (const ImportFailure& failure) {
    warnIgnored(warnings, failure, "an attribute of a stroke");
    return false;
  }
}

}  // namespace

bool isStroke(const JsonView& primitive) {
  const JsonView attributes = primitive.object("attributes");
  return primitive.count("mode", 4) == kLineStrip && attributes && attributes.has("_RADIUS");
}

ReadStroke readStroke(const Import& import, const JsonView& primitive, ImportWarnings& warnings) {
  ReadStroke stroke;
  const JsonView attributes = primitive.object("attributes");
  if (primitive.has("indices")) warnings.add(primitive.path(), "indices of a stroke are ignored");
  const Accessor position = openPoints(import, attributes, "POSITION", 3, 3, 0);
  const size_t count = position.count;
  import.budget.takeBytes(count * (2 * sizeof(StrokePoint)), primitive.path());
  std::vector<float> positions(3 * count), radii(count), colors, turns, times;
  readFloats(position, {}, 3, positions.data());
  readFloats(openPoints(import, attributes, "_RADIUS", 1, 1, count), {}, 1, radii.data());
  readOptional(import, attributes, "COLOR_0", 3, 4, count, colors, 1, warnings);
  readOptional(import, attributes, "_ORIENTATION", 4, 4, count, turns, 0, warnings);
  readOptional(import, attributes, "_TIME", 1, 1, count, times, 0, warnings);
  stroke.points.resize(count);
  for (size_t i = 0; i < count; ++i) {
    StrokePoint& point = stroke.points[i];
    point.position = {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
    point.radius = radii[i];
    if (!colors.empty())
      point.color = {colors[4 * i], colors[4 * i + 1], colors[4 * i + 2], colors[4 * i + 3]};
    if (!turns.empty())
      point.orientation = {turns[4 * i + 3], turns[4 * i], turns[4 * i + 1], turns[4 * i + 2]};
    if (!times.empty()) point.time = times[i];
  }
  stroke.brushName = nameOf(Brush::plain);
  // Extras are whatever somebody put there.
  const auto extras = primitive.json().find("extras");
  if (extras == primitive.json().end() || !extras->is_object() || !extras->contains(kBrush) ||
      !(*extras)[kBrush].is_string())
    return stroke;
  stroke.brushName = (*extras)[kBrush].get<std::string>();
  for (size_t b = 0; b < kBrushes; ++b)
    if (stroke.brushName == nameOf(Brush(b))) {
      stroke.brush = Brush(b);
      return stroke;
    }
  warnings.add(primitive.pathOf("extras"),
               "a brush that is not known is taken for a plain one: " + stroke.brushName.substr(0, 80));
  return stroke;
}

void StrokeCollector::add(ReadStroke stroke, const std::string& path, ImportWarnings& warnings) {
  painting_.add(stroke.brush, std::move(stroke.points), path, warnings);
  if (std::find(painting_.brushes.begin(), painting_.brushes.end(), stroke.brushName) ==
      painting_.brushes.end())
    painting_.brushes.push_back(std::move(stroke.brushName));
}

void StrokeCollector::add(const std::vector<StrokePoint>& gaussians, const std::string& path,
                          ImportWarnings& warnings) {
  for (const StrokePoint& one : gaussians) painting_.add(Brush::gaussian, {one}, path, warnings);
  if (!gaussians.empty()) painting_.brushes.emplace_back(nameOf(Brush::gaussian));
}

std::shared_ptr<const Painting> StrokeCollector::finish() {
  if (painting_.strokes.empty()) return nullptr;
  painting_.finish();
  return std::make_shared<const Painting>(std::move(painting_));
}

}  // namespace scumble::gltf
