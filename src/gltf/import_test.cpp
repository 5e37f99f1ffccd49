// Materials, nodes, skins, clips, cameras, lights and several scenes in one.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "base/test_folder.h"
#include "scene/painting.h"
#include "scene/scene_data.h"
#include "scumble/image.h"
#include "scumble/scene.h"
#include "tests/support/loaded_test_gltf.h"

namespace scumble::scene {
namespace {

using Json = TestGltf::Json;

TEST(Scene, materials) {
  TestGltf g = quad();
  g.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
  g.json["images"] = {{{"uri", "missing.png"}}};
  g.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}, {"minFilter", 9729}}};
  const Json texture = {
      {"index", 0},
      {"extensions",
       {{"KHR_texture_transform",
         {{"offset", {0.5, 0.25}}, {"scale", {2, 3}}, {"rotation", 1.5707963}, {"texCoord", 1}}}}}};
  g.json["materials"] = {
      {{"name", "paint"},
       {"alphaMode", "MASK"},
       {"alphaCutoff", 0.3},
       {"doubleSided", true},
       {"emissiveFactor", {1, 0.5, 0}},
       {"extensions",
        {{"KHR_materials_unlit", Json::object()},
         {"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}}},
       {"extras", {{"scumble_shadowed", "#ff0080"}}},
       {"pbrMetallicRoughness", {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"baseColorTexture", texture}}}}};
  g.json["meshes"][0]["primitives"][0]["material"] = 0;
  const Scene scene = loaded(g);
  ASSERT_EQ(scene.data().materials.size(), 2u);
  const Material& m = scene.data().materials[1];
  EXPECT_EQ(m.name, "paint");
  EXPECT_EQ(m.alphaMode, AlphaMode::mask);
  EXPECT_FLOAT_EQ(m.alphaCutoff, 0.3f);
  EXPECT_TRUE(m.doubleSided && m.unlit);
  EXPECT_EQ(m.emissive, glm::vec3(4, 2, 0));
  EXPECT_FLOAT_EQ(m.baseColor.a, 0.4f);
  ASSERT_TRUE(m.shadowedColor.has_value());
  EXPECT_FLOAT_EQ(m.shadowedColor->x, 1.0f);
  EXPECT_NEAR(m.shadowedColor->z, 0.2158605f, 1e-5f);
  const TextureUse& use = m.baseColorTexture;
  EXPECT_EQ(use.uvSet, 1);
  EXPECT_EQ(use.sampler.wrapU, Wrap::clampToEdge);
  EXPECT_EQ(use.sampler.wrapV, Wrap::mirroredRepeat);
  EXPECT_TRUE(use.sampler.nearest);
  EXPECT_FALSE(use.sampler.mipmaps);
  // The extension's own order: offset + rotation * (scale * uv), v pointing down.
  const glm::vec3 uv = use.transform * glm::vec3(1, 0, 1);
  EXPECT_NEAR(uv.x, 0.5f, 1e-5f);
  EXPECT_NEAR(uv.y, 0.25f - 2.0f, 1e-5f);
  ASSERT_EQ(scene.data().images.size(), 1u);
  EXPECT_TRUE(scene.data().images[0]->standIn);
  EXPECT_EQ(scene.warnings().size(), 1u);
}

// Of both of VRM's versions, with their units and their colours' spaces.
TEST(Scene, mtoonsOutlinesAreRead) {
  TestGltf g = quad();
  g.json["materials"] = {{{"extensions",
                           {{"VRMC_materials_mtoon",
                             {{"outlineWidthMode", "screenCoordinates"},
                              {"outlineWidthFactor", 0.01},
                              {"outlineColorFactor", {1, 0.5, 0}},
                              {"outlineLightingMixFactor", 0.25}}}}}}};
  g.json["meshes"][0]["primitives"][0]["material"] = 0;
  {
    const Scene scene = loaded(g);
    const std::optional<Outline>& outline = scene.data().materials[1].outline;
    ASSERT_TRUE(outline);
    EXPECT_EQ(outline->unit, Outline::Unit::pictureHeights);
    EXPECT_FLOAT_EQ(outline->width, 0.01f);
    EXPECT_EQ(outline->color, glm::vec3(1, 0.5f, 0));
    EXPECT_FLOAT_EQ(outline->lightingMix, 0.25f);
  }
  // VRM 0: centimetres and sRGB.
  g.json["materials"] = {Json::object()};
  g.json["extensions"]["VRM"]["materialProperties"] = {
      {{"shader", "VRM/MToon"},
       {"floatProperties",
        {{"_OutlineWidthMode", 1},
         {"_OutlineWidth", 0.5},
         {"_OutlineColorMode", 1},
         {"_OutlineLightingMix", 0.5}}},
       {"vectorProperties", {{"_OutlineColor", {0.5, 0, 0, 1}}}}}};
  {
    const Scene scene = loaded(g);
    const std::optional<Outline>& outline = scene.data().materials[1].outline;
    ASSERT_TRUE(outline);
    EXPECT_EQ(outline->unit, Outline::Unit::metres);
    EXPECT_FLOAT_EQ(outline->width, 0.005f);
    EXPECT_NEAR(outline->color.x, 0.2140411f, 1e-5f);
    EXPECT_FLOAT_EQ(outline->lightingMix, 0.5f);
  }
  // Textures of widths: a channel of the file's own numbers, at the vertices.
  const TestFolder folder;
  const std::string file = folder.file("widths.png");
  ASSERT_TRUE(writePng(file, {2, 1, {"R", "G", "B", "A"}, {0, 1, 0, 1, 1, 0.2140411f, 0, 1}}));
  const std::string png = contentOf(file);
  TestGltf textured = quad();
  textured.addImage({png.begin(), png.end()});
  textured.json["samplers"] = Json::array({{{"wrapS", 33071}, {"wrapT", 33071}}});
  textured.json["textures"][0]["sampler"] = 0;
  Json& material = textured.json["materials"][0];
  for (const bool isVrm1 : {true, false}) {
    if (isVrm1)
      material["extensions"]["VRMC_materials_mtoon"] = {{"outlineWidthMode", "worldCoordinates"},
                                                        {"outlineWidthFactor", 0.01},
                                                        {"outlineWidthMultiplyTexture", {{"index", 0}}}};
    else
      material.erase("extensions"), textured.json["extensions"]["VRM"]["materialProperties"] = {
                                        {{"shader", "VRM/MToon"},
                                         {"floatProperties", {{"_OutlineWidthMode", 1}}},
                                         {"textureProperties", {{"_OutlineWidthTexture", 0}}}}};
    const Scene scene = loaded(textured);
    const Primitive& p = scene.data().meshes[0]->primitives[0];
    ASSERT_EQ(p.outlineWidths.size(), p.vertexCount());
    for (size_t v = 0; v < p.vertexCount(); ++v) {
      const bool isLeft = p.uv0[v].x < 0.5f;
      EXPECT_NEAR(p.outlineWidths[v], isVrm1 ? (isLeft ? 1 : 0.5) : (isLeft ? 0 : 1), 0.003) << v;
    }
  }
  // A texture that is not there costs itself alone.
  {
    TestGltf without = quad();
    without.json["materials"] = {Json::object()};
    without.json["meshes"][0]["primitives"][0]["material"] = 0;
    without.json["extensions"]["VRM"]["materialProperties"] = {
        {{"shader", "VRM/MToon"},
         {"floatProperties", {{"_OutlineWidthMode", 1}, {"_OutlineWidth", 0.5}}},
         {"textureProperties", {{"_OutlineWidthTexture", 7}}}}};
    const Scene scene = loaded(without);
    ASSERT_TRUE(scene.data().materials[1].outline);
    EXPECT_FLOAT_EQ(scene.data().materials[1].outline->width, 0.005f);
    EXPECT_TRUE(scene.data().meshes[0]->primitives[0].outlineWidths.empty());
    EXPECT_EQ(scene.warnings().size(), 1u);
  }
  // What is broken costs the outline alone.
  for (const Json& broken :
       {Json(3), Json{{"materialProperties", 1}}, Json{{"materialProperties", {1}}},
        Json{{"materialProperties", {{{"shader", "VRM/MToon"}, {"floatProperties", 7}}}}}}) {
    g.json["extensions"]["VRM"] = broken;
    const Scene scene = loaded(g);
    EXPECT_FALSE(scene.data().materials[1].outline) << broken;
  }
}

// Whole sets of colours: by a texture's number, as an object or alone, or by an image's name or file.
TEST(Scene, setsOfColoursFromExtras) {
  TestGltf g = quad();
  g.json["images"] = {
      {{"uri", "base.png"}}, {{"uri", "lit.png"}, {"name", "sail in light"}}, {{"uri", "dark.png"}}};
  g.json["textures"] = {{{"source", 0}}, {{"source", 2}, {"sampler", 0}}};
  g.json["samplers"] = {{{"wrapS", 33071}}};
  g.json["meshes"][0]["primitives"][0]["material"] = 0;
  const auto imagesUnder = [&](const Json& lit, const Json& shadowed) {
    g.json["materials"] = {
        {{"extras", {{"scumble_lit_texture", lit}, {"scumble_shadowed_texture", shadowed}}},
         {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    const Scene scene = loaded(g);
    const Material& m = scene.data().materials[1];
    const auto fileOf = [&](const TextureUse& use) {
      return use.image < 0 ? std::string() : scene.data().images[size_t(use.image)]->name;
    };
    EXPECT_EQ(fileOf(m.baseColorTexture), "base.png");
    const auto isOurs = [](const std::string& warning) {
      return warning.find("light or shadow") != warning.npos;
    };
    const auto warnings = scene.warnings();
    return std::tuple(fileOf(m.litTexture), fileOf(m.shadowedTexture), m.shadowedTexture.sampler.wrapU,
                      std::count_if(warnings.begin(), warnings.end(), isOurs));
  };
  const std::string lit = "sail in light", dark = "dark.png";
  const Wrap repeat = Wrap::repeat, clamped = Wrap::clampToEdge;
  EXPECT_EQ(imagesUnder(lit, {{"index", 1}}), std::tuple(lit, dark, clamped, 0));
  EXPECT_EQ(imagesUnder("lit.png", 1), std::tuple(lit, dark, clamped, 0));
  EXPECT_EQ(imagesUnder("base.png", dark), std::tuple(std::string("base.png"), dark, repeat, 0));
  // What is broken is left out, and said once.
  for (const Json& broken :
       {Json(2), Json(-1), Json(0.5), Json("nowhere"), Json(""), Json(true), Json(nullptr), Json::array(),
        Json::object(), Json({{"index", 2}}), Json({{"index", "a"}})})
    EXPECT_EQ(imagesUnder(broken, broken), std::tuple(std::string(), std::string(), repeat, 1)) << broken;
}

TEST(Scene, tooManyLightsAreSaid) {
  TestGltf g = quad();
  g.json["extensionsUsed"] = {"KHR_lights_punctual"};
  g.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  for (int i = 0; i < 256; ++i) {
    g.json["scenes"][0]["nodes"].push_back(g.json["nodes"].size());
    g.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  }
  EXPECT_EQ(loaded(g).warnings().size(), 0u);
  g.json["scenes"][0]["nodes"].push_back(g.json["nodes"].size());
  g.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  EXPECT_EQ(loaded(g).warnings().size(), 1u);
}

TEST(Scene, specularGlossinessGivesItsDiffuse) {
  TestGltf g = quad();
  g.json["materials"] = {
      {{"extensions", {{"KHR_materials_pbrSpecularGlossiness", {{"diffuseFactor", {0, 1, 0, 1}}}}}}}};
  g.json["meshes"][0]["primitives"][0]["material"] = 0;
  EXPECT_EQ(loaded(g).data().materials[1].baseColor, glm::vec4(0, 1, 0, 1));
}

TEST(Scene, nodesComeParentsFirstAndMatricesAreTakenApart) {
  TestGltf g = quad();
  g.json["nodes"] = {{{"mesh", 0}, {"matrix", {0, 0, -2, 0, 0, 3, 0, 0, 4, 0, 0, 0, 5, 6, 7, 1}}},
                     {{"children", {0}}, {"scale", {-1, 1, 1}}},
                     {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}};
  g.json["scenes"] = {{{"nodes", {1, 2}}}};
  const Scene scene = loaded(g);
  const auto& nodes = scene.data().nodes;
  ASSERT_EQ(nodes.size(), 3u);
  for (size_t i = 0; i < nodes.size(); ++i) EXPECT_LT(nodes[i].parent, static_cast<int>(i));
  EXPECT_TRUE(nodes[1].localMatrix.has_value());  // it shears
  EXPECT_FALSE(nodes[2].localMatrix.has_value());
  EXPECT_EQ(nodes[2].local.translation, glm::dvec3(5, 6, 7));
  const glm::mat4 world = worldMatrices(scene.data())[2];
  EXPECT_LT(glm::length(glm::vec3(world * glm::vec4(1, 1, 0, 1)) - glm::vec3(-5, 9, 5)), 1e-4f);
}

TEST(Scene, choosesAmongScenes) {
  TestGltf g = quad();
  g.json["nodes"].push_back({{"mesh", 0}, {"translation", {10, 0, 0}}});
  g.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
  g.json["scene"] = 1;
  EXPECT_FLOAT_EQ(static_cast<float>(loaded(g).summary().min[0]), 10.0f);
  SceneOptions options;
  options.scene = 0;
  EXPECT_FLOAT_EQ(static_cast<float>(loaded(g, options).summary().min[0]), 0.0f);
  options.scene = 2;
  const std::string text = g.glb();
  EXPECT_FALSE(Scene::loadFromMemory(text.data(), text.size(), "x", "", options).ok());
}

TEST(Scene, instances) {
  TestGltf g = quad();
  g.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", g.addFloats({0, 0, 0, 5, 0, 0}, 3)}, {"SCALE", g.addFloats({1, 1, 1, 2, 2, 2}, 3)}};
  const Scene scene = loaded(g);
  ASSERT_EQ(scene.data().nodes[0].instances.size(), 2u);
  EXPECT_FLOAT_EQ(static_cast<float>(scene.summary().max[0]), 7.0f);
}

TEST(Scene, camerasAndLights) {
  TestGltf g = quad();
  g.json["cameras"] = {
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", 1}, {"znear", 0}, {"zfar", 9}}}},
      {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
  g.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "spot"}, {"intensity", 3}, {"spot", {{"outerConeAngle", 0.5}}}}};
  g.json["nodes"].push_back({{"name", "eye"}, {"camera", 1}});
  g.json["nodes"].push_back({{"name", "lamp"}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  g.json["scenes"][0]["nodes"] = {0, 1, 2};
  const Scene scene = loaded(g);
  EXPECT_EQ(scene.summary().cameras, std::vector<std::string>{"eye"});  // the other is on no node
  EXPECT_EQ(scene.summary().lights, std::vector<std::string>{"lamp"});
  EXPECT_FLOAT_EQ(scene.data().cameras[0].verticalFov, 0.5f);
  EXPECT_EQ(scene.data().cameras[0].far, 0.0f);
  EXPECT_EQ(scene.data().lights[0].kind, LightKind::spot);
  EXPECT_EQ(scene.data().nodes[1].camera, 0);
}

// KHR_lights_punctual: an inner angle of 0 and an outer one of a quarter of pi, where the file says nothing.
TEST(Scene, conesOfSpots) {
  TestGltf g = quad();
  TestGltf::Json& lights = g.json["extensions"]["KHR_lights_punctual"]["lights"];
  lights = {{{"type", "spot"}},
            {{"type", "spot"}, {"spot", TestGltf::Json::object()}},
            {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.25}}}},
            {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}},
            {{"type", "spot"}, {"spot", {{"innerConeAngle", 3}, {"outerConeAngle", 4}}}}};
  for (size_t i = 0; i < lights.size(); ++i) {
    g.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    g.json["scenes"][0]["nodes"].push_back(i + 1);
  }
  const double pi = 3.14159265358979;
  const double cones[][2] = {{0, pi / 4}, {0, pi / 4}, {0.25, pi / 4}, {0.25, 0.5}, {pi / 2, pi / 2}};
  const Scene scene = loaded(g);
  ASSERT_EQ(scene.data().lights.size(), std::size(cones));
  for (size_t i = 0; i < std::size(cones); ++i) {
    EXPECT_NEAR(scene.data().lights[i].innerCone, cones[i][0], 1e-6) << i;
    EXPECT_NEAR(scene.data().lights[i].outerCone, cones[i][1], 1e-6) << i;
  }
}

// A quad that follows one joint, with a morph target and a clip with unsorted, doubled and broken keys.
TestGltf animated() {
  TestGltf g = quad();
  Json& primitive = g.json["meshes"][0]["primitives"][0];
  primitive["attributes"]["JOINTS_0"] = g.add(std::vector<uint8_t>(16, 0), 5121, "VEC4", 4);
  primitive["attributes"]["WEIGHTS_0"] = g.addFloats({2, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, 4);
  primitive["targets"] = {{{"POSITION", g.addFloats(std::vector<float>(12, 0.5f), 3)}}};
  g.json["nodes"][0]["skin"] = 0;
  g.json["nodes"].push_back({{"translation", {0, 0, 7}}});
  g.json["scenes"][0]["nodes"].push_back(1);
  g.json["skins"] = {{{"joints", {1}}}};
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const int times = g.addFloats({2, 0, 1, 1, nan}, 1);
  const int values = g.addFloats({2, 0, 0, 0, 0, 0, 1, 0, 0, 9, 9, 9, 3, 3, 3}, 3);
  const int weights = g.addFloats({0, 1, 0.5f, 0.5f, 1}, 1);
  g.json["animations"] = {
      {{"name", "sway"},
       {"channels",
        {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}},
         {{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}},
         {{"sampler", 0}, {"target", {{"node", 1}, {"path", "rotation"}}}}}},
       {"samplers", {{{"input", times}, {"output", values}}, {{"input", times}, {"output", weights}}}}}};
  return g;
}

TEST(Scene, skinsMorphsAndClips) {
  const Scene scene = loaded(animated());
  const Primitive& p = scene.data().meshes[0]->primitives[0];
  ASSERT_EQ(p.influences, 4);
  for (size_t i = 0; i < p.vertexCount(); ++i)
    EXPECT_FLOAT_EQ(p.weights[4 * i] + p.weights[4 * i + 1] + p.weights[4 * i + 2] + p.weights[4 * i + 3],
                    1.0f);
  EXPECT_EQ(p.morphTargets.size(), 1u);
  EXPECT_EQ(scene.data().meshes[0]->morphWeights.size(), 1u);
  EXPECT_EQ(scene.data().skins[0].joints[0], 1);
  EXPECT_FLOAT_EQ(static_cast<float>(scene.summary().max[2]), 7.0f);  // where the joint is

  ASSERT_EQ(scene.data().clips.size(), 1u);
  const Clip& clip = scene.data().clips[0];
  EXPECT_EQ(clip.name, "sway");
  EXPECT_FLOAT_EQ(clip.duration, 2.0f);
  ASSERT_EQ(clip.channels.size(), 2u);  // the rotation has the wrong type
  EXPECT_EQ(clip.channels[0].times, (std::vector<float>{0, 1, 2}));
  EXPECT_EQ(clip.channels[0].values, (std::vector<float>{0, 0, 0, 1, 0, 0, 2, 0, 0}));
  EXPECT_EQ(clip.channels[1].componentsPerKey, 1);
}

// Joints, weights and displacements arrive as they were written: two sets of joints, indices of 16 bits,
// targets dense and sparse.
TEST(Scene, skinsOfEightAndSparseTargets) {
  TestGltf g = quad();
  Json& primitive = g.json["meshes"][0]["primitives"][0];
  std::vector<uint16_t> joints[2];
  std::vector<float> weights[2];
  for (int v = 0; v < 4; ++v)
    for (int k = 0; k < 8; ++k) {
      joints[k / 4].push_back(uint16_t((300 * k + v) % 1000));
      weights[k / 4].push_back(float(k + 1) / 36);
    }
  for (const int set : {0, 1}) {
    primitive["attributes"]["JOINTS_" + std::to_string(set)] = g.add(joints[set], 5123, "VEC4", 4);
    primitive["attributes"]["WEIGHTS_" + std::to_string(set)] = g.addFloats(weights[set], 4);
  }
  const int indices = g.addView<uint8_t>({1, 3}), values = g.addView<float>({1, 2, 3, 4, 5, 6});
  const int sparse = g.addAccessor(-1, 5126, "VEC3", 4);
  g.json["accessors"][size_t(sparse)]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
      {"values", {{"bufferView", values}}}};
  const int dense = g.addFloats({1, 0, 0, 2, 0, 0, 3, 0, 0, 4, 0, 0}, 3);
  primitive["targets"] = {{{"POSITION", sparse}}, {{"POSITION", dense}, {"NORMAL", dense}}, Json::object()};
  g.json["meshes"][0]["weights"] = {0.5, 0, 2};
  g.json["nodes"][0]["skin"] = 0;
  g.json["nodes"][0]["weights"] = {1, 0, 0};
  Json list = Json::array();
  for (int j = 0; j < 1000; ++j) {
    g.json["nodes"].push_back({{"translation", {0, 0, j}}});
    g.json["scenes"][0]["nodes"].push_back(j + 1);
    list.push_back(j + 1);
  }
  g.json["skins"] = {{{"joints", list}}};
  const Scene scene = loaded(g);
  EXPECT_TRUE(scene.warnings().empty());
  const Mesh& mesh = scene.data().meshes[0];
  const Primitive& p = mesh.primitives[0];
  ASSERT_EQ(p.influences, 8);
  ASSERT_EQ(p.vertexCount(), 4u);
  for (size_t i = 0; i < 32; ++i) {
    EXPECT_EQ(p.joints[i], (300 * (i % 8) + i / 8) % 1000);
    EXPECT_NEAR(p.weights[i], float(i % 8 + 1) / 36, 1e-6f);
  }
  ASSERT_EQ(p.morphTargets.size(), 3u);
  EXPECT_EQ(p.morphTargets[0].positions,
            (std::vector<glm::vec3>{{0, 0, 0}, {1, 2, 3}, {0, 0, 0}, {4, 5, 6}}));
  EXPECT_TRUE(p.morphTargets[0].normals.empty());
  EXPECT_EQ(p.morphTargets[1].normals[2], glm::vec3(3, 0, 0));
  EXPECT_TRUE(p.morphTargets[2].positions.empty());
  EXPECT_EQ(mesh.morphWeights, (std::vector<float>{0.5f, 0, 2}));
  EXPECT_EQ(scene.data().nodes[0].morphWeights, (std::vector<float>{1, 0, 0}));
  EXPECT_EQ(scene.data().skins[0].joints.size(), 1000u);
}

TEST(Scene, combineMovesEveryIndex) {
  const Scene one = loaded(animated()), two = loaded(quad()), both = Scene::combine({two, one, one});
  const SceneData& d = both.data();
  EXPECT_EQ(both.summary().triangles, 6u);
  EXPECT_EQ(d.nodes.size(), 5u);
  EXPECT_EQ(d.nodes[3].mesh, 2);
  EXPECT_EQ(d.nodes[3].skin, 1);
  EXPECT_EQ(d.skins[1].joints[0], 4);
  EXPECT_EQ(d.clips[1].channels[0].node, 4);
  EXPECT_EQ(d.meshes[2]->primitives[0].material, 2);
  EXPECT_EQ(d.materials.size(), 3u);
  EXPECT_EQ(both.warnings(), one.warnings());
  EXPECT_FLOAT_EQ(static_cast<float>(both.summary().max[2]), 7.0f);
  EXPECT_EQ(Scene::combine({}).summary().triangles, 0u);
  EXPECT_EQ(Scene().summary().triangles, 0u);
}

TEST(Scene, threadsDoNotChangeTheResult) {
  TestGltf g;
  for (int i = 0; i < 40; ++i) g.addQuad()["mode"] = i % 3 == 0 ? 1 : 4;
  SceneOptions one, many;
  one.threads = 1;
  many.threads = 8;
  const Scene a = loaded(g, one), b = loaded(g, many);
  EXPECT_EQ(a.warnings(), b.warnings());
  EXPECT_EQ(a.summary().triangles, b.summary().triangles);
}

// Loading tells how far it is, and stops where its caller wants to.
TEST(Scene, progressAndCancelling) {
  TestGltf g = quad();
  for (int i = 0; i < 6; ++i) g.addQuad();
  const std::string glb = g.glb();
  size_t calls = 0;
  for (size_t stopAt = 0;; ++stopAt) {
    double last = 0;
    calls = 0;
    SceneOptions options;
    options.threads = 3;
    options.progress = [&](double part) {
      EXPECT_GE(part, last);
      EXPECT_LE(part, 1);
      last = part;
      return ++calls <= stopAt;
    };
    const Result<Scene> scene = Scene::loadFromMemory(glb.data(), glb.size(), "a.glb", "", options);
    if (scene) {
      EXPECT_EQ(last, 1);
      break;
    }
    ASSERT_EQ(scene.error().kind, ErrorKind::cancelled);
    EXPECT_EQ(calls, stopAt + 1) << "nobody asks again";
  }
  EXPECT_GT(calls, 10u);
}

// Strokes: LINE_STRIPs that say how wide they are. What is broken besides that is left out; other lines are.
TEST(Scene, strokesAreRead) {
  const auto scene = [](const std::function<void(TestGltf&, TestGltf::Json&)>& change) {
    TestGltf gltf;
    gltf.addQuad();
    TestGltf::Json stroke = {{"mode", 3}, {"extras", {{"scumble_brush", "wash"}}}};
    auto& attributes = stroke["attributes"];
    attributes["POSITION"] = gltf.addFloats({0, 0, 1, 1, 0, 1, 1, 2, 1}, 3);
    attributes["_RADIUS"] = gltf.addFloats({0.1f, 0.2f, 0.3f}, 1);
    attributes["COLOR_0"] =
        gltf.add(std::vector<uint8_t>{255, 0, 51, 255, 0, 0, 255, 0, 0}, 5121, "VEC3", 3, true);
    attributes["_ORIENTATION"] = gltf.addFloats({0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}, 4);
    attributes["_TIME"] = gltf.addFloats({3, 4, 5}, 1);
    change(gltf, stroke);
    gltf.json["meshes"][0]["primitives"].push_back(stroke);
    const std::string text = gltf.gltf();
    return Scene::loadFromMemory(text.data(), text.size(), "strokes.gltf", "");
  };
  const auto whole = scene([](TestGltf&, TestGltf::Json&) {});
  ASSERT_TRUE(whole) << whole.error().message();
  EXPECT_TRUE(whole->warnings().empty());
  ASSERT_TRUE(whole->data().meshes[0]->painting);
  EXPECT_EQ(whole->data().meshes[0]->primitives.size(), 1u);
  const Painting& painting = *whole->data().meshes[0]->painting;
  ASSERT_EQ(painting.points.size(), 3u);
  EXPECT_EQ(painting.strokes[0].brush, Brush::wash);
  EXPECT_EQ(painting.points[2].position, glm::vec3(1, 2, 1));
  EXPECT_FLOAT_EQ(painting.points[1].radius, 0.2f);
  EXPECT_FLOAT_EQ(painting.points[0].color.b, 0.2f);
  EXPECT_FLOAT_EQ(painting.points[0].color.a, 1);
  EXPECT_FLOAT_EQ(painting.points[0].orientation.y, 1);
  EXPECT_FLOAT_EQ(painting.points[1].orientation.w, 1);
  EXPECT_FLOAT_EQ(painting.points[2].time, 5);
  EXPECT_NEAR(painting.hull.extent.box.max.y, 2.3, 1e-6);

  // One warning each, and the stroke stays.
  const std::function<void(TestGltf&, TestGltf::Json&)> soft[] = {
      [](TestGltf& g, TestGltf::Json& s) {
        s["attributes"]["COLOR_0"] = g.addFloats({1, 1, 1, 1}, 4);
      },
      [](TestGltf& g, TestGltf::Json& s) {
        s["attributes"]["_TIME"] = g.addFloats({1, 2, 3}, 3);
      },
      [](TestGltf&, TestGltf::Json& s) { s["attributes"]["_ORIENTATION"] = 99; },
      [](TestGltf&, TestGltf::Json& s) { s["extras"]["scumble_brush"] = "broom"; },
      [](TestGltf& g, TestGltf::Json& s) {
        s["attributes"]["_RADIUS"] = g.addFloats({0.1f, 0, 0.2f}, 1);
      },
      [](TestGltf& g, TestGltf::Json& s) {
        s["indices"] = g.addIndices({0, 1, 2});
      }};
  for (const auto& change : soft) {
    const auto changed = scene(change);
    ASSERT_TRUE(changed) << changed.error().message();
    EXPECT_EQ(changed->warnings().size(), 1u);
    EXPECT_TRUE(changed->data().meshes[0]->painting);
  }
  // Extras of others are theirs.
  for (const TestGltf::Json& extras :
       {TestGltf::Json(3), TestGltf::Json{{"scumble_brush", 7}}, TestGltf::Json::array()}) {
    const auto changed = scene([&](TestGltf&, TestGltf::Json& s) { s["extras"] = extras; });
    ASSERT_TRUE(changed);
    EXPECT_TRUE(changed->warnings().empty());
  }
  // Lines without widths, and strokes that are nowhere, are left out.
  const auto lines = scene([](TestGltf&, TestGltf::Json& s) { s["attributes"].erase("_RADIUS"); });
  ASSERT_TRUE(lines);
  EXPECT_FALSE(lines->data().meshes[0]->painting);
  EXPECT_EQ(lines->warnings().size(), 1u);
  const auto thin = scene([](TestGltf& g, TestGltf::Json& s) {
    s["attributes"]["_RADIUS"] = g.addFloats({0, -1, 0}, 1);
  });
  ASSERT_TRUE(thin);
  EXPECT_FALSE(thin->data().meshes[0]->painting);
  EXPECT_EQ(thin->warnings().size(), 1u);
  // What a stroke cannot do without must be sound.
  EXPECT_FALSE(scene([](TestGltf& g, TestGltf::Json& s) {
    s["attributes"]["_RADIUS"] = g.addFloats({1, 2}, 1);
  }));
  EXPECT_FALSE(scene([](TestGltf&, TestGltf::Json& s) { s["attributes"]["POSITION"] = 77; }));
}

}  // namespace
}  // namespace scumble::scene
