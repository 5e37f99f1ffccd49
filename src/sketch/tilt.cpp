// A .tilt's strokes: data.sketch, whose brushes and layers metadata.json names.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <optional>

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
constexpr int kScaleBit = 1, kLayerBit = 4, kFirstLongBit = 16;
// Of its points'.
constexpr uint32_t kPressureBit = 1, kTimeBit = 2;

struct TiltBrush {
  std::string name;
  KnownBrush known{"", Brush::plain, 1, 1};
};

// Open Brush's: whether what is on it is shown, and what moves that, in Unity's axes and decimetres.
struct TiltLayer {
  bool isShown = true;
  glm::vec3 translation{0.0f};
  glm::quat rotation{1, 0, 0, 0};
  float scale = 1;

  void move(StrokePoint& point) const {
    // As positionOf() and orientationOf() have turned the axes.
    const glm::vec3 by = kMetresOfUnit * glm::vec3(translation.x, translation.y, -translation.z);
    const glm::quat turn(rotation.w, -rotation.x, -rotation.y, rotation.z);
    point.position = by + turn * (scale * point.position);
    point.orientation = turn * point.orientation;
    point.radius *= scale;
  }
};

// Numbers of a list; nothing where it is none of so many.
std::optional<std::vector<float>> numbersOf(const Json& list, size_t count) {
  if (!list.is_array() || list.size() != count) return std::nullopt;
  std::vector<float> numbers;
  for (const Json& number : list) {
    if (!number.is_number() || !std::isfinite(number.get<double>())) return std::nullopt;
    numbers.push_back(float(number.get<double>()));
  }
  return numbers;
}

std::vector<TiltLayer> readLayers(const Json& root, ImportWarnings& warnings) {
  std::vector<TiltLayer> layers;
  const auto list = root.find("Layers");
  if (list == root.end() || !list->is_array()) return layers;
  for (const Json& json : *list) {
    TiltLayer& layer = layers.emplace_back();
    if (!json.is_object()) continue;
    const auto visible = json.find("Visible"), transform = json.find("Transform");
    layer.isShown = visible == json.end() || !visible->is_boolean() || visible->get<bool>();
    if (transform == json.end()) continue;
    // Translation, rotation and scale.
    const bool isWhole = transform->is_array() && transform->size() == 3 && (*transform)[2].is_number();
    const auto translation = isWhole ? numbersOf((*transform)[0], 3) : std::nullopt,
               rotation = isWhole ? numbersOf((*transform)[1], 4) : std::nullopt;
    if (!translation || !rotation) {
      warnings.add("metadata.json (Layers)",
                   "a layer's transform is ignored: it is no three parts of numbers");
      continue;
    }
    const glm::quat turn((*rotation)[3], (*rotation)[0], (*rotation)[1], (*rotation)[2]);
    layer.translation = {(*translation)[0], (*translation)[1], (*translation)[2]};
    if (glm::length(turn) > 1e-6f) layer.rotation = glm::normalize(turn);
    if (const float scale = (*transform)[2].get<float>(); scale > 0 && std::isfinite(scale))
      layer.scale = scale;
  }
  return layers;
}

// What a sketch holds beside strokes, each kind once. Guides are for the hand that paints, and are in no
// picture.
void tellOthers(const Json& root, ImportWarnings& warnings) {
  constexpr std::pair<const char*, const char*> kOthers[] = {
      {"ModelIndex", "models"}, {"ImageIndex", "images"},          {"Videos", "videos"},
      {"TextWidgets", "texts"}, {"LightWidgets", "lamps"},         {"SoundClips", "sounds"},
      {"Lights", "own lights"}, {"Environment", "own environment"}};
  for (const auto& [member, what] : kOthers)
    if (const auto found = root.find(member);
        found != root.end() && (found->is_array() || found->is_object()) && !found->empty())
      warnings.add(std::string("metadata.json (") + member + ")",
                   std::string("the sketch's ") + what + " are not read: it is drawn without");
}

std::vector<TiltBrush> readBrushes(const Json& root) {
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
  const Json root = parseJson({reinterpret_cast<const char*>(metadata.data()), metadata.size()});
  if (!root.is_object()) fail("metadata.json", "is no JSON object", "get the file again");
  const std::vector<TiltBrush> brushes = readBrushes(root);
  const std::vector<TiltLayer> layers = readLayers(root, warnings);
  tellOthers(root, warnings);
  ByteReader reader(sketch, "data.sketch");
  if (reader.read<uint32_t>() != kSentinel)
    fail("data.sketch", "does not begin as a sketch does", "the file is damaged; get it again");
  const auto version = reader.read<int32_t>();
  if (version < 5 || version > 6)
    fail("data.sketch", fmt::format("is of version {}", version), "versions 5 and 6 can be read");
  reader.take(4);  // reserved
  reader.take(reader.count<uint32_t>(1));

  Painting painting;
  const auto layerAt = [&](uint32_t index) { return index < layers.size() ? layers[index] : TiltLayer(); };
  std::vector<bool> isUsed(brushes.size());
  constexpr size_t kLeastStroke = 36, kLeastPoint = 28;
  const size_t strokes = reader.count<int32_t>(kLeastStroke);
  for (size_t s = 0; s < strokes; ++s) {
    const auto brushIndex = reader.read<int32_t>();
    if (brushIndex < 0 || size_t(brushIndex) >= brushes.size())
      reader.failHere(fmt::format("asks for brush {}, of {}", brushIndex, brushes.size()));
    const TiltBrush& brush = brushes[size_t(brushIndex)];
    glm::vec4 color;
    for (int c = 0; c < 4; ++c) color[c] = reader.read<float>();
    for (int c = 0; c < 3; ++c) color[c] = linearOf(color[c]);
    const auto size = reader.read<float>();
    const auto strokeMask = reader.read<uint32_t>(), pointMask = reader.read<uint32_t>();
    float scale = 1;
    TiltLayer layer = layerAt(0);
    for (int bit = 0; bit < 32; ++bit) {
      if (!(strokeMask >> bit & 1)) continue;
      if (bit >= kFirstLongBit)
        reader.take(reader.count<uint32_t>(1));
      else if (bit == kScaleBit)
        scale = reader.read<float>();
      else if (bit == kLayerBit)
        layer = layerAt(reader.read<uint32_t>());
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
      layer.move(point);
    }
    if (!layer.isShown) continue;
    isUsed[size_t(brushIndex)] = true;
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
