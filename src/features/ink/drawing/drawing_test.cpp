// Strokes of a frame are where its ink is, as wide, and in one piece; hidden ones are told apart.
#include "scumble/drawing.h"

#include <cmath>

#include "tests/support/aov.h"
#include "tests/support/render_test.h"
#include "tests/support/stroke_distance.h"

namespace scumble::ink {
namespace {

using namespace test;

constexpr int kWide = 200, kHigh = 150;

class InkDrawing : public BothEyes {
 protected:
  Frame drawn(const Scene& scene, const Stand& stand, const Knobs& more = {},
              const std::vector<std::string>& aovs = {"ink"}) {
    Knobs knobs{{"ink.shown", "on"}, {"ink.least", "20"}, {"ink.greatest", "40"}, {"warp.amount", "0"}};
    knobs.insert(knobs.end(), more.begin(), more.end());
    RenderOptions options = sized(kWide, kHigh, aovs);
    options.drawing = true;
    return draw(scene, quietLook(knobs), viewsFrom(scene, stand, kWide, kHigh, GetParam()), options);
  }
  static size_t count(const Drawing& drawing, const std::string& layer, bool isHidden = false) {
    size_t found = 0;
    for (const Drawing::Stroke& stroke : drawing.strokes)
      found += stroke.layer == layer && stroke.isHidden == isHidden;
    return found;
  }
  // The nearest stroke that is seen.
  static double beyondStrokes(const Drawing& drawing, const glm::dvec2& place) {
    double nearest = 1e9;
    for (const Drawing::Stroke& stroke : drawing.strokes)
      if (!stroke.isHidden) nearest = std::min(nearest, beyondStroke(stroke, place));
    return nearest;
  }
  // Up to a part of it.
  static void expectInkIsStrokes(const Frame& frame, size_t view, double part) {
    int inked = 0, missing = 0, wrong = 0, bare = 0;
    for (int y = 0; y < kHigh; ++y)
      for (int x = 0; x < kWide; ++x) {
        const double ink = texel(aov(frame, "ink", view), x, y).w;
        const double beyond = beyondStrokes(frame.drawings[view], {x + 0.5, y + 0.5});
        inked += ink > 0.9, bare += ink < 0.02;
        missing += ink > 0.9 && beyond > 0.6;
        wrong += ink < 0.02 && beyond < -0.6;
      }
    EXPECT_GT(inked, 300) << "view " << view;
    EXPECT_LT(missing, part * inked) << "view " << view;
    EXPECT_LT(wrong, part * inked) << "view " << view;
  }
};
INSTANTIATE_BOTH_EYES(InkDrawing);

TestScene ballBeforeBox() {
  TestScene s;
  s.add(sphereMesh({0, 0.2f, 1.2f}, 0.5f, 48), s.material(TestScene::colored("Ball", {0.6f, 0.5f, 0.4f, 1})));
  s.add(boxMesh({-1, -0.6f, -1}, {1, 0.6f, 0}), s.material(TestScene::colored("Box", {0.4f, 0.5f, 0.6f, 1})));
  return s;
}

TEST_P(InkDrawing, strokesLieWhereInkIs) {
  const Scene scene = ballBeforeBox().load();
  // Lines that lie beside their edges have joints of their own at the corners of a box; strokes go around.
  const Knobs centred{{"ink.placement", "centred"}, {"ink.fade", "0"}},
      beside{{"ink.doubled", "60"}, {"ink.offset", "12"}};
  for (const auto& [knobs, part] : {std::pair(Knobs{}, 0.01), {centred, 0.01}, {beside, 0.02}}) {
    const Frame frame = drawn(scene, {{0.7f, 0.9f, 4}, {0, 0, 0.3f}}, knobs);
    ASSERT_EQ(frame.drawings.size(), viewCount());
    for (size_t v = 0; v < viewCount(); ++v) expectInkIsStrokes(frame, v, part);
    // What they are made from stays with the renderer.
    ASSERT_EQ(frame.layers.size(), 2u);
    EXPECT_EQ(frame.layers[1].name, "ink");
  }
}

TEST_P(InkDrawing, anOutlineIsOneStroke) {
  TestScene s;
  s.add(sphereMesh({0, 0, 0}, 0.8f, 48), s.material(TestScene::colored("Ball", {0.6f, 0.5f, 0.4f, 1})));
  const Frame frame = drawn(s.load(), {{0, 0.3f, 4}, {0, 0, 0}}, {{"ground.mode", "off"}});
  for (const Drawing& drawing : frame.drawings) {
    EXPECT_EQ(drawing.width, uint32_t(kWide));
    ASSERT_EQ(drawing.strokes.size(), 1u);
    EXPECT_EQ(drawing.strokes[0].layer, "silhouettes");
    EXPECT_TRUE(drawing.strokes[0].isClosed);
    EXPECT_GT(drawing.strokes[0].points.size(), 12u);
    EXPECT_LT(drawing.strokes[0].points.size(), 120u);
  }
}

TEST_P(InkDrawing, hiddenLinesAreKnown) {
  TestScene s;
  s.add(boxMesh({-0.4f, -0.4f, -1}, {0.4f, 0.4f, -0.5f}),
        s.material(TestScene::colored("Box", {0.4f, 0.5f, 0.6f, 1})));
  s.add(gridMesh({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}),
        s.material(TestScene::colored("Wall", {0.6f, 0.5f, 0.4f, 1})));
  const Scene scene = s.load();
  const Frame behind = drawn(scene, {{0.3f, 0.2f, 4}, {0, 0, 0}}, {{"ink.boundaries.shown", "off"}});
  const Frame before = drawn(scene, {{0.3f, 0.2f, -4}, {0, 0, 0}}, {{"ink.boundaries.shown", "off"}});
  for (size_t v = 0; v < viewCount(); ++v) {
    EXPECT_EQ(count(behind.drawings[v], "silhouettes", false), 0u);
    EXPECT_GT(count(behind.drawings[v], "silhouettes", true), 0u);
    EXPECT_GT(count(before.drawings[v], "silhouettes", false), 0u);
  }
}

TEST_P(InkDrawing, linesOfThePictureAreStrokes) {
  const Scene scene = ballBeforeBox().load();
  const Stand stand{{0.7f, 0.9f, 4}, {0, 0, 0.3f}};
  const Frame without = drawn(scene, stand);
  const Frame with = drawn(scene, stand, {{"ink.shadows.shown", "on"}, {"ink.objects.shown", "on"}});
  for (size_t v = 0; v < viewCount(); ++v) {
    EXPECT_EQ(count(without.drawings[v], "shadows") + count(without.drawings[v], "objects"), 0u);
    EXPECT_GT(count(with.drawings[v], "shadows"), 0u);
    EXPECT_GT(count(with.drawings[v], "objects"), 0u);
    // Objects end where the picture of objects changes.
    const Frame facts = drawn(scene, stand, {}, {"id"});
    for (const Drawing::Stroke& stroke : with.drawings[v].strokes)
      for (const Drawing::Point& point : stroke.points) {
        if (stroke.layer != "objects") continue;
        bool isBorder = false;
        const auto id = [&](int x, int y) {
          return texel(aov(facts, "id", v), glm::clamp(x, 0, kWide - 1), glm::clamp(y, 0, kHigh - 1)).x;
        };
        const int x = int(point.x), y = int(point.y);
        for (int j = -1; j <= 1; ++j)
          for (int i = -1; i <= 1; ++i) isBorder |= id(x + i, y + j) != id(x, y);
        EXPECT_TRUE(isBorder) << point.x << " " << point.y;
      }
  }
}

TEST_P(InkDrawing, isTheSameAgainAndRefusedWithoutLines) {
  const Scene scene = ballBeforeBox().load();
  const Stand stand{{0.7f, 0.9f, 4}, {0, 0, 0.3f}};
  const Frame first = drawn(scene, stand), second = drawn(scene, stand);
  for (size_t v = 0; v < viewCount(); ++v)
    EXPECT_EQ(svgOf(first.drawings[v], {false, true}), svgOf(second.drawings[v], {false, true}));
  RenderOptions options = sized(kWide, kHigh);
  options.drawing = true;
  const Result<Frame> none =
      renderer().render(scene, quietLook(), 0, viewsFrom(scene, stand, kWide, kHigh, GetParam()), options);
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().kind, ErrorKind::usage);
}

}  // namespace
}  // namespace scumble::ink
