// libFuzzer target for paintings of other programs: any bytes as a file, and as the strokes of a .tilt whose
// brushes are known. What it may find are sanitizer reports, and data that breaks the promises of
// scene/painting.h. Built and run as gltf_fuzz is.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "scene/extras.h"
#include "scene/import_failure.h"
#include "scumble/scene.h"
#include "sketch/sketch.h"
#include "tests/fuzz/fuzz_target.h"

const std::vector<scumble::scene::ExtraRule>& scumble::scene::extraRules() {
  static const std::vector<ExtraRule> none;
  return none;
}

namespace {

using namespace scumble;
using namespace scumble::scene;
using fuzz::require;

constexpr char kMetadata[] =
    R"({"BrushIndex": ["c515dad7-4393-4681-81ad-162ef052241b", "not known", "429ed64a-4e97-4466-84d3-145a861ef684"]})";

void check(const Painting& painting) {
  size_t next = 0;
  for (const Stroke& stroke : painting.strokes) {
    require(stroke.firstPoint == next && stroke.pointCount > 0, "one stroke after the other");
    require(size_t(stroke.brush) < kBrushes, "brush");
    next += stroke.pointCount;
  }
  require(next == painting.points.size(), "every point is of a stroke");
  for (const StrokePoint& p : painting.points) {
    for (int c = 0; c < 3; ++c) require(std::isfinite(p.position[c]), "finite position");
    for (int c = 0; c < 4; ++c) require(p.color[c] >= 0 && p.color[c] <= 1, "color");
    require(p.radius > 0 && std::isfinite(p.radius), "radius");
    require(std::abs(glm::length(p.orientation) - 1) < 1e-3f, "unit orientation");
    require(p.time >= 0 && p.time <= painting.duration, "time");
  }
}

// The bytes behind a sketch's beginning: version, no more header, one stroke of two points.
std::string seed(int32_t brush, uint32_t strokeMask, uint32_t pointMask) {
  std::string bytes;
  const auto put = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(uint32_t(0xC576A5CD));
  for (const int32_t number : {5, 0, 0, 1, brush}) put(number);
  for (const float number : {1.0f, 0.5f, 0.25f, 1.0f, 0.3f}) put(number);
  put(strokeMask);
  put(pointMask);
  for (int bit = 0; bit < 32; ++bit)
    if (strokeMask >> bit & 1) put(bit < 16 ? 1.0f : 0.0f);
  put(int32_t(2));
  for (int point = 0; point < 2; ++point) {
    for (const float number : {0.1f * float(point), 1.0f, 2.0f, 0.0f, 0.0f, 0.0f, 1.0f}) put(number);
    for (int bit = 0; bit < 32; ++bit)
      if (pointMask >> bit & 1) put(bit == 0 ? 0.5f : 0.0f);
  }
  return bytes;
}

}  // namespace

void scumble::fuzz::writeSeeds(const std::string& folder) {
  write(folder, "plain.sketch", seed(0, 0, 3));
  write(folder, "rich.sketch", seed(1, 0x0003003F, 0xF));
  write(folder, "painting.json",
        R"({"version": 1, "strokes": [{"brush": {"index": 0, "color": [1, 0, 0], "size": 0.1},
    "points": [{"position": [0, 1, 2], "orientation": [0, 0, 0, 1], "pressure": 0.5, "timestamp": 1000}]}],
    "brushes": ["flat"]})");
  std::string painting(
      "\x08"
      "apainter\x01\0\x01\x04"
      "flat",
      16);
  const uint32_t one = 1, time = 7;
  const float numbers[] = {1, 0, 0, 0.1f}, point[] = {0, 1, 2, 0, 0, 0, 1, 0.5f};
  const auto put = [&](const auto& value) {
    painting.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(one), painting += '\0', put(numbers), put(one), put(point), put(time);
  write(folder, "painting.apa", painting);
  write(folder, "cut.tilt", std::string("tilT\x10\0\x01\0\0\0\0\0\0\0\0\0PK\x03\x04", 20));
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  const Bytes given(bytes, size);
  if (sketch::isSketch(given)) {
    const Result<Scene> scene = Scene::loadFromMemory(bytes, size, "fuzz", "");
    if (scene)
      check(*scene->data().meshes[0]->painting);
    else
      require(scene.error().kind == ErrorKind::unusableFile && !scene.error().problem.empty(),
              "an error that says something");
    return 0;
  }
  ImportWarnings warnings;
  try {
    check(sketch::readTilt({reinterpret_cast<const uint8_t*>(kMetadata), sizeof kMetadata - 1}, given,
                           warnings));
  } catch (const ImportFailure& failure) {
    require(!failure.error.problem.empty(), "an error that says something");
  }
  return 0;
}
