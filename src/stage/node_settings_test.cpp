// Whom a look's settings for nodes hold for.
#include "stage/node_settings.h"

#include <gtest/gtest.h>

#include "scumble/look.h"
#include "stage/palette.h"

namespace scumble::stage {
namespace {

// Boat > (Sail > Patch, Hull), Gull.
scene::SceneData boat() {
  scene::SceneData scene;
  const auto add = [&](const char* name, int parent) {
    scene::Node node;
    node.name = name, node.parent = parent;
    scene.nodes.push_back(node);
  };
  add("Boat", -1), add("Sail", 0), add("Patch", 1), add("Hull", 0), add("Gull", -1);
  return scene;
}

Look lookOf(const std::string& json) {
  Result<Look> look = Look::fromJson(json, "test");
  EXPECT_TRUE(look) << (look ? "" : look.error().message());
  return std::move(look).value();
}

// What a node's lit set has under a look, with the material "Paint".
LitParams litOf(const scene::SceneData& scene, const Look& look, size_t node) {
  const NodeSettings settings = nodeSettings(scene, look.data());
  const auto& list = settings.lists[settings.ofNode.empty() ? 0 : settings.ofNode[node]];
  return look.data().getForMaterial<LitParams>("Paint", list);
}

TEST(NodeSettings, withoutAnyThereIsNothing) {
  EXPECT_EQ(
      nodeSettings(boat(), lookOf(R"({"lit": {"hue": 3}, "materials": {"*": {"lit": {"hue": 4}}}})").data()),
      NodeSettings());
  // Neither does holding poses separate materials.
  EXPECT_EQ(nodeSettings(boat(), lookOf(R"({"nodes": {"*": {"animation": {"hold": 3}}}})").data()),
            NodeSettings());
}

TEST(NodeSettings, areInheritedRowByRow) {
  const scene::SceneData scene = boat();
  const Look look = lookOf(R"({"nodes": {"Boat": {"lit": {"hue": 10, "saturation": 0.5}},
                                         "Sail": {"lit": {"hue": 20}}}})");
  const NodeSettings settings = nodeSettings(scene, look.data());
  EXPECT_EQ(settings.ofNode, (std::vector<uint32_t>{1, 2, 2, 1, 0}));
  EXPECT_EQ(litOf(scene, look, 0).hue, 10);
  EXPECT_EQ(litOf(scene, look, 1).hue, 20);
  EXPECT_EQ(litOf(scene, look, 1).saturation, 0.5f);
  EXPECT_EQ(litOf(scene, look, 2).hue, 20);
  EXPECT_EQ(litOf(scene, look, 3).hue, 10);
  EXPECT_EQ(litOf(scene, look, 4).hue, 0);
}

TEST(NodeSettings, nodesThatOnePatternNamesShareOneList) {
  const NodeSettings settings =
      nodeSettings(boat(), lookOf(R"({"nodes": {"*": {"lit": {"hue": 10}}}})").data());
  EXPECT_EQ(settings.lists.size(), 2u);
  EXPECT_EQ(settings.ofNode, (std::vector<uint32_t>{1, 1, 1, 1, 1}));
}

TEST(NodeSettings, winOverMaterialsAndLoseAgainstHands) {
  const scene::SceneData scene = boat();
  Look look = lookOf(R"({"lit": {"hue": 1}, "nodes": {"Sail": {"lit": {"hue": 3}}},
                         "materials": {"Paint": {"lit": {"hue": 2}}}})");
  EXPECT_EQ(litOf(scene, look, 1).hue, 3);
  EXPECT_EQ(litOf(scene, look, 3).hue, 2);
  ASSERT_TRUE(look.set("lit.hue", "4"));
  EXPECT_EQ(litOf(scene, look, 1).hue, 4);
  ASSERT_TRUE(look.set("nodes.S*.lit.hue", "6"));
  ASSERT_TRUE(look.set("materials.*.lit.hue", "5"));
  EXPECT_EQ(litOf(scene, look, 1).hue, 6);
  EXPECT_EQ(litOf(scene, look, 3).hue, 5);
}

}  // namespace
}  // namespace scumble::stage
