// The ocean's limits: how much memory it takes, what its knobs refuse, and settings that nobody would choose.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <set>

#include "features/ocean/ocean.h"
#include "shading/frame.shared.h"
#include "tests/support/aov.h"
#include "tests/support/render_test.h"
#include "tests/support/sanitized.h"
#include "tests/support/test_device.h"

namespace scumble {
namespace {

using namespace test;

// ---- Memory ----

Scene box() {
  TestScene s;
  s.add(boxMesh({-0.6f, -0.4f, -0.3f}, {0.6f, 0.4f, 0.3f}),
        s.material(TestScene::colored("Wood", {0.5f, 0.4f, 0.3f, 1})));
  return s.load();
}

// Device memory of a renderer that has drawn one frame, so small that its images do not count.
uint64_t bytesWith(const Knobs& knobs) {
  Result<std::unique_ptr<Renderer>> renderer = Renderer::create({testDevice()});
  if (!renderer) throw std::runtime_error(renderer.error().message());
  const Scene scene = box();
  const auto views = viewsFrom(scene, {{3, 2, 5}}, 8, 8);
  const Result<Frame> frame = (*renderer)->render(scene, quietLook(knobs), 0, views, sized(8, 8));
  if (!frame) throw std::runtime_error(frame.error().message());
  return frame->stats.deviceBytes;
}

// What deform writes for the ocean, which is not loaded.
uint64_t finalVertexBytes() {
  const ocean::OceanShape shape;
  uint64_t vertices = ocean::makeOceanRing(shape).vertexCount();
  for (int z = 0; z < shape.tiles; ++z)
    for (int x = 0; x < shape.tiles; ++x)
      vertices += ocean::makeOceanTile(shape, ocean::oceanTileAt(shape, x, z)).vertexCount();
  return vertices * (sizeof(shared::VertexCore) + sizeof(shared::VertexFrame));
}

TEST(OceanLimits, whatItLoadsIsBelowFourMebibytes) {
  NOT_WITH_SANITIZERS();
  const uint64_t without = bytesWith({}), with = bytesWith({{"ocean.mode", "on"}}),
                 twoMoods = bytesWith({{"ocean.mode", "on"},
                                       {"ocean.paint.nextColors", "storm"},
                                       {"ocean.paint.nextSky", "storm"},
                                       {"ocean.paint.next", "0.5"}});
  const uint64_t drawn = finalVertexBytes();
  const auto mebibytes = [](uint64_t bytes) { return double(bytes) / (1 << 20); };
  std::cout << "An ocean loads " << mebibytes(with - without - drawn) << " MiB, with two moods "
            << mebibytes(twoMoods - without - drawn) << " MiB; final vertices take another "
            << mebibytes(drawn) << " MiB\n";
  EXPECT_LT(mebibytes(with - without - drawn), 4);
  EXPECT_LT(mebibytes(twoMoods - without - drawn), 4);
  EXPECT_GT(twoMoods, with);
}

// Tiles of a ring share meshes, as far as finer ones do not lie beside them.
TEST(OceanLimits, tilesShareMeshes) {
  const ocean::OceanShape shape;
  std::set<ocean::OceanTile> tiles;
  for (int z = 0; z < shape.tiles; ++z)
    for (int x = 0; x < shape.tiles; ++x) tiles.insert(ocean::oceanTileAt(shape, x, z));
  EXPECT_EQ(tiles.size(), 1u + 5u + 5u);
}

// ---- Mistakes in look files ----

TEST(OceanLimits, mistakesAreNamedByTheirPath) {
  const struct {
    const char *text, *path, *says;
  } cases[] = {
      {R"({"ocean": 1})", "ocean", ""},
      {R"({"ocean": []})", "ocean", ""},
      {R"({"ocean": {"mode": "maybe"}})", "ocean.mode", "auto|on|off"},
      {R"({"ocean": {"mode": true}})", "ocean.mode", ""},
      {R"({"ocean": {"wind": "strong"}})", "ocean.wind", ""},
      {R"({"ocean": {"wind": -1}})", "ocean.wind", "0 to 60"},
      {R"({"ocean": {"wind": 61}})", "ocean.wind", "0 to 60"},
      {R"({"ocean": {"wind": null}})", "ocean.wind", ""},
      {R"({"ocean": {"grid": 0}})", "ocean.grid", "1 to 256"},
      {R"({"ocean": {"grid": 80.5}})", "ocean.grid", ""},
      {R"({"ocean": {"grid": 257}})", "ocean.grid", "1 to 256"},
      {R"({"ocean": {"tiles": 0}})", "ocean.tiles", "1 to 9"},
      {R"({"ocean": {"tiles": 10}})", "ocean.tiles", "1 to 9"},
      {R"({"ocean": {"tile": 0.5}})", "ocean.tile", ""},
      {R"({"ocean": {"depth": 0}})", "ocean.depth", ""},
      {R"({"ocean": {"loop": 0}})", "ocean.loop", ""},
      {R"({"ocean": {"speed": 101}})", "ocean.speed", ""},
      {R"({"ocean": {"heading": 200}})", "ocean.heading", ""},
      {R"({"ocean": {"winds": 3}})", "ocean.winds", "ocean.wind"},
      {R"({"ocean": {"paint": 3}})", "ocean.paint", ""},
      {R"({"ocean": {"paint": {"sky": "purple"}}})", "ocean.paint.sky", ""},
      {R"({"ocean": {"paint": {"colours": "storm"}}})", "ocean.paint.colours", ""},
      {R"({"ocean": {"paint": {"foamColor": "whitish"}}})", "ocean.paint.foamColor", ""},
      {R"({"ocean": {"wind": {"keys": [[0, 3], [10, 99]]}}})", "ocean.wind.keys[1][1]", "0 to 60"},
      {R"({"ocean": {"wind": {"keys": [[5, 3], [5, 4]]}}})", "ocean.wind.keys[1][0]", ""},
      {R"({"ocean": {"mode": {"keys": [[0, "on"]], "interpolation": "linear"}}})", "ocean.mode.interpolation",
       ""},
      {R"({"nodes": {"Boat": {"float": true}}})", "nodes.Boat.float", ""},
      {R"({"nodes": {"Boat": {"float": {"rides": "yes"}}}})", "nodes.Boat.float.rides", ""},
      {R"({"nodes": {"Boat": {"float": {"bow": "y"}}}})", "nodes.Boat.float.bow", "x|z"},
      {R"({"nodes": {"Boat": {"float": {"length": -1}}}})", "nodes.Boat.float.length", ""},
      {R"({"float": {"rides": true}})", "float", ""},
      {R"({"nodes": {"Boat": {"ocean": {"wind": 3}}}})", "nodes.Boat.ocean", ""},
  };
  for (const auto& c : cases) {
    const Result<Look> look = Look::fromJson(c.text, "sea.json");
    ASSERT_FALSE(look.ok()) << c.text;
    EXPECT_EQ(look.error().kind, ErrorKind::unusableFile) << c.text;
    EXPECT_EQ(look.error().file, "sea.json") << c.text;
    EXPECT_EQ(look.error().jsonPath.substr(0, std::string(c.path).size()), c.path) << c.text;
    EXPECT_NE(look.error().message().find(c.says), std::string::npos) << look.error().message();
  }
}

// ---- Settings that nobody would choose ----

class OceanExtremes : public BothEyes {};
INSTANTIATE_BOTH_EYES(OceanExtremes);

TEST_P(OceanExtremes, allAtOnceGiveFinitePictures) {
  TestScene s;
  s.add(boxMesh({-0.6f, -0.4f, -0.3f}, {0.6f, 0.4f, 0.3f}),
        s.material(TestScene::colored("Wood", {0.5f, 0.4f, 0.3f, 1})));
  s.json()["nodes"][0]["extras"] = {{"scumble_float", true}};
  const Scene scene = s.load();
  const Knobs least{{"ocean.wind", "0"},
                    {"ocean.tiles", "1"},
                    {"ocean.grid", "1"},
                    {"ocean.tile", "1"},
                    {"ocean.depth", "0.1"}},
      calm{{"ocean.wind", "0"},
           {"ocean.tiles", "1"},
           {"ocean.height", "20"},
           {"ocean.tile", "1"},
           {"ocean.depth", "0.1"}},
      small{{"ocean.wind", "60"}, {"ocean.height", "20"}, {"ocean.tiles", "1"},
            {"ocean.grid", "1"},  {"ocean.tile", "1"},    {"ocean.depth", "0.1"}},
      steep{{"ocean.wind", "60"}, {"ocean.height", "20"}, {"ocean.tiles", "1"},      {"ocean.grid", "60"},
            {"ocean.tile", "1"},  {"ocean.depth", "0.1"}, {"ocean.choppiness", "2"}, {"ocean.smallest", "0"},
            {"ocean.loop", "1"},  {"ocean.speed", "-100"}},
      high{{"ocean.wind", "60"},    {"ocean.height", "20"},   {"ocean.tiles", "9"},   {"ocean.grid", "2"},
           {"ocean.tile", "10000"}, {"ocean.fetch", "10000"}, {"ocean.smallest", "0"}},
      none{{"ocean.smallest", "1000"}, {"ocean.tiles", "1"}, {"ocean.tile", "1"}};
  for (Knobs knobs : {least, calm, small, steep, high, none}) {
    std::string what;
    for (const auto& [knob, value] : knobs) what += knob + "=" + value + " ";
    knobs.emplace_back("ocean.mode", "on");
    RenderOptions options =
        sized(24, 16, {"color", "position", "normal", "uv", "uv-gradient", "warp", "lit", "motion"});
    options.previousTime = 1234.25;
    const Result<Frame> frame = renderer().render(scene, quietLook(knobs), 1234.5,
                                                  viewsFrom(scene, {{3, 2, 5}}, 24, 16, GetParam()), options);
    ASSERT_TRUE(frame.ok()) << what << frame.error().message();
    for (const Frame::Layer& layer : frame->layers)
      for (const Image& image : layer.views)
        EXPECT_TRUE(
            std::all_of(image.pixels.begin(), image.pixels.end(), [](float x) { return std::isfinite(x); }))
            << "'" << layer.name << "' with " << what;
  }
}

}  // namespace
}  // namespace scumble
