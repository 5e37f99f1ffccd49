// libFuzzer target for the glTF importer: any bytes as a file in memory, with no folder to read from. What it
// may find are sanitizer reports, data that breaks the promises of scene_data.h,
// and poses that are not finite.
//
//   CC=clang-14 CXX=clang++-14 cmake -S . -B build-fuzz -G Ninja -DSCUMBLE_FUZZ=ON -DSCUMBLE_SANITIZE=ON
//   ninja -C build-fuzz gltf_fuzz && mkdir -p build-fuzz/corpus-gltf_fuzz
//   build-fuzz/gltf_fuzz --write-seeds=build-fuzz/corpus-gltf_fuzz
//   build-fuzz/gltf_fuzz -dict=tests/fuzz/gltf.dict -max_total_time=60 -timeout=20 -rss_limit_mb=4096
//   build-fuzz/corpus-gltf_fuzz
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "features/ocean/extras.h"
#include "scene/posed_bounds.h"
#include "scene/scene_data.h"
#include "scumble/scene.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/support/test_gltf.h"

// The list of features is not linked; what nodes may say to one of them is.
const std::vector<scumble::scene::ExtraRule>& scumble::scene::extraRules() {
  static const std::vector<ExtraRule> rules = ocean::extraRules();
  return rules;
}

namespace {

using namespace scumble;
using namespace scumble::scene;
using fuzz::require;

bool isFinite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void checkPrimitive(const Primitive& p, const SceneData& scene) {
  const size_t n = p.vertexCount();
  require(!p.indices.empty() && p.indices.size() % 3 == 0, "whole triangles");
  for (const uint32_t index : p.indices) require(index < n, "index");
  require(p.normals.size() == n && p.smoothNormals.size() == n && p.uv0.size() == n && p.dPdu.size() == n &&
              p.dPdv.size() == n,
          "array sizes");
  require((p.uv1.empty() || p.uv1.size() == n) && (p.colors.empty() || p.colors.size() == n),
          "optional arrays");
  require(p.joints.size() == n * p.influences && p.weights.size() == n * p.influences, "skinning arrays");
  require(p.material >= 0 && static_cast<size_t>(p.material) < scene.materials.size(), "material");
  for (size_t i = 0; i < n; ++i) {
    require(isFinite(p.positions[i]) && isFinite(p.dPdu[i]) && isFinite(p.dPdv[i]), "finite");
    require(std::isfinite(p.uv0[i].x) && std::isfinite(p.uv0[i].y), "finite uv");
    require(std::abs(glm::length(p.normals[i]) - 1.0f) < 1e-3f, "unit normal");
    require(std::abs(glm::length(p.smoothNormals[i]) - 1.0f) < 1e-3f, "unit smooth normal");
  }
  for (const MorphTarget& target : p.morphTargets)
    require((target.positions.empty() || target.positions.size() == n) &&
                (target.normals.empty() || target.normals.size() == n),
            "morph targets");
}

void check(const SceneData& scene) {
  require(!scene.bounds.empty && isFinite(scene.bounds.min) && isFinite(scene.bounds.max), "bounds");
  for (const Mesh& mesh : scene.meshes)
    for (const Primitive& p : mesh.primitives) checkPrimitive(p, scene);
  const auto inRange = [](int index, size_t size) { return index < static_cast<int>(size); };
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    require(node.parent < static_cast<int>(i), "parents first");
    require(inRange(node.mesh, scene.meshes.size()) && inRange(node.camera, scene.cameras.size()) &&
                inRange(node.light, scene.lights.size()) && inRange(node.skin, scene.skins.size()),
            "node indices");
    require(
        node.morphWeights.empty() || node.morphWeights.size() == scene.meshes[node.mesh]->morphWeights.size(),
        "morph weights");
    if (const std::optional<ocean::Floats> floats = ocean::floatsOf(node))
      for (const std::optional<float>& size : {floats->length, floats->beam})
        require(!size || (*size >= 0 && *size <= 1000), "sizes of what floats");
  }
  for (const Material& m : scene.materials)
    require(inRange(m.baseColorTexture.image, scene.images.size()) &&
                inRange(m.emissiveTexture.image, scene.images.size()) &&
                inRange(m.litTexture.image, scene.images.size()) &&
                inRange(m.shadowedTexture.image, scene.images.size()),
            "images");
  for (const TextureImage& image : scene.images)
    require(
        image.rgba.size() == size_t(image.width) * image.height * 4 && image.width > 0 && image.height > 0,
        "image");
  for (const Clip& clip : scene.clips)
    for (const Channel& channel : clip.channels) {
      require(channel.node >= 0 && inRange(channel.node, scene.nodes.size()), "channel node");
      const size_t perKey =
          channel.componentsPerKey * (channel.interpolation == ChannelInterpolation::cubicSpline ? 3 : 1);
      require(!channel.times.empty() && channel.values.size() == channel.times.size() * perKey,
              "channel sizes");
      for (size_t i = 1; i < channel.times.size(); ++i)
        require(channel.times[i] > channel.times[i - 1], "times");
    }
  for (const Skin& skin : scene.skins) {
    require(skin.joints.size() == skin.inverseBindMatrices.size(), "skin");
    for (const int joint : skin.joints) require(joint >= 0 && inRange(joint, scene.nodes.size()), "joint");
  }
}

// Clips at some times: matrices are finite (zero where they could not be), and so is what holds them.
void checkPoses(const SceneData& scene) {
  std::vector<int> all;
  std::vector<PlayedClip> played;
  for (size_t c = 0; c < std::min<size_t>(scene.clips.size(), 4); ++c) {
    all.push_back(static_cast<int>(c));
    played.push_back({static_cast<int>(c), 0.4f, c % 2 ? -1.5 : 1.0, 0.1, Repeat(c % 3)});
  }
  for (const double time : {-1.5, 0.0, 0.3, 1.0, 1e6}) {
    const Pose pose = poseAt(scene, played, time);
    require(pose.world.size() == scene.nodes.size() && pose.morphWeights.size() == scene.nodes.size(),
            "a pose of every node");
    for (const glm::mat4& world : pose.world)
      for (int column = 0; column < 4; ++column)
        require(isFinite(glm::vec3(world[column])) && std::isfinite(world[column].w), "finite pose");
    for (size_t n = 0; n < scene.nodes.size(); ++n) {
      const int mesh = scene.nodes[n].mesh;
      require(mesh < 0 || pose.morphWeights[n].size() == scene.meshes[mesh]->morphWeights.size(),
              "a weight for every target");
      for (const float weight : pose.morphWeights[n]) require(std::isfinite(weight), "finite weights");
    }
  }
  const Bounds bounds = playedBounds(scene, all);
  require(!bounds.empty && isFinite(bounds.min) && isFinite(bounds.max), "bounds of what plays");
}

}  // namespace

void scumble::fuzz::writeSeeds(const std::string& folder) {
  TestGltf quad;
  quad.addQuad();
  write(folder, "quad.gltf", quad.gltf());
  write(folder, "quad.glb", quad.glb());

  TestGltf rich;
  rich.addQuad()["targets"] =
      TestGltf::Json::array({{{"POSITION", rich.addFloats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 3)}}});
  auto& attributes = rich.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = rich.add(std::vector<uint8_t>(16, 0), 5121, "VEC4", 4);
  attributes["WEIGHTS_0"] = rich.addFloats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 4);
  attributes["COLOR_0"] = rich.add(std::vector<uint8_t>(16, 200), 5121, "VEC4", 4, true);
  rich.json["meshes"][0]["weights"] = {0.5};
  rich.json["nodes"].push_back({{"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  rich.json["scenes"][0]["nodes"].push_back(1);
  rich.json["nodes"][0]["skin"] = 0;
  rich.json["nodes"][0]["extras"] = {{"scumble_float", {{"length", 4.6}, {"beam", 1.8}, {"bow", "z"}}}};
  rich.json["nodes"][1]["extras"] = {{"scumble_ocean", true}};
  rich.json["skins"] = {{{"joints", {1}}}};
  rich.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
  rich.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "spot"}, {"spot", TestGltf::Json::object()}}};
  const int times = rich.addFloats({0, 1, 2}, 1), values = rich.addFloats({0, 0, 0, 1, 1, 1, 2, 0, 0}, 3);
  const int weights = rich.addFloats({0, 1, 0}, 1);
  rich.json["animations"] = {
      {{"channels",
        {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}},
         {{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
       {"samplers", {{{"input", times}, {"output", values}}, {{"input", times}, {"output", weights}}}}}};
  write(folder, "rich.glb", rich.glb());
  write(folder, "rich.gltf", rich.gltf());

  // Every property and interpolation, eight influences, instances, several clips.
  TestGltf moving;
  auto& primitive = moving.addQuad();
  for (const char* set : {"0", "1"}) {
    primitive["attributes"][std::string("JOINTS_") + set] =
        moving.add(std::vector<uint16_t>(16, 0), 5123, "VEC4", 4);
    primitive["attributes"][std::string("WEIGHTS_") + set] =
        moving.addFloats(std::vector<float>(16, 0.125f), 4);
  }
  const int displaced = moving.addFloats(std::vector<float>(12, 0.25f), 3);
  primitive["targets"] = {{{"POSITION", displaced}, {"NORMAL", displaced}}, {{"POSITION", displaced}}};
  moving.json["nodes"][0]["skin"] = 0;
  moving.json["nodes"].push_back({{"children", {2}}});
  moving.json["nodes"].push_back({{"mesh", 0}, {"weights", {0.5, 1}}});
  moving.json["nodes"][2]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] =
      moving.addFloats({1, 1, 1, 2, 2, 2}, 3);
  moving.json["scenes"][0]["nodes"].push_back(1);
  moving.json["skins"] = {{{"joints", {1, 2}}}};
  const int keys = moving.addFloats({0, 0.5f, 2}, 1);
  for (const char* interpolation : {"LINEAR", "STEP", "CUBICSPLINE"}) {
    const size_t parts = interpolation[0] == 'C' ? 9 : 3;
    TestGltf::Json clip = {{"name", interpolation}};
    for (const auto& [path, components] :
         {std::pair{"translation", 3}, {"rotation", 4}, {"scale", 3}, {"weights", 2}}) {
      std::vector<float> numbers;
      for (size_t i = 0; i < parts * size_t(components); ++i) numbers.push_back(0.3f * float(i % 5) + 0.1f);
      const int output = moving.addFloats(numbers, components == 2 ? 1 : components);
      clip["samplers"].push_back({{"input", keys}, {"output", output}, {"interpolation", interpolation}});
      clip["channels"].push_back({{"sampler", clip["samplers"].size() - 1},
                                  {"target", {{"node", components == 2 ? 2 : 1}, {"path", path}}}});
    }
    moving.json["animations"].push_back(clip);
  }
  write(folder, "moving.glb", moving.glb());
  write(folder, "moving.gltf", moving.gltf());

  TestGltf sparse;
  sparse.addQuad();
  const int view = sparse.addView<uint8_t>({1}), moved = sparse.addView<float>({2, 0, 0});
  sparse.json["accessors"][0]["sparse"] = {{"count", 1},
                                           {"indices", {{"bufferView", view}, {"componentType", 5121}}},
                                           {"values", {{"bufferView", moved}}}};
  sparse.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      sparse.addFloats({0, 0, 0, 3, 0, 0}, 3);
  sparse.addImage({0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0, 0, 0, 13, 'I',  'H',  'D',  'R', 0,
                   0,    0,   1,   0,   0,    0,    1,    8,    2, 0, 0, 0,  0x90, 0x77, 0x53, 0xde});
  write(folder, "sparse.glb", sparse.glb());
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  SceneOptions options;
  options.threads = 1;
  const Result<Scene> scene = Scene::loadFromMemory(bytes, size, "fuzz.gltf", "", options);
  if (scene) {
    check(scene->data());
    checkPoses(scene->data());
  } else {
    require(scene.error().kind == ErrorKind::unusableFile && !scene.error().problem.empty(),
            "an error that says something");
  }
  return 0;
}
