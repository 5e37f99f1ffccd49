// Lines that follow from what is seen: where pieces meet, where objects end, what textures cut out, steps of
// light.
#include <gtest/gtest.h>

#include <functional>

#include "tests/support/aov.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble::ink {
namespace {

using namespace test;

class InkOver : public BothEyes {
 protected:
  static constexpr int kWidth = 160, kHeight = 120;

  // Red lines of one kind and no others, in a picture that has no red.
  static Knobs only(const std::string& kind, const Knobs& more = {}) {
    Knobs knobs{{"ink.shown", "on"},
                {"ink.least", "27"},
                {"ink.greatest", "27"},
                {"ink.line.color", "#FF0000"},
                {"warp.amount", "0"},
                {"ink.silhouettes.shown", "off"},
                {"ink.creases.shown", "off"},
                {"ink.materials.shown", "off"},
                {"ink.boundaries.shown", "off"},
                {"shadow.indication", "0"},
                {"shadow.innerGlow", "0"}};
    knobs.push_back({"ink." + kind + ".shown", "on"});
    knobs.push_back({"ink." + kind + ".width", "1"});
    knobs.insert(knobs.end(), more.begin(), more.end());
    return knobs;
  }
  struct Red {
    const Frame& frame;
    const View& view;
    size_t index;
    bool isAt(int x, int y) const {
      const glm::dvec4 color = texel(aov(frame, "", index), x, y);
      return color.x > 0.9 && color.y < 0.1;
    }
    bool isAt(const glm::dvec3& place) const {
      const glm::dvec2 at = pixelOf(view, place, kWidth, kHeight);
      return isAt(int(at.x), int(at.y));
    }
    size_t count() const {
      size_t pixels = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) pixels += isAt(x, y);
      return pixels;
    }
  };
  void forEachEye(const Scene& scene, const Knobs& knobs, const glm::vec3& eye,
                  const std::function<void(const Red&)>& check) {
    const auto views = viewsFrom(scene, {eye, {0, 0, 0}, 40, 0, 0.1f}, kWidth, kHeight, GetParam());
    const Frame frame = draw(scene, quietLook(knobs), views, sized(kWidth, kHeight, {"final-shadow"}));
    for (size_t v = 0; v < viewCount(); ++v) check(Red{frame, views[v], v});
  }
  static int grey(TestScene& s) { return s.material(TestScene::colored("Grey", {0.5f, 0.5f, 0.5f, 1})); }
  // Two meshes, as one mesh of one node or as two nodes.
  static Scene pair(const TestMesh& one, const TestMesh& other, bool isOneMesh) {
    TestScene s;
    const int material = grey(s);
    if (isOneMesh) {
      TestMesh both;
      for (const TestMesh& mesh : {one, other}) append(both, mesh, {1, 1, 1, 1});
      s.add(both, material);
    } else {
      for (const TestMesh& mesh : {one, other}) s.add(mesh, material);
    }
    return s.load();
  }
};
INSTANTIATE_BOTH_EYES(InkOver);

// A flat square of two triangles, of micrometres and of hundreds of kilometres: its diagonal is no crease.
TEST_P(InkOver, flatFormsHaveNoCreasesAtAnySize) {
  for (const float size : {1e-5f, 1e-3f, 1.0f, 1e4f, 3e5f}) {
    TestScene s;
    s.add(gridMesh(size * glm::vec3(-1, -1, 0), {2 * size, 0, 0}, {0, 2 * size, 0}), grey(s));
    const Scene scene = s.load();
    const auto views =
        viewsFrom(scene, {{0, 0, 5 * size}, {0, 0, 0}, 40, 0, 0.1f * size}, kWidth, kHeight, GetParam());
    const Frame frame = draw(scene, quietLook(only("creases")), views, sized(kWidth, kHeight));
    for (size_t v = 0; v < viewCount(); ++v) EXPECT_EQ((Red{frame, views[v], v}.count()), 0u) << size;
  }
}

// A block, and a beam that comes out of its front; of one primitive, or two things.
TEST_P(InkOver, piecesThatMeetHaveALineThere) {
  const TestMesh block = boxMesh({-1, -1, -0.5f}, {1, 1, 0.5f}),
                 beam = boxMesh({-0.3f, -0.3f, -0.4f}, {0.3f, 0.3f, 1.5f});
  for (const bool isOneMesh : {true, false}) {
    forEachEye(pair(block, beam, isOneMesh), only("intersections"), {2.5f, 2, 4}, [](const Red& red) {
      for (const double along : {-0.2, 0.0, 0.2}) {
        EXPECT_TRUE(red.isAt({0.3, along, 0.5})) << along;
        EXPECT_TRUE(red.isAt({along, 0.3, 0.5})) << along;
        // Its other sides are hidden; its own edges, and where it stands before the block, are no
        // intersections.
        EXPECT_FALSE(red.isAt({-0.3, along, 0.5})) << along;
        EXPECT_FALSE(red.isAt({-0.3, along, 1.5})) << along;
        EXPECT_FALSE(red.isAt({0.3, along, 1.5})) << along;
        EXPECT_FALSE(red.isAt({1, along, 0.5})) << along;
      }
      EXPECT_LT(red.count(), 130u);
    });
  }
}

// Of two things, one before the other; as one thing it is but the outline of both.
TEST_P(InkOver, objectsEndInLines) {
  const TestMesh back = boxMesh({-1.2f, -1, -0.5f}, {1.2f, 1, 0.5f}),
                 front = boxMesh({-0.3f, -0.3f, 1}, {0.3f, 0.3f, 1.2f});
  for (const bool isOneObject : {true, false}) {
    forEachEye(pair(back, front, isOneObject), only("objects"), {0, 0, 6}, [&](const Red& red) {
      for (const double along : {-0.2, 0.0, 0.2}) {
        EXPECT_EQ(red.isAt({0.3, along, 1.2}), !isOneObject);
        EXPECT_EQ(red.isAt({along, -0.3, 1.2}), !isOneObject);
        EXPECT_TRUE(red.isAt({along, 1, 0.5}));
        EXPECT_FALSE(red.isAt({along, 0, 1.2}));
        EXPECT_FALSE(red.isAt({along, 0.6, 0.5}));
      }
    });
  }
}

// A sheet of which a texture leaves the left half, before a wall.
TEST_P(InkOver, texturesCutLines) {
  Image half{8, 8, {"R", "G", "B", "A"}, {}};
  for (int i = 0; i < 64; ++i)
    half.pixels.insert(half.pixels.end(), {0.5f, 0.5f, 0.5f, i % 8 < 4 ? 1.0f : 0.0f});
  TestScene s;
  Json json = TestScene::colored("Leaf", {1, 1, 1, 1});
  json["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", s.texture(half)}};
  json["alphaMode"] = "MASK";
  s.add(gridMesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), s.material(json));
  s.add(gridMesh({-3, -3, -1}, {6, 0, 0}, {0, 6, 0}), grey(s));
  forEachEye(s.load(), only("cutouts"), {0, 0, 5}, [](const Red& red) {
    for (const double y : {-0.7, -0.2, 0.3, 0.8}) {
      EXPECT_TRUE(red.isAt({0, y, 0})) << y;
      EXPECT_FALSE(red.isAt({-0.5, y, 0})) << y;
      EXPECT_FALSE(red.isAt({0.5, y, 0})) << y;
    }
    // Its own border is one as well; nothing of the wall is.
    EXPECT_TRUE(red.isAt({-1, 0, 0}));
    EXPECT_FALSE(red.isAt({-2, 1.5, -1}));
  });
}

// A ball in three steps of light: shadow shapes end where light begins, the other two are steps, but where
// they are so close that one line covers both.
TEST_P(InkOver, stepsOfLightAreApartFromShadowShapes) {
  TestScene s;
  s.add(sphereMesh({0, 0, 0}, 1.4f, 48), grey(s));
  s.light({1, 0.6f, 0.4f});
  const Scene scene = s.load();
  for (const std::string kind : {"steps", "shadows"})
    forEachEye(
        scene, only(kind, {{"shadow.steps", "3"}, {"shadow.softness", "1"}}), {0, 0, 6}, [&](const Red& red) {
          size_t borders[2]{}, reds[2]{};  // of shadow shapes, and of steps
          for (int y = 6; y < kHeight - 6; ++y)
            for (int x = 6; x < kWidth - 6; ++x) {
              double covered = 1;
              for (int dy = -4; dy <= 4; ++dy)
                for (int dx = -4; dx <= 4; ++dx)
                  covered =
                      std::min(covered, texel(aov(red.frame, "final-shadow", red.index), x + dx, y + dy).w);
              const double here = texel(aov(red.frame, "final-shadow", red.index), x, y).x,
                           next = texel(aov(red.frame, "final-shadow", red.index), x + 1, y).x;
              if (covered < 1) continue;
              const double low = std::min(here, next), high = std::max(here, next);
              for (int step = 0; step < 3; ++step)
                if (low < (step + 0.5) / 3 && high >= (step + 0.5) / 3) {
                  ++borders[step > 0];
                  reds[step > 0] += red.isAt(x, y);
                }
            }
          const bool isSteps = kind == "steps";
          for (int b = 0; b < 2; ++b) {
            EXPECT_GT(borders[b], 30u) << kind;
            EXPECT_EQ(reds[b] > borders[b] * 8 / 10, b == int(isSteps))
                << kind << " " << b << ": " << reds[b] << " of " << borders[b];
            if (b != int(isSteps)) {
              EXPECT_LT(reds[b], borders[b] / 10) << kind;
            }
          }
        });
}

}  // namespace
}  // namespace scumble::ink
