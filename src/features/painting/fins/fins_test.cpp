// Layers of paint: fins fade by how they face the viewer, per fragment; all are in one order; and they are
// seen and nothing else.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/aov.h"
#include "tests/support/render_test.h"

namespace scumble::painting {
namespace {

using namespace test;

constexpr int kAcross = 96, kDown = 72;

Json paintMaterial(const std::string& name, const glm::vec4& linear, const Json& paint) {
  Json json = TestScene::unlit(name, linear);
  json["alphaMode"] = "BLEND", json["doubleSided"] = true;
  json["extras"]["scumble_paint"] = paint;
  return json;
}

class PaintedFins : public BothEyes {
 protected:
  static Frame drawn(const Scene& scene, const std::vector<View>& views,
                     const std::vector<std::string>& aovs = {"painting"}) {
    Result<Frame> frame = renderer().render(scene, quietLook({}), 0, views, sized(kAcross, kDown, aovs));
    if (!frame) throw std::runtime_error(frame.error().message());
    return std::move(frame).value();
  }
};
INSTANTIATE_BOTH_EYES(PaintedFins);

// (FORMULAS 18.) Quads around an axis, whose normals turn from one side of each to the other.
TEST_P(PaintedFins, fadePerFragment) {
  constexpr float kStart = 0.8f, kEnd = 0.3f;
  TestScene s;
  const int material =
      s.material(paintMaterial("Fins", {0.8f, 0.1f, 0.1f, 0.9f}, {{"fadeStart", kStart}, {"fadeEnd", kEnd}}));
  struct Quad {
    glm::vec3 corner, u, v, normals[2];
  };
  std::vector<Quad> quads;
  for (int i = 0; i < 5; ++i) {
    const float a = 0.35f * float(i);
    const auto normal = [&](float turn) { return glm::vec3(std::sin(a + turn), 0, std::cos(a + turn)); };
    Quad quad{{-2 + 0.8f * float(i), -0.6f, 0}, {0.7f, 0, 0}, {0, 1.2f, 0}, {normal(-0.3f), normal(0.3f)}};
    TestMesh mesh = gridMesh(quad.corner, quad.u, quad.v, 1);
    for (size_t v = 0; v < mesh.positions.size(); ++v)
      mesh.normals[v] = quad.normals[mesh.positions[v].x > quad.corner.x + 0.1f];
    s.add(mesh, material);
    quads.push_back(quad);
  }
  const Scene scene = s.load();
  double least = 1, most = 0;
  for (const glm::vec3& eye : {glm::vec3(0, 0, 5), glm::vec3(3, 0.5f, 4), glm::vec3(-2, -1, -4)}) {
    const auto views = viewsFrom(scene, {eye}, kAcross, kDown, GetParam());
    const Frame frame = drawn(scene, views);
    for (size_t v = 0; v < viewCount(); ++v) {
      Difference alpha(0.06);  // a place is not the middle of its pixel
      for (const Quad& quad : quads)
        for (const float s01 : {0.2f, 0.4f, 0.6f, 0.8f})
          for (const float t01 : {0.25f, 0.5f, 0.75f}) {
            const glm::dvec3 place(quad.corner + s01 * quad.u + t01 * quad.v);
            const glm::dvec4 clip =
                glm::dmat4(views[v].eyeToClip) * glm::dmat4(views[v].worldToEye) * glm::dvec4(place, 1);
            const glm::dvec2 pixel = (glm::dvec2(clip) / clip.w + 1.0) * 0.5 * glm::dvec2(kAcross, kDown);
            const auto x = int(pixel.x), y = int(pixel.y);
            if (x < 0 || y < 0 || x >= kAcross || y >= kDown) continue;
            const glm::dvec3 normal = glm::normalize(
                glm::mix(glm::dvec3(quad.normals[0]), glm::dvec3(quad.normals[1]), double(s01)));
            const double faces = std::abs(glm::dot(normal, glm::normalize(glm::dvec3(eye) - place)));
            const double t = glm::clamp((1 - faces - kStart) / double(kEnd - kStart), 0.0, 1.0);
            const double want = 0.9 * t * t * (3 - 2 * t);
            alpha.add(texel(aov(frame, "painting", v), x, y).w, want);
            least = std::min(least, want), most = std::max(most, want);
          }
      EXPECT_LT(alpha.beyondPart(), 0.1) << alpha.text();
      EXPECT_LT(alpha.mean(), 0.012) << alpha.text();
    }
  }
  EXPECT_LT(least, 0.01);
  EXPECT_GT(most, 0.85);
}

// (FORMULAS 19.) Of two objects, sheets alternate in depth.
TEST_P(PaintedFins, allObjectsAreInOneOrder) {
  const glm::vec4 colors[] = {{0.9f, 0.1f, 0.1f, 0.5f}, {0.1f, 0.2f, 0.9f, 0.5f}};
  TestScene s;
  for (int i = 0; i < 2; ++i) {
    TestMesh sheets;
    for (int k = 0; k < 4; ++k) {
      const TestMesh sheet =
          gridMesh({-1, -1, -1 + 0.5f * float(k) + 0.25f * float(i)}, {2, 0, 0}, {0, 2, 0}, 1);
      const auto first = uint32_t(sheets.positions.size());
      sheets.positions.insert(sheets.positions.end(), sheet.positions.begin(), sheet.positions.end());
      sheets.normals.insert(sheets.normals.end(), sheet.normals.begin(), sheet.normals.end());
      sheets.uvs.insert(sheets.uvs.end(), sheet.uvs.begin(), sheet.uvs.end());
      for (const uint32_t index : sheet.indices) sheets.indices.push_back(first + index);
    }
    s.add(sheets, s.material(paintMaterial("Sheets " + std::to_string(i), colors[i], Json::object())));
  }
  const Scene scene = s.load();
  for (const float side : {1.0f, -1.0f}) {
    const auto views = viewsFrom(scene, {{0, 0, 5 * side}}, kAcross, kDown, GetParam());
    const Frame frame = drawn(scene, views);
    glm::dvec4 expected(0);
    for (int k = 0; k < 8; ++k) {
      const glm::dvec4 color(colors[side > 0 ? k % 2 : 1 - k % 2]);
      expected = glm::dvec4(glm::sqrt(glm::dvec3(color)) * color.a, color.a) + expected * (1 - color.a);
    }
    for (size_t v = 0; v < viewCount(); ++v) {
      const glm::dvec4 got = texel(aov(frame, "painting", v), kAcross / 2 + 3, kDown / 2 + 2);
      for (int c = 0; c < 4; ++c) EXPECT_NEAR(got[c], expected[c], 0.02) << c;
    }
  }
}

// A coat is seen from its front alone, wherever a mirror turns that, by perspective and without it.
TEST_P(PaintedFins, coatsAreSeenFromTheirFront) {
  const auto coveredFrom = [&](const glm::vec3& scale, float side, bool isParallel) {
    TestScene s;
    Json coat = paintMaterial("Coat", {0.9f, 0.1f, 0.1f, 1}, Json::object());
    coat["doubleSided"] = false;
    s.add(gridMesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 2), s.material(coat),
          glm::scale(glm::mat4(1.0f), scale));
    const Scene scene = s.load();
    std::vector<View> views = viewsFrom(scene, {{0.4f, 0.3f, 5 * side}}, kAcross, kDown, GetParam());
    for (View& view : views)
      if (isParallel) view.eyeToClip = orthographicProjection(1.6f, float(kAcross) / kDown, 0.1f, 20);
    const Frame frame = drawn(scene, views);
    double least = 1, most = 0;
    for (size_t v = 0; v < viewCount(); ++v) {
      const double there = texel(aov(frame, "painting", v), kAcross / 2, kDown / 2).w;
      least = std::min(least, there), most = std::max(most, there);
    }
    EXPECT_NEAR(least, most, 0.01) << "both eyes see the same";
    return most;
  };
  for (const bool isParallel : {false, true})
    for (const glm::vec3& scale :
         {glm::vec3(1), glm::vec3(-1, 1, 1), glm::vec3(1, -1, 1), glm::vec3(1, 1, -1), glm::vec3(-1, -1, 1),
          glm::vec3(-1, -1, -1), glm::vec3(-0.5f, 2, 1)})
      for (const float side : {1.0f, -1.0f}) {
        // Its normal is +z, which a mirror along that turns.
        const bool isFront = side * scale.z > 0;
        EXPECT_NEAR(coveredFrom(scale, side, isParallel), isFront ? 1 : 0, 0.01)
            << scale.x << ", " << scale.y << ", " << scale.z << " from " << side
            << (isParallel ? ", parallel" : "");
      }
}

// Paint over a ball: hidden behind it, seen before it; it casts shadows, and what else there is of the ball
// stays to the bit.
TEST_P(PaintedFins, areSeenAndCastShadowsAndNothingElse) {
  const auto scene = [&](bool hasPaint) {
    TestScene s;
    s.add(sphereMesh({0, 0, 0}, 1, 24), s.material(TestScene::colored("Ball", {0.5f, 0.6f, 0.2f, 1})));
    s.add(gridMesh({-3, -1, 3}, {6, 0, 0}, {0, 0, -6}, 1),
          s.material(TestScene::colored("Floor", {0.5f, 0.5f, 0.5f, 1})));
    if (hasPaint) {
      s.add(gridMesh({-0.3f, -0.3f, 1.2f}, {0.6f, 0, 0}, {0, 0.6f, 0}, 1),
            s.material(paintMaterial("Before", {0.9f, 0.1f, 0.1f, 1}, Json::object())));
      s.add(gridMesh({-0.6f, -0.6f, -1.2f}, {1.2f, 0, 0}, {0, 1.2f, 0}, 1),
            s.material(paintMaterial("Behind", {0.1f, 0.1f, 0.9f, 1}, Json::object())));
    }
    return s.load();
  };
  const Scene with = scene(true), without = scene(false);
  const auto views = viewsFrom(without, {{0, 0, 6}}, kAcross, kDown, GetParam());
  const std::vector<std::string> facts{"painting", "shadow", "depth", "normal", "id"};
  const Frame painted = drawn(with, views, facts), plain = drawn(without, views, facts);
  for (size_t v = 0; v < viewCount(); ++v) {
    int darker = 0;
    for (int y = 0; y < kDown; ++y)
      for (int x = 0; x < kAcross; ++x) {
        const double below = texel(aov(painted, "shadow", v), x, y).x,
                     bare = texel(aov(plain, "shadow", v), x, y).x;
        EXPECT_LE(below, bare + 0.02) << x << ", " << y;
        darker += below < bare - 0.2;
      }
    EXPECT_GT(darker, 20) << "the shadows of sheets of paint on ball and floor";
    for (const char* fact : {"depth", "normal", "id"})
      EXPECT_EQ(aov(painted, fact, v).pixels, aov(plain, fact, v).pixels) << fact;
    EXPECT_NEAR(texel(aov(painted, "painting", v), kAcross / 2, kDown / 2).w, 1, 0.01);
    double blue = 0;
    for (int y = 0; y < kDown; ++y)
      for (int x = 0; x < kAcross; ++x) {
        const glm::dvec4 paint = texel(aov(painted, "painting", v), x, y);
        blue += std::max(paint.z - paint.x, 0.0);
      }
    EXPECT_EQ(blue, 0);
    EXPECT_GT(texel(painted.layers[0].views[v], kAcross / 2, kDown / 2).x, 0.5);
  }
}

}  // namespace
}  // namespace scumble::painting
