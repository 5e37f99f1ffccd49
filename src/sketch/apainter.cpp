// A-Painter's paintings: its binary form, and its JSON.
#include <fmt/format.h>

#include "scene/json.h"
#include "sketch/brushes.h"
#include "sketch/byte_reader.h"
#include "sketch/sketch.h"

namespace scumble::sketch {

using namespace scene;

namespace {

constexpr int kVersion = 1;

// The brushes that a file names.
class Brushes {
 public:
  void add(std::string name) {
    const std::optional<KnownBrush> known = apainterBrush(name);
    known_.push_back(known.value_or(KnownBrush{"", Brush::plain, 0, 1}));
    names_.push_back(std::move(name));
    isUsed_.push_back(false);
  }
  size_t size() const { return names_.size(); }
  const KnownBrush& use(size_t index) {
    isUsed_[index] = true;
    return known_[index];
  }
  void tell(Painting& painting, ImportWarnings& warnings) const {
    std::vector<UsedBrush> used;
    for (size_t b = 0; b < names_.size(); ++b)
      if (isUsed_[b]) used.push_back({names_[b], *known_[b].name != 0});
    tellBrushes(used, painting, warnings);
  }

 private:
  std::vector<std::string> names_;
  std::vector<KnownBrush> known_;
  std::vector<bool> isUsed_;
};

glm::vec4 colorOf(const float srgb[3]) {
  return {linearOf(srgb[0]), linearOf(srgb[1]), linearOf(srgb[2]), 1};
}

void setPressure(StrokePoint& point, const KnownBrush& brush, float size, float pressure) {
  pressure = glm::clamp(pressure, 0.0f, 1.0f);
  point.radius = 0.5f * size * glm::mix(brush.lightestWidth, 1.0f, pressure);
  point.color.a = glm::mix(brush.lightestOpacity, 1.0f, pressure);
}

std::string readText(ByteReader& reader) {
  const Bytes bytes = reader.take(reader.read<uint8_t>());
  return {bytes.begin(), bytes.end()};
}

[[noreturn]] void failOfVersion(int64_t version) {
  fail("version", fmt::format("is {}", version), fmt::format("version {} can be read", kVersion));
}

}  // namespace

Painting readApainter(Bytes file, ImportWarnings& warnings) {
  ByteReader reader(file, "painting");
  readText(reader);  // "apainter", which brought it here
  if (const auto version = reader.read<uint16_t>(); version != kVersion) failOfVersion(version);
  Brushes brushes;
  for (auto left = reader.read<uint8_t>(); left > 0; --left) brushes.add(readText(reader));
  Painting painting;
  constexpr size_t kStrokeBytes = 21, kPointBytes = 36;
  const size_t strokes = reader.count<uint32_t>(kStrokeBytes);
  for (size_t s = 0; s < strokes; ++s) {
    const auto index = reader.read<uint8_t>();
    if (index >= brushes.size())
      reader.failHere(fmt::format("asks for brush {}, of {}", index, brushes.size()));
    const KnownBrush& brush = brushes.use(index);
    float srgb[3];
    for (float& c : srgb) c = reader.read<float>();
    const auto size = reader.read<float>();
    std::vector<StrokePoint> points(reader.count<uint32_t>(kPointBytes));
    for (StrokePoint& point : points) {
      point.color = colorOf(srgb);
      for (int i = 0; i < 3; ++i) point.position[i] = reader.read<float>();
      const float x = reader.read<float>(), y = reader.read<float>(), z = reader.read<float>();
      point.orientation = {reader.read<float>(), x, y, z};
      setPressure(point, brush, size, reader.read<float>());
      point.time = 0.001f * float(reader.read<uint32_t>());
    }
    painting.add(brush.brush, std::move(points), "strokes", warnings);
  }
  if (reader.left() > 0)
    warnings.add(reader.path(), fmt::format("{} bytes after the last stroke are ignored", reader.left()));
  brushes.tell(painting, warnings);
  painting.beginAtZero();
  painting.finish();
  return painting;
}

Painting readApainterJson(Bytes file, ImportWarnings& warnings) {
  const Json json = parseJson({reinterpret_cast<const char*>(file.data()), file.size()});
  const JsonView root(&json, "");
  if (const uint64_t version = root.count("version", kVersion); version != kVersion)
    failOfVersion(int64_t(version));
  Brushes brushes;
  if (const JsonView names = root.list("brushes"))
    for (const Json& name : names.json()) {
      if (!name.is_string()) fail("brushes", "holds something that is no text");
      brushes.add(name.get<std::string>());
    }
  Painting painting;
  const JsonView strokes = root.list("strokes");
  for (size_t s = 0; s < strokes.size(); ++s) {
    const JsonView stroke = strokes.at(s), how = stroke.object("brush"), list = stroke.list("points");
    if (!how) stroke.failAt("brush", "is not there");
    const KnownBrush& brush = brushes.use(size_t(how.requiredIndex("index", brushes.size(), "brush")));
    float srgb[3] = {0, 0, 0};
    how.numbers("color", srgb, 3);
    const float size = how.number("size", 0);
    std::vector<StrokePoint> points(list.size());
    for (size_t i = 0; i < points.size(); ++i) {
      const JsonView from = list.at(i);
      StrokePoint& point = points[i];
      point.color = colorOf(srgb);
      float turn[4] = {0, 0, 0, 1};
      if (!from.numbers("position", &point.position.x, 3)) from.failAt("position", "is not there");
      from.numbers("orientation", turn, 4);
      point.orientation = {turn[3], turn[0], turn[1], turn[2]};
      setPressure(point, brush, size, from.number("pressure", 1));
      point.time = 0.001f * from.number("timestamp", 0);
    }
    painting.add(brush.brush, std::move(points), stroke.path(), warnings);
  }
  brushes.tell(painting, warnings);
  painting.beginAtZero();
  painting.finish();
  return painting;
}

}  // namespace scumble::sketch
