// The ocean as it is drawn: when there is one, its mesh against the waves on the CPU, what rides it, and what
// its settings make of its colours.
#include "features/ocean/ocean.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "base/test_folder.h"
#include "scene/scene_data.h"
#include "tests/support/animated_scene.h"
#include "tests/support/aov.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"
#include "tests/support/sanitized.h"
#include "tests/support/test_device.h"

namespace scumble {
namespace {

using namespace test;

constexpr int kSeaWidth = 64, kSeaHeight = 48;

// A box beside the middle; where `oceanName` says one, a node of that name with a plate of its own at a
// height of 0.5 m.
AnimatedScene harbour(const std::string& oceanName = "", const glm::vec3& box = {1.5f, 0, -1}) {
  AnimatedScene s;
  const int material = s.material(TestScene::colored("Wood", {0.5f, 0.4f, 0.3f, 1}));
  const int mesh = s.mesh({boxMesh({-0.6f, -0.4f, -0.3f}, {0.6f, 0.4f, 0.3f}), 0, {}, {}, {}, {}}, material);
  const glm::quat turned = glm::angleAxis(0.6f, glm::vec3(0, 1, 0));
  s.node({{"name", "Box"},
          {"mesh", mesh},
          {"translation", {box.x, box.y, box.z}},
          {"rotation", {turned.x, turned.y, turned.z, turned.w}}});
  if (!oceanName.empty())
    s.node({{"name", oceanName},
            {"mesh", s.mesh({gridMesh({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}), 0, {}, {}, {}, {}}, material)},
            {"translation", {0.25, 0.5, -0.75}}});
  return s;
}

// The waves as the CPU has them, from the same settings.
struct Sea {
  ocean::OceanShape shape;
  ocean::WaveField field;
  glm::dvec2 travelled{0.0};

  Sea(const Scene& scene, const Look& look, double time)
      : shape(ocean::oceanShape(scene.data(), look.data())) {
    const ocean::OceanParams p = look.data().get<ocean::OceanParams>();
    ocean::Spectrum s;
    s.grid = p.grid, s.tile = double(p.tile);
    s.kind = p.spectrum == 0 ? ocean::Spectrum::phillips : ocean::Spectrum::jonswap;
    s.wind = double(p.wind), s.windDirection = double(p.windDirection), s.fetch = double(p.fetch);
    s.choppiness = double(p.choppiness), s.depth = double(p.depth), s.loop = double(p.loop);
    s.height = double(p.height), s.smallest = double(p.smallest), s.seed = uint32_t(p.seed);
    ocean::Waves(s).at(time, field);
    const double heading = glm::radians(double(p.heading));
    travelled = glm::dvec2(std::cos(heading), std::sin(heading)) * double(p.speed) * time;
  }
  glm::dvec2 onField(const glm::dvec3& at) const {
    return glm::dvec2(at.x - double(shape.origin.x), at.z - double(shape.origin.z)) + travelled;
  }
  double heightAt(const glm::dvec3& at) const {
    const glm::dvec2 place = onField(at);
    return double(shape.origin.y) + double(ocean::heightAt(field, place.x, place.y));
  }
  // Whether triangles at a place lie in the middle tile, which alone has all points.
  bool isFine(const glm::dvec3& at) const {
    const int middle = shape.tiles / 2;
    const double cell = double(shape.cell()), low = (shape.firstPoint() + middle * shape.grid) * cell;
    const double margin =
        double(glm::length(glm::max(glm::abs(field.leastShift), glm::abs(field.greatestShift)))) + 2 * cell;
    const glm::dvec2 place(at.x - double(shape.origin.x), at.z - double(shape.origin.z));
    return shape.tiles < 2 || (glm::all(glm::greaterThan(place, glm::dvec2(low + margin))) &&
                               glm::all(glm::lessThan(place, glm::dvec2(low + double(shape.tile) - margin))));
  }
  // Nearer to the middle than this, waves are whole at all corners of a triangle.
  double whole() const {
    return 0.6 * double(shape.falseHorizon) -
           double(glm::length(glm::max(glm::abs(field.leastShift), glm::abs(field.greatestShift)))) -
           1.5 * double(shape.cell());
  }
};

class OceanDrawn : public BothEyes {
 protected:
  static Frame drawAt(const Scene& scene, const Look& look, double time, const std::vector<View>& views,
                      const std::vector<std::string>& aovs) {
    Result<Frame> frame = renderer().render(scene, look, time, views, sized(kSeaWidth, kSeaHeight, aovs));
    if (!frame) throw std::runtime_error(frame.error().message());
    return std::move(frame).value();
  }
  static std::vector<View> viewsOf(const Scene& scene, const Stand& stand) {
    return viewsFrom(scene, stand, kSeaWidth, kSeaHeight, GetParam());
  }
  static int oceanId(const Scene& scene) { return int(scene.data().nodes.size()) + 2; }
  static size_t count(const Frame& frame, int id, size_t v) {
    const Image& ids = aov(frame, "id", v);
    return size_t(std::count(ids.pixels.begin(), ids.pixels.end(), float(id)));
  }

  // Heights of the ocean's pixels, where waves are whole, against the mesh on the CPU; how many there were.
  static size_t compare(const Scene& scene, const Look& look, double time, const Stand& stand,
                        const std::string& what, double tolerance = 2e-3) {
    const Sea sea(scene, look, time);
    const Frame frame = drawAt(scene, look, time, viewsOf(scene, stand), {"position", "id"});
    size_t compared = 0;
    for (size_t v = 0; v < viewCount(); ++v) {
      Difference heights(tolerance);
      for (int y = 0; y < kSeaHeight; ++y)
        for (int x = 0; x < kSeaWidth; ++x) {
          if (int(texel(aov(frame, "id", v), x, y).x) != oceanId(scene)) continue;
          const glm::dvec3 at(texel(aov(frame, "position", v), x, y));
          const double away =
              glm::length(glm::dvec2(at.x, at.z) - glm::dvec2(sea.shape.origin.x, sea.shape.origin.z));
          if (away < sea.whole() && sea.isFine(at)) heights.add(at.y, sea.heightAt(at));
        }
      // At silhouettes a pixel's middle lies on its triangle but for a part of a pixel.
      EXPECT_LE(heights.beyond, 2u) << what << ", view " << v << ": " << heights.text();
      EXPECT_LT(heights.most, 0.05) << what << ", view " << v << ": " << heights.text();
      compared += heights.count;
    }
    return compared;
  }
};
INSTANTIATE_BOTH_EYES(OceanDrawn);

const Stand kFromAside{{9, 6, 12}}, kFromAbove{{0.1f, 14, 0.2f}}, kLow{{-7, 2.4f, 6}, {0, 1.6f, -3}};

// ---- Whether there is one ----

TEST_P(OceanDrawn, onlyWhereANodeOrTheLookSaysSo) {
  const std::vector<std::string> aovs{"id", "position"};
  const auto drawn = [&](const Scene& scene, const Knobs& knobs) {
    return drawAt(scene, quietLook(knobs), 0.4, viewsOf(scene, kFromAside), aovs);
  };
  const auto expectSame = [&](const Frame& a, const Frame& b, const char* what) {
    for (const char* name : {"", "id", "position"})
      for (size_t v = 0; v < viewCount(); ++v)
        EXPECT_TRUE(sameBytes(aov(a, name, v), aov(b, name, v))) << what << ", '" << name << "'";
  };
  const Scene bare = harbour().load();
  const Frame without = drawn(bare, {});
  EXPECT_EQ(count(without, oceanId(bare), 0), 0u);
  expectSame(without, drawn(bare, {{"ocean.mode", "off"}}), "no ocean");
  EXPECT_GT(count(drawn(bare, {{"ocean.mode", "on"}}), oceanId(bare), 0), 500u);
  // What is like the name, but not it.
  for (const char* name : {"Oceanographer", "The ocean"}) {
    const Scene scene = harbour(name).load();
    const Frame plate = drawn(scene, {});
    EXPECT_EQ(count(plate, oceanId(scene), 0), 0u) << name;
    EXPECT_GT(count(plate, 2, 0), 10u) << name;
    expectSame(plate, drawn(scene, {{"ocean.mode", "off"}}), name);
  }
  for (const char* name : {"Ocean", "ocean.001"}) {
    const Scene scene = harbour(name).load();
    const Frame sea = drawn(scene, {{"ocean.wind", "0"}});
    for (size_t v = 0; v < viewCount(); ++v) {
      EXPECT_GT(count(sea, oceanId(scene), v), 500u) << name;
      EXPECT_EQ(count(sea, 2, v), 0u) << name;
    }
    const Frame plate = drawn(scene, {{"ocean.mode", "off"}});
    EXPECT_EQ(count(plate, oceanId(scene), 0), 0u) << name;
    EXPECT_GT(count(plate, 2, 0), 10u) << name;
  }
}

// Without wind the water is flat, and at its level.
TEST_P(OceanDrawn, calmWaterIsFlatAtItsLevel) {
  for (const bool isNode : {true, false})
    for (const float level : {0.0f, -1.25f}) {
      const Scene scene = harbour(isNode ? "Ocean" : "").load();
      const Look look = quietLook({{"ocean.mode", isNode ? "auto" : "on"},
                                   {"ocean.wind", "0"},
                                   {"ocean.level", std::to_string(level)}});
      const Frame frame = drawAt(scene, look, 1.5, viewsOf(scene, kFromAside), {"position", "id", "normal"});
      for (size_t v = 0; v < viewCount(); ++v) {
        Difference heights(1e-4), normals(1e-3);
        for (int y = 0; y < kSeaHeight; ++y)
          for (int x = 0; x < kSeaWidth; ++x) {
            if (int(texel(aov(frame, "id", v), x, y).x) != oceanId(scene)) continue;
            const glm::dvec4 at = texel(aov(frame, "position", v), x, y);
            if (glm::length(glm::dvec2(at.x, at.z)) > 60) continue;
            heights.add(at.y, double(level) + (isNode ? 0.5 : 0.0));
            normals.add(texel(aov(frame, "normal", v), x, y).y, 1.0);
          }
        EXPECT_GT(heights.count, 1000u);
        EXPECT_EQ(heights.beyond, 0u) << heights.text();
        EXPECT_EQ(normals.beyond, 0u) << normals.text();
      }
    }
}

// ---- Its mesh ----

TEST_P(OceanDrawn, isTheMeshOfTheWaves) {
  const Scene scene = harbour("Ocean").load();
  size_t compared = 0;
  for (const Knobs& knobs : std::vector<Knobs>{
           {},
           {{"ocean.spectrum", "phillips"}, {"ocean.seed", "7"}, {"ocean.windDirection", "-120"}},
           {{"ocean.speed", "3.7"}, {"ocean.heading", "35"}},
           {{"ocean.speed", "-11"}, {"ocean.heading", "100"}, {"ocean.choppiness", "0"}}})
    for (const auto& [time, stand] : {std::pair{0.0, kLow}, {7.3, kFromAside}, {-2.6, kFromAbove}})
      compared += compare(scene, quietLook(knobs), time, stand,
                          (knobs.empty() ? "usual" : knobs[0].second) + " at " + std::to_string(time));
  EXPECT_GT(compared, 12 * 1000 * viewCount());
}

TEST_P(OceanDrawn, isTheMeshOfTheWavesForAnyGrid) {
  const Scene scene = harbour("Ocean").load();
  size_t turn = 0;  // one view and two in turn
  for (const auto& [tiles, grid, tile] : {std::tuple{1, 80, 60},
                                          {3, 16, 12},
                                          {5, 7, 8},
                                          {3, 7, 9},
                                          {1, 1, 40},
                                          {2, 1, 30},
                                          {5, 1, 10},
                                          {1, 2, 40},
                                          {1, 7, 70},
                                          {4, 81, 9},
                                          {9, 16, 5}}) {
    if (turn++ % 2 + 1 != viewCount()) continue;
    const double time = 5.2;
    const Look look = quietLook({{"ocean.tiles", std::to_string(tiles)},
                                 {"ocean.grid", std::to_string(grid)},
                                 {"ocean.tile", std::to_string(tile)},
                                 {"ocean.speed", "2.3"},
                                 {"ocean.heading", "-50"}});
    const std::string what = std::to_string(tiles) + " tiles of " + std::to_string(grid);
    // Between so few points there is no place where waves are whole at all corners.
    if (tiles * grid > 15) {
      EXPECT_GT(compare(scene, look, time, kFromAbove, what), 150u) << what;
    }
    // Water everywhere below: the mesh, and around it the flat water, leave nothing open.
    const Frame frame = drawAt(scene, look, time, viewsOf(scene, {{0, 150, 1}}), {"position", "id"});
    for (size_t v = 0; v < viewCount(); ++v) EXPECT_EQ(count(frame, 0, v), 0u) << what << ", view " << v;
  }
}

// Waves have faded where their mesh ends.
TEST_F(OceanDrawn, wavesEndBeforeTheirMesh) {
  const Scene scene = harbour("Ocean").load();
  for (const auto& [tiles, grid] : {std::pair{5, 8}, {3, 7}, {1, 15}, {4, 5}})
    for (const double speed : {0.0, 0.9, 1.9}) {
      const Look look = quietLook({{"ocean.tiles", std::to_string(tiles)},
                                   {"ocean.grid", std::to_string(grid)},
                                   {"ocean.tile", std::to_string(2 * grid)},
                                   {"ocean.falseHorizon", "1000"},
                                   {"ocean.speed", std::to_string(speed)},
                                   {"ocean.heading", "45"}});
      const Sea sea(scene, look, 1);
      const double half = tiles * grid;
      // The mesh reaches at least as far as waves do, wherever part of a cell has moved it.
      const double cell = 2, first = sea.shape.firstPoint() * cell;
      for (int axis = 0; axis < 2; ++axis) {
        const double within = sea.travelled[axis] - std::floor(sea.travelled[axis] / cell) * cell;
        EXPECT_LE(double(sea.shape.falseHorizon), -(first - within) + 1e-4) << tiles << " of " << grid;
        EXPECT_LE(double(sea.shape.falseHorizon), first + 2 * half - within + 1e-4)
            << tiles << " of " << grid;
      }
    }
}

TEST_P(OceanDrawn, repeatsAfterItsLoop) {
  const Scene scene = harbour("Ocean").load();
  const auto at = [&](double time, const Knobs& more = {}) {
    Knobs knobs{{"ocean.tiles", "1"}, {"ocean.loop", "12"}, {"ocean.paint.live", "0.5"}};
    knobs.insert(knobs.end(), more.begin(), more.end());
    return drawAt(scene, quietLook(knobs), time, viewsOf(scene, kFromAside), {"position"});
  };
  const Frame once = at(2.25), again = at(14.25), before = at(-9.75), later = at(3.5),
              other = at(2.25, {{"ocean.seed", "2"}});
  for (size_t v = 0; v < viewCount(); ++v) {
    for (const char* name : {"", "position"}) {
      EXPECT_TRUE(sameBytes(aov(once, name, v), aov(again, name, v))) << name;
      EXPECT_TRUE(sameBytes(aov(once, name, v), aov(before, name, v))) << name;
      EXPECT_FALSE(sameBytes(aov(once, name, v), aov(later, name, v))) << name;
      EXPECT_FALSE(sameBytes(aov(once, name, v), aov(other, name, v))) << name;
    }
    EXPECT_GT(largestDifference(aov(once, "position", v), aov(other, "position", v)), 0.1);
  }
}

// The water's own motion: waves that are where they were, and water that slides below the scene.
// Water on threes, at eight drawings a second, whatever the rate of frames; and what rides it.
TEST_P(OceanDrawn, wavesStandAsLongAsTheyAreHeld) {
  const Scene scene = harbour("Ocean").load();
  const auto at = [&](double time, const char* hold) {
    const Frame frame =
        drawAt(scene, quietLook({{"ocean.hold", hold}}), time, viewsOf(scene, kFromAside), {"position"});
    std::vector<std::vector<float>> all;
    for (size_t v = 0; v < viewCount(); ++v) all.push_back(aov(frame, "position", v).pixels);
    return all;
  };
  for (const double start : {0.0, 1.0, 7.25}) {
    const auto first = at(start, "3");
    EXPECT_EQ(first, at(start + 1 / 24.0, "3")) << start;
    EXPECT_EQ(first, at(start + 2.9 / 24, "3")) << start;
    EXPECT_NE(first, at(start + 3.1 / 24, "3")) << start;
    EXPECT_NE(first, at(start + 1 / 24.0, "0")) << start;
    EXPECT_EQ(first, at(start, "0")) << start;
  }
}

TEST_P(OceanDrawn, waterMovesAndSlides) {
  NEEDS_FINE_RASTER();
  const Scene scene = harbour("Ocean").load();
  const auto motion = [&](const Knobs& knobs, double time, double before) {
    RenderOptions options = sized(kSeaWidth, kSeaHeight, {"position", "id", "motion"});
    options.previousTime = before;
    Result<Frame> frame =
        renderer().render(scene, quietLook(knobs), time, viewsOf(scene, kFromAside), options);
    if (!frame) throw std::runtime_error(frame.error().message());
    return std::move(frame).value();
  };
  const auto largest = [&](const Frame& frame, size_t v) {
    float most = 0;
    for (const float x : aov(frame, "motion", v).pixels) most = std::max(most, std::abs(x));
    return most;
  };
  const Frame loop = motion({}, 1.5, 21.5), moves = motion({}, 1.5, 1.25);
  // In a quarter of a second: over less than a cell, over several, and back.
  std::vector<std::pair<double, Frame>> slides;
  for (const double speed : {1.0, 12.0, -7.0})
    slides.emplace_back(
        0.25 * speed,
        motion({{"ocean.wind", "0"}, {"ocean.speed", std::to_string(speed)}, {"ocean.heading", "40"}}, 2.5,
               2.25));
  const auto views = viewsOf(scene, kFromAside);
  for (size_t v = 0; v < viewCount(); ++v) {
    EXPECT_LT(largest(loop, v), 0.02);
    EXPECT_GT(largest(moves, v), 0.3);
    for (const auto& [slid, frame] : slides) {
      const double heading = glm::radians(40.0);
      const glm::dvec3 by = slid * glm::dvec3(std::cos(heading), 0, std::sin(heading));
      Difference moved(0.03);
      for (int y = 0; y < kSeaHeight; ++y)
        for (int x = 0; x < kSeaWidth; ++x) {
          if (int(texel(aov(frame, "id", v), x, y).x) != oceanId(scene)) continue;
          const glm::dvec3 at(texel(aov(frame, "position", v), x, y));
          if (glm::length(at) > 60) continue;
          const glm::dvec2 expected =
              glm::dvec2(x, y) + 0.5 - pixelOf(views[v], at + by, kSeaWidth, kSeaHeight);
          moved.add(texel(aov(frame, "motion", v), x, y).x, expected.x);
          moved.add(texel(aov(frame, "motion", v), x, y).y, expected.y);
        }
      EXPECT_GT(moved.count, 2000u);
      EXPECT_EQ(moved.beyond, 0u) << slid << " m: " << moved.text();
    }
  }
}

// From 0 to 3 m/s within ten seconds is as far as 1.5 m/s all the time.
TEST_P(OceanDrawn, travelsAsFarAsItsSpeedTookIt) {
  const Scene scene = harbour("Ocean").load();
  const auto drawn = [&](const std::string& speed) {
    const Result<Look> look =
        Look::fromJson(R"({"ocean": {"tiles": 1, "speed": )" + speed + "}}", "sea.json");
    EXPECT_TRUE(look.ok());
    return drawAt(scene, *look, 10, viewsOf(scene, kFromAside), {"position"});
  };
  const Frame track = drawn(R"({"keys": [[0, 0], [10, 3]]})"), constant = drawn("1.5"), last = drawn("3");
  for (size_t v = 0; v < viewCount(); ++v) {
    EXPECT_TRUE(sameBytes(aov(track, "position", v), aov(constant, "position", v)));
    EXPECT_FALSE(sameBytes(aov(track, "position", v), aov(last, "position", v)));
  }
}

// Frames that are under way do not share waves.
TEST_P(OceanDrawn, framesUnderWayAreThoseAlone) {
  const Scene scene = harbour("Ocean").load();
  const Look look = quietLook({{"ocean.tiles", "1"}, {"ocean.speed", "3"}, {"nodes.Box.float.rides", "on"}});
  const auto views = viewsOf(scene, kFromAside);
  const RenderOptions options = sized(kSeaWidth, kSeaHeight, {"position"});
  std::vector<Frame> alone;
  for (int i = 0; i < 3; ++i) alone.push_back(drawAt(scene, look, i * 0.7, views, options.aovs));
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(renderer().begin(scene, look, i * 0.7, views, options).ok());
  for (int i = 0; i < 3; ++i) {
    Result<Frame> frame = renderer().finish();
    ASSERT_TRUE(frame.ok());
    if (i == 0) {
      ASSERT_TRUE(renderer().begin(scene, look, 1.4, views, options).ok());
    }
    for (size_t v = 0; v < viewCount(); ++v)
      for (const char* name : {"", "position"})
        EXPECT_TRUE(sameBytes(aov(*frame, name, v), aov(alone[size_t(i)], name, v)))
            << i << " '" << name << "'";
  }
}

// ---- What rides it ----

TEST_P(OceanDrawn, nodesRideTheWaves) {
  size_t seen = 0;
  for (const glm::vec3& place : {glm::vec3(1.5f, 1.6f, -1), glm::vec3(-3, 1.2f, 2)}) {
    AnimatedScene harbourScene = harbour("Ocean", place);
    // Something that hangs on the box.
    const glm::vec3 onBox(0.2f, 0.9f, 0.1f);
    harbourScene.node({{"name", "Lamp"}, {"mesh", 0}, {"translation", {onBox.x, onBox.y, onBox.z}}}, 0);
    const Scene scene = harbourScene.load();
    const std::vector<scene::Node>& nodes = scene.data().nodes;
    const auto idOf = [&](const std::string& name) {
      for (size_t n = 0; n < nodes.size(); ++n)
        if (nodes[n].name == name) return int(n) + 1;
      return 0;
    };
    const std::vector<glm::dmat4> rest = scene::worldMatrices(scene.data());
    for (const auto& [alongZ, time] : {std::pair{false, 0.3}, {true, 4.1}}) {
      const Knobs common{
          {"ocean.wind", "14"}, {"ocean.speed", "2"}, {"ocean.height", "1.5"}, {"ocean.tiles", "1"}};
      Knobs riding = common;
      riding.insert(riding.end(), {{"nodes.Box.float.rides", "on"},
                                   {"nodes.Box.float.length", "3"},
                                   {"nodes.Box.float.beam", "1.25"},
                                   {"nodes.Box.float.bow", alongZ ? "z" : "x"}});
      const Look look = quietLook(riding);
      const Sea sea(scene, look, time);
      const glm::dvec3 bow(rest[size_t(idOf("Box")) - 1][alongZ ? 2 : 0]);
      const glm::dvec2 on = sea.onField(place);
      const ocean::Floating floating =
          ocean::floatingAt(sea.field, on.x, on.y, 3, 1.25, glm::degrees(std::atan2(bow.z, bow.x)));
      const glm::dmat3 tilt = glm::dmat3(glm::mat3_cast(floating.tilt));
      EXPECT_NEAR(glm::determinant(tilt), 1, 1e-5);
      const glm::dvec3 middle = glm::dvec3(place) + glm::dvec3(0, double(floating.height), 0);
      // Seen from above its waves' crests.
      const glm::vec3 target(middle);
      const auto views = viewsOf(scene, {target + glm::vec3(2, 6, 3), target});
      const Frame frame = drawAt(scene, look, time, views, {"position", "id"});
      const Frame still = drawAt(scene, quietLook(common), time,
                                 viewsOf(scene, {place + glm::vec3(2, 6, 3), place}), {"position", "id"});
      // Every pixel of a box lies on one of its faces, in its own space.
      const auto expectOnBox = [&, time = time](const Frame& drawn, const char* name, size_t v, bool rides) {
        const int id = idOf(name);
        const glm::dmat4 toNode = glm::inverse(glm::dmat4(rest[size_t(id) - 1]));
        Difference faces(1e-4);
        for (int y = 0; y < kSeaHeight; ++y)
          for (int x = 0; x < kSeaWidth; ++x) {
            if (int(texel(aov(drawn, "id", v), x, y).x) != id) continue;
            glm::dvec3 at(texel(aov(drawn, "position", v), x, y));
            if (rides) at = glm::transpose(tilt) * (at - middle) + glm::dvec3(place);
            const glm::dvec3 p(toNode * glm::dvec4(at, 1));
            faces.add(std::max({std::abs(p.x) / 0.6, std::abs(p.y) / 0.4, std::abs(p.z) / 0.3}), 1.0);
          }
        EXPECT_GT(faces.count, 20u) << name << " at " << time;
        EXPECT_EQ(faces.beyond, 0u) << name << " at " << time << ": " << faces.text();
      };
      for (size_t v = 0; v < viewCount(); ++v) {
        expectOnBox(frame, "Lamp", v, true);
        expectOnBox(still, "Lamp", v, false);
        if (count(frame, idOf("Box"), v) > 20) ++seen, expectOnBox(frame, "Box", v, true);
      }
    }
  }
  EXPECT_GE(seen, 3 * viewCount());
}

TEST_P(OceanDrawn, nothingRidesWithoutAnOcean) {
  const Scene scene = harbour().load();
  const auto drawn = [&](const Knobs& knobs) {
    return drawAt(scene, quietLook(knobs), 1.7, viewsOf(scene, {{3, 4, 5}}), {"position"});
  };
  const Frame still = drawn({}), rides = drawn({{"nodes.Box.float.rides", "on"}}),
              calm = drawn({{"nodes.Box.float.rides", "on"}, {"ocean.mode", "on"}, {"ocean.wind", "0"}}),
              sea = drawn({{"nodes.Box.float.rides", "on"}, {"ocean.mode", "on"}});
  for (size_t v = 0; v < viewCount(); ++v) {
    EXPECT_TRUE(sameBytes(aov(still, "position", v), aov(rides, "position", v)));
    EXPECT_TRUE(sameBytes(aov(still, "", v), aov(rides, "", v)));
    EXPECT_FALSE(sameBytes(aov(calm, "position", v), aov(sea, "position", v)));
  }
}

// A pixel whose middle is not water, but some of whose samples are, has the sea's colour too.
TEST_P(OceanDrawn, edgesAreTheSeas) {
  const Scene scene = harbour().load();
  RenderOptions options = sized(128, 96, {}, 4);
  options.transparent = true;
  for (const Stand& stand : {Stand{{9, 3, 12}, {0, 2, 0}}, Stand{{0, 0.5f, 10}, {0, 0.4f, 0}}}) {
    const Frame frame = draw(scene, quietLook({{"ocean.mode", "on"}, {"ocean.tiles", "3"}}),
                             viewsFrom(scene, stand, 128, 96, GetParam()), options);
    for (size_t v = 0; v < viewCount(); ++v) {
      size_t edges = 0, black = 0;
      for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 128; ++x) {
          const glm::dvec4 color = texel(aov(frame, "", v), x, y);
          if (color.a <= 0.01 || color.a >= 0.99) continue;
          ++edges;
          black += color.g < 0.05;
        }
      EXPECT_GT(edges, 20u);
      EXPECT_EQ(black, 0u);
    }
  }
}

// ---- Settings that nobody would choose ----

TEST_P(OceanDrawn, hostileSettingsGiveFinitePictures) {
  const Scene scene = harbour("Ocean").load();
  size_t turn = 0;  // one view and two in turn
  for (const Knobs& knobs : std::vector<Knobs>{
           {{"ocean.wind", "60"}, {"ocean.height", "20"}, {"ocean.choppiness", "2"}},
           {{"ocean.wind", "60"}, {"ocean.fetch", "10000"}, {"ocean.tile", "1"}, {"ocean.height", "20"}},
           {{"ocean.grid", "1"}, {"ocean.tiles", "1"}},
           {{"ocean.grid", "2"}, {"ocean.tiles", "1"}, {"ocean.tile", "1"}},
           {{"ocean.tile", "1"}, {"ocean.tiles", "1"}, {"ocean.grid", "256"}, {"ocean.horizon", "1000000"}},
           {{"ocean.tile", "10000"}, {"ocean.tiles", "9"}, {"ocean.grid", "7"}, {"ocean.wind", "60"}},
           {{"ocean.depth", "0.1"}, {"ocean.wind", "30"}},
           {{"ocean.falseHorizon", "1"}, {"ocean.horizon", "1"}},
           {{"ocean.falseHorizon", "100000"}, {"ocean.horizon", "1000000"}},
           {{"ocean.level", "-10000"}},
           {{"ocean.level", "3"}},  // seen from below
           {{"ocean.speed", "100"}, {"ocean.heading", "-179"}, {"ocean.loop", "1"}},
           {{"ocean.paint.live", "4"}, {"ocean.paint.liveSpread", "1"}, {"ocean.paint.dither", "2"}}}) {
    if (turn++ % 2 + 1 != viewCount()) continue;
    const Stand stand = turn % 4 < 2 ? kFromAside : Stand{{0, 2, 0.1f}, {0, 1.9f, -30}};
    Knobs all = knobs;
    all.insert(all.end(), {{"nodes.Box.float.rides", "on"}, {"nodes.Box.float.length", "1000"}});
    const Frame frame = drawAt(scene, quietLook(all), 1234.5, viewsOf(scene, stand),
                               {"color", "final-color", "position", "normal", "uv", "warp", "lit"});
    for (const Frame::Layer& layer : frame.layers)
      for (const Image& image : layer.views)
        EXPECT_TRUE(
            std::all_of(image.pixels.begin(), image.pixels.end(), [](float x) { return std::isfinite(x); }))
            << "'" << layer.name << "' with " << knobs[0].first << " " << knobs[0].second;
  }
}

// ---- Its colours ----

class OceanPainted : public OceanDrawn {
 protected:
  static Frame lit(const Scene& scene, const Knobs& knobs, double time = 0.5) {
    Knobs small{{"ocean.tiles", "1"}};  // sooner drawn
    small.insert(small.end(), knobs.begin(), knobs.end());
    return drawAt(scene, quietLook(small), time, viewsOf(scene, kFromAside), {"lit", "shadowed", "id"});
  }
};
INSTANTIATE_BOTH_EYES(OceanPainted);

TEST_P(OceanPainted, mapsAreChosenAndGoneOverTo) {
  const Scene scene = harbour("Ocean").load();
  const std::vector<std::string> names{"evening", "calm-morning", "open-sea", "storm"};
  for (const std::string knob : {"colors", "sky"}) {
    const std::string path = "ocean.paint." + knob,
                      next = std::string("ocean.paint.next") + (knob == "sky" ? "Sky" : "Colors");
    std::vector<Frame> frames;
    for (const std::string& name : names) frames.push_back(lit(scene, {{path, name}}));
    for (size_t v = 0; v < viewCount(); ++v)
      for (size_t i = 0; i < names.size(); ++i)
        for (size_t j = 0; j < i; ++j)
          EXPECT_GT(largestDifference(aov(frames[i], "lit", v), aov(frames[j], "lit", v)), 0.02)
              << knob << " " << names[i] << " and " << names[j];
    // All the way; what is not named stays evening in both.
    const Frame gone = lit(scene, {{path, "calm-morning"}, {next, "storm"}, {"ocean.paint.next", "1"}});
    const Frame half = lit(scene, {{path, "calm-morning"}, {next, "storm"}, {"ocean.paint.next", "0.5"}});
    const Frame none = lit(scene, {{path, "calm-morning"}, {next, "storm"}, {"ocean.paint.next", "0"}});
    for (size_t v = 0; v < viewCount(); ++v) {
      EXPECT_LT(largestDifference(aov(gone, "lit", v), aov(frames[3], "lit", v)), 0.02) << knob;
      EXPECT_LT(largestDifference(aov(gone, "shadowed", v), aov(frames[3], "shadowed", v)), 0.02) << knob;
      EXPECT_TRUE(sameBytes(aov(none, "lit", v), aov(frames[1], "lit", v))) << knob;
      EXPECT_GT(largestDifference(aov(half, "lit", v), aov(frames[1], "lit", v)), 0.005) << knob;
      EXPECT_GT(largestDifference(aov(half, "lit", v), aov(frames[3], "lit", v)), 0.005) << knob;
    }
  }
}

TEST_P(OceanPainted, picturesOfOnesOwn) {
  const Scene scene = harbour("Ocean").load();
  const TestFolder folder;
  const auto file = [&](const char* name, const glm::vec4& color) {
    Image image{4, 4, {"R", "G", "B", "A"}, {}};
    for (int i = 0; i < 16; ++i)
      image.pixels.insert(image.pixels.end(), {color.r, color.g, color.b, color.a});
    std::string path = folder.file(name);
    EXPECT_TRUE(writePng(path, image).ok());
    return path;
  };
  const std::string magenta = file("magenta.png", {0.8f, 0.05f, 0.6f, 1}),
                    green = file("green.png", {0.1f, 0.7f, 0.1f, 1});
  const auto expectAll = [&](const Knobs& knobs, const glm::dvec3& expected, const char* what) {
    Knobs all{{"ocean.paint.foam", "0"}};
    all.insert(all.end(), knobs.begin(), knobs.end());
    const Frame frame = lit(scene, all);
    for (size_t v = 0; v < viewCount(); ++v) {
      Difference colors(0.02);
      for (int y = 0; y < kSeaHeight; ++y)
        for (int x = 0; x < kSeaWidth; ++x)
          if (int(texel(aov(frame, "id", v), x, y).x) == oceanId(scene))
            for (int c = 0; c < 3; ++c) colors.add(texel(aov(frame, "lit", v), x, y)[c], expected[c]);
      EXPECT_GT(colors.count, 3000u) << what;
      // Crests seen edge-on mirror nothing.
      EXPECT_LT(colors.beyondPart(), 0.02) << what << ": " << colors.text();
    }
  };
  expectAll({{"ocean.paint.colors", magenta}, {"ocean.paint.reflection", "0"}, {"ocean.paint.dither", "0"}},
            {0.8, 0.05, 0.6}, "colours");
  expectAll({{"ocean.paint.colors", magenta}, {"ocean.paint.sky", green}, {"ocean.paint.reflection", "4"}},
            {0.1, 0.7, 0.1}, "sky");
  // The same file as either, and gone over to.
  expectAll({{"ocean.paint.colors", green}, {"ocean.paint.sky", green}}, {0.1, 0.7, 0.1}, "both");
  expectAll(
      {{"ocean.paint.nextColors", magenta}, {"ocean.paint.nextSky", magenta}, {"ocean.paint.next", "1"}},
      {0.8, 0.05, 0.6}, "next");
}

TEST_P(OceanPainted, foamWhereItIsAskedFor) {
  const Scene scene = harbour("Ocean").load();
  const auto red = [&](const char* foam) {
    const Frame frame = lit(scene, {{"ocean.paint.foam", foam},
                                    {"ocean.paint.foamColor", "#FF0000"},
                                    {"ocean.paint.foamStart", "1"},
                                    {"ocean.wind", "14"},
                                    {"ocean.choppiness", "1.3"},
                                    {"ocean.paint.colors", "open-sea"},
                                    {"ocean.paint.sky", "open-sea"}});
    size_t pixels = 0;
    for (int y = 0; y < kSeaHeight; ++y)
      for (int x = 0; x < kSeaWidth; ++x) {
        const glm::dvec4 color = texel(aov(frame, "lit"), x, y);
        pixels += int(texel(aov(frame, "id"), x, y).x) == oceanId(scene) && color.x > 0.5 && color.y < 0.2;
      }
    return pixels;
  };
  const size_t none = red("0"), some = red("0.5"), most = red("1");
  EXPECT_EQ(none, 0u);
  EXPECT_GT(most, 20u);
  EXPECT_LE(some, most);
}

TEST_P(OceanPainted, strokesLiveOrStandStill) {
  const Scene scene = harbour("Ocean").load();
  const auto at = [&](double time, const char* live) {
    return lit(scene, {{"ocean.wind", "0"}, {"ocean.paint.live", live}}, time);
  };
  const Frame still = at(0.25, "0"), stillLater = at(5.7, "0"), living = at(0.25, "0.7"),
              livingLater = at(5.7, "0.7");
  for (size_t v = 0; v < viewCount(); ++v) {
    EXPECT_TRUE(sameBytes(aov(still, "lit", v), aov(stillLater, "lit", v)));
    EXPECT_TRUE(sameBytes(aov(still, "", v), aov(stillLater, "", v)));
    EXPECT_GT(largestDifference(aov(living, "lit", v), aov(livingLater, "lit", v)), 0.01);
  }
}

// ---- Both eyes, shadows ----

TEST_F(OceanDrawn, eachEyeSeesWhatOneWouldSee) {
  NOT_WITH_SANITIZERS();
  const Scene scene = harbour("Ocean").load();
  const auto both = viewsFrom(scene, kFromAside, kSeaWidth, kSeaHeight, Stereo::stereo);
  const std::vector<std::string> aovs{"depth", "position", "normal", "uv", "uv-gradient", "id"};
  for (const double time : {0.6, 3.0}) {
    const Look look = quietLook({{"ocean.speed", "1.7"}});
    const Frame two = drawAt(scene, look, time, both, aovs);
    for (size_t v = 0; v < 2; ++v) {
      const Frame one = drawAt(scene, look, time, {both[v]}, aovs);
      for (const std::string& name : aovs)
        EXPECT_LE(largestDifference(aov(two, name, v), aov(one, name)), 1e-5) << name << ", view " << v;
    }
  }
}

TEST_P(OceanDrawn, shadowsFallOnIt) {
  TestScene s;
  s.add(boxMesh({-0.25f, -1, -0.25f}, {0.25f, 4, 0.25f}),
        s.material(TestScene::colored("Wood", {0.5f, 0.4f, 0.3f, 1})));
  s.light({-1, 1, 0});
  const Scene scene = s.load();
  const Look look = quietLook({{"ocean.mode", "on"}, {"ocean.wind", "0"}, {"warp.amount", "0"}});
  const Frame frame = drawAt(scene, look, 0, viewsOf(scene, {{2, 9, 5}, {2, 0, 0}}),
                             {"position", "id", "shadow", "final-shadow"});
  for (size_t v = 0; v < viewCount(); ++v) {
    double dark = 0, light = 0;
    size_t darkCount = 0, lightCount = 0;
    for (int y = 0; y < kSeaHeight; ++y)
      for (int x = 0; x < kSeaWidth; ++x) {
        if (int(texel(aov(frame, "id", v), x, y).x) != oceanId(scene)) continue;
        const glm::dvec4 at = texel(aov(frame, "position", v), x, y);
        const double shadow = texel(aov(frame, "final-shadow", v), x, y).x;
        if (at.x > 0.6 && at.x < 3.4 && std::abs(at.z) < 0.12) dark += shadow, ++darkCount;
        if (at.x < -0.6 || at.x > 5 || std::abs(at.z) > 1) light += shadow, ++lightCount;
      }
    ASSERT_GT(darkCount, 20u);
    ASSERT_GT(lightCount, 500u);
    EXPECT_LT(dark / double(darkCount), 0.3);
    EXPECT_GT(light / double(lightCount), 0.8);
  }
}

}  // namespace
}  // namespace scumble
