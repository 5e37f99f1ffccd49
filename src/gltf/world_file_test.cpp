// Worlds in files.
#include "gltf/world_file.h"

#include <gtest/gtest.h>

#include "base/test_folder.h"
#include "scene/find_node.h"
#include "scene/scene_data.h"
#include "tests/support/test_gltf.h"

namespace scumble {
namespace {

class WorldFile : public testing::Test, protected TestFolder {
 protected:
  WorldFile() {
    scene::TestGltf g;
    g.addQuad();
    g.json["nodes"][0]["name"] = "Plank";
    put("boat.gltf", g.gltf());
    put("parts/dog.glb", g.glb());
  }
};

TEST_F(WorldFile, listsScenesWithTheirPlaces) {
  const Result<Scene> scene = Scene::load(put("world.json", R"(
      { "description": "A dog at sea.",   // comments are taken
        "scenes": [
          { "file": "parts/dog.glb", "at": [0, 1, 0], "turn": 90, "scale": 0.5, "on": "raft/Plank" },
          { "file": "boat.gltf" },
          { "file": "boat.gltf", "name": "raft", "at": [0, 0, 4], "turn": [0, 180, 0], "scene": 0 } ] })"));
  ASSERT_TRUE(scene.ok()) << scene.error().message();
  const scene::SceneData& data = scene->data();
  const auto world = scene::worldMatrices(data);
  const auto at = [&](const char* node, const glm::vec4& point) {
    return glm::vec3(world[size_t(scene::findNode(data, node))] * point);
  };
  EXPECT_LT(glm::length(at("dog/Plank", {0, 0, 0, 1}) - glm::vec3(0, 1, 4)), 1e-5f);
  EXPECT_LT(glm::length(at("dog/Plank", {1, 0, 0, 0}) - glm::vec3(0, 0, 0.5f)), 1e-5f);
  EXPECT_LT(glm::length(at("boat/Plank", {0, 0, 0, 1})), 1e-5f);
  EXPECT_EQ(data.meshes.size(), 3u);  // the raft names a scene of its file
  // A world in a world.
  put("harbour.json",
      R"({"scenes": [{"file": "world.json", "at": [9, 0, 0]}, {"file": "boat.gltf", "on": "world/boat/Plank"}]})");
  const Result<Scene> harbour = Scene::load(file("harbour.json"));
  ASSERT_TRUE(harbour.ok()) << harbour.error().message();
  EXPECT_LT(
      glm::length(glm::vec3(scene::worldMatrices(
                      harbour->data())[size_t(scene::findNode(harbour->data(), "world/boat/Plank"))][3]) -
                  glm::vec3(9, 0, 0)),
      1e-5f);
}

TEST_F(WorldFile, aFileIsReadOnce) {
  std::string trees;
  for (int i = 0; i < 50; ++i)
    trees += std::string(i ? "," : "") + R"({"file": "boat.gltf", "at": [)" + std::to_string(i) + ", 0, 0]}";
  const Result<Scene> forest = Scene::load(put("forest.json", R"({"scenes": [)" + trees + "]}"));
  ASSERT_TRUE(forest.ok()) << forest.error().message();
  EXPECT_EQ(forest->data().meshes.size(), 1u);
  EXPECT_EQ(forest->data().nodes.size(), 100u);
  EXPECT_FLOAT_EQ(forest->data().bounds.max.x, 50);
}

TEST_F(WorldFile, mistakesAreToldWithTheirPlace) {
  const struct {
    const char *json, *path, *says;
  } cases[] = {
      {"[]", "", "a world is a JSON object"},
      {"{}", "scenes", "a world lists its scenes"},
      {R"({"scenes": []})", "scenes", "a world lists its scenes"},
      {R"({"scene": []})", "scene", "did you mean 'scenes'?"},
      {R"({"scenes": [3]})", "scenes[0]", "it is no object"},
      {R"({"scenes": [{}]})", "scenes[0].file", "it names no file"},
      {R"({"scenes": [{"file": 3}]})", "scenes[0].file", "it is no text"},
      {R"({"scenes": [{"file": "boat.gltf", "scael": 2}]})", "scenes[0].scael", "did you mean 'scale'?"},
      {R"({"scenes": [{"file": "boat.gltf", "at": [1, 2]}]})", "scenes[0].at", "three numbers"},
      {R"({"scenes": [{"file": "boat.gltf", "at": [1, "2", 3]}]})", "scenes[0].at[1]", "it is no number"},
      {R"({"scenes": [{"file": "boat.gltf", "at": [1, 1e400, 3]}]})", "", ""},
      {R"({"scenes": [{"file": "boat.gltf", "at": [1, 1e39, 3]}]})", "scenes[0].at[1]", "out of range"},
      {R"({"scenes": [{"file": "boat.gltf", "scale": 0}]})", "scenes[0].scale", "a scale of 0"},
      {R"({"scenes": [{"file": "boat.gltf", "scene": -1}]})", "scenes[0].scene", "no scene's number"},
      {R"({"scenes": [{"file": "boat.gltf"}, {"file": "parts/dog.glb", "on": "Plnk"}]})", "scenes[1].on",
       "did you mean 'Plank'?"},
      {R"({"scenes": [{"file": "boat.gltf", "on": "dog"}, {"file": "parts/dog.glb", "on": "boat"}]})",
       "scenes[0].on", "circle"},
      {R"({"scenes": [{"file": "../boat.gltf"}]})", "scenes[0].file", "leads out of the scene's folder"},
      {R"({"scenes": [{"file": "/etc/boat.gltf"}]})", "scenes[0].file", "leads out of the scene's folder"},
      {R"({"scenes": [{"file": "http://a/boat.gltf"}]})", "scenes[0].file", "never uses the network"},
      {R"({"scenes": [{"file": "world.json"}]})", "scenes[0].file", "list each other"},
      {"{\n\"scenes\"\n}", "", "this is no JSON"},
  };
  for (const auto& c : cases) {
    const std::string file = put("world.json", c.json);
    const Result<Scene> scene = Scene::load(file);
    ASSERT_FALSE(scene.ok()) << c.json;
    EXPECT_EQ(scene.error().kind, ErrorKind::unusableFile) << c.json;
    EXPECT_EQ(scene.error().file, file) << c.json;
    EXPECT_EQ(scene.error().jsonPath, c.path) << c.json;
    EXPECT_NE(scene.error().message().find(c.says), std::string::npos) << scene.error().message();
  }
  // What is wrong with a scene is told of that.
  const Result<Scene> absent = Scene::load(put("world.json", R"({"scenes": [{"file": "cat.glb"}]})"));
  EXPECT_EQ(absent.error().file, file("cat.glb"));
  EXPECT_EQ(absent.error().kind, ErrorKind::unusableFile);
}

TEST_F(WorldFile, outsideWithLeave) {
  put("low/world.json", R"({"scenes": [{"file": "../boat.gltf"}]})");
  SceneOptions options;
  EXPECT_FALSE(Scene::load(file("low/world.json"), options).ok());
  options.allowOutside = true;
  EXPECT_TRUE(Scene::load(file("low/world.json"), options).ok());
  options.scene = 0;
  EXPECT_FALSE(Scene::load(file("low/world.json"), options).ok());
}

// Worlds within worlds multiply: that ends before memory does.
TEST_F(WorldFile, aBombOfWorldsIsDefused) {
  const auto many = [](const std::string& file) {
    std::string entries;
    for (int i = 0; i < 1000; ++i) entries += (i ? ",{\"file\": \"" : "{\"file\": \"") + file + "\"}";
    return "{\"scenes\": [" + entries + "]}";
  };
  put("one.json", many("boat.gltf")), put("two.json", many("one.json"));
  const Result<Scene> scene = Scene::load(file("two.json"));
  ASSERT_FALSE(scene.ok());
  EXPECT_NE(scene.error().problem.find("too many nodes"), std::string::npos) << scene.error().message();
}

// A glTF may be called .json.
TEST_F(WorldFile, aGltfByAnotherName) {
  scene::TestGltf g;
  g.addQuad();
  EXPECT_TRUE(Scene::load(put("quad.json", g.gltf())).ok());
}

}  // namespace
}  // namespace scumble
