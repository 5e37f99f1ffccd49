// Strokes in space against a reference on the CPU in double precision, and what must hold of them: paint lies
// in the order of depth, later strokes over earlier ones; surfaces hide and carry it; nothing pops.
#include "features/painting/painting.h"

#include <algorithm>
#include <cmath>

#include "features/painting/bindings.h"
#include "features/painting/painting.shared.h"
#include "scene/import_warnings.h"
#include "scene/splat_places.h"
#include "tests/support/aov.h"
#include "tests/support/render_test.h"
#include "tests/support/sanitized.h"
#include "tests/support/test_gltf.h"

namespace scumble::painting {
namespace {

using namespace test;

constexpr int kWidth = 96, kHeight = 72;

const Knobs kEven{{"painting.variation", "0"}};

Look paintLook(Knobs knobs = {}) {
  knobs.insert(knobs.begin(), kEven.begin(), kEven.end());
  return quietLook(knobs);
}

// A swung stroke from one place to another.
TestStroke swung(const glm::vec3& from, const glm::vec3& to, float radius, const glm::vec4& color,
                 const std::string& brush = "") {
  TestStroke stroke{{}, radius, color, brush};
  for (int i = 0; i <= 12; ++i) {
    const float t = float(i) / 12;
    stroke.points.push_back(glm::mix(from, to, t) + glm::vec3(0, 0.12f, 0.1f) * std::sin(6 * t));
  }
  return stroke;
}

struct ReferenceSplat {
  glm::dvec3 position, tangent;
  double radius, order, spacing, opacity;
  glm::dvec3 root;
  bool isWash;
};

// All of a scene's strokes as they are painted where nothing carries them.
std::vector<ReferenceSplat> referenceSplats(const scene::Painting& painting) {
  std::vector<ReferenceSplat> splats;
  std::vector<float> along;
  std::vector<size_t> strokeOf;
  for (size_t s = 0; s < painting.strokes.size(); ++s)
    strokeOf.resize(strokeOf.size() + painting.strokes[s].pointCount, s);
  for (const scene::SplatPlace& place : scene::splatPlaces(painting, along)) {
    const scene::Stroke& stroke = painting.strokes[strokeOf[place.point]];
    const auto position = [&](uint32_t i) { return glm::dvec3(painting.points[i].position); };
    const auto tangent = [&](uint32_t i) {
      const uint32_t last = stroke.firstPoint + stroke.pointCount - 1;
      const glm::dvec3 t = position(std::min(i + 1, last)) - position(i > stroke.firstPoint ? i - 1 : i);
      return glm::length(t) > 0 ? glm::normalize(t) : glm::dvec3(1, 0, 0);
    };
    const uint32_t next = place.point + (place.toNext > 0 ? 1 : 0);
    const scene::StrokePoint &a = painting.points[place.point], &b = painting.points[next];
    const double t = place.toNext;
    const auto root = [](const scene::StrokePoint& p) {
      return glm::round(255.0 * glm::sqrt(glm::dvec3(p.color))) / 255.0;
    };
    const double opacity = std::round(255.0 * glm::mix(double(a.color.a), double(b.color.a), t)) / 255;
    splats.push_back({glm::mix(position(place.point), position(next), t),
                      glm::mix(tangent(place.point), tangent(next), t),
                      glm::mix(double(a.radius), double(b.radius), t),
                      double(strokeOf[place.point] + 1) / double(painting.strokes.size()), place.spacing,
                      opacity, glm::mix(root(a), root(b), t), stroke.brush == scene::Brush::wash});
  }
  return splats;
}

// Premultiplied, as the AOV has it. `viewer`: between the eyes.
Texels reference(const std::vector<ReferenceSplat>& splats, const View& view, const glm::dvec3& viewer,
                 double spacing, double order) {
  Texels picture(kWidth, kHeight);
  const glm::dmat4 toClip = glm::dmat4(view.eyeToClip) * glm::dmat4(view.worldToEye);
  const glm::dvec2 size(kWidth, kHeight);
  const double metresOfPixel = 2.0 / std::abs(double(view.eyeToClip[1][1])) / kHeight;
  struct Drawn {
    double distance;
    const ReferenceSplat* splat;
  };
  std::vector<Drawn> drawn;
  for (const ReferenceSplat& s : splats) {
    const glm::dvec3 sight = glm::normalize(viewer - s.position);
    drawn.push_back({glm::distance(viewer, s.position + sight * (order * s.radius * s.order)), &s});
  }
  std::stable_sort(drawn.begin(), drawn.end(),
                   [](const Drawn& a, const Drawn& b) { return a.distance > b.distance; });
  for (const Drawn& d : drawn) {
    const ReferenceSplat& s = *d.splat;
    const double away = glm::distance(viewer, s.position);
    const glm::dvec3 sight = (viewer - s.position) / away, along = glm::normalize(s.tangent);
    const double sine = std::max(glm::length(glm::cross(sight, along)), 0.15);
    const double apart = std::max(spacing, double(shared::kLeastPixels) * metresOfPixel * away / s.radius);
    const double fade = glm::clamp(2 - apart / sine / s.spacing, 0.0, 1.0);
    if (fade <= 0) continue;
    const auto project = [&](const glm::dvec3& p) {
      const glm::dvec4 clip = toClip * glm::dvec4(p, 1);
      return (glm::dvec2(clip) / clip.w + 1.0) * 0.5 * size;
    };
    const glm::dvec2 at = project(s.position);
    const double depth = -(glm::dmat4(view.worldToEye) * glm::dvec4(s.position, 1)).z;
    const double pixels = s.radius / (metresOfPixel * depth), drawnPixels = std::max(pixels, 0.5);
    const double alpha = (1 - std::pow(1 - std::min(s.opacity, 0.9995), std::min(0.5 * apart, 1.0))) * fade *
                         pixels / drawnPixels;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double out = glm::distance(glm::dvec2(x + 0.5, y + 0.5), at) / drawnPixels;
        const double soft = std::max(1 - out * out, 0.0);
        const double covers =
            s.isWash ? 0.35 * soft * soft : glm::clamp((1 - out) * drawnPixels + 0.5, 0.0, 1.0);
        if (covers <= 0) continue;
        glm::dvec4& texel = picture.at(x, y);
        texel = glm::dvec4(s.root, 1) * (covers * alpha) + texel * (1 - covers * alpha);
      }
  }
  return picture;
}

class Paintings : public BothEyes {
 protected:
  void SetUp() override {
    BothEyes::SetUp();
    if (kSanitized && viewCount() == 1) GTEST_SKIP() << "two eyes are enough";
  }
  static Frame drawn(const Scene& scene, const std::vector<View>& views, const Knobs& knobs = {},
                     double time = 0) {
    Result<Frame> frame =
        renderer().render(scene, paintLook(knobs), time, views, sized(kWidth, kHeight, {"painting"}));
    if (!frame) throw std::runtime_error(frame.error().message());
    return std::move(frame).value();
  }
  static double covered(const Frame& frame, size_t view) {
    double sum = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) sum += texel(aov(frame, "painting", view), x, y).w;
    return sum;
  }
  // The middle of what is painted, pixels.
  static glm::dvec2 middle(const Frame& frame, size_t view) {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        sum += texel(aov(frame, "painting", view), x, y).w * glm::dvec3(x + 0.5, y + 0.5, 1);
    return glm::dvec2(sum) / sum.z;
  }
  static glm::dvec2 pixelOf(const View& view, const glm::dvec3& place) {
    const glm::dvec4 clip = glm::dmat4(view.eyeToClip) * glm::dmat4(view.worldToEye) * glm::dvec4(place, 1);
    return (glm::dvec2(clip) / clip.w + 1.0) * 0.5 * glm::dvec2(kWidth, kHeight);
  }
};
INSTANTIATE_BOTH_EYES(Paintings);

TEST_P(Paintings, areAsTheReferenceHasThem) {
  TestScene s;
  s.addStrokes({swung({-1.2f, 0, 0}, {1.2f, 0.3f, 0.4f}, 0.25f, {0.8f, 0.1f, 0.1f, 1}),
                swung({-0.8f, -0.7f, 0.5f}, {0.9f, 0.8f, -0.5f}, 0.15f, {0.1f, 0.3f, 0.8f, 0.6f}),
                swung({0.9f, -0.8f, -0.3f}, {-0.9f, 0.7f, 0.8f}, 0.3f, {0.2f, 0.7f, 0.2f, 0.9f}, "wash"),
                swung({0, -0.9f, -1}, {0.1f, 0.2f, 1.5f}, 0.1f, {0.9f, 0.8f, 0.2f, 1})});
  const Scene scene = s.load();
  const scene::Painting& painting = *scene.data().meshes[0]->painting;
  ASSERT_EQ(painting.strokes.size(), 4u);
  const std::vector<ReferenceSplat> splats = referenceSplats(painting);
  for (const glm::vec3& eye : {glm::vec3(0, 0, 4), glm::vec3(2.5f, 1.5f, -2), glm::vec3(0.5f, 3, 14)}) {
    const auto views = viewsFrom(scene, {eye}, kWidth, kHeight, GetParam());
    const Frame frame = drawn(scene, views, {{"painting.spacing", "0.4"}, {"painting.order", "0.7"}});
    for (size_t v = 0; v < viewCount(); ++v) {
      Texels expected = reference(splats, views[v], eye, 0.4, 0.7);
      Difference paint(0.02);
      double most = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const glm::dvec4 got = texel(aov(frame, "painting", v), x, y), want = expected.at(x, y);
          for (int c = 0; c < 4; ++c) paint.add(got[c], want[c]);
          most = std::max(most, want.w);
        }
      EXPECT_GT(most, 0.95);
      // Splats at nearly one depth may be sorted otherwise.
      EXPECT_LT(paint.beyondPart(), 0.004) << paint.text();
      EXPECT_LT(paint.mean(), 0.001) << paint.text();
    }
  }
}

// A stroke is as opaque as its file says, from wherever it is seen.
TEST_P(Paintings, areAsOpaqueAsTheyShouldBe) {
  for (const float opacity : {0.3f, 0.7f}) {
    TestScene s;
    s.addStrokes({{{{-3, 0, 0}, {3, 0, 0}}, 0.4f, {0.8f, 0.1f, 0.1f, opacity}}});
    const Scene scene = s.load();
    for (const float angle : {90.0f, 60.0f, 30.0f}) {
      const float turn = glm::radians(angle);
      const auto views = viewsFrom(scene, {5.0f * glm::vec3(std::cos(turn), 0, std::sin(turn))}, kWidth,
                                   kHeight, GetParam());
      const Frame frame = drawn(scene, views, {{"painting.spacing", "0.25"}});
      for (size_t v = 0; v < viewCount(); ++v)
        EXPECT_NEAR(texel(aov(frame, "painting", v), kWidth / 2, kHeight / 2).w, opacity, 0.07) << angle;
    }
  }
}

// Over nothing, paint that lets through keeps its colour.
TEST_P(Paintings, keepTheirColorOverNothing) {
  TestScene s;
  s.addStrokes({{{{-3, 0, 0}, {3, 0, 0}}, 0.4f, {0.2f, 0.5f, 0.8f, 0.5f}}});
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 5}}, kWidth, kHeight, GetParam());
  RenderOptions options = sized(kWidth, kHeight);
  options.transparent = true;
  const Frame frame = draw(scene, paintLook(), views, options);
  for (size_t v = 0; v < viewCount(); ++v) {
    const glm::dvec4 got = texel(frame.layers[0].views[v], kWidth / 2, kHeight / 2);
    EXPECT_NEAR(got.w, 0.5, 0.07);
    EXPECT_NEAR(got.x, 0.2, 0.01);
    EXPECT_NEAR(got.y, 0.5, 0.01);
    EXPECT_NEAR(got.z, 0.8, 0.01);
  }
}

// What lies behind the viewer, or before what a camera shows, is not drawn.
TEST_P(Paintings, nothingBehindTheViewer) {
  TestScene s;
  s.addStrokes({{{{-1, 0, 9}, {1, 0, 9}}, 0.4f, {1, 0, 0, 1}}});
  const Scene scene = s.load();
  const Frame frame = drawn(scene, std::vector<View>(viewCount(), parallelView(2, float(kWidth) / kHeight)));
  for (size_t v = 0; v < viewCount(); ++v) EXPECT_EQ(covered(frame, v), 0);
}

// A mirrored mesh mirrors its strokes, those beyond its edge, too.
TEST_P(Paintings, mirroredMeshesMirrorThem) {
  const TestStroke beyond{{{1.3f, 0.4f, 0.1f}, {1.5f, 0.4f, 0.1f}}, 0.1f, {1, 0, 0, 1}};
  TestScene s;
  s.add(gridMesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 2), -1,
        glm::mat4(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1));
  s.paint({beyond});
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 6}}, kWidth, kHeight, GetParam());
  const Frame frame = drawn(scene, views);
  for (size_t v = 0; v < viewCount(); ++v)
    EXPECT_LT(glm::distance(middle(frame, v), pixelOf(views[v], {-1.4, 0.4, 0.1})), 0.3);
}

// What is wound against its own normals carries paint where it was painted: beyond each of its sides.
TEST_P(Paintings, carriersMayBeWoundAgainstTheirNormals) {
  for (const glm::vec2& side : {glm::vec2(1.4f, 0.3f), glm::vec2(0.3f, 1.4f), glm::vec2(-1.4f, -0.3f)}) {
    const glm::vec3 place(side, 0.1f);
    const TestStroke beyond{
        {place - glm::vec3(0.05f, 0, 0), place + glm::vec3(0.05f, 0, 0)}, 0.1f, {1, 0, 0, 1}};
    TestMesh sheet = gridMesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 2);
    std::reverse(sheet.indices.begin(), sheet.indices.end());
    TestScene s;
    Json both = TestScene::colored("Sheet", {0.5f, 0.5f, 0.5f, 1});
    both["doubleSided"] = true;
    s.add(sheet, s.material(both));
    s.paint({beyond});
    const Scene scene = s.load();
    const auto views = viewsFrom(scene, {{0, 0, 6}}, kWidth, kHeight, GetParam());
    const Frame frame = drawn(scene, views);
    for (size_t v = 0; v < viewCount(); ++v)
      EXPECT_LT(glm::distance(middle(frame, v), pixelOf(views[v], place)), 0.3) << side.x << ", " << side.y;
  }
}

// Hairs of no width to speak of, however long, have so many splats and no more.
TEST_P(Paintings, hairsCostNoMoreThanTheyMay) {
  TestScene s;
  std::vector<TestStroke> hairs(1, {{{-1, 0, 0}, {1, 0, 0}}, 1e-30f, {1, 0, 0, 1}});
  hairs.push_back({{{-1, 0, 0}, {1, 0, 0}}, 0.2f, {1, 0, 0, 1}});
  s.addStrokes(hairs);
  const Scene scene = s.load();
  EXPECT_LT(scene::splatCount(*scene.data().meshes[0]->painting, scene::kSplatSpacing), 1e6);
  const auto views = viewsFrom(scene, {{0, 0, 4}}, kWidth, kHeight, GetParam());
  const Frame frame = drawn(scene, views);
  for (size_t v = 0; v < viewCount(); ++v) EXPECT_GT(covered(frame, v), 50);
}

// A file with one Gaussian, or more: `deviations` along the axes of its turn.
struct TestGaussian {
  glm::vec3 position{0.0f}, deviations{0.3f};
  glm::quat turn{1, 0, 0, 0};
  glm::vec3 shown{0.8f, 0.4f, 0.2f};  // sRGB, 0 to 1
  float opacity = 0.8f;
};
scene::TestGltf gaussianFile(const std::vector<TestGaussian>& gaussians) {
  scene::TestGltf g;
  std::vector<float> places, turns, scales, opacities, harmonics;
  for (const TestGaussian& one : gaussians) {
    for (int i = 0; i < 3; ++i) {
      places.push_back(one.position[i]), scales.push_back(one.deviations[i]);
      harmonics.push_back((one.shown[i] - 0.5f) / 0.28209479f);
    }
    for (const float part : {one.turn.x, one.turn.y, one.turn.z, one.turn.w}) turns.push_back(part);
    opacities.push_back(one.opacity);
  }
  const std::string prefix = "KHR_gaussian_splatting:";
  Json& primitive = g.addMesh({{"POSITION", g.addFloats(places, 3)},
                               {prefix + "ROTATION", g.addFloats(turns, 4)},
                               {prefix + "SCALE", g.addFloats(scales, 3)},
                               {prefix + "OPACITY", g.addFloats(opacities, 1)},
                               {prefix + "SH_DEGREE_0_COEF_0", g.addFloats(harmonics, 3)}});
  primitive["mode"] = 0;
  primitive["extensions"]["KHR_gaussian_splatting"] = {{"kernel", "ellipse"},
                                                       {"colorSpace", "srgb_rec709_display"}};
  for (const char* list : {"extensionsUsed", "extensionsRequired"})
    g.json[list].push_back("KHR_gaussian_splatting");
  return g;
}
Result<Scene> loadedGaussians(const scene::TestGltf& file) {
  const std::string text = file.gltf();
  return Scene::loadFromMemory(text.data(), text.size(), "cloud.gltf", "");
}

// Opacity of a Gaussian at a pixel: its ellipse on the screen, by the covariance of its projected axes,
// widened by 0.3 pixels and made as much less opaque as that makes it larger.
double gaussianAt(const TestGaussian& one, const glm::dmat4& model, const View& view, int x, int y) {
  const glm::dmat4 toClip = glm::dmat4(view.eyeToClip) * glm::dmat4(view.worldToEye) * model;
  const glm::dvec4 clip = toClip * glm::dvec4(one.position, 1);
  const glm::dmat3 axes = glm::mat3_cast(glm::dquat(one.turn));
  glm::dmat2 covariance(0.0);
  for (int i = 0; i < 3; ++i) {
    const glm::dvec4 along = toClip * glm::dvec4(axes[i] * double(one.deviations[i]), 0);
    const glm::dvec2 step = (glm::dvec2(along) - glm::dvec2(clip) / clip.w * along.w) / clip.w * 0.5 *
                            glm::dvec2(kWidth, kHeight);
    covariance += glm::outerProduct(step, step);
  }
  const double own = std::max(glm::determinant(covariance), 0.0);
  covariance[0][0] += 0.09, covariance[1][1] += 0.09;
  const glm::dvec2 middle = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(kWidth, kHeight);
  const glm::dvec2 away = glm::dvec2(x + 0.5, y + 0.5) - middle;
  return double(one.opacity) * std::sqrt(own / glm::determinant(covariance)) *
         std::exp(-0.5 * glm::dot(away, glm::inverse(covariance) * away));
}

TEST_P(Paintings, gaussiansAreTheirEllipses) {
  const glm::quat aslant = glm::normalize(glm::quat(0.8f, 0.3f, -0.4f, 0.2f));
  const TestGaussian kinds[] = {
      {{0, 0, 0}, glm::vec3(0.3f)},                                // round
      {{0.4f, 0.2f, 0.3f}, {0.5f, 0.1f, 0.2f}, aslant},            // each way another size
      {{-0.3f, 0.1f, 0}, {0.4f, 0.4f, 0.0f}, aslant},              // flat
      {{0.2f, -0.4f, 0.5f}, {0.1f, 0.02f, 0.6f}, aslant},          // a needle
      {{0, 0.3f, 0}, glm::vec3(0.01f), aslant, glm::vec3(1), 1}};  // less than a pixel
  for (const bool isParallel : {false, true})
    for (const TestGaussian& one : kinds) {
      const Result<Scene> scene = loadedGaussians(gaussianFile({one}));
      ASSERT_TRUE(scene) << scene.error().message();
      ASSERT_TRUE(scene->warnings().empty()) << scene->warnings()[0];
      const auto views = isParallel
                             ? std::vector<View>(viewCount(), parallelView(1.5f, float(kWidth) / kHeight))
                             : viewsFrom(*scene, {{0.5f, 0.4f, 4}}, kWidth, kHeight, GetParam());
      const Frame frame = drawn(*scene, views);
      for (size_t v = 0; v < viewCount(); ++v) {
        Difference alpha(0.012);
        for (int y = 0; y < kHeight; ++y)
          for (int x = 0; x < kWidth; ++x)
            alpha.add(texel(aov(frame, "painting", v), x, y).a,
                      gaussianAt(one, glm::dmat4(1.0), views[v], x, y));
        EXPECT_EQ(alpha.beyond, 0u) << alpha.text() << " of " << one.deviations.x << ", " << isParallel;
      }
    }
}

// Nodes turn, mirror and scale them; several are in the order of depth.
TEST_P(Paintings, gaussiansGoWithTheirNodes) {
  const TestGaussian one{
      {0.4f, 0.2f, 0.3f}, {0.25f, 0.05f, 0.1f}, glm::normalize(glm::quat(0.8f, 0.3f, -0.4f, 0.2f))};
  const glm::dmat4 turned = glm::scale(
      glm::rotate(glm::translate(glm::dmat4(1.0), {0.2, -0.1, 0.3}), 0.7, {0.0, 1.0, 0.2}), glm::dvec3(1.5));
  for (const double side : {1.0, -1.0}) {
    const glm::dmat4 model = glm::scale(turned, glm::dvec3(side, 1, 1));
    scene::TestGltf file = gaussianFile({one});
    file.json["nodes"][0]["matrix"] = std::vector<double>(&model[0][0], &model[0][0] + 16);
    const Result<Scene> scene = loadedGaussians(file);
    ASSERT_TRUE(scene) << scene.error().message();
    const auto views = viewsFrom(*scene, {{0.5f, 0.4f, 4}}, kWidth, kHeight, GetParam());
    const Frame frame = drawn(*scene, views);
    for (size_t v = 0; v < viewCount(); ++v) {
      Difference alpha(0.015);
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
          alpha.add(texel(aov(frame, "painting", v), x, y).a, gaussianAt(one, model, views[v], x, y));
      EXPECT_EQ(alpha.beyond, 0u) << alpha.text() << " " << side;
    }
  }
  TestGaussian near{{0, 0, 1}, glm::vec3(0.3f), {1, 0, 0, 0}, {1, 0, 0}, 1}, far = near;
  far.position.z = -1, far.shown = {0, 0, 1};
  for (const bool isFirst : {false, true}) {
    const auto file = isFirst ? gaussianFile({near, far}) : gaussianFile({far, near});
    const Result<Scene> scene = loadedGaussians(file);
    const auto views = viewsFrom(*scene, {{0, 0, 5}}, kWidth, kHeight, GetParam());
    const Frame frame = drawn(*scene, views);
    for (size_t v = 0; v < viewCount(); ++v) {
      const glm::dvec2 at = pixelOf(views[v], {0, 0, 1});
      const glm::dvec4 there = texel(aov(frame, "painting", v), int(at.x), int(at.y));
      EXPECT_GT(there.r, 0.9) << "the nearer one lies above";
      EXPECT_LT(there.b, 0.05);
    }
  }
}

TEST(Gaussians, areReadAsTheExtensionHasThem) {
  const TestGaussian one{{1, 2, 3}, {0.1f, 0.4f, 0.2f}, {0, 1, 0, 0}, {0.5f, 1, 0}, 0.25f};
  const Result<Scene> scene = loadedGaussians(gaussianFile({one, one}));
  ASSERT_TRUE(scene) << scene.error().message();
  const scene::Painting& painting = *scene->data().meshes[0]->painting;
  ASSERT_EQ(painting.strokes.size(), 2u);
  EXPECT_EQ(painting.strokes[1].brush, scene::Brush::gaussian);
  const scene::StrokePoint& point = painting.points[1];
  EXPECT_FLOAT_EQ(point.radius, 0.8f);
  EXPECT_LT(glm::distance(point.shape, glm::vec3(0.25f, 1, 0.5f)), 1e-6f);
  EXPECT_NEAR(point.color.r, 0.2140411, 1e-6);
  EXPECT_FLOAT_EQ(point.color.a, 0.25f);
  scene::TestGltf linear = gaussianFile({one});
  linear.json["meshes"][0]["primitives"][0]["extensions"]["KHR_gaussian_splatting"]["colorSpace"] =
      "lin_rec709_display";
  EXPECT_FLOAT_EQ(loadedGaussians(linear)->data().meshes[0]->painting->points[0].color.r, 0.5f);
  // An attribute that is missing or of another count is an error that names it; an unknown kernel is a
  // warning.
  for (const char* name : {"ROTATION", "SCALE", "OPACITY", "SH_DEGREE_0_COEF_0"}) {
    scene::TestGltf broken = gaussianFile({one});
    Json& attributes = broken.json["meshes"][0]["primitives"][0]["attributes"];
    attributes.erase(std::string("KHR_gaussian_splatting:") + name);
    const Result<Scene> missing = loadedGaussians(broken);
    ASSERT_FALSE(missing) << name;
    EXPECT_NE(missing.error().message().find(name), std::string::npos) << missing.error().message();
    scene::TestGltf longer = gaussianFile({one});
    const size_t count = std::string(name) == "ROTATION" ? 4 : std::string(name) == "OPACITY" ? 1 : 3;
    const int two = longer.addFloats(std::vector<float>(2 * count, 0.5f), int(count));
    longer.json["meshes"][0]["primitives"][0]["attributes"][std::string("KHR_gaussian_splatting:") + name] =
        two;
    EXPECT_FALSE(loadedGaussians(longer)) << name;
  }
  scene::TestGltf round = gaussianFile({one});
  Json& primitive = round.json["meshes"][0]["primitives"][0];
  primitive["extensions"]["KHR_gaussian_splatting"]["kernel"] = "disc";
  primitive["attributes"]["KHR_gaussian_splatting:SH_DEGREE_1_COEF_0"] =
      primitive["attributes"]["KHR_gaussian_splatting:SH_DEGREE_0_COEF_0"];
  const Result<Scene> plain = loadedGaussians(round);
  ASSERT_TRUE(plain) << plain.error().message();
  EXPECT_EQ(plain->warnings().size(), 2u);
  // Numbers that are none leave their Gaussian out.
  TestGaussian nowhere = one;
  nowhere.deviations = glm::vec3(0);
  const Result<Scene> left = loadedGaussians(gaussianFile({one, nowhere}));
  ASSERT_TRUE(left) << left.error().message();
  EXPECT_EQ(left->data().meshes[0]->painting->points.size(), 1u);
  EXPECT_EQ(left->warnings().size(), 1u);
}

// What does not count at a distance is every second splat, then all but every fourth, and so on; there is one
// at each end.
TEST(Splats, lieEvenlyAndNested) {
  scene::Painting painting;
  scene::ImportWarnings warnings;
  std::vector<scene::StrokePoint> points;
  for (int i = 0; i < 40; ++i) {
    scene::StrokePoint point;
    point.position = glm::vec3(0.1f * float(i), 0, 0) + 0.05f * glm::vec3(0, std::sin(float(i)), 0);
    point.radius = 0.05f + 0.004f * float(i);
    points.push_back(point);
  }
  painting.add(scene::Brush::plain, points, "", warnings);
  painting.add(scene::Brush::plain, {points[3]}, "", warnings);
  painting.finish();
  std::vector<float> along;
  const std::vector<scene::SplatPlace> all = scene::splatPlaces(painting, along);
  const auto places = [&](double least) {
    std::vector<double> found;
    for (const scene::SplatPlace& place : all) {
      if (place.point >= 40 || place.spacing < least) continue;
      const double next = place.point < 39 ? along[place.point + 1] : 0;
      found.push_back(glm::mix(double(along[place.point]), next, double(place.toNext)));
    }
    return found;
  };
  EXPECT_GT(places(0).size(), 30u);
  for (double spacing = scene::kSplatSpacing; spacing <= 4; spacing *= 2) {
    const std::vector<double> found = places(spacing);
    for (size_t i = 1; i + 1 < found.size(); ++i) EXPECT_NEAR(found[i] - found[i - 1], spacing, 1e-3);
    EXPECT_EQ(found.front(), 0);
    EXPECT_FLOAT_EQ(float(found.back()), along[39]);
  }
  EXPECT_EQ(all.back().point, 40u);
  EXPECT_EQ(all.back().toNext, 0);
}

// Of two strokes at one place the later one is seen, from either side.
TEST_P(Paintings, laterStrokesLieOverEarlierOnes) {
  const glm::vec4 red(1, 0, 0, 1), blue(0, 0, 1, 1);
  for (const bool redFirst : {true, false}) {
    TestScene s;
    const auto stroke = [&](const glm::vec4& color) { return swung({-1, 0, 0}, {1, 0, 0}, 0.3f, color); };
    s.addStrokes(redFirst ? std::vector{stroke(red), stroke(blue)} : std::vector{stroke(blue), stroke(red)});
    const Scene scene = s.load();
    for (const float z : {4.0f, -4.0f}) {
      const auto views = viewsFrom(scene, {{0, 0, z}}, kWidth, kHeight, GetParam());
      const Frame frame = drawn(scene, views);
      for (size_t v = 0; v < viewCount(); ++v) {
        const glm::dvec4 got = texel(aov(frame, "painting", v), kWidth / 2, kHeight / 2);
        EXPECT_NEAR(got.x, redFirst ? 0 : 1, 0.02);
        EXPECT_NEAR(got.z, redFirst ? 1 : 0, 0.02);
      }
    }
  }
}

// A wall hides what is behind it, but for strokes that have sunk into it by less than they may.
TEST_P(Paintings, surfacesHideThem) {
  for (const float depth : {0.05f, 0.6f}) {
    TestScene s;
    s.add(gridMesh({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}),
          s.material(TestScene::colored("Wall", {0.5f, 0.5f, 0.5f, 1})));
    s.addStrokes({{{{-1, 0, -depth}, {1, 0, -depth}}, 0.2f, {1, 0, 0, 1}}});
    const Scene scene = s.load();
    const auto views = viewsFrom(scene, {{0, 0, 4}}, kWidth, kHeight, GetParam());
    const Frame frame = drawn(scene, views, {{"painting.sunken", "1"}});
    const Frame strict = drawn(scene, views, {{"painting.sunken", "0"}});
    for (size_t v = 0; v < viewCount(); ++v) {
      if (depth < 0.2f)
        EXPECT_GT(covered(frame, v), 100);
      else
        EXPECT_EQ(covered(frame, v), 0);
      EXPECT_EQ(covered(strict, v), 0);
    }
  }
}

// A painting goes where its node does, and strokes on a mesh go where that is bent to.
TEST_P(Paintings, goWithWhatCarriesThem) {
  const TestStroke dab{{{-0.1f, 0.9f, 0.3f}, {0.1f, 0.9f, 0.3f}}, 0.08f, {1, 0, 0, 1}};
  {
    TestScene s;
    const glm::mat4 place(0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 0.5f, -0.3f, 0, 1);
    s.addStrokes({dab}, place);
    const Scene scene = s.load();
    const auto views = viewsFrom(scene, {{0, 0, 8}}, kWidth, kHeight, GetParam());
    const Frame frame = drawn(scene, views);
    for (size_t v = 0; v < viewCount(); ++v) {
      const glm::dvec3 expected(glm::dmat4(place) * glm::dvec4(0, 0.9, 0.3, 1));
      EXPECT_LT(glm::distance(middle(frame, v), pixelOf(views[v], expected)), 0.2);
    }
  }
  // The upper half of a bar is turned by a joint, a quarter around, and the dab at its upper end with it.
  TestScene s;
  TestMesh bar = gridMesh({-0.3f, -1, 0}, {0.6f, 0, 0}, {0, 2, 0}, 4);
  for (const glm::vec3& p : bar.positions) {
    bar.joints.push_back({p.y > 0 ? 1 : 0, 0, 0, 0});
    bar.weights.push_back({1, 0, 0, 0});
  }
  const glm::mat4 one(1.0f), turned(0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0.2f, 0, 0, 1);
  s.addSkinned(bar, s.material(TestScene::colored("Bar", {0.5f, 0.5f, 0.5f, 1})), {one, turned}, {one, one});
  s.paint({dab});
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 5}}, kWidth, kHeight, GetParam());
  const Frame frame = drawn(scene, views);
  for (size_t v = 0; v < viewCount(); ++v) {
    const glm::dvec3 expected(glm::dmat4(turned) * glm::dvec4(0, 0.9, 0.3, 1));
    EXPECT_LT(glm::distance(middle(frame, v), pixelOf(views[v], expected)), 0.5);
  }
}

// At rest a stroke that a mesh carries lies where it was painted, however far out.
TEST(PaintingBindings, giveBackTheirPoints) {
  TestScene s;
  s.add(sphereMesh({0.2f, 0.1f, 0}, 1, 12), -1);
  const Scene scene = s.load();
  scene::Painting painting;
  scene::ImportWarnings warnings;
  std::vector<scene::StrokePoint> points(50);
  for (size_t i = 0; i < points.size(); ++i) {
    const float t = float(i);
    points[i].position = 1.7f * glm::vec3(std::sin(3 * t), std::cos(5 * t), std::sin(7 * t + 1));
    points[i].radius = 0.1f;
  }
  painting.add(scene::Brush::plain, points, "", warnings);
  const scene::Primitive& p = scene.data().meshes[0]->primitives[0];
  const scene::Primitive* const primitives[] = {&p};
  const std::vector<PointBinding> bindings = bindPoints(painting, primitives);
  ASSERT_EQ(bindings.size(), points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    const PointBinding& b = bindings[i];
    const glm::dvec3 corners[] = {p.positions[b.vertices.x], p.positions[b.vertices.y],
                                  p.positions[b.vertices.z]};
    const double weights[] = {1.0 - b.at.x - b.at.y, b.at.x, b.at.y};
    glm::dvec3 foot(0.0), normal(0.0);
    for (int c = 0; c < 3; ++c) {
      foot += weights[c] * corners[c];
      normal += weights[c] * glm::dvec3(p.normals[b.vertices[c]]);
    }
    normal = glm::normalize(normal);
    glm::dvec3 edge = corners[1] - corners[0];
    edge = glm::normalize(edge - normal * glm::dot(normal, edge));
    const glm::dvec3 back = foot + glm::dmat3(edge, glm::cross(normal, edge), normal) * glm::dvec3(b.offset);
    EXPECT_LT(glm::distance(back, glm::dvec3(points[i].position)), 1e-5);
    // No place of the surface is nearer: corners of all triangles, and their middles.
    const double away = glm::distance(foot, glm::dvec3(points[i].position));
    for (size_t t = 0; t < p.indices.size(); t += 3) {
      glm::dvec3 sum(0.0);
      for (size_t c = 0; c < 3; ++c) {
        const glm::dvec3 corner(p.positions[p.indices[t + c]]);
        EXPECT_GE(glm::distance(corner, glm::dvec3(points[i].position)), away - 1e-6);
        sum += corner / 3.0;
      }
      EXPECT_GE(glm::distance(sum, glm::dvec3(points[i].position)), away - 1e-6);
    }
  }
}

// Meshes that carry nothing, or hardly anything: without area, with edges of three triangles, far away from
// their strokes, in one point.
TEST_P(Paintings, oddCarriers) {
  const TestStroke dab{{{-0.2f, 0, 0}, {0.2f, 0, 0}}, 0.15f, {1, 0, 0, 1}};
  TestMesh flat = gridMesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), fan = flat, far = flat, point = flat;
  for (glm::vec3& p : flat.positions) p.x = 0, p.z = 0;
  for (glm::vec3& p : point.positions) p = glm::vec3(0.3f);
  for (glm::vec3& p : far.positions) p += glm::vec3(0, 0, -4e4f);
  fan.positions.push_back({0, 0, -1}), fan.normals.push_back({0, 0, 1}), fan.uvs.push_back({0, 0});
  for (const uint32_t index : {0u, 1u, 4u, 1u, 0u, 4u}) fan.indices.push_back(index);
  for (const TestMesh& mesh : {flat, fan, far, point}) {
    // Beside something to draw, for a mesh without any triangle is left out.
    TestScene s;
    s.add(gridMesh({5, 5, 0}, {1, 0, 0}, {0, 1, 0}), -1);
    s.add(mesh, -1);
    s.paint({dab, {{{0, 0.3f, 0.1f}}, 0.1f, {0, 1, 0, 1}}});
    const std::string text = s.text();
    const Result<Scene> scene = Scene::loadFromMemory(text.data(), text.size(), "odd.gltf", "");
    ASSERT_TRUE(scene) << scene.error().message();
    const auto views = viewsFrom(*scene, {{0, 0, 4}}, kWidth, kHeight, GetParam());
    const Frame frame = drawn(*scene, views);
    for (size_t v = 0; v < viewCount(); ++v) {
      EXPECT_GT(covered(frame, v), 30);
      for (const float value : aov(frame, "painting", v).pixels) EXPECT_TRUE(std::isfinite(value));
    }
  }
}

// A painting paints itself: what was painted later is not there yet.
TEST_P(Paintings, playAsTheyWerePainted) {
  TestScene s;
  s.addStrokes({{{{-1, 0, 0}, {1, 0, 0}}, 0.1f, {1, 0, 0, 1}, "", {0, 2}},
                {{{-1, 0.6f, 0}, {1, 0.6f, 0}}, 0.1f, {0, 0, 1, 1}, "", {4, 5}}});
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 4}}, kWidth, kHeight, GetParam());
  const auto at = [&](double time, const char* speed) {
    return drawn(scene, views, {{"painting.plays", "on"}, {"painting.speed", speed}}, time);
  };
  const Frame whole = drawn(scene, views), none = at(-0.1, "1"), half = at(1, "1"), one = at(3, "1"),
              faster = at(0.5, "2"), all = at(6, "1");
  for (size_t v = 0; v < viewCount(); ++v) {
    EXPECT_EQ(covered(none, v), 0);
    EXPECT_NEAR(covered(half, v) / covered(one, v), 0.5, 0.06);
    EXPECT_EQ(covered(half, v), covered(faster, v));
    EXPECT_NEAR(covered(one, v) / covered(whole, v), 0.5, 0.03);
    EXPECT_EQ(covered(all, v), covered(whole, v));
  }
}

// Painted colours are what they are, until strokes are to take light.
TEST_P(Paintings, takeLight) {
  TestScene s;
  s.light({0, 0, 1});
  s.add(sphereMesh({0, 0, 0}, 1, 32), s.material(TestScene::colored("Ball", {0.5f, 0.5f, 0.5f, 1})));
  std::vector<TestStroke> strokes;
  for (const float side : {1.0f, -1.0f})
    strokes.push_back(
        {{{-0.3f, 0.2f, 1.05f * side}, {0.3f, 0.2f, 1.05f * side}}, 0.2f, {0.5f, 0.5f, 0.5f, 1}});
  s.paint(strokes);
  const Scene scene = s.load();
  for (const float z : {5.0f, -5.0f}) {
    const auto views = viewsFrom(scene, {{0, 0, z}}, kWidth, kHeight, GetParam());
    const Frame plain = drawn(scene, views), lit = drawn(scene, views, {{"painting.light", "1"}});
    for (size_t v = 0; v < viewCount(); ++v) {
      const auto at = [&](const Frame& frame) {
        const glm::dvec2 place = pixelOf(views[v], {0, 0.2, 1.05 * (z > 0 ? 1 : -1)});
        return texel(aov(frame, "painting", v), int(place.x), int(place.y));
      };
      ASSERT_GT(at(plain).w, 0.95);
      EXPECT_NEAR(at(plain).x / at(plain).w, std::sqrt(0.5), 0.01);
      if (z > 0)
        EXPECT_GT(at(lit).x, at(plain).x - 0.1);
      else
        EXPECT_LT(at(lit).x, at(plain).x - 0.1);
    }
  }
}

// On a floor, below strokes in the air: dark where the light meets paint on its way, and lit elsewhere; of
// strokes alone, of such that a mesh carries, and of a node that moves.
TEST_P(Paintings, castShadows) {
  const glm::vec3 toLight = glm::normalize(glm::vec3(0.3f, 1, 0.2f));
  const glm::vec3 from(-0.8f, 0.7f, 0), to(0.6f, 0.9f, 0.3f);
  constexpr float kRadius = 0.15f;
  enum class Kind { alone, bristles, carried, thin, wash, spatter, light, moves };
  for (const Kind kind : {Kind::alone, Kind::bristles, Kind::carried, Kind::thin, Kind::wash, Kind::spatter,
                          Kind::light, Kind::moves}) {
    const char* brush = kind == Kind::bristles  ? "bristles"
                        : kind == Kind::wash    ? "wash"
                        : kind == Kind::spatter ? "spatter"
                        : kind == Kind::light   ? "light"
                                                : "";
    TestScene s;
    s.add(gridMesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 2),
          s.material(TestScene::colored("Floor", {0.5f, 0.5f, 0.5f, 1})));
    s.light(toLight);
    const TestStroke stroke{
        {from, 0.5f * (from + to), to}, kRadius, {0.8f, 0.2f, 0.1f, kind == Kind::thin ? 0.2f : 1.0f}, brush};
    if (kind == Kind::carried) {
      // A sliver in the air, which casts next to nothing by itself.
      s.add(gridMesh({-0.1f, 0.8f, 0}, {0.02f, 0, 0}, {0, 0, -0.02f}, 1),
            s.material(TestScene::colored("Sliver", {0.5f, 0.5f, 0.5f, 1})));
      s.paint({stroke});
    } else {
      s.addStrokes({stroke});
    }
    if (kind == Kind::moves) s.clip("moves", {0, 1}, {{0, 0, 0}, {0.4f, 0, -0.3f}});
    const Scene scene = s.load();
    const auto views = viewsFrom(scene, {{0, 4, 3}}, kWidth, kHeight, GetParam());
    for (const double time : {0.0, 0.999}) {
      Result<Frame> frame =
          renderer().render(scene, paintLook(), time, views, sized(kWidth, kHeight, {"shadow", "position"}));
      ASSERT_TRUE(frame) << frame.error().message();
      const glm::dvec3 moved = kind == Kind::moves ? time * glm::dvec3(0.4, 0, -0.3) : glm::dvec3(0);
      const bool casts =
          kind != Kind::thin && kind != Kind::wash && kind != Kind::spatter && kind != Kind::light;
      for (size_t v = 0; v < viewCount(); ++v) {
        int dark = 0, lit = 0;
        for (int y = 0; y < kHeight; ++y)
          for (int x = 0; x < kWidth; ++x) {
            const glm::dvec3 place(texel(aov(*frame, "position", v), x, y));
            const glm::dvec4 shadow = texel(aov(*frame, "shadow", v), x, y);
            if (shadow.w < 1 || std::abs(place.y) > 1e-3) continue;
            // How far the way to the light passes the stroke, both seen along the light.
            const auto flat = [&](const glm::dvec3& p) {
              return p - glm::dvec3(toLight) * glm::dot(p, glm::dvec3(toLight));
            };
            const glm::dvec3 a = flat(glm::dvec3(from) + moved), b = flat(glm::dvec3(to) + moved),
                             p = flat(place);
            const double t = glm::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
            const double away = glm::distance(p, glm::mix(a, b, t));
            if (casts && away < 0.7 * kRadius) {
              EXPECT_LT(shadow.x, 0.3) << x << ", " << y << ", kind " << int(kind);
              ++dark;
            } else if (!casts || away > 1.4 * kRadius) {
              EXPECT_GT(shadow.x, 0.7) << x << ", " << y << ", kind " << int(kind);
              ++lit;
            }
          }
        EXPECT_GT(lit, 300);
        EXPECT_EQ(dark > 20, casts) << "kind " << int(kind);
      }
    }
  }
}

// What is not painted yet casts none, and what was there before leaves none behind.
TEST_P(Paintings, shadowsComeWithTheirStrokes) {
  TestScene s;
  s.add(gridMesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 2),
        s.material(TestScene::colored("Floor", {0.5f, 0.5f, 0.5f, 1})));
  TestStroke stroke{{{-0.6f, 0.6f, 0}, {0, 0.6f, 0}, {0.6f, 0.6f, 0}}, 0.2f, {0.8f, 0.2f, 0.1f, 1}};
  stroke.times = {5, 6, 7};
  TestStroke early{{{-1.5f, 0.3f, -1.5f}, {-1.4f, 0.3f, -1.5f}}, 0.05f, {0.8f, 0.2f, 0.1f, 1}};
  early.times = {0, 0};
  s.addStrokes({early, stroke});
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 4, 3}}, kWidth, kHeight, GetParam());
  const auto darkAt = [&](double time) {
    Result<Frame> frame = renderer().render(scene, paintLook({{"painting.plays", "on"}}), time, views,
                                            sized(kWidth, kHeight, {"shadow"}));
    EXPECT_TRUE(frame) << frame.error().message();
    int dark = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const glm::dvec4 shadow = texel(aov(*frame, "shadow"), x, y);
        dark += shadow.w == 1 && shadow.x < 0.3;
      }
    return dark;
  };
  const int none = darkAt(1), all = darkAt(9);
  EXPECT_GT(all, none + 50);
  EXPECT_EQ(darkAt(1), none);
}

// Going away from a painting, what it covers shrinks as the square of the distance, and never at once.
TEST_P(Paintings, nothingPops) {
  TestScene s;
  s.addStrokes({swung({-1.2f, 0, 0}, {1.2f, 0.3f, 0.4f}, 0.2f, {0.8f, 0.1f, 0.1f, 1}),
                swung({-0.8f, -0.7f, 0.5f}, {0.9f, 0.8f, -0.5f}, 0.12f, {0.1f, 0.3f, 0.8f, 0.5f}, "wash")});
  const Scene scene = s.load();
  std::vector<double> before;
  for (int step = 0; step < 24; ++step) {
    const float z = 4 * std::pow(1.03f, float(step));
    const auto views = viewsFrom(scene, {{0, 0, z}}, kWidth, kHeight, GetParam());
    const Frame frame = drawn(scene, views);
    std::vector<double> now;
    for (size_t v = 0; v < viewCount(); ++v) now.push_back(covered(frame, v) * double(z) * double(z));
    for (size_t v = 0; v < before.size(); ++v) EXPECT_NEAR(now[v] / before[v], 1, 0.03) << z;
    before = now;
  }
}

// Strokes cost nothing where there are none, and a frame is the same whenever it is drawn.
TEST_P(Paintings, framesArePure) {
  TestScene s;
  s.addStrokes({swung({-1, 0, 0}, {1, 0, 0}, 0.2f, {0.8f, 0.1f, 0.1f, 1}, "bristles")});
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 4}}, kWidth, kHeight, GetParam());
  const Frame first = drawn(scene, views);
  drawn(scene, viewsFrom(scene, {{3, 1, 2}}, kWidth, kHeight, GetParam()));
  expectSame(first, drawn(scene, views));
  const Frame off = drawn(scene, views, {{"painting.shown", "off"}});
  for (size_t v = 0; v < viewCount(); ++v) {
    EXPECT_GT(covered(first, v), 50);
    EXPECT_EQ(covered(off, v), 0);
  }
}

}  // namespace
}  // namespace scumble::painting
