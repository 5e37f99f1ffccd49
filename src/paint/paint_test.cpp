// Strokes that are made for meshes: on the surface or so far above it, along it, as many as were asked for,
// the same each time; and the file that they come in.
#include "scumble/paint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "paint/direction_field.h"
#include "paint/mesh_strokes.h"
#include "scene/painting.h"
#include "scene/splat_places.h"
#include "tests/support/animated_scene.h"
#include "tests/support/render_test.h"
#include "tests/support/scene_files.h"
#include "tests/support/test_scene.h"

namespace scumble::paint {
namespace {

using namespace test;

class PaintUnderLook : public RenderTest {};

TestScene ball() {
  TestScene s;
  s.add(sphereMesh({0.5f, 0.2f, 0}, 2, 40), s.material(TestScene::colored("Ball", {0.6f, 0.2f, 0.1f, 1})));
  return s;
}

TEST(Paint, strokesOfEveryStyleLieWhereTheyShould) {
  const SceneFiles files(ball().text());
  for (const PaintStyle& style : paintStyles()) {
    PaintOptions options;
    options.style = style.name;
    options.splats = 20000;
    options.height = 0.1f;
    const Result<PaintReport> report = paintScene(files.scene, files.out, options);
    ASSERT_TRUE(report) << report.error().message();
    EXPECT_NEAR(double(report->splats), 20000, 1000) << style.name;
    const Result<Scene> scene = Scene::load(files.out);
    ASSERT_TRUE(scene) << scene.error().message();
    EXPECT_TRUE(scene->warnings().empty());
    ASSERT_EQ(scene->data().meshes.size(), 1u);
    const scene::Mesh& mesh = scene->data().meshes[0];
    ASSERT_TRUE(mesh.painting);
    EXPECT_EQ(mesh.primitives.size(), 1u);
    EXPECT_EQ(mesh.painting->strokes.size(), report->strokes);
    EXPECT_EQ(mesh.painting->points.size(), report->points);
    std::vector<float> along;
    EXPECT_EQ(scene::splatPlaces(*mesh.painting, along).size(), report->splats);
    // The ball's own radius is that of its box, a cube: the height is a part of it.
    const float height = 0.1f * 2 * std::sqrt(3.0f), allowed = 1.6f * height;
    const float stands = style.name == "smoke" || style.name == "grass" || style.name == "fur" ? 2.0f : 0.0f;
    size_t outer = 0;
    for (const scene::StrokePoint& p : mesh.painting->points) {
      const float away = glm::distance(p.position, glm::vec3(0.5f, 0.2f, 0)) - 2;
      EXPECT_GT(away, -0.03f);
      EXPECT_LT(away, allowed + stands) << style.name;
      outer += away > 0.3f * height;
      EXPECT_GT(p.radius, 0);
    }
    EXPECT_GT(outer, mesh.painting->points.size() / 20) << style.name;
    // All over it: every eighth has its part.
    size_t octants[8] = {};
    for (const scene::StrokePoint& p : mesh.painting->points)
      ++octants[(p.position.x > 0.5f) + 2 * (p.position.y > 0.2f) + 4 * (p.position.z > 0)];
    for (const size_t count : octants)
      EXPECT_NEAR(double(count) / double(mesh.painting->points.size()), 0.125, 0.05) << style.name;
  }
}

TEST(Paint, theSameEachTime) {
  const SceneFiles files(ball().text());
  PaintOptions options;
  options.splats = 5000;
  ASSERT_TRUE(paintScene(files.scene, files.out, options));
  const std::string first = contentOf(files.out);
  ASSERT_TRUE(paintScene(files.scene, files.out, options));
  EXPECT_EQ(contentOf(files.out), first);
  options.seed = 1;
  ASSERT_TRUE(paintScene(files.scene, files.out, options));
  EXPECT_NE(contentOf(files.out), first);
}

// On a cylinder strokes follow its axis; by a direction, that.
TEST(Paint, strokesFollowTheForm) {
  TestMesh tube;
  constexpr int kAround = 32, kUp = 24;
  for (int j = 0; j <= kUp; ++j)
    for (int i = 0; i <= kAround; ++i) {
      const float turn = 6.2831853f * float(i) / kAround;
      tube.positions.push_back({std::cos(turn), 4 * float(j) / kUp - 2, std::sin(turn)});
      tube.normals.push_back({std::cos(turn), 0, std::sin(turn)});
      tube.uvs.push_back({float(i) / kAround, float(j) / kUp});
    }
  for (uint32_t j = 0; j < kUp; ++j)
    for (uint32_t i = 0; i < kAround; ++i) {
      const uint32_t a = j * (kAround + 1) + i, b = a + kAround + 1;
      for (const uint32_t index : {a, b, a + 1, a + 1, b, b + 1}) tube.indices.push_back(index);
    }
  TestScene s;
  s.add(tube, -1);
  const Scene scene = s.load();
  const scene::Primitive* const primitives[] = {&scene.data().meshes[0]->primitives[0]};
  const glm::vec3 slanted = glm::normalize(glm::vec3(1, -0.4f, 0.3f));
  const DirectionField curved = alongCurvature(primitives, slanted),
                       directed = alongDirection(primitives, {0.1f, -1, 0});
  for (size_t v = 0; v < primitives[0]->positions.size(); ++v) {
    const glm::vec3& p = primitives[0]->positions[v];
    if (std::abs(p.y) > 1.5f) continue;
    EXPECT_LT(curved[0][v].y, -0.94f) << v;
    EXPECT_LT(directed[0][v].y, -0.94f) << v;
    EXPECT_NEAR(glm::dot(curved[0][v], primitives[0]->normals[v]), 0, 1e-3);
  }
}

// Colours are those of the surface.
TEST(Paint, coloursComeFromTheSurface) {
  TestScene s;
  Image halves{2, 1, {"R", "G", "B", "A"}, {0.8f, 0.1f, 0.1f, 1, 0.1f, 0.1f, 0.8f, 1}};
  Json json = TestScene::colored("Halves", {1, 1, 1, 1});
  json["pbrMetallicRoughness"]["baseColorTexture"]["index"] = s.texture(halves);
  s.add(gridMesh({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, 4), s.material(json));
  const SceneFiles files(s.text());
  PaintOptions options;
  options.splats = 5000;
  options.variation = 0;
  ASSERT_TRUE(paintScene(files.scene, files.out, options));
  const Result<Scene> scene = Scene::load(files.out);
  ASSERT_TRUE(scene);
  const scene::Painting& painting = *scene->data().meshes[0]->painting;
  for (const scene::Stroke& stroke : painting.strokes) {
    const scene::StrokePoint& first = painting.points[stroke.firstPoint];
    if (std::abs(first.position.x) < 0.4f) continue;
    EXPECT_EQ(first.color.r > first.color.b, first.position.x < 0);
  }
}

// Under a look they are those of its picture: light on one side, shadow on the other.
TEST_F(PaintUnderLook, coloursComeFromThePicture) {
  TestScene s = ball();
  s.light({1, 0, 0});
  const SceneFiles files(s.text());
  PaintOptions options;
  options.splats = 5000;
  options.variation = 0;
  const Look look = quietLook();
  options.renderer = &renderer(), options.look = &look;
  ASSERT_TRUE(paintScene(files.scene, files.out, options));
  const Result<Scene> scene = Scene::load(files.out);
  ASSERT_TRUE(scene);
  const scene::Painting& painting = *scene->data().meshes[0]->painting;
  double lit = 0, shadowed = 0;
  size_t litCount = 0, shadowedCount = 0;
  for (const scene::Stroke& stroke : painting.strokes) {
    const scene::StrokePoint& first = painting.points[stroke.firstPoint];
    const float side = first.position.x - 0.5f;
    if (side > 1) lit += first.color.r, ++litCount;
    if (side < -1) shadowed += first.color.r, ++shadowedCount;
  }
  ASSERT_GT(litCount, 10u);
  ASSERT_GT(shadowedCount, 10u);
  EXPECT_GT(lit / double(litCount), 1.25 * shadowed / double(shadowedCount));
}

// Joints, morph targets, clips and what else a file has stay, painted twice, too; and every mesh whose node
// is meant is painted, no other.
TEST(Paint, whatElseAFileHasStays) {
  AnimatedScene troupe = test::troupe();
  const Scene before = troupe.load();
  const SceneFiles files(troupe.text());
  PaintOptions options;
  options.splats = 4000;
  ASSERT_TRUE(paintScene(files.scene, files.out, options));
  const std::string again = files.folder.file("again.glb");
  options.style = "fur";
  const Result<PaintReport> second = paintScene(files.out, again, options);
  ASSERT_TRUE(second) << second.error().message();
  const Result<Scene> once = Scene::load(files.out), twice = Scene::load(again);
  ASSERT_TRUE(once && twice);
  const scene::SceneData &was = before.data(), &is = twice->data();
  EXPECT_TRUE(twice->warnings().empty());
  ASSERT_EQ(is.meshes.size(), was.meshes.size());
  EXPECT_EQ(is.clips.size(), was.clips.size());
  EXPECT_EQ(is.skins.size(), was.skins.size());
  EXPECT_EQ(is.nodes.size(), was.nodes.size());
  size_t strokes = 0;
  for (size_t m = 0; m < is.meshes.size(); ++m) {
    ASSERT_EQ(is.meshes[m]->primitives.size(), was.meshes[m]->primitives.size());
    EXPECT_EQ(is.meshes[m]->morphWeights, was.meshes[m]->morphWeights);
    for (size_t p = 0; p < is.meshes[m]->primitives.size(); ++p) {
      EXPECT_EQ(is.meshes[m]->primitives[p].positions, was.meshes[m]->primitives[p].positions);
      EXPECT_EQ(is.meshes[m]->primitives[p].joints, was.meshes[m]->primitives[p].joints);
      EXPECT_EQ(is.meshes[m]->primitives[p].weights, was.meshes[m]->primitives[p].weights);
    }
    ASSERT_TRUE(is.meshes[m]->painting);
    strokes += is.meshes[m]->painting->strokes.size();
    EXPECT_GT(is.meshes[m]->painting->strokes.size(), once->data().meshes[m]->painting->strokes.size());
  }
  EXPECT_EQ(strokes, once->summary().strokes + second->strokes);
}

TEST(Paint, onlyNodesThatAreMeant) {
  TestScene s = ball();
  s.add(boxMesh({4, 0, 0}, {5, 1, 1}), -1);
  s.json()["nodes"][0]["name"] = "Ball", s.json()["nodes"][1]["name"] = "Box";
  const SceneFiles files(s.text());
  PaintOptions options;
  options.splats = 1000;
  options.nodes = "B?x";
  const Result<PaintReport> report = paintScene(files.scene, files.out, options);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->meshes, 1u);
  const Result<Scene> scene = Scene::load(files.out);
  ASSERT_TRUE(scene);
  EXPECT_FALSE(scene->data().meshes[0]->painting);
  EXPECT_TRUE(scene->data().meshes[1]->painting);
}

TEST(Paint, whatCannotBeIsSaid) {
  const SceneFiles files(ball().text());
  const auto kindOf = [&](const std::function<void(PaintOptions&)>& change, const std::string& scene) {
    PaintOptions options;
    options.splats = 100;
    change(options);
    const Result<PaintReport> report = paintScene(scene, files.out, options);
    EXPECT_FALSE(report);
    return report ? ErrorKind::internal : report.error().kind;
  };
  EXPECT_EQ(kindOf([](PaintOptions& o) { o.style = "coverag"; }, files.scene), ErrorKind::usage);
  EXPECT_EQ(kindOf([](PaintOptions& o) { o.splats = 0; }, files.scene), ErrorKind::usage);
  EXPECT_EQ(kindOf([](PaintOptions& o) { o.size = 2; }, files.scene), ErrorKind::usage);
  EXPECT_EQ(kindOf([](PaintOptions& o) { o.direction = {0, 0, 0}; }, files.scene), ErrorKind::usage);
  EXPECT_EQ(kindOf([](PaintOptions& o) { o.nodes = "Nobody"; }, files.scene), ErrorKind::usage);
  EXPECT_EQ(kindOf([](PaintOptions&) {}, files.scene + "x"), ErrorKind::unusableFile);
  EXPECT_FALSE(std::filesystem::exists(files.out));
  // A mesh without area has no place for strokes.
  TestScene flat;
  flat.add(gridMesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), -1);
  TestScene strokesAlone;
  strokesAlone.addStrokes({{{{0, 0, 0}, {1, 0, 0}}}});
  const SceneFiles alone(strokesAlone.text());
  EXPECT_EQ(kindOf([](PaintOptions&) {}, alone.scene), ErrorKind::unusableFile);
}

}  // namespace
}  // namespace scumble::paint
