// Scenes at their places in one world.
#include "scene/scene_place.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/animation.h"
#include "scene/find_node.h"
#include "tests/support/loaded_test_gltf.h"

namespace scumble::scene {
namespace {

using Json = TestGltf::Json;

// A unit square on a node "Deck" 2 m up, below "Hull".
Scene boat(const std::string& deck = "Deck") {
  TestGltf g;
  g.addQuad();
  g.json["nodes"][0]["name"] = deck;
  g.json["nodes"][0]["translation"] = {0, 2, 0};
  g.json["nodes"].push_back({{"name", "Hull"}, {"children", {0}}, {"translation", {10, 0, 0}}});
  g.json["scenes"][0]["nodes"] = {1};
  return loaded(g);
}

// A unit square with a camera, a clip that lifts it by a metre in a second, and a material of its own.
Scene dog() {
  TestGltf g;
  g.addQuad();
  g.json["nodes"][0]["name"] = "Body";
  g.json["materials"] = Json::array({{{"name", "Fur"}}});
  g.json["meshes"][0]["primitives"][0]["material"] = 0;
  g.json["cameras"] = {{{"name", "Eye"},
                        {"type", "orthographic"},
                        {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0.5}, {"zfar", 5}}}}};
  g.json["nodes"].push_back({{"camera", 0}, {"name", "Neck"}});
  g.json["scenes"][0]["nodes"].push_back(1);
  const int times = g.addFloats({0, 1}, 1), places = g.addFloats({0, 0, 0, 0, 1, 0}, 3);
  g.json["accessors"][size_t(times)]["min"] = {0};
  g.json["accessors"][size_t(times)]["max"] = {1};
  g.json["animations"] = {
      {{"name", "Jump"},
       {"samplers", {{{"input", times}, {"output", places}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
  return loaded(g);
}

Scene mustPlace(const std::vector<PlacedScene>& scenes) {
  const Result<Scene> placed = Scene::place(scenes);
  EXPECT_TRUE(placed.ok()) << placed.error().message();
  return placed.ok() ? placed.value() : Scene::combine({});
}

glm::vec3 originOf(const Scene& scene, const std::string& node, double time = 0) {
  const SceneData& data = scene.data();
  const int n = findNode(data, node);
  EXPECT_GE(n, 0) << node;
  std::vector<PlayedClip> clips(data.clips.size());
  for (size_t i = 0; i < clips.size(); ++i) clips[i].clip = int(i);
  return n < 0 ? glm::vec3(NAN) : glm::vec3(worldAt(data, clips, size_t(n), time)[3]);
}

void expectClose(const glm::vec3& a, const glm::vec3& b) {
  EXPECT_LT(glm::length(a - b), 1e-4f) << a.x << " " << a.y << " " << a.z;
}

TEST(ScenePlace, offsetTurnAndScale) {
  const Scene placed = mustPlace({{boat(), "boat", {1, 0, 5}, {0, 90, 0}, 2}});
  // The hull's 10 m along x are 20 m along -z; the deck is 4 m above it.
  expectClose(originOf(placed, "Hull"), {1, 0, 5 - 20});
  expectClose(originOf(placed, "Deck"), {1, 4, 5 - 20});
  expectClose(originOf(placed, "boat"), {1, 0, 5});
  // Bounds are anew; the square spans x and y.
  const Bounds& bounds = placed.data().bounds;
  expectClose(bounds.min, {1, 4, 5 - 22});
  expectClose(bounds.max, {1, 6, 5 - 20});
  // x, then y, then z.
  const Scene turned = mustPlace({{boat(), "boat", {0, 0, 0}, {90, 0, 90}, 1}});
  expectClose(originOf(turned, "Deck"), {0, 10, 2});
  // What is written in metres goes along.
  const Node& hull = placed.data().nodes[size_t(findNode(placed.data(), "Hull"))];
  EXPECT_FLOAT_EQ(hull.extrasScale, 2);
  const Camera camera = mustPlace({{dog(), "dog", {}, {}, 3}}).data().cameras[0];
  EXPECT_FLOAT_EQ(camera.halfHeight, 3);
  EXPECT_FLOAT_EQ(camera.near, 1.5f);
  EXPECT_FLOAT_EQ(camera.far, 15);
}

// The order of the list does not matter: a scene may stand on one that comes later.
TEST(ScenePlace, whatStandsOnANodeRidesWithIt) {
  for (const bool dogFirst : {false, true}) {
    const PlacedScene hull{boat(), "boat", {0, 1, 0}}, rider{dog(), "dog", {0, 0.5f, 0}, {}, 0.5f, "Deck"};
    const Scene placed = mustPlace(dogFirst ? std::vector{rider, hull} : std::vector{hull, rider});
    const SceneData& data = placed.data();
    for (size_t n = 0; n < data.nodes.size(); ++n) EXPECT_LT(data.nodes[n].parent, int(n));
    expectClose(originOf(placed, "Body"), {10, 3.5f, 0});
    expectClose(originOf(placed, "Body", 0.999), {10, 3.5f + 0.4995f, 0});
    expectClose(originOf(placed, "Neck"), {10, 3.5f, 0});
    EXPECT_EQ(data.nodes[size_t(findNode(data, "dog"))].parent, findNode(data, "Deck"));
    // Its mesh, material and camera are its own.
    const Node& body = data.nodes[size_t(findNode(data, "Body"))];
    EXPECT_EQ(data.materials[size_t(data.meshes[size_t(body.mesh)]->primitives[0].material)].name, "Fur");
    EXPECT_EQ(data.cameras[size_t(data.nodes[size_t(findNode(data, "Neck"))].camera)].name, "Eye");
  }
  // On what stands on something, and on a scene itself.
  const Scene tower = mustPlace({{dog(), "top", {0, 1, 0}, {}, 1, "middle/Body"},
                                 {dog(), "middle", {0, 1, 0}, {}, 1, "boat"},
                                 {boat(), "boat", {0, 0, 7}}});
  expectClose(originOf(tower, "top/Body"), {0, 2, 7});
  expectClose(originOf(tower, "top/Body", 0.999), {0, 2 + 2 * 0.999f, 7});
}

// Exporters scale nodes by 100 and lay them on their backs; what stands on one stands upright in metres.
TEST(ScenePlace, theNodesOwnAxesAndScaleDoNotCount) {
  TestGltf g;
  g.addQuad();
  g.json["nodes"][0] = {{"name", "Deck"},
                        {"mesh", 0},
                        {"translation", {3, 0, 1}},
                        {"scale", {100, 100, 50}},
                        {"rotation", {-0.70710678, 0, 0, 0.70710678}}};
  const Scene ship = loaded(g);
  const Scene placed =
      mustPlace({{ship, "ship", {0, 0, 0}, {0, 90, 0}, 2}, {dog(), "dog", {0, 0.5f, 1}, {}, 1, "Deck"}});
  // Twice as large as the ship is, and turned as that: (3, 0, 1) + (0, 0.5, 1), doubled, x to -z and z to x.
  expectClose(originOf(placed, "Body"), {4, 1, -6});
  expectClose(originOf(placed, "Body", 0.999), {4, 1 + 2 * 0.999f, -6});
  // What is written in metres follows the whole chain of scales.
  const Camera& eye = placed.data().cameras[0];
  EXPECT_FLOAT_EQ(eye.halfHeight, 2);
  EXPECT_FLOAT_EQ(eye.far, 10);
  const Scene towed = mustPlace({{boat("Raft"), "raft", {}, {}, 3, "Deck"}, {ship, "ship", {}, {}, 2}});
  const Node& hull = towed.data().nodes[size_t(findNode(towed.data(), "Hull"))];
  EXPECT_FLOAT_EQ(hull.extrasScale, 3 * 2);
  g.json["nodes"][0]["scale"] = {1, 0, 1};
  const Result<Scene> flat = Scene::place({{loaded(g), "ship"}, {dog(), "dog", {}, {}, 1, "Deck"}});
  ASSERT_FALSE(flat.ok());
  EXPECT_NE(flat.error().problem.find("'dog': nothing can stand on 'Deck'"), std::string::npos)
      << flat.error().message();
}

TEST(ScenePlace, namesThatRepeat) {
  const Scene two =
      mustPlace({{boat(), "boat"}, {boat(), "boat", {0, 0, 30}}, {dog(), "", {}, {}, 1, "boat-2/Deck"}});
  expectClose(originOf(two, "Body"), {10, 2, 30});
  expectClose(originOf(two, "boat/Deck"), {10, 2, 0});
  expectClose(originOf(two, "boat-2/Deck"), {10, 2, 30});
  expectClose(originOf(two, "Deck"), {10, 2, 0});  // the first
  // A scene in the list twice holds its meshes once.
  const Scene one = boat();
  EXPECT_EQ(mustPlace({{one, "a"}, {one, "b"}, {one, "c"}}).data().meshes.size(), 1u);
  EXPECT_EQ(mustPlace({{one, "a"}, {boat(), "b"}}).data().meshes.size(), 2u);
  // A file's first clip plays, of each copy.
  const Scene pair = mustPlace({{dog(), "a"}, {dog(), "b"}});
  EXPECT_EQ(pair.data().clips[0].file, 0);
  EXPECT_EQ(pair.data().clips[1].file, 1);
  EXPECT_NE(pair.data().clips[0].channels[0].node, pair.data().clips[1].channels[0].node);
}

TEST(ScenePlace, whatPlacesNothing) {
  const Scene hull = boat(), rider = dog();
  const float nan = std::nanf(""), infinite = INFINITY;
  const struct {
    std::vector<PlacedScene> scenes;
    const char *problem, *advice;
  } cases[] = {
      {{{hull, "boat", {nan, 0, 0}}}, "'boat': its place is out of range", "metres"},
      {{{hull, "boat", {0, infinite, 0}}}, "place is out of range", "metres"},
      {{{hull, "boat", {}, {0, nan, 0}}}, "turn is out of range", "degrees"},
      {{{hull, "boat", {}, {}, 0}}, "a scale of 0", "above 0"},
      {{{hull, "boat", {}, {}, -1}}, "scale is out of range", "above 0"},
      {{{hull, "boat", {}, {}, nan}}, "scale is out of range", "above 0"},
      {{{hull, "boat", {}, {}, infinite}}, "scale is out of range", "above 0"},
      {{{hull, "boat"}, {rider, "dog", {}, {}, 1, "Dekc"}},
       "'dog': no other scene has a node 'Dekc'",
       "did you mean 'Deck'?"},
      {{{hull, "boat"}, {rider, "dog", {}, {}, 1, "boat/Dekc"}},
       "no other scene",
       "did you mean 'boat/Deck'?"},
      {{{hull, "boat"}, {rider, "dog", {}, {}, 1, "nothing at all"}}, "no other scene", "scumble info"},
      {{{hull, "boat"}, {rider, "dog", {}, {}, 1, "Body"}}, "it cannot stand on itself", "another scene"},
      {{{hull, "boat"}, {hull, "raft"}, {rider, "dog", {}, {}, 1, "Deck"}},
       "several scenes have a node 'Deck'",
       "'boat/Deck' or 'raft/Deck'"},
      {{{hull, "boat", {}, {}, 1, "Body"}, {rider, "dog", {}, {}, 1, "Deck"}},
       "in a circle: 'boat' on 'dog' on 'boat'",
       "in the world"},
      {{{hull, "boat", {}, {}, 1, "dog"},
        {rider, "dog", {}, {}, 1, "raft"},
        {hull, "raft", {}, {}, 1, "dog"}},
       "in a circle: 'dog' on 'raft' on 'dog'",
       "in the world"},
      {{{Scene(), "nothing"}}, "the scene is empty", "Scene::load"},
  };
  for (const auto& c : cases) {
    const Result<Scene> placed = Scene::place(c.scenes);
    ASSERT_FALSE(placed.ok()) << c.problem;
    EXPECT_EQ(placed.error().kind, ErrorKind::usage);
    EXPECT_NE(placed.error().problem.find(c.problem), std::string::npos) << placed.error().message();
    EXPECT_NE(placed.error().advice.find(c.advice), std::string::npos) << placed.error().message();
  }
}

TEST(FindNode, byNameAndByWhatItHangsOn) {
  TestGltf g;
  g.addQuad();
  g.json["nodes"][0]["name"] = "Deck";
  for (const char* name : {"a/b", "Hull", "Raft"}) g.json["nodes"].push_back({{"name", name}});
  g.json["nodes"].push_back({{"name", "Deck"}});
  g.json["nodes"][2]["children"] = {0};
  g.json["nodes"][3]["children"] = {1};
  g.json["nodes"][1]["children"] = {4};
  g.json["scenes"][0]["nodes"] = {2, 3};
  const Scene scene = loaded(g);
  const SceneData& data = scene.data();
  const auto pathOf = [&](const std::string& name) {
    std::string path;
    for (int n = findNode(data, name); n >= 0; n = data.nodes[size_t(n)].parent)
      path = "<" + data.nodes[size_t(n)].name + path;
    return path;
  };
  EXPECT_EQ(pathOf("Hull/Deck"), "<Hull<Deck");
  EXPECT_EQ(pathOf("Raft/Deck"), "<Raft<a/b<Deck");
  EXPECT_EQ(pathOf("Raft/a/b/Deck"), "<Raft<a/b<Deck");
  EXPECT_EQ(pathOf("a/b/Deck"), "<Raft<a/b<Deck");
  EXPECT_EQ(pathOf("a/b"), "<Raft<a/b");
  EXPECT_EQ(pathOf("Raft/a/b"), "<Raft<a/b");
  for (const char* none : {"", "/", "Deck/Hull", "Hull/", "/Deck", "deck", "Hull/a/b"})
    EXPECT_EQ(pathOf(none), "") << none;
}

}  // namespace
}  // namespace scumble::scene
