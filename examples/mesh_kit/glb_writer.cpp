#include "mesh_kit/glb_writer.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

namespace meshkit {
namespace {

using Json = nlohmann::ordered_json;

// glTF's numbers for what a buffer view is bound as, and for component types.
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963, kNoTarget = 0;
constexpr int kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;

static_assert(std::endian::native == std::endian::little, "GLB is little-endian");

std::array<double, 3> srgbHexToLinear(const std::string& hex) {
  std::array<double, 3> color{};
  for (size_t i = 0; i < 3; ++i) {
    const double s = std::stoi(hex.substr(1 + 2 * i, 2), nullptr, 16) / 255.0;
    const double linear = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    color[i] = std::round(linear * 1e6) / 1e6;  // six digits say all that eight bits hold
  }
  return color;
}

class Writer {
 public:
  explicit Writer(const Document& document) : document_(document) {}

  Json json(const std::string& generator) {
    root_["asset"] = {{"version", "2.0"}, {"generator", generator}};
    root_["extensionsUsed"] = {"KHR_lights_punctual"};
    for (const Material& m : document_.materials) addMaterial(m);
    for (const Mesh& m : document_.meshes) addMesh(m);
    for (const Camera& c : document_.cameras) {
      root_["cameras"].push_back(
          {{"name", c.name},
           {"type", "perspective"},
           {"perspective",
            {{"yfov", c.verticalFov}, {"aspectRatio", c.aspect}, {"znear", c.near}, {"zfar", c.far}}}});
    }
    for (const Skin& s : document_.skins) addSkin(s);
    for (const Clip& c : document_.clips) addClip(c);
    addNodes();
    root_["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
    return root_;
  }

  const std::vector<char>& bytes() const { return bytes_; }

 private:
  void addMaterial(const Material& m) {
    const auto lit = srgbHexToLinear(m.lit);
    Json material = {{"name", m.name},
                     {"pbrMetallicRoughness",
                      {{"baseColorFactor", {lit[0], lit[1], lit[2], 1.0}},
                       {"metallicFactor", 0.0},
                       {"roughnessFactor", 1.0}}}};
    if (!m.emissive.empty()) material["emissiveFactor"] = srgbHexToLinear(m.emissive);
    if (m.doubleSided) material["doubleSided"] = true;
    material["extras"] = {{"scumble_shadowed", m.shadowed}};
    root_["materials"].push_back(material);
  }

  // Appends to the buffer, returns the index of the new buffer view.
  size_t addView(const void* data, size_t size, int target) {
    const size_t offset = bytes_.size();
    bytes_.insert(bytes_.end(), static_cast<const char*>(data), static_cast<const char*>(data) + size);
    bytes_.resize((bytes_.size() + 3) & ~size_t(3));
    Json view = {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}};
    if (target != kNoTarget) view["target"] = target;
    root_["bufferViews"].push_back(std::move(view));
    return root_["bufferViews"].size() - 1;
  }

  size_t addAccessor(size_t view, int componentType, size_t count, const char* type) {
    root_["accessors"].push_back(
        {{"bufferView", view}, {"componentType", componentType}, {"count", count}, {"type", type}});
    return root_["accessors"].size() - 1;
  }

  template <class Item, class Pick>
  size_t addAttribute(const std::vector<Item>& items, Pick pick, const char* type, int component = kFloat) {
    std::vector<std::decay_t<decltype(pick(items.front()))>> values;
    values.reserve(items.size());
    for (const Item& item : items) values.push_back(pick(item));
    const size_t view = addView(values.data(), values.size() * sizeof(values.front()), kArrayBuffer);
    return addAccessor(view, component, values.size(), type);
  }

  // Positions, for which glTF wants the range said.
  template <class Item>
  size_t addPositions(const std::vector<Item>& items) {
    glm::vec3 low = items.front().position, high = low;
    for (const Item& item : items) {
      low = glm::min(low, item.position);
      high = glm::max(high, item.position);
    }
    const size_t position = addAttribute(
        items, [](const Item& item) { return item.position; }, "VEC3");
    root_["accessors"][position]["min"] = {low.x, low.y, low.z};
    root_["accessors"][position]["max"] = {high.x, high.y, high.z};
    return position;
  }

  Json attributes(const Primitive& p, bool bound) {
    Json json = {{"POSITION", addPositions(p.vertices)}};
    json["NORMAL"] = addAttribute(
        p.vertices, [](const Vertex& v) { return v.normal; }, "VEC3");
    json["TEXCOORD_0"] = addAttribute(
        p.vertices, [](const Vertex& v) { return v.uv; }, "VEC2");
    if (bound) {
      json["JOINTS_0"] = addAttribute(
          p.vertices, [](const Vertex& v) { return v.binding.joints; }, "VEC4", kUnsignedShort);
      json["WEIGHTS_0"] = addAttribute(
          p.vertices, [](const Vertex& v) { return v.binding.weights; }, "VEC4");
    }
    return json;
  }

  size_t addIndices(const Primitive& p) {
    // 65535 would be the primitive restart value.
    if (p.vertices.size() < 65535) {
      const std::vector<uint16_t> small(p.indices.begin(), p.indices.end());
      return addAccessor(addView(small.data(), small.size() * 2, kElementArrayBuffer), kUnsignedShort,
                         small.size(), "SCALAR");
    }
    return addAccessor(addView(p.indices.data(), p.indices.size() * 4, kElementArrayBuffer), kUnsignedInt,
                       p.indices.size(), "SCALAR");
  }

  void addMesh(const Mesh& mesh) {
    Json primitives = Json::array();
    for (const Primitive& p : mesh.primitives) {
      if (p.indices.empty()) continue;
      Json primitive = {{"attributes", attributes(p, mesh.bound)}, {"indices", addIndices(p)}};
      primitive["material"] = p.material;
      for (const std::vector<VertexChange>& target : p.targets) {
        const size_t normal = addAttribute(
            target, [](const VertexChange& c) { return c.normal; }, "VEC3");
        primitive["targets"].push_back({{"POSITION", addPositions(target)}, {"NORMAL", normal}});
      }
      primitives.push_back(std::move(primitive));
    }
    Json json = {{"name", mesh.name}, {"primitives", std::move(primitives)}};
    if (!mesh.weights.empty()) json["weights"] = mesh.weights;
    root_["meshes"].push_back(std::move(json));
  }

  void addSkin(const Skin& skin) {
    const size_t view =
        addView(skin.inverseBinds.data(), skin.inverseBinds.size() * sizeof(glm::mat4), kNoTarget);
    root_["skins"].push_back(
        {{"name", skin.name},
         {"inverseBindMatrices", addAccessor(view, kFloat, skin.inverseBinds.size(), "MAT4")},
         {"joints", skin.joints}});
  }

  // Channels that have their keys at the same moments share them.
  size_t addTimes(const std::vector<float>& times) {
    const auto [found, isNew] = times_.try_emplace(times, 0);
    if (isNew) {
      const size_t view = addView(times.data(), times.size() * sizeof(float), kNoTarget);
      found->second = addAccessor(view, kFloat, times.size(), "SCALAR");
      root_["accessors"][found->second]["min"] = {times.front()};
      root_["accessors"][found->second]["max"] = {times.back()};
    }
    return found->second;
  }

  void addClip(const Clip& clip) {
    static constexpr const char* kPaths[] = {"translation", "rotation", "scale", "weights"};
    static constexpr const char* kInterpolations[] = {"LINEAR", "STEP", "CUBICSPLINE"};
    static constexpr const char* kTypes[] = {"VEC3", "VEC4", "VEC3", "SCALAR"};
    static constexpr size_t kSizes[] = {3, 4, 3, 1};
    Json channels = Json::array(), samplers = Json::array();
    for (const Channel& c : clip.channels) {
      const size_t path = size_t(c.path);
      const size_t input = addTimes(c.times);
      const size_t view = addView(c.values.data(), c.values.size() * sizeof(float), kNoTarget);
      const size_t output = addAccessor(view, kFloat, c.values.size() / kSizes[path], kTypes[path]);
      channels.push_back(
          {{"sampler", samplers.size()}, {"target", {{"node", c.node}, {"path", kPaths[path]}}}});
      samplers.push_back({{"input", input},
                          {"interpolation", kInterpolations[size_t(c.interpolation)]},
                          {"output", output}});
    }
    root_["animations"].push_back(
        {{"name", clip.name}, {"channels", std::move(channels)}, {"samplers", std::move(samplers)}});
  }

  void addNodes() {
    Json roots = Json::array();
    std::vector<Json> children(document_.nodes.size(), Json::array());
    for (size_t i = 0; i < document_.nodes.size(); ++i) {
      const int parent = document_.nodes[i].parent;
      (parent < 0 ? roots : children[size_t(parent)]).push_back(i);
    }
    for (size_t i = 0; i < document_.nodes.size(); ++i) {
      const Node& n = document_.nodes[i];
      Json node = {{"name", n.name}};
      if (n.translation != glm::vec3(0.0f))
        node["translation"] = {n.translation.x, n.translation.y, n.translation.z};
      if (n.rotation != glm::quat(1, 0, 0, 0))
        node["rotation"] = {n.rotation.x, n.rotation.y, n.rotation.z, n.rotation.w};
      if (n.scale != glm::vec3(1.0f)) node["scale"] = {n.scale.x, n.scale.y, n.scale.z};
      if (n.mesh >= 0) node["mesh"] = n.mesh;
      if (n.skin >= 0) node["skin"] = n.skin;
      if (n.camera >= 0) node["camera"] = n.camera;
      if (n.sun) node["extensions"]["KHR_lights_punctual"]["light"] = 0;
      if (!children[i].empty()) node["children"] = children[i];
      if (!n.extras.empty()) node["extras"] = Json::parse(n.extras);
      root_["nodes"].push_back(node);
    }
    root_["extensions"]["KHR_lights_punctual"]["lights"] =
        Json::array({{{"name", "Sun"},
                      {"type", "directional"},
                      {"color", {document_.sunColor.x, document_.sunColor.y, document_.sunColor.z}},
                      {"intensity", document_.sunIntensity}}});
    root_["scenes"] = Json::array({{{"nodes", roots}}});
    root_["scene"] = 0;
  }

  const Document& document_;
  Json root_;
  std::vector<char> bytes_;
  std::map<std::vector<float>, size_t> times_;
};

void append32(std::vector<char>& out, uint32_t value) {
  const char* bytes = reinterpret_cast<const char*>(&value);
  out.insert(out.end(), bytes, bytes + 4);
}

}  // namespace

std::string writeGlb(const Document& document, const std::string& path, const std::string& generator) {
  Writer writer(document);
  std::string json = writer.json(generator).dump();
  json.resize((json.size() + 3) & ~size_t(3), ' ');
  const std::vector<char>& binary = writer.bytes();

  std::vector<char> head;
  append32(head, 0x46546C67);  // "glTF"
  append32(head, 2);
  append32(head, uint32_t(12 + 8 + json.size() + 8 + binary.size()));
  append32(head, uint32_t(json.size()));
  append32(head, 0x4E4F534A);  // "JSON"
  head.insert(head.end(), json.begin(), json.end());
  append32(head, uint32_t(binary.size()));
  append32(head, 0x004E4942);  // "BIN"

  const std::string beside = path + ".part";
  {
    std::ofstream file(beside, std::ios::binary);
    file.write(head.data(), std::streamsize(head.size()));
    file.write(binary.data(), std::streamsize(binary.size()));
    file.close();
    if (!file) {
      std::remove(beside.c_str());
      return path + ": cannot be written";
    }
  }
  std::error_code error;
  std::filesystem::rename(beside, path, error);
  if (error) {
    std::remove(beside.c_str());
    return path + ": " + error.message();
  }
  return {};
}

int generate(int argc, char** argv, const char* name, Document (*makeScene)()) {
  if (argc != 2 || argv[1][0] == '-') {
    std::fprintf(stderr, "usage: %s OUT.glb\n", name);
    return 2;
  }
  const Document document = makeScene();
  const std::string problem = writeGlb(document, argv[1], std::string("scumble ") + name);
  if (!problem.empty()) {
    std::fprintf(stderr, "%s: error: %s\n", name, problem.c_str());
    return 5;
  }
  std::printf("%s: %zu triangles, %zu meshes, %zu materials\n", argv[1], document.triangleCount(),
              document.meshes.size(), document.materials.size());
  return 0;
}

}  // namespace meshkit
