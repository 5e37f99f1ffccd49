// Watercolours: with every knob at nothing the picture is what it was; each knob does what it says; pigment
// stays with its object, and is as dense on the screen far away as near by.
#include <cmath>
#include <functional>
#include <optional>

#include "base/test_folder.h"
#include "scumble/image.h"
#include "scumble/scene_editor.h"
#include "tests/support/aov.h"
#include "tests/support/plain_wash.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble::watercolor {
namespace {

using namespace test;

class Watercolor : public BothEyes {
 protected:
  static constexpr int kWidth = 160, kHeight = 120;

  // A board that faces the viewer and the light, of one colour.
  static TestScene board(float size = 1, const glm::vec4& color = {0.3f, 0.5f, 0.7f, 1}) {
    TestScene s;
    s.add(gridMesh({-size, -size, 0}, {2 * size, 0, 0}, {0, 2 * size, 0}, 8),
          s.material(TestScene::unlit("Board", color)));
    return s;
  }
  Frame paint(const TestScene& s, const Knobs& knobs, const Stand& stand,
              std::vector<std::string> aovs = {}) {
    const Scene scene = s.load();
    views_ = viewsFrom(scene, stand, kWidth, kHeight, GetParam());
    return draw(scene, quietLook(knobs), views_, sized(kWidth, kHeight, std::move(aovs)));
  }
  static double value(const Frame& frame, size_t view, const glm::dvec2& at) {
    const glm::dvec4 color = texel(aov(frame, "", view), int(at.x), int(at.y));
    return (color.x + color.y + color.z) / 3;
  }
  glm::dvec2 at(size_t view, const glm::dvec3& world) const {
    return pixelOf(views_[view], world, kWidth, kHeight);
  }

  std::vector<View> views_;
};
INSTANTIATE_BOTH_EYES(Watercolor);

TEST_P(Watercolor, withoutAnyOfItThePictureStays) {
  const TestScene s = stillLife();
  const Stand stand{{2, 2.5f, 6}, {-0.7f, 0.8f, 0.4f}};
  const Frame with = paint(s, plainWash(), stand),
              without = paint(s, plainWash({{"watercolor.shown", "off"}}), stand);
  for (size_t v = 0; v < viewCount(); ++v)
    EXPECT_LT(largestDifference(aov(with, "", v), aov(without, "", v)), 0.006) << v;
}

TEST_P(Watercolor, whatIsNotPaintedIsPaper) {
  const Frame frame = paint(board(), plainWash({{"watercolor.white", "#F0E0C0"}}), {{0, 0, 5}});
  const double linear[] = {0.8714, 0.7454, 0.5271};
  for (size_t v = 0; v < viewCount(); ++v)
    for (const glm::ivec2 corner : {glm::ivec2(2, 2), glm::ivec2(kWidth - 3, kHeight - 3)}) {
      const glm::dvec4 color = texel(aov(frame, "", v), corner.x, corner.y);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(color[c], linear[c], 0.005);
    }
}

// Darker just inside of a border than in the middle; nothing outside.
TEST_P(Watercolor, pigmentGathersAtBorders) {
  const Frame frame = paint(board(), plainWash({{"watercolor.edges", "1"}, {"watercolor.edgeWidth", "30"}}),
                            {{0, 0, 5}}),
              without = paint(board(), plainWash(), {{0, 0, 5}});
  for (size_t v = 0; v < viewCount(); ++v) {
    double inside = 0, middle = 0, plain = 0;
    for (int i = -7; i <= 7; ++i) {
      const double y = 0.1 * i;
      inside += value(frame, v, at(v, {-0.96, y, 0})) / 15;
      middle += value(frame, v, at(v, {0, y, 0})) / 15;
      plain += value(without, v, at(v, {0, y, 0})) / 15;
      EXPECT_GT(value(frame, v, at(v, {-1.08, y, 0})), 0.99);
    }
    // Not everywhere alike: where it is wet, it does not dry at the border.
    EXPECT_LT(inside, 0.93 * middle);
    EXPECT_NEAR(middle, plain, 0.005);
  }
}

// Pigment lies where paper is deep: what is added and taken away is even.
TEST_P(Watercolor, pigmentSettlesInValleys) {
  const Knobs grained = plainWash({{"watercolor.granulation", "0.5"}, {"watercolor.paperSize", "700"}});
  const Frame frame = paint(board(4), grained, {{0, 0, 5}}),
              without = paint(board(4), plainWash(), {{0, 0, 5}});
  for (size_t v = 0; v < viewCount(); ++v) {
    double sum = 0, squares = 0, plain = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double density = -std::log(value(frame, v, {x, y}));
        sum += density, squares += density * density, plain += -std::log(value(without, v, {x, y}));
      }
    const double count = kWidth * kHeight, mean = sum / count,
                 deviation = std::sqrt(squares / count - mean * mean);
    EXPECT_GT(deviation, 0.05 * mean);
    EXPECT_NEAR(mean, plain / count, 0.12 * mean);
  }
}

TEST_P(Watercolor, paintingRunsOutBeforeTheFrameEnds) {
  const Frame frame = paint(board(6), plainWash({{"watercolor.margin", "0.08"}}), {{0, 0, 5}});
  for (size_t v = 0; v < viewCount(); ++v) {
    for (const glm::dvec2 corner : {glm::dvec2(1, 1), glm::dvec2(kWidth - 2, 1), glm::dvec2(1, kHeight - 2),
                                    glm::dvec2(kWidth - 2, kHeight - 2)})
      EXPECT_GT(value(frame, v, corner), 0.99);
    EXPECT_LT(value(frame, v, {kWidth / 2, kHeight / 2}), 0.6);
  }
}

// FORMULAS 23: over a sixteenfold range of distances the same part of the surface is under stamps, within a
// factor of two.
TEST_P(Watercolor, stampsAreAsDenseFarAwayAsNearBy) {
  const Knobs dots = plainWash(
      {{"watercolor.spacing", "90"}, {"watercolor.stampSize", "0.3"}, {"watercolor.backruns", "0"}});
  const TestScene s = board(8);
  std::vector<double> covered;
  for (const float distance : {2.0f, 4.0f, 8.0f, 16.0f, 32.0f}) {
    const Frame frame = paint(s, dots, {{0.3f, 0.2f, distance}, {0.3f, 0.2f, 0}, 40, 0, 0.05f}, {"pigment"});
    for (size_t v = 0; v < viewCount(); ++v) {
      const Image& pigment = aov(frame, "pigment", v);
      double sum = 0, count = 0;
      for (int y = 1; y < int(pigment.height); y += 3)
        for (int x = 1; x < int(pigment.width); x += 3) {
          const double scale = double(kWidth) / pigment.width;
          if (!castRay(pixelRay(views_[v], int((x + 0.5) * scale), int((y + 0.5) * scale), kWidth, kHeight),
                       s.triangles()))
            continue;
          sum += texel(pigment, x, y).w;
          ++count;
        }
      ASSERT_GT(count, 20);
      covered.push_back(sum / count);
    }
  }
  const auto [least, most] = std::minmax_element(covered.begin(), covered.end());
  EXPECT_GT(*least, 0.02);
  EXPECT_LT(*most, 2 * *least) << testing::PrintToString(covered);
}

// What lies far behind an object keeps its pigment, whatever the object's stamps are.
TEST_P(Watercolor, stampsStayOnTheirObject) {
  const Stand stand{{0, 0, 5}, {0, 0, 0}, 40, 0, 0.05f};
  const auto scene = [](bool hasBoth) {
    TestScene s;
    const int material = s.material(TestScene::unlit("Board", {0.3f, 0.5f, 0.7f, 1}));
    s.add(gridMesh({-6, -6, -8}, {12, 0, 0}, {0, 12, 0}, 8), material);
    s.add(gridMesh({-0.5f, -0.5f, hasBoth ? 0.0f : 20.0f}, {1, 0, 0}, {0, 1, 0}, 8), material);
    return s;
  };
  const Frame both = paint(scene(true), plainWash(), stand, {"pigment"}),
              alone = paint(scene(false), plainWash(), stand, {"pigment"});
  for (size_t v = 0; v < viewCount(); ++v) {
    const Image &with = aov(both, "pigment", v), &without = aov(alone, "pigment", v);
    const double scale = double(with.width) / kWidth;
    size_t changedBeside = 0, changedOn = 0;
    for (int y = 0; y < int(with.height); ++y)
      for (int x = 0; x < int(with.width); ++x) {
        const glm::dvec2 corner = at(v, {-0.5, 0.5, 0}) * scale, other = at(v, {0.5, -0.5, 0}) * scale;
        const bool isOn = x > corner.x - 1.5 && x < other.x + 0.5 && y > corner.y - 1.5 && y < other.y + 0.5;
        const bool isChanged = glm::distance(texel(with, x, y), texel(without, x, y)) > 0.02;
        (isOn ? changedOn : changedBeside) += isChanged;
      }
    EXPECT_GT(changedOn, 10u);
    // The board behind shows fewer of its own where it is hidden: stamps whose middle is.
    EXPECT_LT(changedBeside, size_t(with.width * with.height) / 12);
  }
}

// (Paper 004, section 3.4: what faces away is not seen.) Thin things wear the marks of their fronts alone,
// whatever is behind them.
TEST_P(Watercolor, thinThingsWearNoMarksOfTheirBacks) {
  const Stand stand{{0.1f, 0.05f, 4}, {0, 0, 0}, 40, 0, 0.05f};
  // A front and, `behind` it, another sheet, which faces the viewer or away.
  const auto sheets = [](float behind, bool isTurned, bool isMirrored) {
    TestScene s;
    const int material = s.material(TestScene::unlit("Board", {0.3f, 0.5f, 0.7f, 1}));
    s.add(gridMesh({-0.8f, -0.8f, 0}, {1.6f, 0, 0}, {0, 1.6f, 0}, 4), material);
    const glm::vec3 along(1.6f, 0, 0), up(0, 1.6f, 0), corner(-0.8f, -0.8f, -behind);
    const bool swaps = isTurned != isMirrored;
    glm::mat4 mirror(1.0f);
    if (isMirrored) mirror[0][0] = -1;
    s.add(swaps ? gridMesh(corner, up, along, 4) : gridMesh(corner, along, up, 4), material, mirror);
    return s;
  };
  for (const bool isMirrored : {false, true})
    for (const bool isTurned : {false, true}) {
      const Frame far = paint(sheets(500, isTurned, isMirrored), plainWash(), stand, {"pigment"});
      for (const float behind : {0.02f, 0.05f, 0.2f}) {
        const Frame near = paint(sheets(behind, isTurned, isMirrored), plainWash(), stand, {"pigment"});
        for (size_t v = 0; v < viewCount(); ++v) {
          const glm::dvec2 low = at(v, {-0.75, 0.75, 0}), high = at(v, {0.75, -0.75, 0});
          for (int y = int(low.y) + 1; y < int(high.y); ++y)
            for (int x = int(low.x) + 1; x < int(high.x); ++x)
              ASSERT_EQ(texel(aov(near, "pigment", v), x, y), texel(aov(far, "pigment", v), x, y))
                  << behind << (isTurned ? ", turned" : "") << (isMirrored ? ", mirrored" : "");
        }
      }
    }
  // A closed slab has backs, too, where its material says that both sides are seen.
  const auto slab = [](bool isDoubleSided) {
    TestScene s;
    Json material = TestScene::unlit("Board", {0.3f, 0.5f, 0.7f, 1});
    material["doubleSided"] = isDoubleSided;
    s.add(boxMesh({-0.8f, -0.8f, -0.05f}, {0.8f, 0.8f, 0}), s.material(material));
    return s;
  };
  const Frame one = paint(slab(false), plainWash(), stand, {"pigment"}),
              both = paint(slab(true), plainWash(), stand, {"pigment"});
  for (size_t v = 0; v < viewCount(); ++v)
    EXPECT_EQ(largestDifference(aov(one, "pigment", v), aov(both, "pigment", v)), 0);
}

// (Paper 004, section 3.5.) And an open sheet that is seen from both sides is painted on both.
TEST_P(Watercolor, objectsThatTouchKeepTheirStamps) {
  const Stand stand{{0, 0, 3}, {0, 0, 0}, 34, 0, 0.05f};
  const auto sheets = [](float awayOfRight, bool isTurned) {
    TestScene s;
    Json material = TestScene::unlit("Board", {0.3f, 0.5f, 0.7f, 1});
    material["doubleSided"] = true;
    const int board = s.material(material);
    s.add(isTurned ? gridMesh({-0.9f, -0.7f, 0}, {0, 1.4f, 0}, {0.9f, 0, 0}, 4)
                   : gridMesh({-0.9f, -0.7f, 0}, {0.9f, 0, 0}, {0, 1.4f, 0}, 4),
          board);
    s.add(gridMesh({0, -0.7f, -awayOfRight}, {0.9f, 0, 0}, {0, 1.4f, 0}, 4), board);
    return s;
  };
  for (const bool isTurned : {false, true}) {
    const Frame both = paint(sheets(0, isTurned), plainWash(), stand, {"pigment"}),
                alone = paint(sheets(500, isTurned), plainWash(), stand, {"pigment"});
    for (size_t v = 0; v < viewCount(); ++v) {
      const glm::dvec2 low = at(v, {-0.9, 0.7, 0}) + 4.0, border = at(v, {0, -0.7, 0}) - 4.0;
      double painted = 0;
      for (int y = int(low.y) + 1; y < int(border.y); ++y)
        for (int x = int(low.x) + 1; x < int(border.x); ++x) {
          ASSERT_EQ(texel(aov(both, "pigment", v), x, y), texel(aov(alone, "pigment", v), x, y))
              << x << " " << y;
          painted += texel(aov(both, "pigment", v), x, y).w;
        }
      EXPECT_GT(painted, 20) << isTurned;
    }
  }
}

// (Paper 004, sections 3.1 and 5.2.) What an object is painted with follows from itself, its name and the
// seed: not from what else there is, and no two are painted alike.
TEST_P(Watercolor, objectsArePaintedByThemselves) {
  const Stand stand{{0, 0, 5}, {0, 0, 0}, 34, 0, 0};
  const auto twins = [&](bool hasMore, bool hasNames) {
    TestScene s;
    const int board = s.material(TestScene::unlit("Board", {0.3f, 0.5f, 0.7f, 1}));
    const TestMesh mesh = gridMesh({-0.7f, -0.8f, 0}, {1.4f, 0, 0}, {0, 1.6f, 0}, 4);
    if (hasMore) {
      // A ground of a square kilometre, out of sight, and before all others in the file.
      s.add(gridMesh({-500, -900, 500}, {1000, 0, 0}, {0, 0, -1000}, 8), board);
      s.add(sphereMesh({0, 0, 900}, 30, 12), board);
    }
    for (const float x : {-0.8f, 0.8f}) {
      s.add(mesh, board, glm::translate(glm::mat4(1.0f), {x, 0, 0}));
      Json& nodes = s.json()["nodes"];
      nodes.back()["name"] = hasNames ? (x < 0 ? "Left" : "Right") : "Twin";
      if (x > 0) nodes.back()["mesh"] = nodes[nodes.size() - 2]["mesh"];
    }
    return s;
  };
  const auto pigmentOf = [&](const TestScene& s, uint32_t seed) {
    const Scene scene = s.load();
    views_ = viewsFrom(scene, stand, kWidth, kHeight, GetParam());
    RenderOptions options = sized(kWidth, kHeight, {"pigment"});
    options.seed = seed;
    return draw(scene, quietLook(plainWash({{"watercolor.spacing", "100"}})), views_, options);
  };
  // Of amounts of pigment, over what one of the boards takes up.
  const auto correlation = [&](const Frame& a, double atA, const Frame& b, double atB, size_t v) {
    double sums[5] = {}, count = 0;
    for (double y = -0.7; y < 0.75; y += 0.05)
      for (double x = -0.6; x < 0.65; x += 0.05) {
        const auto amount = [&](const Frame& frame, double middle) {
          const glm::dvec2 place = at(v, {middle + x, y, 0});
          return texel(aov(frame, "pigment", v), int(place.x), int(place.y)).x;
        };
        const double p = amount(a, atA), q = amount(b, atB);
        sums[0] += p, sums[1] += q, sums[2] += p * p, sums[3] += q * q, sums[4] += p * q, ++count;
      }
    for (double& sum : sums) sum /= count;
    return (sums[4] - sums[0] * sums[1]) /
           std::sqrt((sums[2] - sums[0] * sums[0]) * (sums[3] - sums[1] * sums[1]));
  };
  for (const bool hasNames : {false, true}) {
    const Frame few = pigmentOf(twins(false, hasNames), 0), more = pigmentOf(twins(true, hasNames), 0),
                other = pigmentOf(twins(false, hasNames), 1);
    for (size_t v = 0; v < viewCount(); ++v) {
      EXPECT_EQ(largestDifference(aov(few, "pigment", v), aov(more, "pigment", v)), 0) << hasNames;
      EXPECT_GT(correlation(few, -0.8, few, -0.8, v), 0.999);
      EXPECT_LT(std::abs(correlation(few, -0.8, few, 0.8, v)), 0.35) << hasNames;
      EXPECT_LT(std::abs(correlation(few, -0.8, other, -0.8, v)), 0.35) << hasNames;
    }
  }
}

// (Paper 004, section 3.6: visibility is a proportion.) Something that slides before a board hides the stamps
// of it bit by bit.
TEST_P(Watercolor, stampsComeAndGoByHowMuchOfThemIsSeen) {
  constexpr int kLarge = 4;  // the picture's size in those of the others
  TestScene s;
  const int board = s.material(TestScene::unlit("Board", {0.3f, 0.5f, 0.7f, 1}));
  s.add(gridMesh({-3, -3, 0}, {6, 0, 0}, {0, 6, 0}, 4), board);
  s.add(gridMesh({-0.4f, -3, 0.5f}, {0.8f, 0, 0}, {0, 6, 0}, 1), board);
  SceneEditor editor(s.load());
  // So much is a tenth of a pixel for what slides.
  const float step = float(2 * 4.5 * std::tan(glm::radians(17.0)) / (kLarge * kHeight) / 10);
  std::optional<Frame> before;
  double most = 0, all = 0;
  for (int i = 0; i <= 20; ++i) {
    EXPECT_TRUE(editor.setTransform(NodeId(1), glm::translate(glm::dmat4(1.0), {step * float(i), 0, 0})));
    const Scene scene = *editor.scene();
    views_ =
        viewsFrom(scene, {{0, 0, 5}, {0, 0, 0}, 34, 0, 0.05f}, kLarge * kWidth, kLarge * kHeight, GetParam());
    Frame now = draw(scene, quietLook(plainWash()), views_,
                     sized(kLarge * kWidth, kLarge * kHeight, {"pigment", "id"}));
    if (before)
      for (size_t v = 0; v < viewCount(); ++v) {
        const Image &was = aov(*before, "pigment", v), &is = aov(now, "pigment", v);
        // Of places that were seen and are.
        const auto isBoard = [&](const Frame& frame, int x, int y) {
          for (const int by : {-8, -4, 0, 4, 8})
            if (texel(aov(frame, "id", v), x + by, y).x != 1) return false;
          return true;
        };
        for (int y = 0; y < int(is.height); y += 3)
          for (int x = 0; x < int(is.width); ++x)
            if (isBoard(*before, x, y) && isBoard(now, x, y)) {
              const glm::dvec4 apart = glm::abs(texel(is, x, y) - texel(was, x, y));
              most = std::max({most, apart.x, apart.y, apart.z}), all += apart.x;
            }
      }
    before = std::move(now);
  }
  EXPECT_GT(all, 0.1);
  EXPECT_LT(most, 0.02 + 1.01 / 255);
}

// Cells of a Voronoi diagram: everywhere one, of one value.
// Where vertices are on the device alone (SceneOptions::keepsVertices), surfaces are painted as elsewhere.
TEST_P(Watercolor, stampsStayWhereVerticesAreDropped) {
  const std::string text = board().text();
  const auto stampsOf = [&](bool keepsVertices) {
    const Result<Scene> scene =
        Scene::loadFromMemory(text.data(), text.size(), "test.gltf", "", {.keepsVertices = keepsVertices});
    return draw(*scene, quietLook(plainWash({{"watercolor.hue", "1"}})),
                viewsFrom(*scene, {{0, 0, 3}}, kWidth, kHeight, GetParam()),
                sized(kWidth, kHeight, {"pigment"}));
  };
  const Frame kept = stampsOf(true), dropped = stampsOf(false);
  for (size_t v = 0; v < viewCount(); ++v) {
    EXPECT_GT(texel(aov(kept, "pigment", v), kWidth / 2, kHeight / 2).w, 0);
    EXPECT_EQ(largestDifference(aov(kept, "pigment", v), aov(dropped, "pigment", v)), 0);
  }
}

TEST_P(Watercolor, cellsCoverTheSurface) {
  const Frame frame =
      paint(board(8), plainWash({{"watercolor.generator", "cells"}, {"watercolor.spacing", "280"}}),
            {{0.3f, 0.2f, 4}, {0.3f, 0.2f, 0}, 40, 0, 0.05f}, {"pigment"});
  for (size_t v = 0; v < viewCount(); ++v) {
    const Image& pigment = aov(frame, "pigment", v);
    size_t same = 0, covered = 0, count = 0;
    for (int y = 0; y < int(pigment.height); y += 4)
      for (int x = 4; x < int(pigment.width); x += 4) {
        ++count;
        covered += texel(pigment, x, y).w > 0;
        same += texel(pigment, x, y) == texel(pigment, x - 4, y);
      }
    EXPECT_GT(covered, count * 9 / 10);
    EXPECT_GT(same, count / 2);
    EXPECT_LT(same, count * 97 / 100);
  }
}

// A picture of one's own is a stamp's whole shape: white paints.
TEST_P(Watercolor, picturesAreShapesOfStamps) {
  const TestFolder folder;
  const auto covered = [&](const char* name, int side, const std::function<float(int, int)>& white) {
    Image image{uint32_t(side), uint32_t(side), {"R", "G", "B", "A"}, {}};
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        for (int c = 0; c < 4; ++c) image.pixels.push_back(c < 3 ? white(x, y) : 1.0f);
    EXPECT_TRUE(writePng(folder.file(name), image).ok());
    const Frame frame = paint(board(8),
                              plainWash({{"watercolor.generator", "shapes"},
                                         {"watercolor.brush", folder.file(name)},
                                         {"watercolor.spacing", "150"},
                                         {"watercolor.stampSize", "0.6"},
                                         {"watercolor.backruns", "0"}}),
                              {{0.3f, 0.2f, 4}, {0.3f, 0.2f, 0}, 40, 0, 0.05f}, {"pigment"});
    double sum = 0;
    const Image& pigment = aov(frame, "pigment", viewCount() - 1);
    for (int y = 1; y < int(pigment.height); y += 4)
      for (int x = 1; x < int(pigment.width); x += 4) sum += texel(pigment, x, y).w;
    return sum;
  };
  const double whole = covered("white.png", 1, [](int, int) { return 1.0f; });
  const double bar = covered("bar.png", 96, [](int x, int) { return float(x >= 32 && x < 64); });
  EXPECT_GT(whole, 20);
  EXPECT_EQ(covered("black.png", 1, [](int, int) { return 0.0f; }), 0);
  EXPECT_GT(bar, 0.2 * whole);
  EXPECT_LT(bar, 0.55 * whole);
}

// (Paper 004, section 3.3 and figure 11: brushes have transparency.) Brushes as painters save them.
TEST_P(Watercolor, transparencyOfBrushesCounts) {
  const TestFolder folder;
  const auto pigmentOf = [&](const char* name, const std::function<glm::vec4(bool)>& color) {
    constexpr int kSide = 64;
    Image image{kSide, kSide, {"R", "G", "B", "A"}, {}};
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const glm::vec4 c = color(glm::distance(glm::vec2(x, y), glm::vec2(31.5f)) < 25);
        image.pixels.insert(image.pixels.end(), {c.r, c.g, c.b, c.a});
      }
    EXPECT_TRUE(writePng(folder.file(name), image).ok());
    return paint(board(8),
                 plainWash({{"watercolor.generator", "shapes"},
                            {"watercolor.brush", folder.file(name)},
                            {"watercolor.spacing", "150"},
                            {"watercolor.stampSize", "0.6"}}),
                 {{0.3f, 0.2f, 4}, {0.3f, 0.2f, 0}, 40, 0, 0.05f}, {"pigment"});
  };
  const Frame white = pigmentOf("white.png", [](bool isIn) { return glm::vec4(glm::vec3(isIn), 1); });
  double painted = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) painted += texel(aov(white, "pigment"), x, y).w;
  EXPECT_GT(painted, 20);
  for (const auto& [name, color] : std::vector<std::pair<const char*, std::function<glm::vec4(bool)>>>{
           {"black.png", [](bool isIn) { return glm::vec4(0, 0, 0, isIn); }},
           {"clear.png", [](bool isIn) { return glm::vec4(1, 1, 1, isIn); }},
           {"red.png", [](bool isIn) { return glm::vec4(1, 0, 0, isIn); }}}) {
    const Frame frame = pigmentOf(name, color);
    for (size_t v = 0; v < viewCount(); ++v)
      EXPECT_LT(largestDifference(aov(frame, "pigment", v), aov(white, "pigment", v)), 0.02) << name;
  }
}

TEST_P(Watercolor, knobsOfTheBrushChangeThePicture) {
  const Stand stand{{2, 2.5f, 6}, {-0.7f, 0.8f, 0.4f}};
  const TestScene s = stillLife();
  const Frame plain = paint(s, plainWash(), stand);
  for (const Knobs& knob : std::vector<Knobs>{{{"watercolor.turbulence", "1"}},
                                              {{"watercolor.hue", "1"}},
                                              {{"watercolor.glazing", "1"}},
                                              {{"watercolor.bleeding", "1"}},
                                              {{"watercolor.bare", "1"}, {"watercolor.bareFrom", "0.3"}},
                                              {{"watercolor.dryBrush", "1"}},
                                              {{"watercolor.wobble", "12"}},
                                              {{"watercolor.relief", "1"}},
                                              {{"watercolor.strength", "2"}}}) {
    const Frame changed = paint(s, plainWash(knob), stand);
    for (size_t v = 0; v < viewCount(); ++v)
      EXPECT_GT(largestDifference(aov(plain, "", v), aov(changed, "", v)), 0.03) << knob[0].first << v;
  }
}

// The paper goes along with what it is told to.
TEST_P(Watercolor, paperGoesAlong) {
  const auto reliefAt = [&](const char* motion, float turn) {
    const Stand stand{{0, 0, 5}, {turn, 0, 0}, 40, 0, 0.05f};
    return paint(board(12), plainWash({{"watercolor.granulation", "1"}, {"watercolor.paperMotion", motion}}),
                 stand);
  };
  for (const char* motion : {"screen", "turn", "subject"}) {
    const Frame before = reliefAt(motion, 0), after = reliefAt(motion, 0.4f);
    for (size_t v = 0; v < viewCount(); ++v) {
      const bool isSame = largestDifference(aov(before, "", v), aov(after, "", v)) < 0.004;
      EXPECT_EQ(isSame, std::string(motion) == "screen") << motion;
    }
  }
}

TEST_P(Watercolor, costsNothingWhereItIsNot) {
  const Stand stand{{0, 2, 8}, {0, 1, 0}};
  const auto passesOf = [](const Frame& frame) {
    size_t count = 0;
    for (const PassTime& pass : frame.stats.passes)
      count += pass.name == "watercolor" || pass.name == "pigment";
    return count;
  };
  const Frame without = paint(stillLife(), {}, stand),
              with = paint(stillLife(), {{"watercolor.shown", "on"}}, stand),
              again = paint(stillLife(), {}, stand),
              withAgain = paint(stillLife(), {{"watercolor.shown", "on"}}, stand);
  EXPECT_EQ(passesOf(without), 0u);
  EXPECT_GE(passesOf(with), 2u);
  expectSame(without, again);
  expectSame(with, withAgain);
}

}  // namespace
}  // namespace scumble::watercolor
