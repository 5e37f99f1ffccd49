// Weights of lines follow light and form: the key light, lamps near by, and how round a file says that a form
// is.
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "tests/support/aov.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble::ink {
namespace {

using namespace test;

// Outlines alone, centred and whole, from 9 to 63 pixels wide at 1080 lines.
Knobs weighedLines(const Knobs& more = {}) {
  Knobs knobs{{"ink.shown", "on"},
              {"ink.least", "9"},
              {"ink.greatest", "63"},
              {"ink.placement", "centred"},
              {"ink.fade", "0"},
              {"ink.outer", "1"},
              {"ink.weights", "tangent"},
              {"warp.amount", "0"},
              {"ink.creases.shown", "off"},
              {"light.punctualUnit", "candela"}};
  knobs.insert(knobs.end(), more.begin(), more.end());
  return knobs;
}

class InkWeights : public BothEyes {
 protected:
  static constexpr int kWidth = 160, kHeight = 120;

  static void addLamp(TestScene& s, const glm::vec3& place, double candela) {
    Json& list = s.json()["extensions"]["KHR_lights_punctual"]["lights"];
    list.push_back({{"type", "point"}, {"intensity", candela}});
    s.json()["scenes"][0]["nodes"].push_back(s.json()["nodes"].size());
    s.json()["nodes"].push_back({{"translation", {place.x, place.y, place.z}},
                                 {"extensions", {{"KHR_lights_punctual", {{"light", list.size() - 1}}}}}});
  }
  // A ball of a radius around the origin, seen from eight radii before it.
  static TestScene ball(float radius) {
    TestScene s;
    s.add(sphereMesh({0, 0, 0}, radius, 64), s.material(TestScene::colored("Thing", {0.6f, 0.5f, 0.4f, 1})));
    return s;
  }
  Frame drawn(const Scene& scene, float radius, const Knobs& knobs) {
    views_ =
        viewsFrom(scene, {{0, 0, 8 * radius}, {0, 0, 0}, 20, 0, 0.02f * radius}, kWidth, kHeight, GetParam());
    return draw(scene, quietLook(weighedLines(knobs)), views_, sized(kWidth, kHeight, {"ink"}));
  }
  // Holds widths all around the ball against those where light comes from `lightAt` a place.
  void expectWidths(const Frame& frame, float radius, const std::string& what,
                    const std::function<glm::dvec3(const glm::dvec3&)>& lightAt) {
    for (size_t v = 0; v < viewCount(); ++v) {
      const glm::dvec2 middle = pixelOf(views_[v], {0, 0, 0}, kWidth, kHeight);
      for (int i = 0; i < 24; ++i) {
        const double angle = i * std::numbers::pi / 12;
        // Rows go down.
        const glm::dvec3 normal(std::cos(angle), -std::sin(angle), 0);
        double width = 0;
        for (double r = 25; r < 58; r += 0.05) {
          const glm::dvec2 at = middle + r * glm::dvec2(std::cos(angle), std::sin(angle));
          width += 0.05 * texel(aov(frame, "ink", v), int(at.x), int(at.y)).w;
        }
        const double light = glm::clamp(glm::dot(normal, lightAt(double(radius) * normal)), -1.0, 1.0);
        const double expected = (36 - 27 * light) * kHeight / 1080;
        EXPECT_NEAR(width, expected, 0.15 * expected + 0.35) << what << ", " << i;
      }
    }
  }

  std::vector<View> views_;
};
INSTANTIATE_BOTH_EYES(InkWeights);

// (Paper 004, section 2: light is one point source.) A scene's only lamp is its key light, and as near as it
// is: the same from afar as a light without end, whatever the scene's size.
TEST_P(InkWeights, followTheOnlyLampFromWhereItStands) {
  for (const float radius : {0.01f, 1.0f, 300.0f})
    for (const double away : {1.9, 3.0, 200.0}) {
      TestScene s = ball(radius);
      const glm::vec3 lamp = float(away) * radius * glm::vec3(0.8f, 0.6f, 0);
      addLamp(s, lamp, 1);
      const Scene scene = s.load();
      const Frame frame = drawn(scene, radius, {});
      expectWidths(frame, radius, std::to_string(radius) + " m, lamp at " + std::to_string(away),
                   [&](const glm::dvec3& place) { return glm::normalize(glm::dvec3(lamp) - place); });
    }
}

// Lamps count beside the key light by how much they light, and not where a look turns them off.
TEST_P(InkWeights, followLampsByHowMuchTheyLight) {
  const glm::dvec3 key = glm::normalize(glm::dvec3(-1, 0.3, 0.2)), lamp(1.3, 0.4, 0.1);
  for (const double candela : {0.0, 0.3, 8.0}) {
    TestScene s = ball(1);
    s.light(glm::vec3(key));
    addLamp(s, glm::vec3(lamp), candela);
    const Scene scene = s.load();
    expectWidths(drawn(scene, 1, {}), 1, std::to_string(candela) + " candela", [&](const glm::dvec3& place) {
      const glm::dvec3 away = lamp - place;
      const double squared = glm::dot(away, away);
      const glm::dvec3 light = key + candela / squared * glm::normalize(away);
      return light / std::max(glm::length(light), 1.0);
    });
    expectWidths(drawn(scene, 1, {{"light.punctual", "0"}}), 1, "off",
                 [&](const glm::dvec3&) { return key; });
  }
}

// (Section 2.3: the parameter is a vertex's, so that the transition is smooth.) Weights go from those of the
// tangents to those of the vertices as far as `_ROUND` says, and switch nowhere.
TEST_P(InkWeights, roundnessIsBlended) {
  const auto drawnWith = [&](const std::function<float(const glm::vec3&)>& roundness, const char* weights) {
    TestMesh ball = sphereMesh({0, 0, 0}, 1, 10);
    for (const glm::vec3& position : ball.positions) ball.roundness.push_back(roundness(position));
    TestScene s;
    s.add(ball, s.material(TestScene::colored("Thing", {0.6f, 0.5f, 0.4f, 1})));
    s.light({1, 0.4f, 0.2f});
    const Scene scene = s.load();
    views_ = viewsFrom(scene, {{0, 1, 7}, {0, 0, 0}, 20, 0, 0.05f}, kWidth, kHeight, GetParam());
    return draw(scene, quietLook(weighedLines({{"ink.weights", weights}})), views_,
                sized(kWidth, kHeight, {"ink"}));
  };
  const auto apart = [&](const Frame& a, const Frame& b, size_t v, int from, int to) {
    double sum = 0;
    for (int y = from; y < to; ++y)
      for (int x = 0; x < kWidth; ++x)
        sum += std::abs(texel(aov(a, "ink", v), x, y).w - texel(aov(b, "ink", v), x, y).w);
    return sum;
  };
  const auto all = [](float value) { return [value](const glm::vec3&) { return value; }; };
  const Frame sharp = drawnWith(all(0), "hybrid"), round = drawnWith(all(1), "hybrid"),
              less = drawnWith(all(0.49f), "hybrid"), more = drawnWith(all(0.51f), "hybrid"),
              half = drawnWith([](const glm::vec3&p) { return p.y > 0.05f ? 1.0f : 0.0f; }, "hybrid");
  for (size_t v = 0; v < viewCount(); ++v) {
    const double whole = apart(sharp, round, v, 0, kHeight);
    EXPECT_GT(whole, 10);
    EXPECT_LT(apart(less, more, v, 0, kHeight), 0.1 * whole);
    EXPECT_NEAR(apart(sharp, less, v, 0, kHeight), 0.5 * whole, 0.15 * whole);
    EXPECT_NEAR(apart(round, more, v, 0, kHeight), 0.5 * whole, 0.15 * whole);
    // By vertex: round above, sharp below.
    EXPECT_LT(apart(half, round, v, 0, kHeight / 3), 0.02 * whole);
    EXPECT_LT(apart(half, sharp, v, 2 * kHeight / 3, kHeight), 0.02 * whole);
  }
}

}  // namespace
}  // namespace scumble::ink
