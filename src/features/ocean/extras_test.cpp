#include "features/ocean/extras.h"

#include "features/ocean/floating.h"
#include "tests/support/loaded_test_gltf.h"

namespace scumble::ocean {
namespace {

using scene::loaded, scene::quad, scene::TestGltf;
using Json = TestGltf::Json;

TEST(OceanExtras, areReadAndWhatIsBrokenIsSaid) {
  TestGltf g = quad();
  const auto read = [&](const Json& extras) {
    g.json["nodes"][0]["extras"] = extras;
    return loaded(g);
  };
  const auto nodeOf = [](const Scene& scene) { return scene.data().nodes[0]; };
  for (const Json& silent :
       {Json(nullptr), Json::object(), Json("text"), Json::array({1}), Json({{"other", 1}})}) {
    const Scene scene = read(silent);
    EXPECT_FALSE(saysOcean(nodeOf(scene)) || floatsOf(nodeOf(scene))) << silent;
    EXPECT_TRUE(scene.warnings().empty()) << silent;
  }
  EXPECT_EQ(saysOcean(nodeOf(read({{"scumble_ocean", true}}))), true);
  EXPECT_EQ(saysOcean(nodeOf(read({{"scumble_ocean", 1}}))), true);
  EXPECT_EQ(saysOcean(nodeOf(read({{"scumble_ocean", false}}))), false);
  EXPECT_FALSE(floatsOf(nodeOf(read({{"scumble_float", false}}))));
  ASSERT_TRUE(floatsOf(nodeOf(read({{"scumble_float", true}}))));
  const Floats some = *floatsOf(nodeOf(read({{"scumble_float", {{"length", 4.5}}}}))),
               all = *floatsOf(
                   nodeOf(read({{"scumble_float", {{"length", 0}, {"beam", 1000}, {"bow", "z"}}}})));
  EXPECT_EQ(some.length, 4.5f);
  EXPECT_FALSE(some.beam || some.bowAlongZ);
  EXPECT_EQ(all.length, 0.0f);
  EXPECT_EQ(all.beam, 1000.0f);
  EXPECT_TRUE(all.bowAlongZ);
  // What is broken is left out, and said once.
  for (const Json& broken :
       {Json("yes"), Json(2), Json(-1), Json(0.5), Json(nullptr), Json::array(), Json::object()}) {
    const Scene scene = read({{"scumble_ocean", broken}});
    EXPECT_FALSE(saysOcean(nodeOf(scene))) << broken;
    ASSERT_EQ(scene.warnings().size(), 1u) << broken;
    EXPECT_NE(scene.warnings()[0].find("nodes[0].extras.scumble_ocean"), std::string::npos);
    if (broken.is_object()) continue;
    const Scene other = read({{"scumble_float", broken}});
    EXPECT_FALSE(floatsOf(nodeOf(other))) << broken;
    ASSERT_EQ(other.warnings().size(), 1u) << broken;
    EXPECT_NE(other.warnings()[0].find("nodes[0].extras.scumble_float"), std::string::npos);
  }
  for (const auto& [key, value] : {std::pair<const char*, Json>{"length", "long"},
                                   {"length", -0.1},
                                   {"beam", 1001},
                                   {"beam", nullptr},
                                   {"bow", "y"},
                                   {"bow", 1},
                                   {"lenght", 3}}) {
    const Scene scene = read({{"scumble_float", {{key, value}}}});
    ASSERT_TRUE(floatsOf(nodeOf(scene))) << key;
    EXPECT_FALSE(floatsOf(nodeOf(scene))->length || floatsOf(nodeOf(scene))->beam ||
                 floatsOf(nodeOf(scene))->bowAlongZ);
    ASSERT_EQ(scene.warnings().size(), 1u) << key;
    EXPECT_NE(scene.warnings()[0].find(std::string("nodes[0].extras.scumble_float.") + key),
              std::string::npos);
  }
}

TEST(OceanExtras, sayHowAHullKeepsTheSeaOut) {
  TestGltf g = quad();
  const auto read = [&](const Json& value) {
    g.json["nodes"][0]["extras"] = {{"scumble_hull", value}};
    return loaded(g);
  };
  EXPECT_EQ(hullOf(read(true).data().nodes[0]), kHullWhole);
  EXPECT_EQ(hullOf(read(0).data().nodes[0]), kHullOff);
  EXPECT_EQ(hullOf(read("inside").data().nodes[0]), kHullInside);
  EXPECT_FALSE(hullOf(loaded(quad()).data().nodes[0]));
  for (const Json& broken : {Json("outside"), Json(2), Json(nullptr), Json::array(), Json::object()}) {
    const Scene scene = read(broken);
    EXPECT_FALSE(hullOf(scene.data().nodes[0])) << broken;
    ASSERT_EQ(scene.warnings().size(), 1u) << broken;
    EXPECT_NE(scene.warnings()[0].find("nodes[0].extras.scumble_hull"), std::string::npos);
  }
}

// What is written in metres is of the scene's own size.
TEST(OceanExtras, sizesGoAlongWithPlacing) {
  TestGltf g = quad();
  g.json["nodes"][0]["name"] = "Hull";
  g.json["nodes"][0]["extras"] = {{"scumble_float", {{"length", 4}, {"beam", 2}}}};
  const Result<Scene> placed = Scene::place({{loaded(g), "boat", {}, {}, 3}});
  ASSERT_TRUE(placed.ok());
  for (const scene::Node& node : placed->data().nodes) {
    if (node.name != "Hull") continue;
    const std::optional<Floats> floats = floatsOf(node);
    ASSERT_TRUE(floats);
    EXPECT_FLOAT_EQ(*floats->length, 12);
    EXPECT_FLOAT_EQ(*floats->beam, 6);
    return;
  }
  ADD_FAILURE() << "there is no hull";
}

}  // namespace
}  // namespace scumble::ocean
