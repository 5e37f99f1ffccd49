// Pattern gradients, warp vectors and inflation on meshes that are turned, stretched, mirrored, sheared,
// instanced, skinned and morphed, against surfaces posed in double precision (tests/support/posed_surface.h).
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "tests/support/animated_scene.h"
#include "tests/support/aov.h"
#include "tests/support/metatexture_reference.h"
#include "tests/support/posed_surface.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"
#include "tests/support/test_device.h"
#include "world/example_textures.h"

namespace scumble::passes {
namespace {

using namespace test;

Json listOf(const glm::mat4& m) {
  Json list = Json::array();
  for (int i = 0; i < 16; ++i) list.push_back(m[i / 4][i % 4]);
  return list;
}

Json quaternion(const glm::vec3& axis, float degrees) {
  const glm::quat q = glm::angleAxis(glm::radians(degrees), glm::normalize(axis));
  return {q.x, q.y, q.z, q.w};
}

// No whole numbers at its seams, so that nothing looks as if it closed on itself; longer along u than along
// v.
TestMesh stretchedUv(TestMesh mesh) {
  for (glm::vec2& uv : mesh.uvs) uv = uv * glm::vec2(1.7f, 0.6f) + glm::vec2(0.13f, 0.21f);
  return mesh;
}

AnimatedMesh still(TestMesh mesh) {
  return {std::move(mesh), 0, {}, {}, {}, {}};
}

// A target that takes every point p to p + change p, with the normals that belong to it.
AnimatedMesh::Target affineTarget(const TestMesh& mesh, const glm::mat3& change) {
  AnimatedMesh::Target target;
  const glm::mat3 turn = glm::inverse(glm::transpose(glm::mat3(1.0f) + change));
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    target.positions.push_back(change * mesh.positions[v]);
    target.normals.push_back(glm::normalize(turn * mesh.normals[v]) - mesh.normals[v]);
  }
  return target;
}

// Boxes that every way to pose a mesh takes to the world by a map that is affine, so that uv on the screen
// have exact derivatives; which are one way round in some and mirrored in others.
AnimatedScene affinePoses() {
  AnimatedScene s;
  const int grey = s.material(TestScene::colored("Grey", {0.5f, 0.5f, 0.5f, 1}));
  Json sheet = TestScene::colored("Sheet", {0.5f, 0.5f, 0.5f, 1});
  sheet["doubleSided"] = true;
  const int bothSides = s.material(sheet);
  const TestMesh box = stretchedUv(boxMesh({-0.5f, -0.3f, -0.6f}, {0.6f, 0.7f, 0.4f}));
  const int shared = s.mesh(still(box), grey);
  s.node({{"name", "Stretched"},
          {"mesh", shared},
          {"translation", {-2.4, 1, 0}},
          {"rotation", quaternion({1, 2, 0.5f}, 50)},
          {"scale", {1.5, 0.5, 0.8}}});
  const int parent = s.node({{"rotation", quaternion({0.2f, 0.3f, 1}, -35)}, {"scale", {0.6, 1.2, 1}}});
  s.node({{"name", "Mirrored"},
          {"mesh", shared},
          {"translation", {-1.7, 0.3, 0}},
          {"rotation", quaternion({0.3f, 1, 0}, 40)},
          {"scale", {-1.2, 0.9, 0.7}}},
         parent);
  glm::mat4 shear =
      glm::translate(glm::mat4(1.0f), {0.9f, 1, 0}) * glm::rotate(glm::mat4(1.0f), 0.6f, glm::vec3(1, 1, 0));
  glm::mat4 slant(1.0f);
  slant[1][0] = 0.6f, slant[2][1] = -0.4f, slant[0][2] = 0.3f;
  s.node({{"name", "Sheared"}, {"mesh", shared}, {"matrix", listOf(shear * slant)}});
  // Every vertex follows three joints by the same shares; in the second skin one of them is mirrored, so that
  // the blend is.
  for (const bool mirrored : {false, true}) {
    AnimatedMesh skinned = still(box);
    skinned.influences = mirrored ? 8 : 4;
    for (size_t v = 0; v < box.positions.size(); ++v)
      for (int k = 0; k < skinned.influences; ++k) {
        constexpr float kShares[] = {0.5f, 0.3f, 0.2f};
        skinned.joints.push_back(uint16_t(k < 3 ? k : 0));
        skinned.weights.push_back(k < 3 ? kShares[k] : 0.0f);
      }
    const float x = mirrored ? 2.6f : -2.4f, y = mirrored ? 1.0f : -1.0f;
    std::vector<int> joints;
    std::vector<glm::mat4> binds;
    for (int k = 0; k < 3; ++k) {
      joints.push_back(s.node({{"translation", {x + 0.1f * float(k), y, 0.1f * float(k)}},
                               {"rotation", quaternion({0.5f * float(k), 1, 0.4f}, 20 + 25 * float(k))},
                               {"scale", {mirrored ? -1.1f : 1.3f, 0.9f, 0.7f + 0.2f * float(k)}}}));
      binds.push_back(
          glm::inverse(glm::scale(glm::translate(glm::mat4(1.0f), {0.1f, 0, 0}), {1.1f, 0.8f, 1})));
    }
    s.node({{"name", mirrored ? "MirroredSkin" : "Skin"},
            {"mesh", s.mesh(skinned, bothSides)},
            {"skin", s.skin(joints, binds)}});
  }
  AnimatedMesh morphed = still(box);
  morphed.targets = {affineTarget(box, {0.4f, 0.1f, 0, 0.3f, -0.3f, 0, 0.2f, 0, 0.1f}),
                     affineTarget(box, {-0.2f, 0, 0.3f, 0, 0.5f, 0, 0, -0.4f, 0})};
  morphed.defaultWeights = {0.7f, 0.5f};
  s.node({{"name", "Morphed"},
          {"mesh", s.mesh(morphed, grey)},
          {"translation", {-0.7, -1, 0}},
          {"rotation", quaternion({0.3f, 1, 0.2f}, -50)},
          {"scale", {0.7, 0.8, -0.9}}});
  const int instanced = s.node({{"name", "Instances"},
                                {"mesh", shared},
                                {"rotation", quaternion({1, 0.4f, 0}, 35)},
                                {"translation", {0, -1, 0}}});
  s.instances(instanced, {{0.9f, 0, 0}, {2.5f, 0.2f, -0.2f}}, {{0.6f, 1.1f, 0.8f}, {0.8f, -0.7f, 1.2f}});
  return s;
}

// Balls and bars whose skins and targets bend them.
AnimatedScene bentPoses() {
  AnimatedScene s;
  Json sheet = TestScene::colored("Sheet", {0.5f, 0.5f, 0.5f, 1});
  sheet["doubleSided"] = true;
  const int material = s.material(sheet);
  for (const int influences : {4, 8}) {
    AnimatedMesh bar = bendingBar(influences);
    bar.shape = stretchedUv(bar.shape);
    std::vector<int> joints;
    std::vector<glm::mat4> binds;
    int parent = s.node({{"translation", {influences == 4 ? -2.2 : 2.2, 0, 0}}});
    float height = 0;
    for (int k = 0; k < influences; ++k) {
      const float y = -1 + 2 * float(k) / float(influences - 1);
      parent = s.node(
          {{"translation", {0, y - height, 0}},
           {"rotation", quaternion({0.3f, 0.4f, influences == 4 ? 1.0f : -1.0f}, 90 / float(influences))},
           {"scale", {k == 1 ? 1.6f : 1.0f, 1, k == 1 ? 0.7f : 1.0f}}},
          parent);
      height = y;
      joints.push_back(parent);
      binds.push_back(glm::translate(glm::mat4(1.0f), {0, -y, 0}));
    }
    s.node({{"mesh", s.mesh(bar, material)}, {"skin", s.skin(joints, binds)}});
  }
  AnimatedMesh ball = still(sphereMesh({0, 0, 0}, 0.7f, 20));
  ball.targets = {swelling(ball.shape, 0.5f, {0, 0.5f, 0.2f}),
                  affineTarget(ball.shape, {0.5f, 0.2f, 0, 0, -0.4f, 0, 0.3f, 0, 0})};
  ball.defaultWeights = {0.6f, 0.8f};
  const int mesh = s.mesh(ball, material);
  s.node({{"mesh", mesh}, {"translation", {-0.6, 0.9, 0}}, {"rotation", quaternion({1, 0.5f, 0}, 60)}});
  s.node({{"mesh", mesh},
          {"translation", {0.6, -0.9, 0}},
          {"rotation", quaternion({1, 0, 0.5f}, -40)},
          {"scale", {-0.7, 1.2, 0.6}}});
  return s;
}

class PosedWarpTest : public BothEyes {
 protected:
  static constexpr int kWidth = 160, kHeight = 120;

  std::vector<View> views(const Scene& scene) const {
    auto views = viewsFrom(scene, {{1.2f, 0.8f, 7}, {0, 0, 0}, 36}, kWidth, kHeight, GetParam());
    for (View& view : views) view.eyeToClip[2][0] = 0.15f, view.eyeToClip[2][1] = -0.1f;
    return views;
  }
  static constexpr auto kStay = [](const SurfaceTriangle&, const SurfaceCorner&) { return glm::dvec2(0.0); };

  // u and v by x and y: what moves pixels by these vectors for a unit of each does not move the other.
  struct Gradients {
    glm::dvec2 u, v;
  };
  static Gradients ofTangents(const glm::dvec2& dSdu, const glm::dvec2& dSdv) {
    const glm::dmat2 back = glm::inverse(glm::dmat2(dSdu, dSdv));
    return {{back[0][0], back[1][0]}, {back[0][1], back[1][1]}};
  }
  // From the tangents of the corners, as they are between them.
  static Gradients smoothAt(const View& view, const SurfaceTriangle& triangle, const ScreenHit& hit) {
    glm::dvec3 point(0.0), u(0.0), v(0.0);
    for (size_t k = 0; k < 3; ++k) {
      point += hit.barycentric[int(k)] * triangle.corners[k].position;
      u += hit.barycentric[int(k)] * triangle.corners[k].dPdu;
      v += hit.barycentric[int(k)] * triangle.corners[k].dPdv;
    }
    return ofTangents(pixelsAlong(view, point, u, kWidth, kHeight),
                      pixelsAlong(view, point, v, kWidth, kHeight));
  }
  static glm::dvec2 uvAt(const SurfaceTriangle& triangle, const glm::dvec3& shares) {
    glm::dvec2 uv(0.0);
    for (size_t k = 0; k < 3; ++k) uv += shares[int(k)] * triangle.corners[k].uv;
    return uv;
  }
  // From uv themselves, which are linear on a triangle.
  static Gradients differencesAt(const View& view, const SurfaceTriangle& triangle, const glm::dvec2& at) {
    const ScreenTriangle seen = onScreen({triangle}, view, kWidth, kHeight, kStay).at(0);
    const auto along = [&](const glm::dvec2& step) {
      return (uvAt(triangle, sharesAt(seen, at + step)) - uvAt(triangle, sharesAt(seen, at - step))) / 2e-4;
    };
    const glm::dvec2 x = along({1e-4, 0}), y = along({0, 1e-4});
    return {{x.x, y.x}, {x.y, y.y}};
  }
  // As a part of what it should be.
  static double off(const glm::dvec2& got, const glm::dvec2& expected) {
    return glm::length(got - expected) / glm::length(expected);
  }

  // Every object is there by more pixels than this.
  static void expectAllSeen(const std::map<int, size_t>& pixels, const std::vector<SurfaceTriangle>& surface,
                            size_t least) {
    for (const SurfaceTriangle& triangle : surface) {
      const auto found = pixels.find(triangle.id);
      ASSERT_TRUE(found != pixels.end() && found->second > least) << "object " << triangle.id;
    }
  }

  // Calls visit(x, y, hit) at each pixel that shows what the reference hits there; few may show something
  // else, and every object has more pixels than `least`.
  template <class Hits, class Visit>
  static void atSamePixels(const Frame& frame, size_t view, const Hits& hits,
                           const std::vector<SurfaceTriangle>& surface, size_t least, Visit visit) {
    std::map<int, size_t> pixels;
    size_t misplaced = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const auto& hit = hits[size_t(y * kWidth + x)];
        const int id = int(texel(aov(frame, "id", view), x, y).x);
        if (id != (hit ? surface[hit->surface].id : 0)) {
          ++misplaced;
          continue;
        }
        if (!hit) continue;
        ++pixels[id];
        visit(x, y, *hit);
      }
    expectAllSeen(pixels, surface, least);
    EXPECT_LT(misplaced, size_t(kWidth * kHeight / 200));
  }

  // `pixelsOf`: the inflation of an object.
  void checkInflation(const Scene& scene, const Knobs& knobs,
                      const std::function<double(int)>& pixelsOf) const;
};
INSTANTIATE_BOTH_EYES(PosedWarpTest);

TEST_P(PosedWarpTest, gradientsAndVectorsOfAffinePoses) {
  NEEDS_FINE_RASTER();
  const Scene scene = affinePoses().load();
  const auto surface = posedSurface(scene.data());
  const auto seen = views(scene);
  constexpr double kAmount = 54, kSize = 1800;  // pixels at 1080 lines; the example is magnified
  const Frame frame = draw(scene,
                           quietLook({{"light.shadowWarp", "0"},
                                      {"warp.amount", "54"},
                                      {"warp.inflation", "0"},
                                      {"warp.metatexture.size", "1800"},
                                      {"warp.metatexture.contrast", "gaussian"},
                                      {"warp.metatexture.cyclopean", "off"}}),
                           seen, sized(kWidth, kHeight, {"uv", "uv-gradient", "id", "warp", "metatexture"}));
  const double scale = kHeight / 1080.0;
  MetaTextureReference reference;
  reference.texture.pixels = builtInExample(0);
  reference.mean = meanOf(reference.texture.pixels);
  reference.size = kSize * scale;
  reference.skew = MetaTextureReference::exact;
  reference.skewLevels = 2;
  for (size_t v = 0; v < seen.size(); ++v) {
    const auto hits = rasterised(onScreen(surface, seen[v], kWidth, kHeight, kStay), kWidth, kHeight);
    size_t turned[2] = {}, shallower = 0;
    Difference uvs(1e-3), gradients(1e-4), exponents(1e-4), vectors(0.05);
    atSamePixels(frame, v, hits, surface, 100, [&](int x, int y, const auto& hit) {
      const SurfaceTriangle& triangle = surface[hit.surface];
      const Gradients g = differencesAt(seen[v], triangle, glm::dvec2(x, y) + 0.5);
      const glm::dvec4 got = texel(aov(frame, "uv-gradient", v), x, y);
      const double turn = g.u.x * g.v.y - g.u.y * g.v.x;
      if (std::abs(turn) < 0.05 * glm::length(g.u) * glm::length(g.v)) return;  // seen from the edge
      const glm::dvec2 uv = uvAt(triangle, hit.barycentric);
      uvs.add(texel(aov(frame, "uv", v), x, y).x, uv.x), uvs.add(texel(aov(frame, "uv", v), x, y).y, uv.y);
      gradients.add(off({got.x, got.y}, g.u), 0), gradients.add(off({got.z, got.w}, g.v), 0);
      // The tangents of the corners say the same.
      const Gradients smooth = smoothAt(seen[v], triangle, hit);
      EXPECT_LT(off(smooth.u, g.u) + off(smooth.v, g.v), 1e-4) << "the references differ";

      const auto shown = reference.at(uv, g.u, g.v);
      const glm::dvec4 chosen = texel(aov(frame, "metatexture", v), x, y);
      exponents.add(chosen.x, shown.exponent.x), exponents.add(chosen.y, shown.exponent.y);
      exponents.add(chosen.z, shown.q);
      // Section 4.3: turned by the gradient of u, by its other way where the mapping shows its back.
      const glm::dvec2 axis = glm::normalize(g.u) * (turn < 0 ? -1.0 : 1.0),
                       free = 2.0 * glm::dvec2(shown.value - reference.mean),
                       w = free * std::min(1.0, 2.0 / glm::length(free)) *
                           std::min(1.0, 1.5 / shown.fineness);  // finer is shallower
      shallower += shown.fineness > 1.5;
      const glm::dvec2 warp(texel(aov(frame, "warp", v), x, y));
      vectors.add(warp.x / (kAmount * scale), axis.x * w.x - axis.y * w.y);
      vectors.add(warp.y / (kAmount * scale), axis.y * w.x + axis.x * w.y);
      ++turned[turn < 0];
    });
    EXPECT_GT(turned[0], 500u) << "mirrored ones";
    EXPECT_GT(turned[1], 500u);
    EXPECT_GT(shallower, 50u);
    // Floats; edges between faces are where rasterisers have them, to 1/256 pixel.
    EXPECT_LT(uvs.beyondPart(), 2e-3) << uvs.text();
    EXPECT_LT(gradients.beyondPart(), 2e-3) << gradients.text();
    EXPECT_LT(exponents.beyondPart(), 2e-3) << exponents.text();
    // Filters count in steps of 1/256, tangents lie in 16 bits.
    EXPECT_LT(vectors.beyondPart(), 2e-3) << vectors.text();
    EXPECT_LT(vectors.mean(), 0.008) << vectors.text();
  }
}

// Where skins and targets bend a mesh, tangents follow vertex by vertex.
TEST_P(PosedWarpTest, gradientsOfBentPoses) {
  NEEDS_FINE_RASTER();
  const Scene scene = bentPoses().load();
  const auto surface = posedSurface(scene.data());
  const auto seen = views(scene);
  const Frame frame = draw(scene, quietLook({{"light.shadowWarp", "0"}, {"warp.inflation", "0"}}), seen,
                           sized(kWidth, kHeight, {"uv-gradient", "id"}));
  for (size_t v = 0; v < seen.size(); ++v) {
    const auto hits = rasterised(onScreen(surface, seen[v], kWidth, kHeight, kStay), kWidth, kHeight);
    Difference gradients(0.01);  // GPUs interpolate the tangents of corners less finely than CPU drivers
    atSamePixels(frame, v, hits, surface, 300, [&](int x, int y, const auto& hit) {
      const Gradients g = smoothAt(seen[v], surface[hit.surface], hit);
      const double turn = g.u.x * g.v.y - g.u.y * g.v.x;
      if (std::abs(turn) < 0.05 * glm::length(g.u) * glm::length(g.v)) return;
      const glm::dvec4 got = texel(aov(frame, "uv-gradient", v), x, y);
      gradients.add(off({got.x, got.y}, g.u), 0), gradients.add(off({got.z, got.w}, g.v), 0);
    });
    EXPECT_GT(gradients.count, 4000u);
    EXPECT_LT(gradients.beyondPart(), 4e-3) << gradients.text();
  }
}

// Each vertex moves along its projected smooth normal by so many pixels, times its _WARP; those that face the
// viewer stay. Coverage and depth of the inflated surface, wherever a tenth of a pixel does not matter.
void PosedWarpTest::checkInflation(const Scene& scene, const Knobs& knobs,
                                   const std::function<double(int)>& pixelsOf) const {
  const auto surface = posedSurface(scene.data());
  const auto seen = views(scene);
  Knobs all{{"light.shadowWarp", "0"}};
  all.insert(all.end(), knobs.begin(), knobs.end());
  const Frame frame = draw(scene, quietLook(all), seen, sized(kWidth, kHeight, {"warp"}));
  for (size_t v = 0; v < seen.size(); ++v) {
    const auto move = [&](const SurfaceTriangle& triangle, const SurfaceCorner& corner) {
      const glm::dvec2 outward = pixelsAlong(seen[v], corner.position, corner.smoothNormal, kWidth, kHeight);
      const double metre =
          0.5 * kHeight * std::abs(seen[v].eyeToClip[1][1]) / depthOf(seen[v], corner.position);
      return pixelsOf(triangle.id) * corner.warpScale * smoothstep(0.05, 0.35, glm::length(outward) / metre) *
             glm::normalize(outward);
    };
    const auto plain = rasterised(onScreen(surface, seen[v], kWidth, kHeight, kStay), kWidth, kHeight);
    const auto inflated = onScreen(surface, seen[v], kWidth, kHeight, move);
    std::vector<std::vector<std::optional<ScreenHit>>> around;
    for (const glm::dvec2& offset : {glm::dvec2(0, 0), {0.1, 0.1}, {-0.1, 0.1}, {0.1, -0.1}, {-0.1, -0.1}})
      around.push_back(rasterised(inflated, kWidth, kHeight, offset));
    std::map<int, size_t> widened;
    size_t covered = 0, wrong = 0, unsure = 0;
    Difference depths(2e-3);  // half floats
    for (size_t i = 0; i < plain.size(); ++i) {
      const double got = texel(aov(frame, "warp", v), int(i) % kWidth, int(i) / kWidth).w;
      size_t hits = 0;
      double nearest = 1e9, farthest = 0;
      for (const auto& one : around)
        if (one[i])
          ++hits, nearest = std::min(nearest, one[i]->depth), farthest = std::max(farthest, one[i]->depth);
      if (hits != 0 && hits != around.size()) {
        ++unsure;
        continue;
      }
      wrong += (got > 0) != (hits > 0);
      covered += hits > 0;
      if (hits > 0 && !plain[i]) ++widened[surface[around[0][i]->surface].id];
      if (hits > 0 && got > 0 && farthest < 1.01 * nearest) depths.add(got / around[0][i]->depth, 1);
    }
    expectAllSeen(widened, surface, 50);
    EXPECT_GT(covered, 4000u);
    EXPECT_LT(unsure, 400u);
    EXPECT_LT(wrong, 3u);
    EXPECT_GT(depths.count, 3500u);
    EXPECT_LT(depths.beyondPart(), 1e-3) << depths.text();
  }
}
TEST_P(PosedWarpTest, inflationOfAffinePoses) {
  checkInflation(affinePoses().load(), {{"warp.inflation", "45"}}, [](int) { return 5.0; });
}
TEST_P(PosedWarpTest, inflationOfBentPoses) {
  checkInflation(bentPoses().load(), {{"warp.inflation", "45"}}, [](int) { return 5.0; });
}

// Percent are of the picture's height, whatever the size of an object, its distance and the picture's width;
// pixels are at 1080 lines.
TEST_P(PosedWarpTest, inflationInPercentOfThePicture) {
  TestScene s;
  const auto named = [&](const char* name) {
    return s.material(TestScene::colored(name, {0.5f, 0.5f, 0.5f, 1}));
  };
  const int percent = named("Percent"), pixels = named("Pixels"), plain = named("Plain");
  s.add(sphereMesh({-1.6f, 1.2f, -1}, 0.9f, 32), percent);
  s.add(sphereMesh({-0.6f, -0.8f, 2}, 0.25f, 24), percent);
  s.add(sphereMesh({1.5f, 1.2f, 0}, 0.4f, 24), pixels);
  TestMesh varied = sphereMesh({0.9f, -0.8f, 0}, 0.6f, 24);
  for (const glm::vec3& p : varied.positions) varied.warpScales.push_back(1 + p.y);
  s.add(varied, plain);
  checkInflation(s.load(),
                 {{"warp.inflation", "3"},
                  {"warp.inflationUnit", "percent"},
                  {"materials.Percent.warp.inflation", "5"},
                  {"materials.Pixels.warp.inflation", "36"},
                  {"materials.Pixels.warp.inflationUnit", "pixels"}},
                 [](int id) {
                   return id <= 2 ? 0.05 * kHeight : id == 3 ? 36.0 * kHeight / 1080 : 0.03 * kHeight;
                 });
}

// (Paper 000, section 6.3: line boil keeps characters alive.) What a skeleton moves has another drawing
// whenever its poses may be others; what none does, of the same material, stays to the bit.
TEST_P(PosedWarpTest, charactersBoilOnTheirOwnSteps) {
  AnimatedScene s;
  const int grey = s.material(TestScene::colored("Grey", {0.5f, 0.5f, 0.5f, 1}));
  AnimatedMesh bar = bendingBar(4);
  bar.shape = stretchedUv(bar.shape);
  std::vector<int> joints;
  for (int k = 0; k < 4; ++k) joints.push_back(s.node({{"translation", {-1, 0, 0}}}));
  const Json skin{{"name", "Sailor"},
                  {"mesh", s.mesh(bar, grey)},
                  {"skin", s.skin(joints, std::vector<glm::mat4>(4, glm::mat4(1.0f)))}};
  s.node(skin);
  s.node({{"name", "Mast"},
          {"mesh", s.mesh(still(stretchedUv(boxMesh({0.6f, -1, -0.3f}, {1.4f, 1, 0.3f}))), grey)}});
  const Scene scene = s.load();
  const std::vector<View> seen = views(scene);
  const auto warpAt = [&](int frame, const Knobs& knobs) {
    Result<Frame> drawn = renderer().render(scene, quietLook(knobs), frame / 24.0, seen,
                                            sized(kWidth, kHeight, {"warp", "id"}));
    EXPECT_TRUE(drawn.ok());
    return std::move(drawn).value();
  };
  // Parts of what is skinned, and of what is not, whose vectors differ.
  const auto changed = [&](const Frame& a, const Frame& b, size_t v) {
    std::map<double, std::pair<double, double>> counts;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        auto& [all, other] = counts[texel(aov(a, "id", v), x, y).x];
        ++all, other += texel(aov(a, "warp", v), x, y) != texel(aov(b, "warp", v), x, y);
      }
    counts.erase(0);
    std::vector<double> parts;
    for (const auto& [id, count] : counts) parts.push_back(count.second / count.first);
    return parts;
  };
  for (const int hold : {1, 2, 3, 4}) {
    const Knobs alive{
        {"warp.amount", "8"}, {"warp.characterBoil", "0.5"}, {"animation.hold", std::to_string(hold)}};
    const Frame first = warpAt(0, alive), last = warpAt(hold - 1, alive), next = warpAt(hold, alive),
                dead = warpAt(hold, {{"warp.amount", "8"}}),
                all = warpAt(2, {{"warp.amount", "8"}, {"warp.boil", "0.5"}});
    for (size_t v = 0; v < viewCount(); ++v) {
      const std::vector<double> within = changed(first, last, v), then = changed(first, next, v),
                                without = changed(first, dead, v), both = changed(first, all, v);
      ASSERT_EQ(then.size(), 2u);
      EXPECT_EQ(within, (std::vector<double>{0, 0})) << hold;
      EXPECT_EQ(without, (std::vector<double>{0, 0})) << hold;
      EXPECT_GT(std::max(then[0], then[1]), 0.9) << hold;
      EXPECT_EQ(std::min(then[0], then[1]), 0) << hold;
      EXPECT_GT(std::min(both[0], both[1]), 0.9) << hold;
    }
  }
}

// Each node boils on steps of its own.
TEST_P(PosedWarpTest, nodesBoilOnTheirOwnSteps) {
  AnimatedScene s;
  const int grey = s.material(TestScene::colored("Grey", {0.5f, 0.5f, 0.5f, 1}));
  const int box = s.mesh(still(stretchedUv(boxMesh({-0.5f, -0.8f, -0.3f}, {0.5f, 0.8f, 0.3f}))), grey);
  const std::pair<const char*, int> nodes[] = {{"Sailor", 2}, {"Curtain", 3}, {"Rock", 0}};
  for (int i = 0; i < 3; ++i)
    s.node({{"name", nodes[i].first}, {"mesh", box}, {"translation", {1.4 * (i - 1), 0, 0}}});
  const Scene scene = s.load();
  const std::vector<View> seen = views(scene);
  const auto at = [&](int frame) {
    const Knobs knobs{{"warp.amount", "8"},
                      {"nodes.Sailor.warp.boil", "0.5"},
                      {"nodes.Sailor.warp.boilHold", "2"},
                      {"nodes.Curtain.warp.boil", "0.5"},
                      {"nodes.Curtain.warp.boilHold", "3"}};
    Result<Frame> drawn = renderer().render(scene, quietLook(knobs), frame / 24.0, seen,
                                            sized(kWidth, kHeight, {"warp", "id"}));
    EXPECT_TRUE(drawn.ok());
    return std::move(drawn).value();
  };
  Frame before = at(0);
  for (int frame = 1; frame <= 6; ++frame) {
    Frame now = at(frame);
    for (size_t v = 0; v < viewCount(); ++v)
      for (int i = 0; i < 3; ++i) {
        size_t others = 0;
        for (int y = -8; y <= 8; ++y) {
          const glm::dvec2 place = pixelOf(seen[v], {1.4 * (i - 1), 0.05 * y, 0.3}, kWidth, kHeight);
          others += texel(aov(before, "warp", v), int(place.x), int(place.y)) !=
                    texel(aov(now, "warp", v), int(place.x), int(place.y));
        }
        const bool jumps = nodes[i].second > 0 && frame % nodes[i].second == 0;
        EXPECT_EQ(others > 8, jumps) << nodes[i].first << ", frame " << frame;
        if (!jumps) {
          EXPECT_EQ(others, 0u) << nodes[i].first << ", frame " << frame;
        }
      }
    before = std::move(now);
  }
}

}  // namespace
}  // namespace scumble::passes
