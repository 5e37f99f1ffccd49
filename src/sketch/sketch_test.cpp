// Paintings of other programs: those that a test writes itself, broken ones, and (where they are at hand)
// real ones, each to its last byte.
#include "sketch/sketch.h"

#include <gtest/gtest.h>
#include <zip.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "base/srgb.h"
#include "scene/import_failure.h"
#include "scumble/scene.h"
#include "tests/support/asset_files.h"

namespace scumble::sketch {
namespace {

using namespace scene;
using Bytewise = std::vector<uint8_t>;

template <class T>
void put(Bytewise& to, T value) {
  const auto* bytes = reinterpret_cast<const uint8_t*>(&value);
  to.insert(to.end(), bytes, bytes + sizeof(T));
}

Bytewise textBytes(const std::string& text) {
  return {text.begin(), text.end()};
}

const std::string kOil = "c515dad7-4393-4681-81ad-162ef052241b",
                  kUnknown = "12345678-0000-0000-0000-000000000000";

Bytewise metadata() {
  return textBytes("{\"BrushIndex\": [\"" + kOil + "\", \"" + kUnknown + "\"], \"SchemaVersion\": 2}");
}

struct WrittenStroke {
  int32_t brush = 0;
  float size = 1;
  uint32_t strokeMask = 0, pointMask = 3;
  std::vector<glm::vec3> points;  // in the file's axes and units
  float pressure = 1;
  uint32_t milliseconds = 0;  // of the first; a tenth of a second more for each
};

Bytewise sketchOf(const std::vector<WrittenStroke>& strokes, int32_t version = 5) {
  Bytewise bytes;
  put<uint32_t>(bytes, 0xC576A5CD);
  put<int32_t>(bytes, version);
  put<int32_t>(bytes, 0);
  put<uint32_t>(bytes, 3);
  for (int i = 0; i < 3; ++i) put<uint8_t>(bytes, 7);
  put<int32_t>(bytes, int32_t(strokes.size()));
  for (const WrittenStroke& s : strokes) {
    put(bytes, s.brush);
    for (const float c : {1.0f, 0.5f, 0.0f, 0.75f}) put(bytes, c);
    put(bytes, s.size);
    put(bytes, s.strokeMask);
    put(bytes, s.pointMask);
    for (int bit = 0; bit < 32; ++bit) {
      if (!(s.strokeMask >> bit & 1)) continue;
      if (bit >= 16) {
        put<uint32_t>(bytes, 5);
        for (int i = 0; i < 5; ++i) put<uint8_t>(bytes, 9);
      } else if (bit == 1) {
        put<float>(bytes, 2);
      } else {
        put<uint32_t>(bytes, 4);
      }
    }
    put<int32_t>(bytes, int32_t(s.points.size()));
    uint32_t time = s.milliseconds;
    for (const glm::vec3& p : s.points) {
      for (int i = 0; i < 3; ++i) put(bytes, p[i]);
      for (const float q : {0.0f, std::sin(0.3f), 0.0f, std::cos(0.3f)}) put(bytes, q);
      for (int bit = 0; bit < 32; ++bit) {
        if (!(s.pointMask >> bit & 1)) continue;
        if (bit == 0)
          put(bytes, s.pressure);
        else if (bit == 1)
          put(bytes, time);
        else
          put<uint32_t>(bytes, 1);
      }
      time += 100;
    }
  }
  return bytes;
}

Bytewise zipped(const std::vector<std::pair<std::string, Bytewise>>& files, int method = ZIP_CM_STORE) {
  zip_error_t error;
  zip_source_t* const target = zip_source_buffer_create(nullptr, 0, 0, &error);
  zip_source_keep(target);
  zip_t* const zip = zip_open_from_source(target, ZIP_TRUNCATE, &error);
  for (const auto& [name, bytes] : files) {
    const zip_int64_t index =
        zip_file_add(zip, name.c_str(), zip_source_buffer(zip, bytes.data(), bytes.size(), 0), 0);
    zip_set_file_compression(zip, zip_uint64_t(index), method, 0);
  }
  zip_close(zip);
  zip_source_open(target);
  zip_source_seek(target, 0, SEEK_END);
  Bytewise packed(size_t(zip_source_tell(target)));
  zip_source_seek(target, 0, SEEK_SET);
  zip_source_read(target, packed.data(), packed.size());
  zip_source_close(target);
  zip_source_free(target);
  Bytewise file = textBytes("tilT");
  put<uint16_t>(file, 16);
  put<uint16_t>(file, 1);
  file.resize(16);
  file.insert(file.end(), packed.begin(), packed.end());
  return file;
}

Result<Scene> loaded(const Bytewise& file, const std::string& name) {
  return Scene::loadFromMemory(file.data(), file.size(), name, "");
}

std::string failureOf(const Bytewise& sketch) {
  ImportWarnings warnings;
  try {
    readTilt(metadata(), sketch, warnings);
  } catch (const ImportFailure& failure) {
    return failure.error.jsonPath + ": " + failure.error.problem;
  }
  return "";
}

TEST(Sketch, tiltStrokesAreRead) {
  const std::vector<WrittenStroke> strokes{
      {.points = {{1, 2, 3}, {4, 5, 6}}, .pressure = 0.5f, .milliseconds = 2000},
      {.brush = 1,
       .size = 0.2f,
       .strokeMask = 0x00030002,
       .pointMask = 7,
       .points = {{0, 0, 1}},
       .milliseconds = 2500}};
  for (const int32_t version : {5, 6})
    for (const int method : {ZIP_CM_STORE, ZIP_CM_DEFLATE}) {
      const Bytewise file = zipped({{"thumbnail.png", textBytes("no picture")},
                                    {"metadata.json", metadata()},
                                    {"data.sketch", sketchOf(strokes, version)}},
                                   method);
      const Result<Scene> scene = loaded(file, "oak.tilt");
      ASSERT_TRUE(scene) << scene.error().message();
      ASSERT_EQ(scene->data().meshes.size(), 1u);
      const Painting& painting = *scene->data().meshes[0]->painting;
      ASSERT_EQ(painting.strokes.size(), 2u);
      ASSERT_EQ(painting.points.size(), 3u);
      EXPECT_EQ(painting.strokes[0].brush, Brush::bristles);
      EXPECT_EQ(painting.strokes[1].brush, Brush::plain);
      EXPECT_EQ(painting.strokes[1].firstPoint, 2u);
      // Decimetres, and z turned towards the viewer.
      const StrokePoint& first = painting.points[0];
      EXPECT_EQ(first.position, 0.1f * glm::vec3(1, 2, -3));
      const glm::vec3 faces = first.orientation * glm::vec3(0, 0, 1);
      EXPECT_NEAR(faces.x, -std::sin(0.6f), 1e-6);
      EXPECT_NEAR(faces.z, std::cos(0.6f), 1e-6);
      // Half of the width at a pressure between the brush's least, a tenth, and its whole one.
      EXPECT_FLOAT_EQ(first.radius, 0.05f * 0.55f);
      EXPECT_FLOAT_EQ(first.color.g, float(linearFromSrgb(0.5)));
      EXPECT_FLOAT_EQ(first.color.a, 0.75f);
      // The second stroke's scale.
      EXPECT_FLOAT_EQ(painting.points[2].radius, 0.05f * 0.2f * 2);
      // From the first point on.
      EXPECT_FLOAT_EQ(first.time, 0);
      EXPECT_NEAR(painting.points[1].time, 0.1f, 1e-5);
      EXPECT_NEAR(painting.points[2].time, 0.5f, 1e-5);
      EXPECT_NEAR(painting.duration, 0.5f, 1e-5);
      EXPECT_EQ(scene->summary().strokes, 2u);
      EXPECT_EQ(scene->summary().brushes, (std::vector<std::string>{"OilPaint", kUnknown}));
      ASSERT_EQ(scene->warnings().size(), 1u);
      EXPECT_NE(scene->warnings()[0].find(kUnknown), std::string::npos);
    }
}

TEST(Sketch, whatIsCutOffOrWrongIsSaid) {
  const Bytewise whole = sketchOf({{.points = {{1, 2, 3}, {4, 5, 6}}}});
  EXPECT_EQ(failureOf(whole), "");
  for (size_t length = 0; length < whole.size(); ++length)
    EXPECT_NE(failureOf({whole.begin(), whole.begin() + long(length)}), "") << length;
  EXPECT_NE(failureOf(sketchOf({{.points = {{0, 0, 0}}}}, 4)).find("version 4"), std::string::npos);
  EXPECT_NE(failureOf(sketchOf({{.brush = 2, .points = {{0, 0, 0}}}})).find("brush 2"), std::string::npos);
  Bytewise counts = whole;
  const int32_t many = 1000000000, negative = -1;
  std::memcpy(&counts[19], &many, 4);
  EXPECT_NE(failureOf(counts).find("1000000000"), std::string::npos);
  std::memcpy(&counts[19], &negative, 4);
  EXPECT_NE(failureOf(counts).find("-1"), std::string::npos);
  // More than there should be is told, and no fault.
  Bytewise more = whole;
  more.resize(more.size() + 9);
  ImportWarnings warnings;
  EXPECT_EQ(readTilt(metadata(), more, warnings).strokes.size(), 1u);
  EXPECT_EQ(warnings.lines("x").size(), 1u);
}

TEST(Sketch, pointsThatAreNowhereAreLeftOut) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Bytewise sketch = sketchOf({{.points = {{nan, 0, 0}, {1, 0, 0}, {0, 3e38f, 0}}},
                                    {.points = {}},
                                    {.size = 0, .points = {{0, 0, 0}}},
                                    {.size = nan, .points = {{0, 0, 0}}}});
  ImportWarnings warnings;
  const Painting painting = readTilt(metadata(), sketch, warnings);
  ASSERT_EQ(painting.strokes.size(), 1u);
  EXPECT_EQ(painting.points.size(), 1u);
  EXPECT_EQ(warnings.lines("x").size(), 3u);
}

TEST(Sketch, aFileWithoutAnythingToDrawIsRefused) {
  const Result<Scene> scene =
      loaded(zipped({{"metadata.json", metadata()}, {"data.sketch", sketchOf({})}}), "nothing.tilt");
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().kind, ErrorKind::unusableFile);
}

TEST(Sketch, brokenZipsAreRefused) {
  const Bytewise sketch = sketchOf({{.points = {{1, 2, 3}}}});
  const Bytewise whole = zipped({{"metadata.json", metadata()}, {"data.sketch", sketch}});
  ASSERT_TRUE(loaded(whole, "x.tilt"));
  for (const size_t length :
       {size_t(4), size_t(5), size_t(16), size_t(40), whole.size() / 2, whole.size() - 1}) {
    const Result<Scene> scene = loaded({whole.begin(), whole.begin() + long(length)}, "x.tilt");
    ASSERT_FALSE(scene) << length;
    EXPECT_EQ(scene.error().kind, ErrorKind::unusableFile);
  }
  const Result<Scene> without = loaded(zipped({{"data.sketch", sketch}}), "x.tilt");
  ASSERT_FALSE(without);
  EXPECT_NE(without.error().message().find("metadata.json"), std::string::npos);
  // What would fill the memory is refused before anything is unpacked.
  const Bytewise bomb =
      zipped({{"metadata.json", metadata()}, {"data.sketch", Bytewise(size_t(300) << 20)}}, ZIP_CM_DEFLATE);
  ASSERT_LT(bomb.size(), size_t(1) << 20);
  const Result<Scene> bombed = loaded(bomb, "x.tilt");
  ASSERT_FALSE(bombed);
  EXPECT_NE(bombed.error().message().find("would unpack to"), std::string::npos);
}

Bytewise apainterOf(uint16_t version = 1) {
  Bytewise bytes = textBytes(
      "\x08"
      "apainter");
  put(bytes, version);
  put<uint8_t>(bytes, 2);
  for (const std::string name : {"lines1", "mystery"}) {
    put(bytes, uint8_t(name.size()));
    for (const char c : name) put(bytes, c);
  }
  put<uint32_t>(bytes, 2);
  for (const uint8_t brush : {uint8_t(0), uint8_t(1)}) {
    put(bytes, brush);
    for (const float c : {0.25f, 0.5f, 1.0f}) put(bytes, c);
    put(bytes, 0.04f);
    put<uint32_t>(bytes, 2);
    for (int i = 0; i < 2; ++i) {
      for (const float c : {float(i), 1.0f, 2.0f}) put(bytes, c);
      for (const float c : {0.0f, 0.0f, 0.0f, 1.0f}) put(bytes, c);
      put(bytes, 0.5f);
      put<uint32_t>(bytes, uint32_t(1000 + 500 * i));
    }
  }
  return bytes;
}

void expectApainter(const Result<Scene>& scene) {
  ASSERT_TRUE(scene) << scene.error().message();
  const Painting& painting = *scene->data().meshes[0]->painting;
  ASSERT_EQ(painting.strokes.size(), 2u);
  EXPECT_EQ(painting.strokes[0].brush, Brush::bristles);
  ASSERT_EQ(painting.points.size(), 4u);
  EXPECT_EQ(painting.points[1].position, glm::vec3(1, 1, 2));
  EXPECT_FLOAT_EQ(painting.points[1].radius, 0.01f);
  EXPECT_FLOAT_EQ(painting.points[1].time, 0.5f);
  EXPECT_FLOAT_EQ(painting.points[1].color.b, 1);
  EXPECT_EQ(scene->warnings().size(), 1u);
}

TEST(Sketch, apainterIsRead) {
  const Bytewise whole = apainterOf();
  expectApainter(loaded(whole, "x.apa"));
  for (size_t length = 9; length < whole.size(); ++length)
    EXPECT_FALSE(loaded({whole.begin(), whole.begin() + long(length)}, "x.apa")) << length;
  EXPECT_FALSE(loaded(apainterOf(2), "x.apa"));
  expectApainter(loaded(textBytes(R"({"version": 1, "strokes": [
        {"brush": {"index": 0, "color": [0.25, 0.5, 1], "size": 0.04}, "points": [
          {"position": [0, 1, 2], "orientation": [0, 0, 0, 1], "pressure": 0.5, "timestamp": 1000},
          {"position": [1, 1, 2], "orientation": [0, 0, 0, 1], "pressure": 0.5, "timestamp": 1500}]},
        {"brush": {"index": 1, "color": [0.25, 0.5, 1], "size": 0.04}, "points": [
          {"position": [0, 1, 2], "orientation": [0, 0, 0, 1], "pressure": 0.5, "timestamp": 1000},
          {"position": [1, 1, 2], "orientation": [0, 0, 0, 1], "pressure": 0.5, "timestamp": 1500}]}],
        "author": "", "brushes": ["lines1", "mystery"]})"),
                        "x.json"));
  for (const char* broken :
       {R"({"strokes": 1, "brushes": []})", R"({"strokes": [{}], "brushes": []})",
        R"({"strokes": [], "brushes": [1]})",
        R"({"strokes": [{"brush": {"index": 1}}], "brushes": ["flat"]})",
        R"({"strokes": [{"brush": {"index": 0, "size": 1}, "points": [{}]}], "brushes": ["flat"]})",
        R"({"version": 2, "strokes": [], "brushes": []})", R"({"strokes": [], "brushes": [)"}) {
    const Result<Scene> scene = loaded(textBytes(broken), "x.json");
    ASSERT_FALSE(scene) << broken;
    EXPECT_EQ(scene.error().kind, ErrorKind::unusableFile);
  }
}

// Real ones: how many strokes and points they have is what another reader found in them.
TEST(Sketch, realPaintingsLoadToTheLastByte) {
  const struct {
    const char* file;
    size_t strokes, points;
  } known[] = {{"tilt/Blue_Tit.tilt", 471, 9403},
               {"tilt/Liz_Edwards_Portrait.tilt", 1952, 37773},
               {"tilt/Stay_Strong_Americans.tilt", 2377, 64398},
               {"tilt/OneStroke.tilt", 1, 4},
               {"tilt/perf-NeonPulseDense.tilt", 1072, 19696},
               {"tilt-dir/Credits.tilt", 1128, 26803}};
  const std::filesystem::path folder = test::kAssets / "paintings3d";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
  for (const auto& one : known) {
    const Result<Scene> scene = Scene::load((folder / one.file).string());
    ASSERT_TRUE(scene) << scene.error().message();
    const Painting& painting = *scene->data().meshes[0]->painting;
    // A few points may be of no width.
    EXPECT_LE(painting.strokes.size(), one.strokes);
    EXPECT_LE(painting.points.size(), one.points);
    EXPECT_GE(painting.strokes.size(), one.strokes * 99 / 100) << one.file;
    EXPECT_GE(painting.points.size(), one.points * 99 / 100) << one.file;
    for (const std::string& warning : scene->warnings())
      EXPECT_EQ(warning.find("after the last stroke"), std::string::npos) << warning;
  }
}

}  // namespace
}  // namespace scumble::sketch
