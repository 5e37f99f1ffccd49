// A .tilt's strokes: data.sketch, whose brushes metadata.json names.
#include <fmt/format.h>

#include <bit>

#include "scene/json.h"
#include "sketch/brushes.h"
#include "sketch/byte_reader.h"
#include "sketch/sketch.h"

namespace scumble::sketch {

using namespace scene;

namespace {

constexpr uint32_t kSentinel = 0xC576A5CD;
constexpr float kMetresOfUnit = 0.1f;  // decimetres

// Bits of a stroke's extensions; those from 16 on say how long they are.
constexpr int kScaleBit = 1, kFirstLongBit = 16;
// Of its points'.
constexpr uint32_t kPressureBit = 1, kTimeBit = 2;

struct TiltBrush {
  std::string name;
  KnownBrush known{"", Brush::plain, 1, 1};
};

std::vector<TiltBrush> readBrushes(Bytes metadata) {
  const Json root = parseJson({reinterpret_cast<const char*>(metadata.data()), metadata.size()});
  if (!root.is_object()) fail("metadata.json", "is no JSON object", "get the file again");
  const Json* const list = root.contains("BrushIndex") ? &root["BrushIndex"] : nullptr;
  if (!list || !list->is_array())
    fail("metadata.json (BrushIndex)", "names no brushes", "get the file again");
  std::vector<TiltBrush> brushes;
  for (const Json& guid : *list) {
    if (!guid.is_string()) fail("metadata.json (BrushIndex)", "holds something that is no text");
    TiltBrush& brush = brushes.emplace_back();
    brush.name = guid.get<std::string>();
    if (const std::optional<KnownBrush> known = tiltBrush(brush.name))
      brush.known = *known, brush.name = known->name;
  }
  return brushes;
}

// Unity's axes, of which z points away, become ours.
glm::vec3 positionOf(ByteReader& reader) {
  const float x = reader.read<float>(), y = reader.read<float>(), z = reader.read<float>();
  return kMetresOfUnit * glm::vec3(x, y, -z);
}
glm::quat orientationOf(ByteReader& reader) {
  const float x = reader.read<float>(), y = reader.read<float>(), z = reader.read<float>(),
              w = reader.read<float>();
  return {w, -x, -y, z};
}

}  // namespace

Painting readTilt(Bytes metadata, Bytes sketch, ImportWarnings& warnings) {
  const std::vector<TiltBrush> brushes = readBrushes(metadata);
  ByteReader reader(sketch, "data.sketch");
  if (reader.read<uint32_t>() != kSentinel)
    fail("data.sketch", "does not begin as a sketch does", "the file is damaged; get it again");
  const auto version = reader.read<int32_t>();
  if (version < 5 || version > 6)
    fail("data.sketch", fmt::format("is of version {}", version), "versions 5 and 6 can be read");
  reader.take(4);  // reserved
  reader.take(reader.count<uint32_t>(1));

  Painting painting;
  std::vector<bool> isUsed(brushes.size());
  constexpr size_t kLeastStroke = 36, kLeastPoint = 28;
  const size_t strokes = reader.count<int32_t>(kLeastStroke);
  for (size_t s = 0; s < strokes; ++s) {
    const auto brushIndex = reader.read<int32_t>();
    if (brushIndex < 0 || size_t(brushIndex) >= brushes.size())
      reader.failHere(fmt::format("asks for brush {}, of {}", brushIndex, brushes.size()));
    const TiltBrush& brush = brushes[size_t(brushIndex)];
    isUsed[size_t(brushIndex)] = true;
    glm::vec4 color;
    for (int c = 0; c < 4; ++c) color[c] = reader.read<float>();
    for (int c = 0; c < 3; ++c) color[c] = linearOf(color[c]);
    const auto size = reader.read<float>();
    const auto strokeMask = reader.read<uint32_t>(), pointMask = reader.read<uint32_t>();
    float scale = 1;
    for (int bit = 0; bit < 32; ++bit) {
      if (!(strokeMask >> bit & 1)) continue;
      if (bit >= kFirstLongBit)
        reader.take(reader.count<uint32_t>(1));
      else if (bit == kScaleBit)
        scale = reader.read<float>();
      else
        reader.take(4);
    }
    const size_t pointBytes = kLeastPoint + 4 * size_t(std::popcount(pointMask));
    std::vector<StrokePoint> points(reader.count<int32_t>(pointBytes));
    for (StrokePoint& point : points) {
      point.position = positionOf(reader);
      point.orientation = orientationOf(reader);
      const float pressure = pointMask & kPressureBit ? glm::clamp(reader.read<float>(), 0.0f, 1.0f) : 1.0f;
      if (pointMask & kTimeBit) point.time = 0.001f * float(reader.read<uint32_t>());
      reader.take(4 * size_t(std::popcount(pointMask & ~(kPressureBit | kTimeBit))));
      point.radius =
          0.5f * kMetresOfUnit * size * scale * glm::mix(brush.known.lightestWidth, 1.0f, pressure);
      point.color = color;
      point.color.a *= glm::mix(brush.known.lightestOpacity, 1.0f, pressure);
    }
    painting.add(brush.known.brush, std::move(points), "data.sketch", warnings);
  }
  if (reader.left() > 0)
    warnings.add(reader.path(), fmt::format("{} bytes after the last stroke are ignored", reader.left()));
  std::vector<UsedBrush> used;
  for (size_t b = 0; b < brushes.size(); ++b)
    if (isUsed[b]) used.push_back({brushes[b].name, *brushes[b].known.name != 0});
  tellBrushes(used, painting, warnings);
  painting.beginAtZero();
  painting.finish();
  return painting;
}

}  // namespace scumble::sketch
