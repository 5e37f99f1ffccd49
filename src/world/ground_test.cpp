#include "world/ground.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <memory>

#include "tests/support/aov.h"
#include "tests/support/render_test.h"

namespace scumble::world {
namespace {

using namespace test;

scene::Bounds someBounds() {
  scene::Bounds bounds;
  bounds.add(glm::vec3(-1, 2, -3));
  bounds.add(glm::vec3(4, 7, 5));
  return bounds;
}

// Strokes are seen from above, lie between ground and scene, each on its own height, and leave most of the
// ground alone.
TEST(Ground, strokesLieOnItBelowTheScene) {
  const scene::Bounds bounds = someBounds();
  const float ground = groundHeight(bounds);
  ASSERT_LT(ground, bounds.min.y);
  for (int tone = 1; tone < kGroundTones; ++tone) {
    const scene::Primitive strokes = makeGroundStrokes(bounds, tone);
    double area = 0;
    for (const glm::vec3& p : strokes.positions) {
      EXPECT_GT(p.y, ground);
      EXPECT_LT(p.y, bounds.min.y);
    }
    for (size_t i = 0; i < strokes.indices.size(); i += 3) {
      const glm::vec3 a = strokes.positions[strokes.indices[i]],
                      b = strokes.positions[strokes.indices[i + 1]],
                      c = strokes.positions[strokes.indices[i + 2]];
      const glm::vec3 cross = glm::cross(b - a, c - a);
      EXPECT_GT(cross.y, 0);
      area += 0.5 * double(cross.y) * double(std::pow(glm::length(a - bounds.center()), -2.0f));
    }
    // By solid angle at the scene, about: of a turn and the octaves that they lie in.
    const double part = area / (2 * 3.14159265 * 4 * std::log(2.0));
    EXPECT_GT(part, 0.05) << tone;
    EXPECT_LT(part, 0.2) << tone;
  }
}

// Pattern coordinates run on over disc and strokes.
TEST(Ground, patternsRunOnOverStrokes) {
  const scene::Bounds bounds = someBounds();
  for (int tone = 0; tone < kGroundTones; ++tone) {
    const scene::Primitive part = tone == 0 ? makeGround(bounds) : makeGroundStrokes(bounds, tone);
    for (size_t v = 0; v < part.vertexCount(); ++v) {
      const glm::vec3 at = (part.positions[v] - bounds.center()) / bounds.radius();
      EXPECT_NEAR(part.uv0[v].x, at.x, 1e-4 * (1 + std::abs(at.x)));
      EXPECT_NEAR(part.uv0[v].y, at.z, 1e-4 * (1 + std::abs(at.z)));
    }
  }
}

class GroundStrokesTest : public BothEyes {
 protected:
  static constexpr int kWidth = 160, kHeight = 120;

  // Roots of the ground's colours in light, and of how many pixels.
  static std::map<std::array<int, 3>, int> colors(const Frame& frame, size_t view) {
    std::map<std::array<int, 3>, int> count;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        if (texel(aov(frame, "id", view), x, y).x <= 1) continue;  // the box, and the sky
        const glm::dvec3 root =
            glm::round(255.0 * glm::sqrt(glm::dvec3(texel(aov(frame, "lit", view), x, y))));
        ++count[{int(root.r), int(root.g), int(root.b)}];
      }
    return count;
  }
};
INSTANTIATE_BOTH_EYES(GroundStrokesTest);

// Three tones as far apart as the knob says, the ground's own on most of it, and that exactly as without.
TEST_P(GroundStrokesTest, threeTones) {
  TestScene s;
  s.add(boxMesh({-0.3f, 0, -0.3f}, {0.3f, 1, 0.3f}),
        s.material(TestScene::colored("Box", {0.8f, 0.2f, 0.1f, 1})));
  s.light({-0.4f, 1, 0.5f});
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 2.2f, 4}, {0, 0, 0}, 45}, kWidth, kHeight, GetParam());
  const auto drawn = [&](const char* strokes) {
    return draw(scene,
                quietLook({{"ground.mode", "on"}, {"ground.tint", "#B0C0D0"}, {"ground.strokes", strokes}}),
                views, sized(kWidth, kHeight, {"lit", "id"}));
  };
  const Frame none = drawn("0");
  for (const auto& [knob, amount] : {std::pair{"0.25", 0.25f}, {"1", 1.0f}}) {
    const Frame some = drawn(knob);
    for (size_t v = 0; v < viewCount(); ++v) {
      const auto plain = colors(none, v), toned = colors(some, v);
      ASSERT_EQ(plain.size(), 1u);
      ASSERT_EQ(toned.size(), size_t(kGroundTones));
      const std::array<int, 3> own = plain.begin()->first;
      int all = 0;
      for (const auto& [color, count] : toned) all += count;
      EXPECT_GT(toned.at(own), all / 2);
      for (int tone = 1; tone < kGroundTones; ++tone) {
        const glm::vec3 factor = groundTone(tone, amount);
        bool isThere = false;
        for (const auto& [color, count] : toned) {
          bool fits = true;
          for (int c = 0; c < 3; ++c)
            fits &= std::abs(color[size_t(c)] - double(own[size_t(c)]) * double(factor[c])) <= 1.5;
          isThere |= fits && count > all / 50;
        }
        EXPECT_TRUE(isThere) << "tone " << tone << " at " << knob;
      }
    }
  }
}

// On a picture, where nothing but shadows is seen of the ground, and without any, they do not count.
TEST_P(GroundStrokesTest, onlyWhereTheGroundIsSeen) {
  TestScene s;
  s.add(boxMesh({-0.3f, 0, -0.3f}, {0.3f, 1, 0.3f}),
        s.material(TestScene::colored("Box", {0.8f, 0.2f, 0.1f, 1})));
  s.light({-0.4f, 1, 0.5f});
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 2.2f, 4}, {0, 0, 0}, 45}, kWidth, kHeight, GetParam());
  auto picture =
      std::make_shared<Image>(Image{8, 8, {"R", "G", "B", "A"}, std::vector<float>(8 * 8 * 4, 0.4f)});
  for (size_t i = 3; i < picture->pixels.size(); i += 4) picture->pixels[i] = 1;
  for (const bool overPicture : {false, true}) {
    RenderOptions options = sized(kWidth, kHeight, {}, 4);
    if (overPicture) options.background = picture;
    const auto drawn = [&](const char* strokes) {
      return draw(scene,
                  quietLook({{"ground.mode", overPicture ? "on" : "off"}, {"ground.strokes", strokes}}),
                  views, options);
    };
    const Frame none = drawn("0"), some = drawn("1");
    for (size_t v = 0; v < viewCount(); ++v)
      EXPECT_TRUE(sameBytes(aov(none, "", v), aov(some, "", v))) << overPicture;
  }
}

}  // namespace
}  // namespace scumble::world
