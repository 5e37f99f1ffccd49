// Point and spot lights on surfaces, against KHR_lights_punctual in double precision.
#include <glm/gtc/matrix_transform.hpp>

#include "passes/surface/surface_knobs.h"
#include "tests/support/aov.h"
#include "tests/support/render_test.h"

namespace scumble::passes {
namespace {

using namespace test;

constexpr double kLightByte = 1.0 / 255;
constexpr int kLampsWidth = 96, kLampsHeight = 72;

struct Lamp {
  glm::dvec3 position;
  double intensity = 1, range = 0;  // metres; 0: infinite
  double inner = 0, outer = 0;      // radians; outer 0: a point light
  double turn = 0;                  // around X: shines along -Z turned by it
  glm::dvec3 direction() const { return {0, std::sin(turn), -std::cos(turn)}; }
};

// The extension's formulas.
double lightOf(const Lamp& lamp, const glm::dvec3& point, const glm::dvec3& normal) {
  const glm::dvec3 away = lamp.position - point;
  const double d = glm::length(away);
  double light = lamp.intensity * std::max(glm::dot(away / d, normal), 0.0) / (d * d);
  if (lamp.range > 0) light *= std::max(std::min(1 - std::pow(d / lamp.range, 4), 1.0), 0.0);
  if (lamp.outer > 0) {
    const double scale = 1 / std::max(0.001, std::cos(lamp.inner) - std::cos(lamp.outer));
    const double cone =
        std::clamp(glm::dot(lamp.direction(), -away / d) * scale - std::cos(lamp.outer) * scale, 0.0, 1.0);
    light *= cone * cone;
  }
  return light;
}

class PunctualLightsTest : public BothEyes {
 protected:
  static void addLamps(TestScene& s, const std::vector<Lamp>& lamps) {
    if (lamps.empty()) return;
    Json& list = s.json()["extensions"]["KHR_lights_punctual"]["lights"];
    for (const Lamp& lamp : lamps) {
      Json json = {{"type", lamp.outer > 0 ? "spot" : "point"}, {"intensity", lamp.intensity}};
      if (lamp.range > 0) json["range"] = lamp.range;
      if (lamp.outer > 0) json["spot"] = {{"innerConeAngle", lamp.inner}, {"outerConeAngle", lamp.outer}};
      list.push_back(json);
      s.json()["scenes"][0]["nodes"].push_back(s.json()["nodes"].size());
      s.json()["nodes"].push_back({{"translation", {lamp.position.x, lamp.position.y, lamp.position.z}},
                                   {"rotation", {std::sin(lamp.turn / 2), 0, 0, std::cos(lamp.turn / 2)}},
                                   {"extensions", {{"KHR_lights_punctual", {{"light", list.size() - 1}}}}}});
    }
  }
};
INSTANTIATE_BOTH_EYES(PunctualLightsTest);

// A floor of many colours and a wall of one, with the key light from behind the wall, where it reaches
// nothing.
TEST_P(PunctualLightsTest, followTheExtension) {
  const std::vector<Lamp> lamps{{{-0.8, 0.6, 0.5}, 0.35, 1.6, 0, 0, 0},
                                {{0.9, 0.9, 0.2}, 0.6, 0, 0.2, 0.7, -1.2},
                                {{0, 0.5, 1.0}, 0.1, 0, 0, 0, 0}};
  TestScene s;
  TestMesh floor = gridMesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -3}, 8);
  floor.colors.assign(floor.positions.size(), {0.5f, 0.4f, 0.3f, 1});
  s.add(floor, s.material(TestScene::colored("Floor", {1, 1, 1, 1})));
  // A wall that turns its back: seen from behind, lit from where it is seen.
  Json wall = TestScene::colored("Wall", {0.5f, 0.5f, 0.5f, 1});
  wall["doubleSided"] = true;
  s.add(gridMesh({2, 0, -1}, {-4, 0, 0}, {0, 2, 0}), s.material(wall));
  s.light({0, -1, -1});
  addLamps(s, lamps);
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 1.5f, 4}, {0, 0.4f, 0}}, kLampsWidth, kLampsHeight, GetParam());
  const Frame frame = draw(scene,
                           quietLook({{"light.punctualUnit", "candela"},
                                      {"light.punctual", "0.8"},
                                      {"light.terminatorSharpness", "64"},
                                      {"shadowMap.cast", "off"}}),
                           views, sized(kLampsWidth, kLampsHeight, {"shadow", "position", "normal", "id"}));
  for (size_t v = 0; v < viewCount(); ++v) {
    Difference light(2.0 * kLightByte);
    double most = 0;
    for (int y = 0; y < kLampsHeight; ++y)
      for (int x = 0; x < kLampsWidth; ++x) {
        if (texel(aov(frame, "id", v), x, y).x == 0) continue;
        const glm::dvec3 point(texel(aov(frame, "position", v), x, y)),
            normal(texel(aov(frame, "normal", v), x, y));
        double expected = 0;
        for (const Lamp& lamp : lamps) expected += 0.8 * lightOf(lamp, point, normal);
        light.add(texel(aov(frame, "shadow", v), x, y).x, std::min(expected, 1.0));
        most = std::max(most, expected);
      }
    EXPECT_GT(light.count, 2000u);
    EXPECT_GT(most, 0.7);
    EXPECT_LT(light.beyondPart(), 0.002) << light.text();
  }
}

// Off, a scene with lamps is one without, to the bit; on, light is only added.
TEST_P(PunctualLightsTest, offChangesNothing) {
  const auto sceneWith = [](const std::vector<Lamp>& lamps) {
    TestScene s;
    s.add(sphereMesh({0, 1, 0}, 1), s.material(TestScene::colored("Ball", {0.5f, 0.3f, 0.2f, 1})));
    s.light({-1, 1, 0.5f});
    addLamps(s, lamps);
    return s.load();
  };
  const Scene with = sceneWith({{{1.05, 1, 1.05}, 500, 0, 0, 0, 0}}), without = sceneWith({});
  const auto views = viewsFrom(without, {{0, 1, 5}, {0, 1, 0}}, kLampsWidth, kLampsHeight, GetParam());
  const auto options = sized(kLampsWidth, kLampsHeight, {"shadow"}, 4);
  const Frame dark = draw(without, quietLook(), views, options),
              off = draw(with, quietLook({{"light.punctual", "0"}}), views, options),
              on = draw(with, quietLook(), views, options);
  for (size_t v = 0; v < viewCount(); ++v) {
    EXPECT_TRUE(sameBytes(aov(dark, "", v), aov(off, "", v)));
    EXPECT_TRUE(sameBytes(aov(dark, "shadow", v), aov(off, "shadow", v)));
    int lit = 0;
    for (int y = 0; y < kLampsHeight; ++y)
      for (int x = 0; x < kLampsWidth; ++x) {
        const glm::dvec4 before = texel(aov(dark, "shadow", v), x, y),
                         after = texel(aov(on, "shadow", v), x, y);
        EXPECT_GE(after.x, before.x);
        EXPECT_EQ(after.z, before.z);
        lit += before.x < 0.5 && after.x > 0.5;
      }
    EXPECT_GT(lit, 20) << "the lamp turns shadow into light";
  }
}

}  // namespace
}  // namespace scumble::passes
