// Lines pixel by pixel (paper 004, section 2.4): a line makes room for what is nearer, and never lies on it;
// it comes out from behind it little by little, nearer lines lie over farther ones, and what is hidden is
// dashed where that is asked for.
#include <cmath>

#include "features/ink/ink_reference.h"
#include "tests/support/aov.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble::ink {
namespace {

using namespace test;

class InkPixels : public BothEyes {
 protected:
  static constexpr int kSide = 120;
  static constexpr double kHalfWidth = 5;                                       // pixels
  static constexpr double kHalfHeight = 1.2, kPixel = 2 * kHalfHeight / kSide;  // metres

  static Knobs wideLines(const Knobs& more = {}) { return linesOfWidth("90", more); }

  // A bar with an outline along y = 0, and before it a plate so far away that begins at a height.
  static Scene barBehindPlate(double gap, double from, double slope = 0) {
    TestScene s;
    const int bar = s.material(TestScene::colored("Bar", {0.6f, 0.5f, 0.4f, 1}));
    const int plate = s.material(TestScene::colored("Plate", {0.4f, 0.5f, 0.6f, 1}));
    s.add(boxMesh({-3, -3, -1}, {3, 0, -0.5f}), bar);
    s.add(gridMesh({-3, float(from - 3 * slope), float(gap - 0.5)}, {6, float(6 * slope), 0}, {0, 3, 0}),
          plate);
    return s.load();
  }
  // Parallel views, whose eyes stand beside each other.
  static std::vector<View> views() {
    std::vector<View> all(viewCount(), parallelView(float(kHalfHeight), 1));
    if (all.size() > 1)
      all[1].worldToEye = glm::translate(glm::mat4(1.0f), {-0.06f, 0, 0}) * all[1].worldToEye;
    return all;
  }
  static Frame drawLines(const Scene& scene, const Knobs& knobs) {
    return draw(scene, quietLook(knobs), views(), sized(kSide, kSide, {"ink"}));
  }
  static double inkAt(const Frame& frame, size_t view, int x, int y) {
    return texel(aov(frame, "ink", view), x, y).w;
  }
  static double inkOfColumn(const Frame& frame, size_t view, int x) {
    double sum = 0;
    for (int y = 0; y < kSide; ++y) sum += inkAt(frame, view, x, y);
    return sum;
  }
};
INSTANTIATE_BOTH_EYES(InkPixels);

// It is as wide as there is room for beside what is nearer, which it never lies on.
TEST_P(InkPixels, linesMakeRoomForWhatIsNearer) {
  for (const double gap : {0.45, 2.0})
    for (const double border : {-4.0, -0.7, 0.7, 2.0, 3.0, 4.0, 8.0}) {  // pixels above the line
      const Frame frame = drawLines(barBehindPlate(gap, border * kPixel), wideLines());
      for (size_t v = 0; v < viewCount(); ++v) {
        for (int y = 0; y < kSide; ++y) {
          const double above = 0.5 * kSide - (y + 0.5);
          if (above < border + 1) continue;
          EXPECT_LT(inkAt(frame, v, kSide / 2, y), 0.02) << above << " px above the line, of a plate from "
                                                         << border << " on, " << gap << " m before it";
        }
        const double ink = inkOfColumn(frame, v, kSide / 2), room = std::clamp(border, 0.0, kHalfWidth);
        EXPECT_NEAR(ink, 2 * room, 2.1) << "of a plate from " << border << " on, " << gap << " m before it";
      }
    }
}

// By a tenth of a pixel at a time: the border of what is before it, which is a little oblique, uncovers row
// after row.
TEST_P(InkPixels, comeOutFromBehindLittleByLittle) {
  std::vector<double> before(viewCount(), 0);
  for (int step = 0; step <= 140; ++step) {
    const double border = -7 + 0.1 * step;
    const Frame frame = drawLines(barBehindPlate(0.45, border * kPixel, 0.02), wideLines());
    for (size_t v = 0; v < viewCount(); ++v) {
      double ink = 0;
      for (int x = kSide / 2 - 25; x < kSide / 2 + 25; ++x) ink += inkOfColumn(frame, v, x) / 50;
      if (step > 0) {
        EXPECT_LT(std::abs(ink - before[v]), 0.5) << border;
      }
      before[v] = ink;
      if (step == 0) {
        EXPECT_LT(ink, 0.05);
      }
      if (step == 140) {
        EXPECT_NEAR(ink, 2 * kHalfWidth, 0.2);
      }
    }
  }
}

// The crossing of two lines has the nearer one's colour, and no mixture.
TEST_P(InkPixels, nearerLinesLieOverFartherOnes) {
  for (const bool isNearFirst : {true, false}) {
    TestScene s;
    const int far = s.material(TestScene::colored("Far", {0.6f, 0.5f, 0.4f, 1})),
              near = s.material(TestScene::colored("Near", {0.6f, 0.5f, 0.4f, 1}));
    const TestMesh bar = boxMesh({-3, -3, -1}, {3, 0, -0.5f}), post = boxMesh({0, -3, 0.3f}, {0.6f, 3, 0.9f});
    s.add(isNearFirst ? post : bar, isNearFirst ? near : far);
    s.add(isNearFirst ? bar : post, isNearFirst ? far : near);
    const Frame frame = draw(s.load(),
                             quietLook(wideLines({{"materials.Far.ink.line.color", "#0000FF"},
                                                  {"materials.Near.ink.line.color", "#FF0000"}})),
                             views(), sized(kSide, kSide));
    for (size_t v = 0; v < viewCount(); ++v) {
      const int edge = kSide / 2 - (v == 0 ? 0 : int(0.06 / kPixel));
      for (int x = edge - 4; x < edge + 4; ++x)
        for (int y = kSide / 2 - 3; y < kSide / 2 + 3; ++y) {
          const glm::dvec4 color = texel(aov(frame, "", v), x, y);
          EXPECT_GT(color.r, 0.98) << x << ", " << y;
          EXPECT_LT(color.b, 0.02) << x << ", " << y;
        }
      // Beside it the other one is as it was.
      EXPECT_GT(texel(aov(frame, "", v), edge - 12, kSide / 2).b, 0.98);
    }
  }
}

TEST_P(InkPixels, hiddenLinesAreDashedWhereTheyAreAskedFor) {
  const Scene scene = barBehindPlate(0.45, -0.3);
  const Knobs some = wideLines({{"ink.hidden", "0.4"}, {"ink.hiddenDash", "60"}});
  const Frame none = drawLines(scene, wideLines()), frame = drawLines(scene, some);
  for (size_t v = 0; v < viewCount(); ++v) {
    int drawn = 0, bare = 0;
    for (int x = 10; x < kSide - 10; ++x) {
      EXPECT_LT(inkAt(none, v, x, kSide / 2), 0.02);
      const double ink = inkAt(frame, v, x, kSide / 2);
      drawn += ink > 0.95, bare += ink < 0.05;
      // As thin as they are asked for.
      EXPECT_LT(inkOfColumn(frame, v, x), 0.4 * 2 * kHalfWidth + 0.1);
    }
    EXPECT_GT(drawn, 35);
    EXPECT_GT(bare, 25);
  }
  // Lines that are seen have no dashes.
  expectSame(drawLines(barBehindPlate(0.45, 2), wideLines()), drawLines(barBehindPlate(0.45, 2), some));
}

// (Paper 004, section 2.2.) Outlines and borders of open sheets lie outside of what they are of, which loses
// nothing but what softens its edge.
TEST_P(InkPixels, outlinesAndBordersLieOutside) {
  for (const bool isSheet : {true, false}) {
    TestScene s;
    const int material = s.material(TestScene::colored("Thing", {0.6f, 0.5f, 0.4f, 1}));
    s.add(isSheet ? gridMesh({-0.5f, -0.4f, 0}, {1, 0, 0}, {0, 0.8f, 0}, 2)
                  : boxMesh({-0.5f, -0.4f, -0.8f}, {0.5f, 0.4f, 0}),
          material);
    const Frame frame = drawLines(s.load(), wideLines({{"ink.placement", "exterior"},
                                                       {"ink.boundaries.shown", "on"},
                                                       {"ink.boundaries.width", "0.6"}}));
    const double width = 2 * kHalfWidth * (isSheet ? 0.6 : 1);
    for (size_t v = 0; v < viewCount(); ++v) {
      const double shift = v == 0 ? 0 : -0.06 / kPixel, left = 0.5 * kSide - 0.5 / kPixel + shift;
      double inside = 0, outside = 0;
      for (int x = 0; x < kSide / 2; ++x)
        (x + 0.5 > left ? inside : outside) += inkAt(frame, v, x, kSide / 2);
      EXPECT_LT(inside, 0.6) << isSheet;
      EXPECT_NEAR(outside, width - 0.5, 0.7) << isSheet;
    }
  }
}

// Dashes go along with what they are on: nine pixels farther they are the same ones.
TEST_P(InkPixels, dashesStayOnTheirLine) {
  const auto drawnAt = [&](double shift) {
    TestScene s;
    const int material = s.material(TestScene::colored("Thing", {0.6f, 0.5f, 0.4f, 1}));
    s.add(boxMesh({-3, -3, -1}, {3, 0, -0.5f}), material,
          glm::translate(glm::mat4(1.0f), {float(shift), 0, 0}));
    s.add(gridMesh({-3, -0.3f, 0}, {6, 0, 0}, {0, 3, 0}), material);
    return drawLines(s.load(), wideLines({{"ink.hidden", "0.4"}, {"ink.hiddenDash", "60"}}));
  };
  const Frame here = drawnAt(0), there = drawnAt(9 * kPixel);
  for (size_t v = 0; v < viewCount(); ++v)
    for (int x = 20; x < kSide - 20; ++x)
      EXPECT_NEAR(inkAt(there, v, x + 9, kSide / 2), inkAt(here, v, x, kSide / 2), 0.05) << x;
}

}  // namespace
}  // namespace scumble::ink
