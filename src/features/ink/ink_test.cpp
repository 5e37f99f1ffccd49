// Lines of edges: those that a CPU reference finds, where it has them; hidden ones are not seen, joints
// close, widths follow the light, and what is switched off is not there.
#include <cmath>
#include <numbers>
#include <optional>

#include "features/ink/ink_reference.h"
#include "scumble/measure.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble::ink {
namespace {

using namespace test;

Knobs evenLines(const Knobs& more = {}) {
  return linesOfWidth("27", more);
}

class Ink : public BothEyes {
 protected:
  static constexpr int kWidth = 160, kHeight = 120;
  static constexpr double kRadius = 13.5 * kHeight / 1080;  // pixels: 1.5

  static glm::dvec3 eyeOf(const View& view) {
    return glm::dvec3(glm::inverse(glm::dmat4(view.worldToEye)) * glm::dvec4(0, 0, 0, 1));
  }
  Frame drawLines(const Scene& scene, const Knobs& knobs, const std::vector<View>& views) {
    return draw(scene, quietLook(knobs), views, sized(kWidth, kHeight, {"ink"}));
  }
  static double ink(const Frame& frame, size_t view, const glm::dvec2& at) {
    return texel(aov(frame, "ink", view), int(at.x), int(at.y)).w;
  }
  // Across a line that runs from left to right, in parts of its width.
  static double inkAcross(const Frame& frame, size_t view, const glm::dvec2& at) {
    double sum = 0;
    for (int y = -5; y <= 5; ++y) sum += ink(frame, view, at + glm::dvec2(0, y));
    return sum / (2 * kRadius);
  }
  // That ink covers what it should, pixel by pixel.
  void expectLines(const TestScene& s, const Knobs& knobs, const Stand& stand,
                   const std::function<double(const ReferenceEdge&, const glm::dvec3& eye)>& radiusOf) {
    const Scene scene = s.load();
    const auto views = viewsFrom(scene, stand, kWidth, kHeight, GetParam());
    const Frame frame = drawLines(scene, knobs, views);
    const std::vector<ReferenceEdge> edges = referenceEdges(s.triangles());
    for (size_t v = 0; v < viewCount(); ++v) {
      const glm::dvec3 eye = eyeOf(views[v]);
      const Texels expected = referenceLines(edges, views[v], kWidth, kHeight,
                                             [&](const ReferenceEdge& edge) { return radiusOf(edge, eye); });
      Difference coverage(0.03);
      double drawn = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          coverage.add(texel(aov(frame, "ink", v), x, y).w, expected.values[size_t(y * kWidth + x)].x);
          drawn += expected.values[size_t(y * kWidth + x)].x;
        }
      EXPECT_GT(drawn, 200) << "view " << v;
      EXPECT_LT(coverage.beyondPart(), 0.0005) << "view " << v << ": " << coverage.text();
    }
  }
};
INSTANTIATE_BOTH_EYES(Ink);

TestScene oneThing(const TestMesh& mesh, const glm::mat4& matrix = glm::mat4(1.0f)) {
  TestScene s;
  s.add(mesh, s.material(TestScene::colored("Thing", {0.6f, 0.5f, 0.4f, 1})), matrix);
  return s;
}

// Every vertex of these meshes is split; normals differ at the corners of the box.
TEST_P(Ink, silhouettesAreThoseOfTheReference) {
  const auto outline = [](const ReferenceEdge& edge, const glm::dvec3& eye) {
    return edge.isSilhouette(eye) ? kRadius : 0;
  };
  expectLines(oneThing(boxMesh({-1, -0.8f, -0.6f}, {1, 0.7f, 0.9f})), evenLines(), {{2, 1.5f, 4}}, outline);
  expectLines(oneThing(sphereMesh({0, 0, 0}, 1.2f, 20)), evenLines(), {{0.4f, 1.2f, 4.5f}}, outline);
  // Turned inside out by its matrix.
  expectLines(oneThing(boxMesh({-1, -0.8f, -0.6f}, {1, 0.7f, 0.9f}),
                       glm::mat4({-1, 0, 0, 0}, {0, 0.8f, 0.1f, 0}, {0, 0, 1, 0}, {0.2f, 0, 0, 1})),
              evenLines(), {{2, 1.5f, 4}}, outline);
}

// A box of so many cells a side, and a column of as many sides that stands upright, one of them towards +z.
TestMesh cellBox(int cells) {
  TestMesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      glm::vec3 corner(-0.8f, -0.6f, -0.5f), u(0.0f), v(0.0f);
      const glm::vec3 size(1.6f, 1.2f, 1);
      u[(axis + 1) % 3] = size[(axis + 1) % 3], v[(axis + 2) % 3] = size[(axis + 2) % 3];
      if (side) corner[axis] += size[axis];
      append(mesh, side ? gridMesh(corner, u, v, cells) : gridMesh(corner, v, u, cells), {1, 1, 1, 1});
    }
  return mesh;
}
TestMesh column(int sides) {
  TestMesh mesh;
  const auto at = [&](int i, float y) {
    const double turn = (i + 0.5) * 2 * std::numbers::pi / sides;
    return glm::vec3(std::sin(turn), y, std::cos(turn));
  };
  for (int i = 0; i < sides; ++i) {
    const glm::vec3 a = at(i - 1, -0.7f), b = at(i, -0.7f);
    append(mesh, gridMesh(a, b - a, {0, 1.4f, 0}), {1, 1, 1, 1});
    for (const float y : {-0.7f, 0.7f}) {
      TestMesh cap;
      cap.positions = {at(i, y), at(i - 1, y), {0, y, 0}};
      if (y > 0) std::swap(cap.positions[0], cap.positions[1]);
      cap.normals.assign(3, {0, y > 0 ? 1 : -1, 0});
      cap.uvs.assign(3, {0, 0});
      cap.indices = {0, 1, 2};
      append(mesh, cap, {1, 1, 1, 1});
    }
  }
  return mesh;
}

// (Paper 004, section 2.2: an edge between a face that is seen from its edge and one that is turned away is
// an outline.) Zero is a side: there, and as far to either side of it as rounding leads, the outline is as
// whole as it is when the form is turned a little.
TEST_P(Ink, facesSeenFromTheirEdgeHaveOutlines) {
  const std::vector<std::pair<std::string, TestMesh>> forms{{"box", cellBox(1)},
                                                            {"box of cells", cellBox(3)},
                                                            {"column of 4", column(4)},
                                                            {"column of 8", column(8)}};
  for (const auto& form : forms)
    for (const bool isMirrored : {false, true})
      for (const bool isDoubleSided : {false, true}) {
        if (isMirrored && isDoubleSided) continue;
        const auto turned = [&](float turn) {
          TestScene s;
          Json material = TestScene::colored("Thing", {0.6f, 0.5f, 0.4f, 1});
          material["doubleSided"] = isDoubleSided;
          glm::mat4 matrix = glm::rotate(glm::mat4(1.0f), turn, {0, 1, 0});
          if (isMirrored) matrix[0] = -matrix[0];
          s.add(form.second, s.material(material), matrix);
          return s.load();
        };
        const auto outlines = [&](const Scene& scene, const std::vector<View>& views, const char* placement) {
          const Frame frame = drawLines(scene, evenLines({{"ink.placement", placement}}), views);
          std::vector<double> sums;
          for (size_t v = 0; v < viewCount(); ++v) {
            sums.push_back(0);
            for (int y = 0; y < kHeight; ++y)
              for (int x = 0; x < kWidth; ++x) sums.back() += texel(aov(frame, "ink", v), x, y).w;
          }
          return sums;
        };
        const Scene turnedALittle = turned(0.002f);
        const std::vector<View> parallel(viewCount(), parallelView(1.6f, float(kWidth) / kHeight));
        const std::string what =
            form.first + (isMirrored ? ", mirrored" : "") + (isDoubleSided ? ", double-sided" : "");
        for (const char* placement : {"centred", "exterior"}) {
          if (isMirrored != (std::string(placement) == "exterior")) continue;
          const std::vector<double> expected = outlines(turnedALittle, parallel, placement);
          for (const float turn : {0.0f, 1e-7f, 1e-5f, -3e-5f, -5e-4f}) {
            const std::vector<double> sums = outlines(turned(turn), parallel, placement);
            for (size_t v = 0; v < viewCount(); ++v)
              EXPECT_NEAR(sums[v] / expected[v], 1, 0.03)
                  << what << ", " << placement << ", turned by " << turn;
          }
          // Eyes in the plane of the box's side, and a little beside it.
          if (!form.first.starts_with("box")) continue;
          const auto from = [&](const Scene& scene, float x) {
            return outlines(
                scene, viewsFrom(scene, {{x, 0.6f, 6}, {0, 0, 0}, 40, 0, 0.1f}, kWidth, kHeight, GetParam()),
                placement);
          };
          const Scene scene = turned(0);
          const std::vector<double> inside = from(scene, 0.79f);
          for (const float x : {0.75f, 0.7999f, 0.8f, 0.8001f, 0.85f}) {
            const std::vector<double> sums = from(scene, x);
            for (size_t v = 0; v < viewCount(); ++v)
              EXPECT_NEAR(sums[v] / inside[v], 1, 0.03) << what << ", " << placement << ", eye at " << x;
          }
        }
      }
}

TEST_P(Ink, creasesAreEdgesThatAreSharpAndSeen) {
  const Knobs knobs = evenLines({{"ink.silhouettes.shown", "off"},
                                 {"ink.creases.shown", "on"},
                                 {"ink.creases.width", "1"},
                                 {"ink.creaseAngle", "50"}});
  const auto crease = [](const ReferenceEdge& edge, const glm::dvec3& eye) {
    return edge.angle() > 50 && edge.isSeen(eye) ? kRadius : 0;
  };
  expectLines(oneThing(boxMesh({-1, -0.8f, -0.6f}, {1, 0.7f, 0.9f})), knobs, {{2, 1.5f, 4}}, crease);
}

// Creases come within some degrees, by how sharp they are.
TEST_P(Ink, creasesComeByTheirAngle) {
  const auto cosine = [](double degrees) { return std::cos(glm::radians(degrees)); };
  for (const double angle : {30.0, 35.0, 38.0, 40.0, 42.0, 45.0, 60.0}) {
    TestMesh roof;
    const float side = float(glm::radians(angle / 2));
    const glm::vec3 down(0, -std::cos(side), -std::sin(side)), up(0, std::cos(side), -std::sin(side));
    append(roof, gridMesh(2.0f * down - glm::vec3(2, 0, 0), {4, 0, 0}, -2.0f * down), {1, 1, 1, 1});
    append(roof, gridMesh({-2, 0, 0}, {4, 0, 0}, 2.0f * up), {1, 1, 1, 1});
    const Scene scene = oneThing(roof).load();
    const auto views = viewsFrom(scene, {{0, 0, 6}, {0, 0, 0}, 40, 0, 0.1f}, kWidth, kHeight, GetParam());
    const Frame frame = drawLines(
        scene,
        evenLines({{"ink.creases.shown", "on"}, {"ink.creases.width", "1"}, {"ink.creaseAngle", "40"}}),
        views);
    const double t = std::clamp((cosine(angle) - cosine(44)) / (cosine(36) - cosine(44)), 0.0, 1.0);
    for (size_t v = 0; v < viewCount(); ++v)
      EXPECT_NEAR(inkAcross(frame, v, pixelOf(views[v], {0, 0, 0}, kWidth, kHeight)), 1 - t * t * (3 - 2 * t),
                  0.03)
          << angle;
  }
}

// A line that no other one goes on from has round ends.
TEST_P(Ink, linesHaveRoundEnds) {
  TestMesh roof;
  append(roof, gridMesh({-0.6f, -0.7f, -0.6f}, {1.2f, 0, 0}, {0, 0.7f, 0.6f}), {1, 1, 1, 1});
  append(roof, gridMesh({-0.6f, 0, 0}, {1.2f, 0, 0}, {0, 0.7f, -0.6f}), {1, 1, 1, 1});
  for (const bool isTurned : {false, true}) {
    const glm::mat4 turned = glm::rotate(glm::mat4(1.0f), isTurned ? 1.2f : 0.0f, {0, 0, 1});
    expectLines(oneThing(roof, turned),
                linesOfWidth("162", {{"ink.silhouettes.shown", "off"},
                                     {"ink.creases.shown", "on"},
                                     {"ink.creases.width", "1"}}),
                {{0.2f, 0.1f, 5}}, [](const ReferenceEdge& edge, const glm::dvec3&) {
                  return edge.isOpen || edge.angle() < 50 ? 0 : 6 * kRadius;
                });
  }
}

// An edge of several kinds is the first of them: a border of materials, a crease where it is wholly one, a
// border of colours, a crease that is about to be one.
TEST_P(Ink, edgesOfSeveralKindsAreTheFirst) {
  const auto widthAt = [&](double angle, bool hasColors, bool hasMaterials) {
    const float side = float(glm::radians(angle / 2));
    const glm::vec3 down(0, -std::cos(side), -std::sin(side)), up(0, std::cos(side), -std::sin(side));
    TestScene s;
    const glm::vec4 red(1, 0.2f, 0.2f, 1), blue(0.2f, 0.2f, 1, 1);
    TestMesh below, above;
    append(below, gridMesh(2.0f * down - glm::vec3(2, 0, 0), {4, 0, 0}, -2.0f * down), red);
    append(above, gridMesh({-2, 0, 0}, {4, 0, 0}, 2.0f * up), hasColors ? blue : red);
    const int first = s.material(TestScene::colored("First", {1, 1, 1, 1}));
    const int second = s.material(TestScene::colored("Second", {0.9f, 1, 1, 1}));
    s.add(below, first);
    s.add(above, hasMaterials ? second : first);
    Json& json = s.json();
    json["meshes"][0]["primitives"].push_back(json["meshes"][1]["primitives"][0]);
    json["scenes"][0]["nodes"].erase(1);
    const Scene scene = s.load();
    const auto views = viewsFrom(scene, {{0, 0, 6}, {0, 0, 0}, 40, 0, 0.1f}, kWidth, kHeight, GetParam());
    const Frame frame = drawLines(scene,
                                  evenLines({{"ink.creaseAngle", "40"},
                                             {"ink.creases.shown", "on"},
                                             {"ink.creases.width", "1"},
                                             {"ink.colors.shown", "on"},
                                             {"ink.colors.width", "0.6"},
                                             {"ink.materials.shown", "on"},
                                             {"ink.materials.width", "1.5"}}),
                                  views);
    return inkAcross(frame, viewCount() - 1, pixelOf(views[viewCount() - 1], {0, 0, 0}, kWidth, kHeight));
  };
  for (const double angle : {10.0, 38.0, 42.0, 46.0, 60.0}) {
    EXPECT_NEAR(widthAt(angle, true, true), 1.5, 0.05) << angle;
    EXPECT_NEAR(widthAt(angle, false, true), 1.5, 0.05) << angle;
    EXPECT_NEAR(widthAt(angle, true, false), angle > 44 ? 1 : 0.6, 0.05) << angle;
  }
  EXPECT_EQ(widthAt(10, false, false), 0);
  EXPECT_NEAR(widthAt(60, false, false), 1, 0.05);
}

TEST_P(Ink, openSurfacesEndInLines) {
  const Knobs knobs = evenLines(
      {{"ink.boundaries.shown", "on"}, {"ink.boundaries.width", "1"}, {"ink.silhouettes.shown", "off"}});
  expectLines(oneThing(gridMesh({-1, -1, 0}, {2, 0, 0.5f}, {0.2f, 2, 0}, 5)), knobs, {{0.5f, 0.4f, 5}},
              [](const ReferenceEdge& edge, const glm::dvec3&) { return edge.isOpen ? kRadius : 0; });
}

// Two primitives of one mesh, of two materials, share a border; it is neither an end nor a crease.
TEST_P(Ink, bordersOfMaterialsAreLines) {
  TestScene s;
  s.add(gridMesh({-1, -1, 0}, {1, 0, 0}, {0, 2, 0}, 3),
        s.material(TestScene::colored("Left", {0.6f, 0.5f, 0.4f, 1})));
  s.add(gridMesh({0, -1, 0}, {1, 0, 0}, {0, 2, 0}, 3),
        s.material(TestScene::colored("Right", {0.2f, 0.5f, 0.4f, 1})));
  // Both primitives become those of the first mesh.
  Json& json = s.json();
  json["meshes"][0]["primitives"].push_back(json["meshes"][1]["primitives"][0]);
  json["scenes"][0]["nodes"].erase(1);
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0.3f, 0.2f, 5}}, kWidth, kHeight, GetParam());
  const Knobs shown{{"ink.materials.shown", "on"},
                    {"ink.boundaries.shown", "on"},
                    {"ink.materials.width", "1"},
                    {"ink.boundaries.width", "1"}};
  const Frame with = drawLines(scene, evenLines(shown), views),
              without = drawLines(scene, evenLines({shown[1], shown[3]}), views);
  for (size_t v = 0; v < viewCount(); ++v)
    for (const double y : {-0.7, -0.2, 0.4}) {
      const glm::dvec2 at = pixelOf(views[v], {0, y, 0}, kWidth, kHeight);
      EXPECT_GT(ink(with, v, at), 0.9);
      EXPECT_EQ(ink(without, v, at), 0.0);
      EXPECT_GT(ink(without, v, pixelOf(views[v], {-1, y, 0}, kWidth, kHeight)), 0.9);
    }
}

// Where vertex colours differ on both ends of an edge, with a width and a colour of their own.
TEST_P(Ink, bordersOfColorsAreLines) {
  TestMesh mesh;
  append(mesh, gridMesh({-1, -1, 0}, {1, 0, 0}, {0, 2, 0}, 3), {1, 0.2f, 0.2f, 1});
  append(mesh, gridMesh({0, -1, 0}, {1, 0, 0}, {0, 2, 0}, 3), {0.2f, 0.2f, 1, 1});
  const Scene scene = oneThing(mesh).load();
  const auto views = viewsFrom(scene, {{0.3f, 0.2f, 5}}, kWidth, kHeight, GetParam());
  const Knobs shown{{"ink.colors.shown", "on"},
                    {"ink.colors.width", "1"},
                    {"ink.colors.color", "#00FF00"},
                    {"ink.colors.colorAmount", "1"}};
  const Frame with = drawLines(scene, evenLines(shown), views),
              without = drawLines(scene, evenLines(), views);
  for (size_t v = 0; v < viewCount(); ++v)
    for (const double y : {-0.7, -0.2, 0.4}) {
      const glm::dvec2 at = pixelOf(views[v], {0, y, 0}, kWidth, kHeight);
      EXPECT_GT(ink(with, v, at), 0.9);
      EXPECT_EQ(ink(without, v, at), 0.0);
      const glm::dvec4 color = texel(aov(with, "", v), int(at.x), int(at.y));
      EXPECT_GT(color.y, 0.85);
      EXPECT_LT(color.x, 0.15);
    }
}

// Inner lines in valleys are seen, whatever the size of the picture, in perspective and without it; and lines
// behind something are not, also in parallel projections.
TEST_P(Ink, valleysAndParallelProjections) {
  TestScene s;
  const int material = s.material(TestScene::colored("Thing", {0.6f, 0.5f, 0.4f, 1}));
  TestMesh corner;
  append(corner, gridMesh({-1, -1, 0}, {1, 0, -1}, {0, 2, 0}, 1), {1, 1, 1, 1});
  append(corner, gridMesh({0, -1, -1}, {1, 0, 1}, {0, 2, 0}, 1), {1, 1, 1, 1});
  s.add(corner, material);
  s.add(boxMesh({-0.3f, -0.6f, 0.8f}, {0.3f, -0.2f, 1}), material);
  const Scene scene = s.load();
  auto views = viewsFrom(scene, {{0, 0, 6}, {0, 0, 0}, 34, 0, 0.05f}, kWidth, kHeight, GetParam());
  for (int parallel = 0; parallel < 2; ++parallel) {
    if (parallel)
      for (View& view : views) view = parallelView(1.6f, float(kWidth) / kHeight);
    const Frame frame =
        drawLines(scene, evenLines({{"ink.creases.shown", "on"}, {"ink.creases.width", "1"}}), views);
    for (size_t v = 0; v < viewCount(); ++v) {
      EXPECT_GT(ink(frame, v, pixelOf(views[v], {0, 0.5, -1}, kWidth, kHeight)), 0.9) << parallel;
      EXPECT_GT(ink(frame, v, pixelOf(views[v], {0, 0.1, -1}, kWidth, kHeight)), 0.9) << parallel;
      EXPECT_EQ(ink(frame, v, pixelOf(views[v], {0, -0.4, 0.9}, kWidth, kHeight)), 0.0) << parallel;
    }
  }
}

// Lines of a box that stands behind another one; both are far enough apart to say which.
TEST_P(Ink, hiddenLinesAreNotSeen) {
  TestScene s;
  const int material = s.material(TestScene::colored("Thing", {0.6f, 0.5f, 0.4f, 1}));
  s.add(boxMesh({-0.6f, -0.6f, 0}, {0.6f, 0.6f, 0.2f}), material);
  s.add(boxMesh({-1.5f, -0.3f, -1.5f}, {1.5f, 0.3f, -1}), material);
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 6}, {0, 0, 0}, 40, 0, 0.1f}, kWidth, kHeight, GetParam());
  const Frame frame = drawLines(scene, evenLines({{"ink.creases.shown", "on"}}), views);
  for (size_t v = 0; v < viewCount(); ++v) {
    const auto at = [&](const glm::dvec3& world) {
      return ink(frame, v, pixelOf(views[v], world, kWidth, kHeight));
    };
    for (const double x : {-1.2, -0.9, 0.9, 1.2}) EXPECT_GT(at({x, 0.3, -1}), 0.9) << x;
    for (const double x : {-0.4, 0.0, 0.4}) EXPECT_EQ(at({x, 0.3, -1}), 0.0) << x;
    for (const double x : {-0.4, 0.0, 0.4}) EXPECT_GT(at({x, 0.6, 0.2}), 0.9) << x;
  }
}

// A bar, one of whose outlines runs behind a plate that lies so close before it; `left`: where the plate
// begins.
class HalfHidden {
 public:
  HalfHidden(double gap, double left) {
    TestScene s;
    const int material = s.material(TestScene::colored("Thing", {0.6f, 0.5f, 0.4f, 1}));
    s.add(boxMesh({-1.5f, -0.3f, -1.5f}, {1.5f, 0.3f, -1}), material);
    s.add(gridMesh({float(left), -0.6f, float(gap - 1)}, {1.6f, 0, 0}, {0, 1.2f, 0}), material);
    scene_ = s.load();
  }
  const Scene& scene() const { return scene_; }
  static constexpr double kDistance = 7;  // of the outline
  static constexpr Stand kStand{{0, 0, 6}, {0, 0, 0}, 40, 0, 0.1f};

 private:
  Scene scene_;
};

// What lies before a line hides it more and more the farther it lies before it, and never at once.
TEST_P(Ink, whatIsHiddenComesByItsDepth) {
  const double pixel = 2 * HalfHidden::kDistance * std::tan(glm::radians(20.0)) / kHeight;
  const double from = 0.5 * pixel, to = pixel;
  for (const double part : {-0.3, 0.0, 0.2, 0.4, 0.5, 0.6, 0.8, 1.0, 1.2}) {
    const HalfHidden s(from + part * (to - from), -0.8);
    const auto views = viewsFrom(s.scene(), HalfHidden::kStand, kWidth, kHeight, GetParam());
    const Frame frame =
        drawLines(s.scene(), evenLines({{"ink.creases.shown", "on"}, {"ink.creases.width", "1"}}), views);
    const double t = std::clamp(part, 0.0, 1.0), hidden = t * t * (3 - 2 * t);
    for (size_t v = 0; v < viewCount(); ++v)
      EXPECT_NEAR(inkAcross(frame, v, pixelOf(views[v], {0, 0.3, -1}, kWidth, kHeight)), 1 - hidden, 0.03)
          << part;
  }
}

// (Paper 004, section 2.4.) Closed doors show no line of what is behind them: not of shelves close behind,
// from however far, however they are turned to the viewer, in either projection; and all of those of the
// door.
TEST_P(Ink, linesDoNotShineThroughWalls) {
  const auto scene = [](float turn, float gap, bool hasShelf) {
    TestScene s;
    const int material = s.material(TestScene::colored("Thing", {0.6f, 0.5f, 0.4f, 1}));
    const glm::mat4 turned = glm::rotate(glm::mat4(1.0f), turn, {0.3f, 0.9f, 0.1f});
    s.add(gridMesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 3), material, turned);
    if (hasShelf) {
      s.add(boxMesh({-0.6f, -0.5f, -gap - 0.4f}, {0.6f, -0.1f, -gap}), material, turned);
      s.add(sphereMesh({0, 0.4f, -gap - 0.3f}, 0.3f, 12), material, turned);
    }
    return s.load();
  };
  const Knobs knobs = evenLines({{"ink.creases.shown", "on"},
                                 {"ink.creases.width", "1"},
                                 {"ink.boundaries.shown", "on"},
                                 {"ink.boundaries.width", "1"}});
  for (const float distance : {3.0f, 10.0f, 100.0f})
    for (const float turn : {0.0f, 0.25f, -0.3f})
      for (const bool isParallel : {false, true}) {
        if (isParallel && distance > 3) continue;
        // So that it fills the same part of the picture.
        const float fov = glm::degrees(2 * std::atan(1.4f / distance));
        const float pixel = 2.8f / float(kHeight);
        for (const float gap : {3 * pixel / std::cos(turn), 0.1f, 0.5f}) {
          const Scene with = scene(turn, gap, true), without = scene(turn, gap, false);
          auto views =
              viewsFrom(with, {{0, 0, distance}, {0, 0, 0}, fov, 0, 0.02f}, kWidth, kHeight, GetParam());
          if (isParallel)
            for (View& view : views) view = parallelView(1.4f, float(kWidth) / kHeight);
          const Frame open = drawLines(with, knobs, views), closed = drawLines(without, knobs, views);
          for (size_t v = 0; v < viewCount(); ++v) {
            Difference ink(0.02);
            double drawn = 0;
            for (int y = 0; y < kHeight; ++y)
              for (int x = 0; x < kWidth; ++x) {
                const double there = texel(aov(closed, "ink", v), x, y).w;
                drawn += there;
                ink.add(texel(aov(open, "ink", v), x, y).w, there);
              }
            EXPECT_GT(drawn, 300);
            // Corners of edges that lead away from the eye are all that may be left, as dots of a pixel.
            EXPECT_LT(ink.beyond, 12u) << distance << " m, turned by " << turn << ", " << gap << " m behind"
                                       << (isParallel ? ", parallel: " : ": ") << ink.text();
            EXPECT_LT(ink.mean() * kWidth * kHeight, 4)
                << distance << " m, turned by " << turn << ", " << gap << " m behind";
          }
        }
      }
}

// A line that goes behind something ends within some pixels before that, however it lies on the pixels.
TEST_P(Ink, linesEndSoftly) {
  for (const double left : {-0.02, 0.0, 0.01}) {
    const HalfHidden s(0.7, left);
    const auto views = viewsFrom(s.scene(), HalfHidden::kStand, kWidth, kHeight, GetParam());
    const Frame frame = drawLines(s.scene(), evenLines(), views);
    for (size_t v = 0; v < viewCount(); ++v) {
      const double edge = pixelOf(views[v], {left, 0.3, -0.3}, kWidth, kHeight).x;
      const glm::dvec2 line = pixelOf(views[v], {0, 0.3, -1}, kWidth, kHeight);
      const auto at = [&](double beside) {
        return inkAcross(frame, v, {std::floor(edge) + 0.5 + beside, line.y});
      };
      EXPECT_GT(at(-4), 0.95);
      EXPECT_NEAR(at(-1), 2 / 3.0, 0.1);
      EXPECT_EQ(at(1), 0.0);
    }
  }
}

// Bold lines outside of a ball: its outline is covered all around, from the ball on to the line's width.
TEST_P(Ink, jointsOfExteriorLinesAreClosed) {
  const TestScene s = oneThing(sphereMesh({0, 0, 0}, 1, 24));
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 5}, {0, 0, 0}, 40, 0, 0.1f}, kWidth, kHeight, GetParam());
  const Frame frame = drawLines(
      scene, evenLines({{"ink.placement", "exterior"}, {"ink.least", "54"}, {"ink.greatest", "54"}}), views);
  for (size_t v = 0; v < viewCount(); ++v) {
    // Where surfaces end, along rays from the middle.
    const glm::dvec2 middle = pixelOf(views[v], {0, 0, 0}, kWidth, kHeight);
    for (int i = 0; i < 180; ++i) {
      const double angle = i * std::numbers::pi / 90;
      const glm::dvec2 along(std::cos(angle), std::sin(angle));
      double edge = 0;
      for (double r = 20; r < 55; r += 0.25) {
        const glm::dvec2 at = middle + r * along;
        if (castRay(pixelRay(views[v], int(at.x), int(at.y), kWidth, kHeight), s.triangles())) edge = r;
      }
      EXPECT_GT(ink(frame, v, middle + (edge + 1.5) * along), 0.95) << i;
      EXPECT_GT(ink(frame, v, middle + (edge + 3.5) * along), 0.95) << i;
      EXPECT_EQ(ink(frame, v, middle + (edge + 9) * along), 0) << i;
      EXPECT_EQ(ink(frame, v, middle + (edge - 4) * along), 0) << i;
    }
  }
}

// A fold that is one triangle deep has all its depth until it closes: its line tapers by the angle, to the
// inner line that it is besides.
TEST_P(Ink, foldsCloseByAnAngle) {
  TestMesh step;
  for (const TestMesh& part :
       {gridMesh({-2, -2, 0.1f}, {4, 0, 0}, {0, 2, 0}), gridMesh({-2, 0, 0.1f}, {4, 0, 0}, {0, 0, -0.1f}),
        gridMesh({-2, 0, 0}, {4, 0, 0}, {0, 2, 0})})
    append(step, part, {1, 1, 1, 1});
  const Scene scene = oneThing(step).load();
  // Ink across the line, in parts of its width, where the riser turns away by so many degrees.
  const auto inkAt = [&](double degrees, const Knobs& knobs) {
    const double angle = glm::radians(degrees);
    const auto views = viewsFrom(
        scene, {{0, float(-6 * std::sin(angle)), float(6 * std::cos(angle))}, {0, 0, 0}, 40, 0, 0.1f}, kWidth,
        kHeight, GetParam());
    const Frame frame = drawLines(scene, evenLines(knobs), views);
    std::vector<double> parts;
    for (size_t v = 0; v < viewCount(); ++v) {
      parts.push_back(inkAcross(frame, v, pixelOf(views[v], {0, 0, 0.1}, kWidth, kHeight)));
    }
    return parts;
  };
  for (const double degrees : {-1.0, 0.5, 2.0, 5.0, 8.0, 12.0}) {
    const double turn = std::clamp(std::sin(glm::radians(degrees)) / std::sin(glm::radians(10.0)), 0.0, 1.0);
    const double full = turn * turn * (3 - 2 * turn);
    for (const double part : inkAt(degrees, {{"ink.fadeAngle", "10"}}))
      EXPECT_NEAR(part, full, 0.06) << degrees;
    for (const double part : inkAt(degrees, {{"ink.fadeAngle", "0"}}))
      EXPECT_NEAR(part, degrees > 0, 0.06) << degrees;
    for (const double part :
         inkAt(degrees, {{"ink.fadeAngle", "10"}, {"ink.creases.shown", "on"}, {"ink.creases.width", "0.4"}}))
      EXPECT_NEAR(part, std::max(full, 0.4), 0.06) << degrees;
  }
}

// Where a coarse form goes on turning, its outline stays whole while it passes from edge to edge, also right
// before a wall.
TEST_P(Ink, outlinesThatPassOnStayWhole) {
  TestScene s = oneThing(sphereMesh({0, 0, 0}, 1, 14));
  s.add(gridMesh({-30, -30, -1.5f}, {60, 0, 0}, {0, 60, 0}),
        s.material(TestScene::colored("Wall", {0.6f, 0.5f, 0.4f, 1})));
  const Scene scene = s.load();
  for (int i = 0; i < 12; ++i) {
    const double angle = glm::radians(1.1 * i);
    const auto views = viewsFrom(
        scene, {{float(5 * std::sin(angle)), 0.4f, float(5 * std::cos(angle))}, {0, 0, 0}, 40, 0, 0.1f},
        kWidth, kHeight, GetParam());
    double sums[2][2]{};
    for (int fades = 0; fades < 2; ++fades) {
      const Frame frame = drawLines(scene, evenLines({{"ink.fadeAngle", fades ? "8" : "0"}}), views);
      for (size_t v = 0; v < viewCount(); ++v)
        for (int y = 0; y < kHeight; ++y)
          for (int x = 0; x < kWidth; ++x) sums[fades][v] += texel(aov(frame, "ink", v), x, y).w;
    }
    for (size_t v = 0; v < viewCount(); ++v) {
      EXPECT_GT(sums[0][v], 400);
      EXPECT_NEAR(sums[1][v] / sums[0][v], 1, 0.02) << "step " << i;
    }
  }
}

// Of lumps whose outlines pass over many an edge while one walks around them, nothing comes or goes at once.
TEST_F(RenderTest, linesOfLumpsAreSteady) {
  TestMesh lumps = sphereMesh({0, 0, 0}, 1, 16);
  for (glm::vec3& position : lumps.positions)
    position *=
        1 + 0.12f * std::sin(7 * position.x + 2) * std::sin(6 * position.y) * std::sin(8 * position.z + 1);
  const Scene scene = oneThing(lumps).load();
  MeasureOptions options;
  options.width = 480, options.height = 360;
  const auto flickersWith = [&](const Knobs& more) {
    Knobs knobs{{"ink.least", "6"}, {"ink.greatest", "6"}, {"ink.fade", "1.5"}};
    knobs.insert(knobs.end(), more.begin(), more.end());
    const LineMeasurements found =
        measureLines(renderer(), scene, quietLook(evenLines(knobs)), "ink", options).value();
    return found.lines.flickers * found.lines.drawn * kLineStep * (kLineFrames - 1);
  };
  const double plain = flickersWith({{"ink.fade", "0"}, {"ink.fadeAngle", "0"}}), ours = flickersWith({});
  EXPECT_GT(plain, 50);
  EXPECT_LE(ours, 4);
}

// An outline of edges of a pixel or two is as wide as one of long edges, also before a wall close behind it.
TEST_P(Ink, shortEdgesAreAsWideAsLongOnes) {
  const auto inkWith = [&](int segments) {
    TestScene s = oneThing(sphereMesh({0, 0, 0}, 1, segments));
    s.add(gridMesh({-30, -30, -1.2f}, {60, 0, 0}, {0, 60, 0}),
          s.material(TestScene::colored("Wall", {0.6f, 0.5f, 0.4f, 1})));
    const Scene scene = s.load();
    const auto views = viewsFrom(scene, {{0, 0.4f, 9}, {0, 0, 0}, 30, 0, 0.1f}, kWidth, kHeight, GetParam());
    const Frame frame = drawLines(scene, evenLines({{"ink.fade", "0.5"}}), views);
    std::vector<double> sums;
    for (size_t v = 0; v < viewCount(); ++v) {
      double& sum = sums.emplace_back(0);
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) sum += texel(aov(frame, "ink", v), x, y).w;
    }
    return sums;
  };
  const std::vector<double> longOnes = inkWith(16), shortOnes = inkWith(160);
  for (size_t v = 0; v < viewCount(); ++v) {
    EXPECT_GT(longOnes[v], 300);
    EXPECT_NEAR(shortOnes[v] / longOnes[v], 1, 0.08);
  }
}

// FORMULAS 24: thin where light falls on it, bold where it turns away, and in between what a cosine says.
TEST_P(Ink, widthsFollowTheLight) {
  TestScene s = oneThing(sphereMesh({0, 0, 0}, 1, 64));
  s.light({1, 0, 0});
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 8}, {0, 0, 0}, 20, 0, 0.05f}, kWidth, kHeight, GetParam());
  for (const char* weights : {"edge", "vertex", "tangent", "hybrid"}) {
    const Frame frame = drawLines(
        scene, evenLines({{"ink.weights", weights}, {"ink.least", "9"}, {"ink.greatest", "63"}}), views);
    for (size_t v = 0; v < viewCount(); ++v) {
      const glm::dvec2 middle = pixelOf(views[v], {0, 0, 0}, kWidth, kHeight);
      for (int i = 0; i < 24; ++i) {
        const double angle = i * std::numbers::pi / 12;
        const glm::dvec2 along(std::cos(angle), std::sin(angle));
        double width = 0;
        for (double r = 25; r < 58; r += 0.05) width += 0.05 * ink(frame, v, middle + r * along);
        const double expected = (36 - 27 * std::cos(angle)) * kHeight / 1080;
        EXPECT_NEAR(width, expected, 0.15 * expected + 0.35) << weights << " " << i;
      }
    }
  }
}

// A vertex attribute chooses, where a file has one: whatever the angle is.
TEST_P(Ink, roundFormsAreWhatTheFileSays) {
  const auto drawn = [&](const char* weights, std::optional<float> roundness) {
    TestMesh ball = sphereMesh({0, 0, 0}, 1, 10);
    if (roundness) ball.roundness.assign(ball.positions.size(), *roundness);
    TestScene s = oneThing(ball);
    s.light({1, 0.4f, 0.2f});
    const Scene scene = s.load();
    return drawLines(scene, evenLines({{"ink.weights", weights}, {"ink.least", "9"}, {"ink.greatest", "63"}}),
                     viewsFrom(scene, {{0, 1, 7}, {0, 0, 0}, 20, 0, 0.05f}, kWidth, kHeight, GetParam()));
  };
  const auto isSame = [&](const Frame& a, const Frame& b) {
    bool same = true;
    for (size_t v = 0; v < viewCount(); ++v) same &= sameBytes(aov(a, "ink", v), aov(b, "ink", v));
    return same;
  };
  EXPECT_TRUE(isSame(drawn("hybrid", 1), drawn("vertex", std::nullopt)));
  EXPECT_TRUE(isSame(drawn("hybrid", 0), drawn("tangent", std::nullopt)));
  EXPECT_TRUE(isSame(drawn("vertex", 0), drawn("vertex", std::nullopt)));
  EXPECT_FALSE(isSame(drawn("hybrid", 0), drawn("hybrid", 1)));
}

// A degree of what is seen stays one when a lens is exchanged, and a metre is one at any distance.
TEST_P(Ink, unitsOfWidths) {
  const TestScene s = oneThing(boxMesh({-1, -1, -0.1f}, {1, 1, 0.1f}));
  const Scene scene = s.load();
  const auto width = [&](const char* unit, const char* value, float distance, float fov) {
    const auto views =
        viewsFrom(scene, {{0, 0, distance}, {0, 0, 0}, fov, 0, 0.02f}, kWidth, kHeight, GetParam());
    const Frame frame = drawLines(
        scene, evenLines({{"ink.unit", unit}, {"ink.least", value}, {"ink.greatest", value}}), views);
    // Across the upper edge.
    const double x = pixelOf(views[0], {0, 1, 0.1}, kWidth, kHeight).x;
    double sum = 0;
    for (int y = 0; y < kHeight / 2; ++y) sum += ink(frame, 0, {x, y});
    return sum;
  };
  const auto pixelsOfOne = [&](float fov) { return 0.5 * kHeight / std::tan(fov * std::numbers::pi / 360); };
  EXPECT_NEAR(width("pixels", "36", 6, 40), 4, 0.1);
  for (const float distance : {4.0f, 8.0f})
    EXPECT_NEAR(width("metres", "0.2", distance, 40), 0.2 * pixelsOfOne(40) / (distance - 0.1), 0.15);
  for (const float fov : {25.0f, 50.0f})
    EXPECT_NEAR(width("degrees", "2", 7, fov), 2 * std::numbers::pi / 180 * pixelsOfOne(fov), 0.15);
}

// Both eyes may share one outline.
TEST_F(RenderTest, cyclopeanOutlinesAreThoseOfOneEyeBetween) {
  constexpr int kWidth = 160, kHeight = 120;
  const TestScene s = oneThing(sphereMesh({0, 0, 0}, 1.2f, 16));
  const Scene scene = s.load();
  const Stand stand{{0.4f, 1.2f, 4.5f}, {0, 0, 0}, 40, 0, 0.6f};
  const auto views = viewsFrom(scene, stand, kWidth, kHeight, Stereo::stereo);
  const Frame frame =
      draw(scene, quietLook(evenLines({{"ink.cyclopean", "on"}})), views, sized(kWidth, kHeight, {"ink"}));
  const std::vector<ReferenceEdge> edges = referenceEdges(s.triangles());
  for (size_t v = 0; v < 2; ++v) {
    // Lines that are hidden for one eye are not drawn there: those that it sees are among the shared ones.
    const Texels shared = referenceLines(edges, views[v], kWidth, kHeight, [&](const ReferenceEdge& edge) {
      return edge.isSilhouette({0.4, 1.2, 4.5}) ? 1.5 : 0;
    });
    Difference beyond(0.03);
    double drawn = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double got = texel(aov(frame, "ink", v), x, y).w, most = shared.clamped(x, y).x;
        drawn += got;
        beyond.add(std::max(got - most, 0.0), 0);
      }
    EXPECT_GT(drawn, 200);
    EXPECT_LT(beyond.beyondPart(), 0.0005) << beyond.text();
  }
}

TEST_P(Ink, colorsAreOfMaterialAndKind) {
  const TestScene s = oneThing(boxMesh({-1, -1, -1}, {1, 1, 1}));
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 6}}, kWidth, kHeight, GetParam());
  const auto colorWith = [&](const Knobs& knobs) {
    const Frame frame = draw(scene, quietLook(evenLines(knobs)), views, sized(kWidth, kHeight));
    const glm::dvec2 at = pixelOf(views[0], {0, 1, 1}, kWidth, kHeight);
    return glm::dvec3(texel(aov(frame, ""), int(at.x), int(at.y)));
  };
  const auto expectNear = [](const glm::dvec3& got, const glm::dvec3& expected) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], expected[c], 0.012) << c;
  };
  expectNear(colorWith({{"ink.line.color", "#FF8000"}}), {1, 0.2159, 0});
  expectNear(colorWith({{"materials.Thing.ink.line.color", "#0080FF"}}), {0, 0.2159, 1});
  expectNear(colorWith({{"ink.silhouettes.color", "#FFFFFF"}, {"ink.silhouettes.colorAmount", "1"}}),
             {1, 1, 1});
}

// A second outline lies at its distance from the first one, outside or inside, and is as wide as it should
// be.
TEST_P(Ink, outlinesAreDoubled) {
  const Scene scene = oneThing(boxMesh({-1, -1, -1}, {1, 1, 1})).load();
  const auto views = viewsFrom(scene, {{0, 0, 6}}, kWidth, kHeight, GetParam());
  for (const double side : {1.0, -1.0}) {
    const Frame frame = drawLines(
        scene, evenLines({{"ink.doubled", std::to_string(72 * side)}, {"ink.doubledWidth", "0.5"}}), views);
    for (size_t v = 0; v < viewCount(); ++v) {
      const glm::dvec2 edge = pixelOf(views[v], {0, 1, 1}, kWidth, kHeight);
      double first = 0, second = 0, elsewhere = 0;
      for (double y = -16; y <= 16; ++y) {
        const double at = y * side, covered = ink(frame, v, edge - glm::dvec2(0, y));
        (std::abs(at) < 4 ? first : at > 4 && at < 12 ? second : elsewhere) += covered;
      }
      EXPECT_NEAR(first, 3, 0.1);
      EXPECT_NEAR(second, 1.5, 0.1);
      EXPECT_EQ(elsewhere, 0);
    }
  }
  // A wider one close by reaches over the first one, to both of its sides.
  const Frame frame = drawLines(scene, evenLines({{"ink.doubled", "1"}, {"ink.doubledWidth", "4"}}), views);
  for (size_t v = 0; v < viewCount(); ++v) {
    const glm::dvec2 edge = pixelOf(views[v], {0, 1, 1}, kWidth, kHeight);
    double covered = 0;
    for (double y = -16; y <= 16; ++y) covered += ink(frame, v, edge + glm::dvec2(0, y));
    EXPECT_NEAR(covered, 12, 0.3);
  }
}

// MToon's outlines, of VRM 1 in metres and of VRM 0 in parts of the picture, are as wide as the file says,
// with its colour; a look can ignore them.
TEST_P(Ink, filesBringOutlines) {
  const TestScene plain = oneThing(boxMesh({-1, -1, -0.1f}, {1, 1, 0.1f}));
  TestScene vrm1 = plain, vrm0 = plain, halved = plain;
  vrm1.json()["materials"][0]["extensions"]["VRMC_materials_mtoon"] = {
      {"outlineWidthMode", "worldCoordinates"},
      {"outlineWidthFactor", 0.2},
      {"outlineColorFactor", {1, 0.25, 0}},
      {"outlineLightingMixFactor", 0}};
  // A texture of widths: 0.5, in the channel that counts.
  const Image half{1, 1, {"R", "G", "B", "A"}, {1, 0.2140411f, 0, 1}};
  halved.json()["materials"][0]["extensions"]["VRMC_materials_mtoon"] =
      vrm1.json()["materials"][0]["extensions"]["VRMC_materials_mtoon"];
  halved.json()["materials"][0]["extensions"]["VRMC_materials_mtoon"]["outlineWidthMultiplyTexture"] = {
      {"index", halved.texture(half)}};
  vrm0.json()["extensions"]["VRM"]["materialProperties"] = {
      {{"shader", "VRM/MToon"},
       {"floatProperties", {{"_OutlineWidthMode", 2}, {"_OutlineWidth", 10}}},
       {"vectorProperties", {{"_OutlineColor", {0, 0, 1, 1}}}}}};
  struct Case {
    const TestScene& scene;
    const char* own;
    double width;  // pixels; or, below 0, parts of 0.2 metres
    glm::dvec3 color;
  };
  for (const Case& c : {Case{vrm1, "on", -1, {1, 0.25, 0}}, Case{halved, "on", -0.5, {1, 0.25, 0}},
                        Case{vrm0, "on", 0.05 * kHeight, {0, 0, 1}},
                        Case{vrm0, "off", 2 * kRadius, {0.013, 0.0103, 0.0116}}}) {
    const Scene scene = c.scene.load();
    const auto views = viewsFrom(scene, {{0, 0, 6}, {0, 0, 0}, 40}, kWidth, kHeight, GetParam());
    const Frame frame = drawLines(scene, evenLines({{"ink.ownOutlines", c.own}}), views);
    for (size_t v = 0; v < viewCount(); ++v) {
      const glm::dvec2 edge = pixelOf(views[v], {0, 1, 0.1}, kWidth, kHeight);
      double width = 0;
      for (double y = 0; y < kHeight / 2.0; ++y) width += ink(frame, v, {edge.x, y});
      const double metres = 0.2 * 0.5 * kHeight / std::tan(20 * std::numbers::pi / 180) / 5.9;
      EXPECT_NEAR(width, c.width > 0 ? c.width : -c.width * metres, 0.15);
      const glm::dvec4 color = texel(aov(frame, "", v), int(edge.x), int(edge.y));
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(color[i], c.color[i], 0.012);
    }
  }
}

// Lines around shadow shapes lie where light meets shadow, and nowhere else.
TEST_P(Ink, shadowShapesHaveOutlines) {
  TestScene s = oneThing(sphereMesh({0, 0, 0}, 1.3f, 48));
  s.light({1, 0.6f, 0.4f});
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 6}, {0, 0, 0}, 40, 0, 0.1f}, kWidth, kHeight, GetParam());
  Knobs knobs = evenLines({{"ink.silhouettes.shown", "off"},
                           {"ink.line.color", "#FF0000"},
                           {"shadow.indication", "0"},
                           {"shadow.innerGlow", "0"},
                           {"ink.shadows.width", "1"}});
  const auto frameWith = [&](const char* shown) {
    knobs.push_back({"ink.shadows.shown", shown});
    return draw(scene, quietLook(knobs), views, sized(kWidth, kHeight, {"final-shadow"}));
  };
  const Frame without = frameWith("off"), with = frameWith("on");
  for (size_t v = 0; v < viewCount(); ++v) {
    const auto lightAt = [&](int x, int y) { return texel(aov(with, "final-shadow", v), x, y); };
    size_t on = 0, red = 0, off = 0, changed = 0;
    for (int y = 6; y < kHeight - 6; ++y)
      for (int x = 6; x < kWidth - 6; ++x) {
        double least = 1, most = 0, covered = 1;
        for (int dy = -4; dy <= 4; ++dy)
          for (int dx = -4; dx <= 4; ++dx) {
            const glm::dvec4 light = lightAt(x + dx, y + dy);
            covered = std::min(covered, light.w);
            least = std::min(least, light.x), most = std::max(most, light.x);
          }
        const glm::dvec4 now = texel(aov(with, "", v), x, y);
        const bool isChanged = glm::distance(now, texel(aov(without, "", v), x, y)) > 0.02;
        if (most - least < 0.02) {
          ++off, changed += isChanged;
        } else if (covered == 1 && (lightAt(x, y).x > 0.5) != (lightAt(x + 1, y).x > 0.5)) {
          ++on, red += now.x > 0.9 && now.y < 0.1;
        }
      }
    EXPECT_GT(on, 40u);
    EXPECT_GT(red, on * 95 / 100);
    EXPECT_GT(off, 5000u);
    EXPECT_EQ(changed, 0u);
  }
}

// What is not shown has no passes, and pictures without it are what they were, to the byte.
TEST_P(Ink, costsNothingWhereItIsNot) {
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{0, 2, 8}, {0, 1, 0}}, kWidth, kHeight, GetParam());
  const auto passesOf = [](const Frame& frame) {
    size_t count = 0;
    for (const PassTime& pass : frame.stats.passes) count += pass.name.starts_with("ink");
    return count;
  };
  const Frame without = draw(scene, quietLook(), views, sized(kWidth, kHeight)),
              with = draw(scene, quietLook({{"ink.shown", "on"}}), views, sized(kWidth, kHeight)),
              again = draw(scene, quietLook(), views, sized(kWidth, kHeight)),
              withAgain = draw(scene, quietLook({{"ink.shown", "on"}}), views, sized(kWidth, kHeight));
  EXPECT_EQ(passesOf(without), 0u);
  EXPECT_GT(passesOf(with), 0u);
  expectSame(without, again);
  expectSame(with, withAgain);
  EXPECT_FALSE(sameBytes(aov(without, ""), aov(with, "")));
}

}  // namespace
}  // namespace scumble::ink
