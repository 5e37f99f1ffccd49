// Levels of detail: which are chosen, against what the CPU finds of the same boxes, and that pictures look as
// they do with all triangles, near and far and on the way.
// (passes/cull, scene/levels.h)

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "film/compare.h"
#include "scene/scene_data.h"
#include "stage/light.h"
#include "tests/support/aov.h"
#include "tests/support/draw_list_spy.h"
#include "tests/support/render_test.h"
#include "tests/support/sanitized.h"
#include "tests/support/test_device.h"

namespace scumble {
namespace {

using namespace test;

class Levels : public BothEyes {
 protected:
  static constexpr uint32_t kWidth = 192, kHeight = 120;

  // Spheres of 8064 triangles each, of all sizes, some with a texture, and one that bends.
  static Scene denseSpheres() {
    TestScene s;
    const int red = s.material(TestScene::colored("Red", {0.6f, 0.15f, 0.1f, 1})),
              blue = s.material(TestScene::colored("Blue", {0.1f, 0.25f, 0.5f, 1})),
              sand = s.material(textured(s));
    const TestMesh sphere = sphereMesh({0, 0, 0}, 1, 64);
    const auto at = [](const glm::vec3& place, const glm::vec3& size) {
      return glm::scale(glm::translate(glm::mat4(1.0f), place), size);
    };
    s.add(sphere, red, at({-1.5f, 1, 0}, glm::vec3(1)));
    s.add(sphere, blue, at({1.2f, 0.5f, 1}, {-0.5f, 0.5f, 0.3f}));
    s.add(sphere, sand, at({0.3f, 0.2f, 2}, glm::vec3(0.2f)));
    s.add(sphere, sand, at({2.5f, 1.6f, -2}, {1.2f, 1.6f, 0.8f}));
    TestMesh bent = sphereMesh({0, 0.4f, 0}, 0.4f, 48);
    bent.joints.assign(bent.positions.size(), {0, 0, 0, 0});
    bent.weights.assign(bent.positions.size(), {1, 0, 0, 0});
    s.addSkinned(bent, red, {glm::translate(glm::mat4(1.0f), {0, 0, 1.5f})}, {glm::mat4(1.0f)});
    s.add(gridMesh({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}, 40), blue);
    return s.load();
  }

  static Json textured(TestScene& s) {
    Image image{8, 8, {"R", "G", "B", "A"}, {}};
    for (int i = 0; i < 64; ++i)
      image.pixels.insert(image.pixels.end(), {0.6f, 0.5f, i % 9 < 4 ? 0.35f : 0.3f, 1});
    Json sand = TestScene::colored("Sand", {1, 1, 1, 1});
    sand["pbrMetallicRoughness"]["baseColorTexture"]["index"] = s.texture(image);
    return sand;
  }

  static std::vector<View> from(const Scene& scene, float distance) {
    const glm::vec3 target(0, 0.8f, 0);
    return viewsFrom(scene, {target + distance * glm::normalize(glm::vec3(0.5f, 0.5f, 1)), target}, kWidth,
                     kHeight, GetParam());
  }
  // All that is seen moves to the right, by so many pixels.
  static std::vector<View> movedBy(std::vector<View> views, float pixels) {
    for (View& view : views) {
      const glm::vec3 offset(2 * pixels / float(kWidth), 0, 0);
      view.eyeToClip = glm::translate(glm::mat4(1.0f), offset) * view.eyeToClip;
    }
    return views;
  }
  static Look withError(const std::string& error) { return quietLook({{"levels.error", error}}); }
  // With all that a picture usually has.
  static Look painted(const std::string& error) {
    Look look;
    EXPECT_TRUE(look.set("levels.error", error).ok());
    return look;
  }

  static uint64_t triangles(const std::vector<shared::DrawCommand>& commands) {
    uint64_t sum = 0;
    for (const shared::DrawCommand& command : commands) sum += command.instanceCount * command.indexCount / 3;
    return sum;
  }

  // The picture and all that it is made of.
  static film::Difference difference(const Frame& a, const Frame& b) {
    film::Difference most;
    for (size_t v = 0; v < viewCount(); ++v) {
      const film::Difference d = film::comparePictures(aov(a, "", v), aov(b, "", v));
      most = {std::max(most.mean, d.mean), std::max(most.tile, d.tile), std::max(most.max, d.max)};
    }
    return most;
  }
};
INSTANTIATE_BOTH_EYES(Levels);

// What a level may be off, in pixels of any eye: in double precision, from the corners of the box.
TEST_P(Levels, haveTheFewestTrianglesThatMayBe) {
  RendererWithSpy renderer;
  const Scene scene = denseSpheres();
  std::map<uint32_t, const scene::Primitive*> byFirstIndex;
  size_t coarse = 0, casting = 0;
  uint64_t surface = 0, torn = 0;  // indices
  for (const double error : {0.5, 3.0})
    for (const float distance : {2.5f, 8.0f, 30.0f}) {
      renderer.draw(scene, withError(std::to_string(error)), from(scene, distance), sized(kWidth, kHeight));
      const SeenList& list = renderer.list();
      ASSERT_EQ(list.draws.size(), 6u);
      // The middle of both eyes, as near as the nearest may be.
      double rig = 0;
      for (size_t v = 0; v < viewCount(); ++v)
        rig = std::max(rig, double(glm::distance(list.uniforms.views[v].eye, list.uniforms.viewer)));
      const auto perMetre = [&](const scene::Bounds& box, const glm::mat4& worldToClip, double closer) {
        const glm::dmat4 rows = glm::transpose(glm::dmat4(worldToClip));
        double nearest = 1e30;
        for (int c = 0; c < 8; ++c)
          nearest = std::min(nearest, glm::dot(rows[3], glm::dvec4(box.corner(c), 1)));
        nearest -= closer * glm::length(glm::dvec3(rows[3]));
        // The most that a metre takes anywhere in the picture: |row 0 - x row 3| at the edges.
        double scale = 0;
        for (const double edge : {-1.0, 1.0})
          scale = std::max({scale, glm::length(glm::dvec3(rows[0] - edge * rows[3])) * 0.5 * kWidth,
                            glm::length(glm::dvec3(rows[1] - edge * rows[3])) * 0.5 * kHeight});
        return nearest > 0 ? scale / nearest : 1e30;
      };
      for (const frame::Draw& draw : list.draws) {
        const scene::Bounds& box = list.bounds[draw.object];
        double pixels = perMetre(box, list.uniforms.worldToCyclopean, rig);
        for (size_t v = 0; v < viewCount(); ++v)
          pixels = std::max(pixels, perMetre(box, list.uniforms.views[v].worldToClip, 0));
        // Of the same mesh, by how many triangles it has.
        const scene::Primitive* primitive = nullptr;
        for (const auto& mesh : scene.data().meshes)
          for (const scene::Primitive& p : static_cast<const scene::Mesh&>(mesh).primitives)
            if (p.indexCount() == draw.indexCount) primitive = &p;
        ASSERT_TRUE(primitive);
        ASSERT_EQ(primitive->levels.size(), draw.levels);
        const auto command = std::find_if(
            list.commands.begin(), list.commands.end(),
            [&](const shared::DrawCommand& c) { return c.firstInstance == draw.object && c.instanceCount; });
        if (command == list.commands.end()) continue;
        const bool hasTexture = scene.data().materials[draw.state.material].baseColorTexture.image >= 0;
        // What tears edges may be off by twice as much.
        for (const bool isTorn : {false, true}) {
          uint32_t count = draw.indexCount, first = draw.firstIndex;
          bool isClose = false;
          const double most = isTorn ? 2 * error : error;
          for (const scene::DetailLevel& level : primitive->levels) {
            const double own = hasTexture ? std::max(level.error, level.textureError) : level.error;
            const double off = own * double(list.scales[draw.object]) * pixels;
            isClose |= std::abs(off / most - 1) < 1e-3;
            if (off < most)
              count = level.indexCount, first = draw.firstIndex + draw.indexCount + level.firstIndex;
          }
          if (isClose) continue;
          const shared::DrawCommand& chosen =
              isTorn ? list.torn[size_t(command - list.commands.begin())] : *command;
          EXPECT_EQ(chosen.indexCount, count) << error << " px at " << distance << " m, torn " << isTorn;
          EXPECT_EQ(chosen.firstIndex, first);
          EXPECT_EQ(chosen.firstInstance, draw.object);
          coarse += !isTorn && count < draw.indexCount;
          (isTorn ? torn : surface) += count;
        }
      }
      for (size_t i = 0; i < list.casters.size(); ++i) {
        EXPECT_EQ(list.casters[i].instanceCount, 1u);
        casting += list.casters[i].indexCount < list.draws[0].indexCount;
      }
    }
  EXPECT_GE(coarse, 10u);
  EXPECT_LT(torn, surface);
  EXPECT_GE(casting, 1u);
  EXPECT_EQ(renderer.validationMessages(), 0);
}

// Coarser ones cast shadows where a texel is larger than what they are off: nowhere by more than a texel.
TEST_P(Levels, shadowsAreOffByLessThanATexel) {
  RendererWithSpy renderer;
  const Scene scene = denseSpheres();
  for (const std::string warp : {"0", "4"}) {
    Look look = quietLook({{"levels.error", "0.5"}, {"light.shadowWarp", warp}});
    renderer.draw(scene, look, from(scene, 8), sized(kWidth, kHeight));
    const SeenList& list = renderer.list();
    const uint64_t few = triangles(list.casters);
    // A metre takes at least so many texels, wherever it lies.
    const glm::dmat4 rows = glm::transpose(glm::dmat4(list.uniforms.worldToLight));
    const double texels = 0.5 * frame::kShadowMapSize *
                          std::max(glm::length(glm::dvec3(rows[0])), glm::length(glm::dvec3(rows[1])));
    for (const shared::DrawCommand& caster : list.casters)
      for (const frame::Draw& draw : list.draws) {
        if (draw.object != caster.firstInstance || caster.indexCount == draw.indexCount) continue;
        for (const auto& mesh : scene.data().meshes)
          for (const scene::Primitive& p : static_cast<const scene::Mesh&>(mesh).primitives)
            for (const scene::DetailLevel& level : p.levels)
              if (p.indexCount() == draw.indexCount && level.indexCount == caster.indexCount) {
                if (warp == "0") {
                  EXPECT_LT(level.shadowError * list.scales[draw.object] * texels, 0.5);
                }
                EXPECT_LE(level.longestEdge * list.scales[draw.object], list.longestCasterEdge);
              }
      }
    look = quietLook({{"levels.error", "0"}, {"light.shadowWarp", warp}});
    renderer.draw(scene, look, from(scene, 8), sized(kWidth, kHeight));
    // A warped map bends long edges: what has them keeps all.
    if (warp == "0") {
      EXPECT_LT(few, triangles(renderer.list().casters));
    }
  }
}

TEST_P(Levels, zeroDrawsAllTriangles) {
  RendererWithSpy renderer;
  const Scene scene = denseSpheres();
  renderer.draw(scene, withError("0"), from(scene, 60), sized(kWidth, kHeight));
  uint64_t all = 0;
  for (const frame::Draw& draw : renderer.list().draws) all += draw.indexCount / 3;
  EXPECT_EQ(triangles(renderer.list().commands), all);
  EXPECT_EQ(triangles(renderer.list().casters), all);
  renderer.draw(scene, withError("0.5"), from(scene, 60), sized(kWidth, kHeight));
  EXPECT_LT(triangles(renderer.list().commands), all / 3);
}

// One choice for a frame, however many samples it takes.
TEST_P(Levels, samplesDoNotChoose) {
  RendererWithSpy renderer;
  const Scene scene = denseSpheres();
  std::vector<uint64_t> counts;
  for (const uint32_t samples : {1u, 4u}) {
    renderer.draw(scene, withError("0.5"), from(scene, 9), sized(kWidth, kHeight, {}, samples));
    counts.push_back(triangles(renderer.list().commands));
    EXPECT_EQ(counts.back(), counts.front());
  }
}

// Seen from anywhere, a picture looks as it does with all triangles.
TEST_P(Levels, picturesLookTheSame) {
  NOT_WITH_SANITIZERS();
  const Scene scene = denseSpheres();
  for (const float distance : {4.0f, 9.0f, 25.0f}) {
    const auto views = from(scene, distance);
    const auto drawn = [&](const std::string& error) {
      return draw(scene, painted(error), views, sized(kWidth, kHeight, {}, 4));
    };
    const Frame whole = drawn("0");
    const film::Difference usual = difference(drawn("0.5"), whole), far = difference(drawn("16"), whole);
    // Edges that are lost spread what differs at them.
    EXPECT_LT(usual.mean, 0.0055) << distance;
    EXPECT_LT(usual.tile, 0.1) << distance;
    EXPECT_GT(far.mean, 0.005) << "the measure sees it where it is too much";
  }
}

// A dolly: where levels change, a frame differs by hardly more from the one before it, as it would be seen
// from where the camera is now, than with all triangles.
TEST_P(Levels, nothingPopsOnTheWay) {
  NOT_WITH_SANITIZERS();
  NEEDS_FINE_RASTER();
  const Scene scene = denseSpheres();
  RendererWithSpy renderer;
  int changes = 0;
  Frame before;
  uint64_t countBefore = 0;
  for (int i = 0; i < 32; ++i) {
    const auto views = from(scene, 7 * std::pow(1.1f, float(i)));
    const auto drawn = [&](const std::string& error) {
      return renderer.draw(scene, painted(error), views, sized(kWidth, kHeight));
    };
    Frame frame = drawn("0.5");
    const uint64_t count = triangles(renderer.list().commands);
    const Frame whole = drawn("0");
    // Two neighbours that are each so near to what is not simplified are twice as near to each other. Three
    // tenths of what half a pixel makes that all moves by, and nowhere as much as that.
    const Frame aside = renderer.draw(scene, painted("0"), movedBy(views, 0.5f), sized(kWidth, kHeight));
    const film::Difference off = difference(frame, whole), half = difference(aside, whole);
    EXPECT_LT(off.mean, 0.3 * half.mean) << i;
    EXPECT_LT(off.tile, half.tile) << i;
    if (i > 0) {
      const film::Difference moved = difference(whole, before);
      changes += count != countBefore;
      EXPECT_LT(off.mean, 0.1 * moved.mean) << "beside what moves, " << i;
    }
    before = whole, countBefore = count;
  }
  EXPECT_GE(changes, 3);
}

}  // namespace
}  // namespace scumble
