// What a client's edits make of a scene: places of what was removed are given to others, which inherit
// nothing, and each member of a texture's use is its own.
#include "apps/serve/served_scene.h"

#include <gtest/gtest.h>

#include <string>

#include "base/test_folder.h"
#include "scene/scene_data.h"

namespace scumble::serve {
namespace {

using nlohmann::json;

class ServedScenes : public ::testing::Test {
 protected:
  void SetUp() override {
    // A triangle, four white pixels, two instances, one after the other.
    const float numbers[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    std::string bytes(reinterpret_cast<const char*>(numbers), sizeof numbers);
    bytes += std::string(16, char(255));
    for (const float aside : {2.0f, 4.0f}) {
      const float matrix[] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, aside, 0, 0, 1};
      bytes.append(reinterpret_cast<const char*>(matrix), sizeof matrix);
    }
    putContent(folder.file("memory"), bytes);
    memory.share("m", folder.file("memory"), bytes.size());
  }
  static json at(uint64_t offset, uint64_t count) {
    return {{"memory", "m"}, {"offset", offset}, {"count", count}};
  }
  static json triangle(const std::string& key) {
    return {{"set", "mesh"}, {"key", key}, {"parts", json::array({{{"positions", at(0, 3)}}})}};
  }
  void edit(const json& one) { scene.edit(one, "edit", memory); }
  // The nodes that are seen, as the library has them.
  std::vector<scene::Node> shown() const {
    std::vector<scene::Node> nodes;
    const Scene made = scene.scene().value();
    for (const scene::Node& node : made.data().nodes)
      if (node.visible) nodes.push_back(node);
    return nodes;
  }

  TestFolder folder;
  ClientMemory memory;
  ServedScene scene;
};

TEST_F(ServedScenes, aPlaceThatIsGivenAnewInheritsNothing) {
  edit(triangle("mesh"));
  const json full = {{"set", "node"},
                     {"key", "full"},
                     {"name", "Full"},
                     {"mesh", "mesh"},
                     {"instances", at(52, 2)},
                     {"light", {{"kind", "point"}}},
                     {"extras", {{"scumble_float", true}}},
                     {"transform", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}};
  edit(full);
  ASSERT_EQ(shown().size(), 1u);
  EXPECT_EQ(shown()[0].instances.size(), 2u);
  EXPECT_GE(shown()[0].light, 0);
  EXPECT_EQ(shown()[0].extras.size(), 1u);
  edit({{"remove", "node"}, {"key", "full"}});
  EXPECT_EQ(shown().size(), 0u);
  edit({{"set", "node"}, {"key", "bare"}});
  EXPECT_EQ(scene.counts().at("nodesEver"), 1) << "its place is used again";
  const std::vector<scene::Node> nodes = shown();
  ASSERT_EQ(nodes.size(), 1u);
  EXPECT_EQ(nodes[0].name, "bare");
  EXPECT_EQ(nodes[0].mesh, -1);
  EXPECT_EQ(nodes[0].light, -1);
  EXPECT_TRUE(nodes[0].instances.empty());
  EXPECT_TRUE(nodes[0].extras.empty());
  EXPECT_EQ(nodes[0].restTransform(), glm::dmat4(1.0));
  // With a mesh again, it is drawn once.
  edit({{"set", "node"}, {"key", "bare"}, {"mesh", "mesh"}});
  EXPECT_TRUE(shown()[0].instances.empty());
}

// Below another node, a place serves there alone.
TEST_F(ServedScenes, placesStayBelowTheirParents) {
  edit({{"set", "node"}, {"key", "a"}});
  edit({{"set", "node"}, {"key", "b"}, {"parent", "a"}});
  edit({{"remove", "node"}, {"key", "b"}});
  edit({{"set", "node"}, {"key", "c"}});
  EXPECT_EQ(scene.counts().at("nodesEver"), 3);
  edit({{"set", "node"}, {"key", "d"}, {"parent", "a"}});
  EXPECT_EQ(scene.counts().at("nodesEver"), 3);
}

TEST_F(ServedScenes, eachMemberOfATexturesUseIsItsOwn) {
  edit({{"set", "texture"},
        {"key", "t"},
        {"width", 2},
        {"height", 2},
        {"rgba", {{"memory", "m"}, {"offset", 36}}}});
  const char* const wraps[] = {"repeat", "mirrored-repeat", "clamp-to-edge"};
  using Wrap = decltype(scene::Sampler::wrapU);
  const Wrap known[] = {Wrap::repeat, Wrap::mirroredRepeat, Wrap::clampToEdge};
  for (size_t u = 0; u < 3; ++u)
    for (size_t v = 0; v < 3; ++v)
      for (const int set : {0, 1}) {
        edit({{"set", "material"},
              {"key", "m"},
              {"baseColorTexture",
               {{"texture", "t"}, {"wrapU", wraps[u]}, {"wrapV", wraps[v]}, {"uvSet", set}}}});
        json mesh = triangle("mesh");
        mesh["parts"][0]["material"] = "m";
        edit(mesh);
        edit({{"set", "node"}, {"key", "n"}, {"mesh", "mesh"}});
        const Scene made = scene.scene().value();
        const scene::SceneData& data = made.data();
        const scene::Material& material = data.materials[size_t(data.meshes[0]->primitives[0].material)];
        EXPECT_EQ(material.baseColorTexture.sampler.wrapU, known[u]) << wraps[u] << " " << wraps[v];
        EXPECT_EQ(material.baseColorTexture.sampler.wrapV, known[v]) << wraps[u] << " " << wraps[v];
        EXPECT_EQ(material.baseColorTexture.uvSet, set);
        EXPECT_EQ(material.emissiveTexture.image, -1);
      }
}

// A node that is refused is not there, whatever of it was right.
TEST_F(ServedScenes, whatIsRefusedIsNotThere) {
  edit(triangle("mesh"));
  const json bad[] = {{{"set", "node"}, {"key", "n"}, {"mesh", "none"}},
                      {{"set", "node"}, {"key", "n"}, {"parent", "none"}},
                      {{"set", "node"}, {"key", ""}},
                      {{"set", "node"}, {"key", "n"}, {"mesh", "mesh"}, {"instances", at(52, 3)}},
                      {{"set", "node"}, {"key", "n"}, {"extras", 1}},
                      {{"set", "node"}, {"key", "n"}, {"light", {{"kind", "moon"}}}},
                      {{"set", "nothing"}, {"key", "n"}},
                      {{"remove", "mesh"}, {"key", "none"}}};
  for (const json& one : bad) EXPECT_THROW(edit(one), Refusal) << one;
  EXPECT_EQ(scene.counts().at("nodes"), 0);
  EXPECT_EQ(shown().size(), 0u);
  // What is used stays.
  edit({{"set", "node"}, {"key", "n"}, {"mesh", "mesh"}});
  EXPECT_THROW(edit({{"remove", "mesh"}, {"key", "mesh"}}), Refusal);
  edit({{"remove", "node"}, {"key", "n"}});
  edit({{"remove", "mesh"}, {"key", "mesh"}});
}

}  // namespace
}  // namespace scumble::serve
