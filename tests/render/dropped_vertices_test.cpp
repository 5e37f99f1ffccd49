// Scenes whose vertices are on the device alone (SceneOptions::keepsVertices): the same pictures, and an
// answer where the vertices would be needed.
#include "scene/scene_data.h"
#include "scumble/scene_editor.h"
#include "tests/support/render_test.h"
#include "tests/support/test_device.h"

namespace scumble {
namespace {

using namespace test;

class DroppedVertices : public BothEyes {
 protected:
  static constexpr uint32_t kWidth = 64, kHeight = 48;

  // Plain, coloured, blended, instanced, skinned and moving things.
  static TestScene everything() {
    TestScene s;
    const int plain = s.material(TestScene::colored("Plain", {0.7f, 0.5f, 0.3f, 1}));
    Json glass = TestScene::colored("Glass", {0.2f, 0.5f, 0.8f, 0.5f});
    glass["alphaMode"] = "BLEND";
    const int blended = s.material(glass);
    TestMesh colored;
    append(colored, sphereMesh({-1, 0, 0}, 0.5f, 12), {0.9f, 0.2f, 0.1f, 1});
    colored.warpScales.assign(colored.positions.size(), 0.5f);
    s.add(colored, plain);
    s.add(sphereMesh({0.8f, 0.2f, 0.6f}, 0.4f, 12), blended);
    s.addInstances(boxMesh({-0.2f, -0.2f, -0.2f}, {0.2f, 0.2f, 0.2f}), plain,
                   {{0, 0.8f, 0}, {0.5f, -0.6f, 0}}, {glm::quat(1, 0, 0, 0), glm::quat(1, 0, 0, 0)},
                   {{1, 1, 1}, {1, 2, 1}});
    TestMesh bar = boxMesh({-0.1f, -0.5f, -0.1f}, {0.1f, 0.5f, 0.1f});
    bar.joints.assign(bar.positions.size(), {0, 1, 0, 0});
    bar.weights.assign(bar.positions.size(), {0.5f, 0.5f, 0, 0});
    const glm::mat4 one(1.0f);
    s.addSkinned(bar, plain, {one, one}, {one, one});
    s.add(boxMesh({-0.3f, -0.3f, -1.3f}, {0.3f, 0.3f, -0.7f}), plain);
    s.clip("Go", {0, 1}, {{0, 0, 0}, {0.5f, 0.3f, 0}});
    return s;
  }
  static Scene load(const TestScene& test, bool keepsVertices) {
    SceneOptions options;
    options.keepsVertices = keepsVertices;
    const std::string text = test.text();
    Result<Scene> scene = Scene::loadFromMemory(text.data(), text.size(), "test.gltf", "", options);
    EXPECT_TRUE(scene);
    return std::move(scene).value();
  }
  static std::vector<View> views(const Scene& scene) {
    return viewsFrom(scene, {{0.5f, 0.8f, 4}}, kWidth, kHeight, GetParam());
  }
  static RenderOptions options() { return sized(kWidth, kHeight, Renderer::aovNames()); }
  static Look animated() {
    Result<Look> look = Look::fromJson(R"({"light": {"shadowWarp": {"keys": [[0, 0], [1, 2]]}}})", "a.json");
    EXPECT_TRUE(look);
    return std::move(look).value();
  }
  static Frame frameAt(const Scene& scene, const Look& look, double time, const RenderOptions& options) {
    return renderer().render(scene, look, time, views(scene), options).value();
  }
  static Result<Frame> tryToDraw(Renderer& with, const Scene& scene, const Look& look = {}) {
    return with.render(scene, look, 0, views(scene), options());
  }
  // How many primitives hold memory for vertices, of those that need not.
  static int holding(const Scene& scene) {
    int count = 0;
    for (const scene::Mesh& mesh : scene.data().meshes)
      for (const scene::Primitive& p : mesh.primitives)
        count +=
            p.influences == 0 && (p.positions.capacity() > 0 || p.normals.capacity() > 0 ||
                                  p.smoothNormals.capacity() > 0 || p.uv0.capacity() > 0 ||
                                  p.dPdu.capacity() > 0 || p.dPdv.capacity() > 0 || p.indices.capacity() > 0);
    return count;
  }
  static void expectRefused(const Result<Frame>& frame) {
    ASSERT_FALSE(frame);
    EXPECT_EQ(frame.error().kind, ErrorKind::usage);
    EXPECT_NE(frame.error().problem.find("vertices have been dropped"), std::string::npos)
        << frame.error().problem;
  }
};
INSTANTIATE_BOTH_EYES(DroppedVertices);

TEST_P(DroppedVertices, changeNoPicture) {
  const TestScene test = everything();
  const Scene kept = load(test, true), dropped = load(test, false);
  EXPECT_EQ(holding(dropped), holding(kept));
  Look other;
  ASSERT_TRUE(other.set("shadow.threshold", "0.3"));
  RenderOptions options = DroppedVertices::options();
  for (const Look& look : {Look(), other})
    for (const double time : {0.0, 0.4, 0.9}) {
      options.previousTime = time - 0.04;
      expectSame(frameAt(dropped, look, time, options), frameAt(kept, look, time, options),
                 "at " + std::to_string(time));
      EXPECT_EQ(holding(dropped), 0);
    }
  EXPECT_EQ(holding(kept), 4);
  // What it was is still told.
  const SceneSummary is = dropped.summary(), was = kept.summary();
  EXPECT_EQ(is.triangles, was.triangles);
  EXPECT_EQ(is.vertices, was.vertices);
}

TEST_P(DroppedVertices, areMissedWhereTheyAreNeeded) {
  const Scene scene = load(everything(), false);
  ASSERT_TRUE(tryToDraw(renderer(), scene));
  expectRefused(tryToDraw(otherRenderer(), scene));
  Look warped;
  ASSERT_TRUE(warped.set("light.shadowWarp", "2"));
  expectRefused(tryToDraw(renderer(), scene, warped));
  SceneEditor editor(scene);
  const Result<Scene> edited = editor.scene();
  ASSERT_TRUE(edited);
  expectRefused(tryToDraw(renderer(), *edited));
  expectRefused(tryToDraw(renderer(), Scene::combine({scene, load(everything(), true)})));
  // Nothing has become worse by that.
  EXPECT_TRUE(tryToDraw(renderer(), scene));
}

// A mesh of which a part follows joints and another does not tells where it is by both.
TEST_P(DroppedVertices, ofAPartOfASkinnedMeshAreNotMissed) {
  TestScene test = everything();
  Json& meshes = test.json()["meshes"];
  for (Json& mesh : meshes)
    if (mesh["primitives"][0]["attributes"].contains("JOINTS_0"))
      mesh["primitives"].push_back(meshes[0]["primitives"][0]);
  const Scene scene = load(test, false);
  SceneEditor editor(scene);
  ASSERT_TRUE(tryToDraw(renderer(), scene));
  Result<Scene> placed = Scene::place({{scene}, {load(test, true)}});
  ASSERT_TRUE(placed);
  expectRefused(tryToDraw(renderer(), *placed));
  const auto node = editor.addNode({.name = "More"});
  ASSERT_TRUE(node);
  const Result<Scene> edited = editor.scene();
  ASSERT_TRUE(edited);
  EXPECT_EQ(edited->data().bounds.min, scene.data().bounds.min);
  EXPECT_EQ(edited->data().bounds.max, scene.data().bounds.max);
  expectRefused(tryToDraw(renderer(), *edited));
}

// What a renderer adds by itself, it may need again: nothing else of these scenes has been dropped.
TEST_P(DroppedVertices, areNeverThoseOfTheGround) {
  TestScene test;
  TestMesh bar = boxMesh({-0.1f, -0.5f, -0.1f}, {0.1f, 0.5f, 0.1f});
  bar.joints.assign(bar.positions.size(), {0, 0, 0, 0});
  bar.weights.assign(bar.positions.size(), {1, 0, 0, 0});
  test.addSkinned(bar, test.material(TestScene::colored("Bar", {0.5f, 0.5f, 0.5f, 1})), {glm::mat4(1.0f)},
                  {glm::mat4(1.0f)});
  const Scene scene = load(test, false), kept = load(test, true);
  // With a sea, all vertices are written anew.
  for (const Knobs& sea : {Knobs(), thoseThere({{"ocean.mode", "on"}}), Knobs()}) {
    Look look;
    ASSERT_TRUE(look.set("ground.mode", "on"));
    for (const auto& [path, value] : sea) ASSERT_TRUE(look.set(path, value));
    expectSame(frameAt(scene, look, 0, options()), frameAt(kept, look, 0, options()));
  }
}

// Memory for scenes that might be drawn again is no reason to lose one that could not.
TEST_P(DroppedVertices, areNotTakenOffTheDeviceBeforeTheirScene) {
  RendererOptions small;
  small.device = testDevice();
  small.sceneBudget = 1;
  Result<std::unique_ptr<Renderer>> own = Renderer::create(small);
  ASSERT_TRUE(own) << own.error().message();
  const Scene other = stillLife().load();
  uint64_t alone = 0;
  for (int i = 0; i < 3; ++i) {
    // Those that nobody holds any more go.
    const Scene scene = load(everything(), false);
    ASSERT_TRUE(tryToDraw(**own, scene));
    ASSERT_TRUE(tryToDraw(**own, other));
    const Result<Frame> again = tryToDraw(**own, scene);
    ASSERT_TRUE(again) << again.error().message();
    if (i == 0) alone = again->stats.deviceBytes;
    EXPECT_LE(again->stats.deviceBytes, alone + alone / 10);
  }
}

TEST_P(DroppedVertices, stayWhereALookMoves) {
  const Scene scene = load(everything(), false);
  const int all = holding(scene);
  ASSERT_TRUE(tryToDraw(renderer(), scene, animated()));
  EXPECT_EQ(holding(scene), all);
  // A rehearsal leaves them too.
  ASSERT_TRUE(otherRenderer().prepare(scene, Look(), views(scene), options()));
  EXPECT_EQ(holding(scene), all);
  ASSERT_TRUE(tryToDraw(otherRenderer(), scene));
  EXPECT_EQ(holding(scene), 0);
}

TEST_P(DroppedVertices, ofAWorldAreDroppedWhereAllOfItsScenesDropThem) {
  const TestScene test = everything();
  const Scene some = Scene::combine({load(test, false), load(test, true)}),
              all = Scene::combine({load(test, false), load(test, false)});
  const int each = holding(some);
  ASSERT_TRUE(tryToDraw(renderer(), some));
  ASSERT_TRUE(tryToDraw(renderer(), all));
  EXPECT_EQ(holding(some), each);
  EXPECT_EQ(holding(all), 0);
}

}  // namespace
}  // namespace scumble
