// Wakes, ripples and splashes as they are drawn: where their foam lies, that their meshes ride at the ocean's
// height, and that nothing shows where they end or have holes.
#include <algorithm>
#include <cmath>

#include "scene/scene_data.h"
#include "scumble/check.h"
#include "scumble/renderer.h"
#include "tests/support/animated_scene.h"
#include "tests/support/aov.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble {
namespace {

using namespace test;

constexpr int kWakeWidth = 96, kWakeHeight = 72;
const Stand kAbove{{0.1f, 20, 0.2f}}, kAside{{7, 4, 9}};

// A small box, "Boat", that goes along x by so many metres in four seconds, and begins anew.
Scene boatScene(float way = 0) {
  AnimatedScene s;
  const int mesh = s.mesh({boxMesh({-0.3f, -0.2f, -0.2f}, {0.3f, 0.2f, 0.2f}), 0, {}, {}, {}, {}},
                          s.material(TestScene::colored("Wood", {0.5f, 0.4f, 0.3f, 1})));
  const int boat = s.node({{"name", "Boat"}, {"mesh", mesh}});
  if (way != 0)
    s.channel(s.clip("Goes"), boat, "translation", "LINEAR", {0, 4}, {-0.5f * way, 0, 0, 0.5f * way, 0, 0});
  return s.load();
}

// A calm sea, if nothing else is said, whose own foam is off, and whose decorations' is magenta.
Look seaLook(const Knobs& knobs) {
  Knobs all{{"ocean.mode", "on"},
            {"ocean.wind", "0"},
            {"ocean.tiles", "1"},
            {"ocean.paint.foam", "0"},
            {"ocean.paint.foamColor", "#FF00FF"}};
  all.insert(all.end(), knobs.begin(), knobs.end());
  return quietLook(all);
}

class Decorations : public BothEyes {
 protected:
  static Frame drawAt(const Scene& scene, const Knobs& knobs, double time, const Stand& stand = kAbove,
                      double before = 0, uint32_t seed = 0) {
    RenderOptions options = sized(kWakeWidth, kWakeHeight, {"lit", "position", "id", "motion"});
    options.previousTime = before;
    options.seed = seed;
    Result<Frame> frame = renderer().render(
        scene, seaLook(knobs), time, viewsFrom(scene, stand, kWakeWidth, kWakeHeight, GetParam()), options);
    if (!frame) throw std::runtime_error(frame.error().message());
    return std::move(frame).value();
  }
  static bool isSea(const Scene& scene, const Frame& frame, int x, int y, size_t v) {
    return int(texel(aov(frame, "id", v), x, y).x) == int(scene.data().nodes.size()) + 2;
  }
  // Where in the world there is foam.
  static std::vector<glm::dvec3> foam(const Frame& frame, size_t v) {
    std::vector<glm::dvec3> places;
    for (int y = 0; y < kWakeHeight; ++y)
      for (int x = 0; x < kWakeWidth; ++x) {
        const glm::dvec4 lit = texel(aov(frame, "lit", v), x, y);
        if (lit.r > 0.8 && lit.g < 0.2 && lit.b > 0.8)
          places.emplace_back(texel(aov(frame, "position", v), x, y));
      }
    return places;
  }
  static double highest(const Scene& scene, const Frame& frame, size_t v) {
    double most = -1e9;
    for (int y = 0; y < kWakeHeight; ++y)
      for (int x = 0; x < kWakeWidth; ++x)
        if (isSea(scene, frame, x, y, v))
          most = std::max(most, double(texel(aov(frame, "position", v), x, y).y));
    return most;
  }
  static void expectSame(const Frame& a, const Frame& b, const std::string& what) {
    for (size_t v = 0; v < viewCount(); ++v)
      for (const char* name : {"", "lit", "position", "motion"})
        EXPECT_TRUE(sameBytes(aov(a, name, v), aov(b, name, v))) << what << " '" << name << "'";
  }
};
INSTANTIATE_BOTH_EYES(Decorations);

TEST_P(Decorations, areNotThereBeforeTheyBeginAndAfterTheyEnd) {
  const Scene scene = boatScene();
  for (const char* kind : {"ripples", "splash"}) {
    const Knobs knobs{{"decorations.D.water.kind", kind},
                      {"decorations.D.water.start", "2"},
                      {"decorations.D.water.lasts", "3"}};
    Knobs none = knobs;
    none.push_back({"decorations.D.water.amount", "0"});
    for (const double time : {1.99, 5.01}) {
      const Frame bare = drawAt(scene, {}, time, kAbove, time);
      expectSame(drawAt(scene, knobs, time, kAbove, time), bare, kind);
    }
    expectSame(drawAt(scene, none, 3, kAbove, 3), drawAt(scene, {}, 3, kAbove, 3), kind);
    EXPECT_FALSE(
        sameBytes(aov(drawAt(scene, knobs, 3), "position"), aov(drawAt(scene, none, 3), "position")));
  }
  expectSame(drawAt(scene, {{"decorations.D.water.node", "Nobody"}}, 3, kAbove, 3),
             drawAt(scene, {}, 3, kAbove, 3), "of a node that is not there");
}

// What has neither height nor foam is all hole: the water lies where it lay, only without strokes.
TEST_P(Decorations, holesShowTheWaterAtItsHeight) {
  const Scene scene = boatScene();
  const Knobs sea{{"ocean.wind", "7"}, {"ocean.speed", "2"}, {"ocean.tiles", "3"}};
  for (const Stand& stand : {kAside, kAbove})
    for (const char* kind : {"wake", "ripples", "splash"}) {
      Knobs knobs = sea;
      knobs.insert(knobs.end(), {{"decorations.D.water.kind", kind},
                                 {"decorations.D.water.node", "Boat"},
                                 {"decorations.D.water.height", "0"},
                                 {"decorations.D.water.foam", "0"}});
      const Frame bare = drawAt(scene, sea, 2.3, stand, 2.3), with = drawAt(scene, knobs, 2.3, stand, 2.3);
      for (size_t v = 0; v < viewCount(); ++v) {
        Difference heights(0.08);
        size_t differ = 0;
        for (int y = 0; y < kWakeHeight; ++y)
          for (int x = 0; x < kWakeWidth; ++x) {
            if (!isSea(scene, bare, x, y, v) || !isSea(scene, with, x, y, v)) continue;
            const glm::dvec4 a = texel(aov(bare, "position", v), x, y),
                             b = texel(aov(with, "position", v), x, y);
            if (glm::length(glm::dvec2(a.x, a.z)) < 25) heights.add(b.y, a.y);
            differ += texel(aov(bare, "lit", v), x, y) != texel(aov(with, "lit", v), x, y);
          }
        EXPECT_GT(heights.count, 3000u);
        // The two meshes differ by what a triangle of one cuts off an edge of the other. The water pushed
        // down below would lie 0.3 m deeper.
        EXPECT_LT(heights.mean(), 0.003) << kind << ": " << heights.text();
        EXPECT_LE(heights.beyond, 2u) << kind << ": " << heights.text();
        EXPECT_GT(differ, 20u) << kind << " suppresses strokes";
      }
    }
}

// (Paper 000, section 6.2: suppressed, so that the texture has effectively zero saliency.) Where a decoration
// lies, strokes keep a tenth of their contrast at most, and none is put on what is mirrored.
TEST_P(Decorations, leaveNoStrokesWhereTheyLie) {
  const Scene scene = boatScene();
  struct Zone {
    const char *kind, *radius, *start;
    double from, to;  // metres from the middle
  };
  // Of a wake, all around what makes it: behind it there is one.
  for (const Zone& zone : {Zone{"ripples", "6", "0", 0, 2.4}, Zone{"ripples", "8", "-2", 0, 4.5},
                           Zone{"splash", "3", "2", 0, 2.5}, Zone{"wake", "2", "0", 2.6, 4.4}}) {
    const bool isWake = std::string(zone.kind) == "wake";
    const Knobs sea{{"ocean.wind", "0"}, {"ocean.speed", isWake ? "2" : "0"}};
    Knobs knobs = sea;
    knobs.insert(knobs.end(), {{"decorations.D.water.kind", zone.kind},
                               {"decorations.D.water.radius", zone.radius},
                               {"decorations.D.water.start", zone.start},
                               {"decorations.D.water.height", "0"},
                               {"decorations.D.water.foam", "0"}});
    if (isWake) knobs.push_back({"decorations.D.water.node", "Boat"});
    // What strokes there are is what another seed changes.
    const Frame bare[] = {drawAt(scene, sea, 4), drawAt(scene, sea, 4, kAbove, 0, 1)},
                with[] = {drawAt(scene, knobs, 4), drawAt(scene, knobs, 4, kAbove, 0, 1)};
    for (size_t v = 0; v < viewCount(); ++v) {
      // By direction: sums of squares of that, before and after.
      constexpr int kSectors = 36;
      double sums[kSectors][3] = {};
      for (int y = 0; y < kWakeHeight; ++y)
        for (int x = 0; x < kWakeWidth; ++x) {
          if (!isSea(scene, bare[0], x, y, v) || !isSea(scene, with[0], x, y, v)) continue;
          const glm::dvec4 place = texel(aov(bare[0], "position", v), x, y);
          const double away = std::hypot(place.x, place.z);
          if (away < zone.from || away > zone.to) continue;
          const double turn = std::atan2(place.z, place.x) / 6.2831854 + 0.5;
          double* sum = sums[isWake ? int(turn * kSectors) % kSectors : 0];
          const auto change = [&](const Frame* frames) {
            return glm::distance(texel(aov(frames[0], "lit", v), x, y),
                                 texel(aov(frames[1], "lit", v), x, y));
          };
          sum[0] += std::pow(change(bare), 2), sum[1] += std::pow(change(with), 2), ++sum[2];
        }
      double least = 1e9;
      for (const double* sum : sums) {
        if (sum[2] < 25) continue;
        EXPECT_GT(std::sqrt(sum[0] / sum[2]), 0.005) << zone.kind;
        least = std::min(least, std::sqrt(sum[1] / sum[0]));
      }
      EXPECT_LE(least, 0.1) << zone.kind << " " << zone.radius << " from " << zone.start;
    }
  }
}

TEST_P(Decorations, wakesLieBehindWhatGoesThroughTheWater) {
  // The boat goes; the scene travels; the boat goes one way and the scene as fast back over the water.
  struct Case {
    float way;
    const char *speed, *what;
    double boat;  // where it is
    bool hasWake;
  };
  for (const Case& c : {Case{8, "0", "the boat goes", 2.8, true}, Case{0, "2", "the scene travels", 0, true},
                        Case{8, "-2", "neither, over the water", 2.8, false}}) {
    const Scene scene = boatScene(c.way);
    const Frame frame = drawAt(scene,
                               {{"ocean.speed", c.speed},
                                {"decorations.D.water.node", "Boat"},
                                {"decorations.D.water.length", "0.8"},
                                {"decorations.D.water.beam", "0.6"}},
                               3.4);
    for (size_t v = 0; v < viewCount(); ++v) {
      const std::vector<glm::dvec3> places = foam(frame, v);
      if (!c.hasWake) {
        EXPECT_EQ(places.size(), 0u) << c.what;
        continue;
      }
      ASSERT_GT(places.size(), 30u) << c.what;
      double farthest = 0;
      for (const glm::dvec3& at : places) {
        const double behind = c.boat - at.x;
        EXPECT_GT(behind, -1.0) << c.what;
        EXPECT_LT(std::abs(at.z), 0.5 + 0.35 * std::max(behind + 0.4, 0.0)) << c.what;
        farthest = std::max(farthest, behind);
      }
      EXPECT_GT(farthest, 2) << c.what;
    }
  }
}

TEST_P(Decorations, wakesDoNotGoBackToWhereAClipEnded) {
  const Scene scene = boatScene(8);
  const Frame frame = drawAt(
      scene, {{"decorations.D.water.node", "Boat"}, {"decorations.D.water.length", "0.8"}}, 4.3);  // at -3.4
  for (size_t v = 0; v < viewCount(); ++v) {
    const std::vector<glm::dvec3> places = foam(frame, v);
    EXPECT_GT(places.size(), 10u);
    for (const glm::dvec3& at : places) EXPECT_LT(at.x, -2.4);
  }
}

TEST_P(Decorations, ripplesRunOutward) {
  const Scene scene = boatScene();
  const auto mean = [&](double time, size_t v) {
    const std::vector<glm::dvec3> places = foam(drawAt(scene,
                                                       {{"decorations.D.water.kind", "ripples"},
                                                        {"decorations.D.water.at", "1,7,-0.5"},
                                                        {"decorations.D.water.radius", "4"},
                                                        {"decorations.D.water.foam", "2"},
                                                        {"decorations.D.water.every", "6"}},
                                                       time),
                                                v);
    double sum = 0;
    for (const glm::dvec3& at : places) sum += glm::length(glm::dvec2(at.x - 1, at.z + 0.5));
    EXPECT_GT(places.size(), 3u) << time;
    return sum / double(std::max<size_t>(places.size(), 1));
  };
  for (size_t v = 0; v < viewCount(); ++v) {
    const double early = mean(2, v), late = mean(4.5, v);
    EXPECT_GT(late, 1.5 * early);
    EXPECT_LT(late, 4);
  }
}

TEST_P(Decorations, splashesRiseAndFall) {
  const Scene scene = boatScene();
  const auto heightAt = [&](double time, size_t v) {
    return highest(scene,
                   drawAt(scene,
                          {{"decorations.D.water.kind", "splash"},
                           {"decorations.D.water.at", "2,0,2"},
                           {"decorations.D.water.radius", "1.5"}},
                          time, kAside),
                   v);
  };
  for (size_t v = 0; v < viewCount(); ++v) {
    const double flight = 2 * std::sqrt(2 * 0.675 / 9.81);  // to a height of 0.45 radii
    EXPECT_GT(heightAt(0.5 * flight, v), 0.4);
    EXPECT_LT(heightAt(0.5 * flight, v), 0.75);
    EXPECT_GT(heightAt(0.5 * flight, v), heightAt(0.2 * flight, v) + 0.05);
    EXPECT_LT(heightAt(1.1 * flight, v), 0.2);
  }
}

// Decorated water moves as the water does.
TEST_P(Decorations, motionIsTheWaters) {
  const Scene scene = boatScene();
  const Frame frame = drawAt(
      scene,
      {{"ocean.speed", "2"}, {"decorations.D.water.node", "Boat"}, {"decorations.D.water.height", "0"}}, 2.5,
      kAbove, 2.25);
  const auto views = viewsFrom(scene, kAbove, kWakeWidth, kWakeHeight, GetParam());
  for (size_t v = 0; v < viewCount(); ++v) {
    Difference moved(0.03);
    for (int y = 0; y < kWakeHeight; ++y)
      for (int x = 0; x < kWakeWidth; ++x) {
        if (!isSea(scene, frame, x, y, v)) continue;
        const glm::dvec3 at(texel(aov(frame, "position", v), x, y));
        const glm::dvec2 expected =
            glm::dvec2(x, y) + 0.5 - pixelOf(views[v], at + glm::dvec3(0.5, 0, 0), kWakeWidth, kWakeHeight);
        moved.add(texel(aov(frame, "motion", v), x, y).x, expected.x);
        moved.add(texel(aov(frame, "motion", v), x, y).y, expected.y);
      }
    EXPECT_GT(moved.count, 5000u);
    EXPECT_EQ(moved.beyond, 0u) << moved.text();
  }
}

TEST_P(Decorations, hostileSettingsGiveFinitePictures) {
  const Scene scene = boatScene(8);
  size_t turn = 0;
  for (const Knobs& knobs :
       std::vector<Knobs>{{{"water.radius", "1000"}, {"water.height", "10"}},
                          {{"water.radius", "0.05"}, {"water.crests", "8"}, {"water.every", "0.001"}},
                          {{"water.beam", "1000"}, {"water.length", "0.1"}, {"water.spread", "45"}},
                          {{"water.beam", "0.05"}, {"water.length", "1000"}, {"water.lasts", "120"}},
                          {{"water.lasts", "0.1"}, {"water.height", "10"}},
                          {{"water.at", "1000000,0,-1000000"}},
                          {{"water.start", "-1000000"}, {"water.every", "0.01"}, {"water.lasts", "120"}}})
    for (const char* kind : {"wake", "ripples", "splash"}) {
      if (turn++ % 2 + 1 != viewCount()) continue;
      Knobs all{{"ocean.wind", "20"}, {"ocean.speed", "100"}, {"decorations.D.water.kind", kind}};
      if (turn % 3 == 0) all.insert(all.end(), {{"ocean.grid", "1"}, {"ocean.tile", "1"}});
      for (const auto& [knob, value] : knobs) all.push_back({"decorations.D." + knob, value});
      const Frame frame = drawAt(scene, all, 1.3, turn % 2 ? kAside : kAbove, 1.2);
      for (const Frame::Layer& layer : frame.layers)
        for (const Image& image : layer.views)
          EXPECT_TRUE(
              std::all_of(image.pixels.begin(), image.pixels.end(), [](float x) { return std::isfinite(x); }))
              << kind << ", '" << layer.name << "' with " << knobs[0].first << " " << knobs[0].second;
    }
}

TEST(DecorationSettings, areChecked) {
  const auto problem = [](const Knobs& knobs) {
    Look look;
    for (const auto& [path, value] : knobs)
      if (const Status set = look.set(path, value); !set) return set.error().message();
    return std::string();
  };
  EXPECT_EQ(problem({{"decorations.D.water.kind", "splash"}}), "");
  EXPECT_NE(problem({{"decorations.D.water.kind", "wave"}}).find("splash"), std::string::npos);
  EXPECT_NE(problem({{"decorations.D.water.radius", "-1"}}), "");
  EXPECT_NE(problem({{"decorations.D.water.crests", "1.5"}}), "");
  EXPECT_NE(problem({{"decorations.D.water.hight", "1"}}).find("height"), std::string::npos);
  EXPECT_NE(problem({{"water.height", "1"}}), "");
  Knobs many;
  for (int i = 0; i < 17; ++i) many.push_back({"decorations.D" + std::to_string(i) + ".water.foam", "1"});
  EXPECT_NE(problem(many).find("16"), std::string::npos);
  many.pop_back();
  EXPECT_EQ(problem(many), "");

  Look look = seaLook({{"decorations.D.water.node", "Bote"}, {"decorations.E.water.node", "Boat"}});
  const auto found = [](const Look& of, Finding::Kind kind) {
    std::vector<std::string> settings;
    for (const Finding& one : check(boatScene(), of))
      if (one.kind == kind) settings.push_back(one.setting);
    return settings;
  };
  EXPECT_EQ(found(look, Finding::Kind::noSuchNode), std::vector<std::string>{"decorations.D.water.node"});

  EXPECT_TRUE(found(look, Finding::Kind::notThere).empty());
  ASSERT_TRUE(look.set("ocean.mode", "off").ok());
  EXPECT_EQ(found(look, Finding::Kind::notThere),
            (std::vector<std::string>{"decorations", "ocean", "ocean.paint"}));
  EXPECT_TRUE(found(*Look::load("storm"), Finding::Kind::notThere).empty()) << "it is for many scenes";
}

}  // namespace
}  // namespace scumble
