#include "gltf/add_fins.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "gltf/rewrite.h"

namespace scumble::gltf {

namespace {

constexpr const char* kUnlit = "KHR_materials_unlit";

template <class T>
Bytes bytesOf(const std::vector<T>& values) {
  return {reinterpret_cast<const uint8_t*>(values.data()), values.size() * sizeof(T)};
}

class PaintWriter {
 public:
  PaintWriter(Rewrite& file, Json& mesh, const Mesh& own) : file_(file), mesh_(mesh), own_(own) {}

  void add(const PaintedMesh& painted) {
    Json image = {{"name", own_.name + " paint"}, {"mimeType", "image/png"}};
    image["bufferView"] = file_.addView(painted.picture);
    const size_t sampler =
        file_.add("samplers", {{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", 33071}, {"wrapT", 33071}});
    const size_t texture =
        file_.add("textures", {{"source", file_.add("images", image)}, {"sampler", sampler}});
    for (const PaintPart& part : painted.parts) add(part, texture);
    addOrders(painted);
    file_.useExtension(kUnlit);
  }

 private:
  void add(const PaintPart& part, size_t texture) {
    Json primitive = {{"attributes", Json::object()}};
    Json& attributes = primitive["attributes"];
    attributes["POSITION"] = addPoints(part.positions, true);
    attributes["NORMAL"] = addPoints(part.normals, false);
    attributes["TEXCOORD_0"] =
        addAccessor(bytesOf(part.uvs), kFloatType, "VEC2", part.uvs.size(), 8, kVertexData);
    primitive["indices"] =
        addAccessor(bytesOf(part.indices), kIntType, "SCALAR", part.indices.size(), 0, kIndexData);
    addSkin(part, attributes);
    addTargets(part, primitive);
    primitive["material"] = file_.add("materials", materialOf(part, texture));
    mesh_["primitives"].push_back(std::move(primitive));
  }

  // Accessors that only extras name, as index lists; by their names, since tools count accessors anew and
  // leave extras as they are.
  void addOrders(const PaintedMesh& painted) {
    if (painted.orders.empty()) return;
    size_t vertices = 0;
    for (const PaintPart& part : painted.parts) vertices += part.positions.size();
    Json orders = Json::array();
    for (const PaintOrder& order : painted.orders) {
      const std::vector<uint16_t> shorts(order.indices.begin(), order.indices.end());
      const bool fits = vertices <= 0xFFFF;
      const size_t number =
          addAccessor(fits ? bytesOf(shorts) : bytesOf(order.indices), fits ? kShortType : kIntType, "SCALAR",
                      order.indices.size(), 0, kIndexData);
      const std::string name = "scumble order " + std::to_string(number);
      file_.root()["accessors"][number]["name"] = name;
      orders.push_back(
          {{"toViewer", {order.toViewer.x, order.toViewer.y, order.toViewer.z}}, {"indices", name}});
    }
    Json& extras = mesh_["extras"];
    if (!extras.is_object()) extras = Json::object();
    Json primitives = Json::array();
    for (size_t p = 0; p < painted.parts.size(); ++p)
      primitives.push_back(mesh_["primitives"].size() - painted.parts.size() + p);
    extras["scumble_orders"] = {{"primitives", std::move(primitives)}, {"orders", std::move(orders)}};
  }

  static Json materialOf(const PaintPart& part, size_t texture) {
    Json paint = Json::object();
    if (part.layer.fades) paint = {{"fadeStart", part.layer.fadeStart}, {"fadeEnd", part.layer.fadeEnd}};
    return {{"name", part.name},
            {"alphaMode", "BLEND"},
            {"doubleSided", part.isDoubleSided},
            {"pbrMetallicRoughness",
             {{"baseColorTexture", {{"index", texture}}}, {"metallicFactor", 0}, {"roughnessFactor", 1}}},
            {"extensions", {{kUnlit, Json::object()}}},
            {"extras", {{"scumble_paint", paint}}}};
  }

  size_t addAccessor(Bytes bytes, int componentType, const char* type, size_t count, size_t stride,
                     int target) {
    return file_.add("accessors", {{"bufferView", file_.addView(bytes, stride, target)},
                                   {"componentType", componentType},
                                   {"type", type},
                                   {"count", count}});
  }
  size_t addPoints(const std::vector<glm::vec3>& points, bool hasBox) {
    const size_t number = addAccessor(bytesOf(points), kFloatType, "VEC3", points.size(), 12, kVertexData);
    if (!hasBox) return number;
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (const glm::vec3& p : points) low = glm::min(low, p), high = glm::max(high, p);
    Json& accessor = file_.root()["accessors"][number];
    accessor["min"] = {low.x, low.y, low.z}, accessor["max"] = {high.x, high.y, high.z};
    return number;
  }

  void addSkin(const PaintPart& part, Json& attributes) {
    const Primitive& carrier = own_.primitives[part.primitive];
    const auto n = size_t(carrier.influences);
    for (size_t set = 0; 4 * set < n; ++set) {
      std::vector<uint16_t> joints;
      std::vector<float> weights;
      for (const uint32_t vertex : part.carriers)
        for (size_t k = 4 * set; k < 4 * set + 4; ++k) {
          const float weight = carrier.weights[vertex * n + k];
          weights.push_back(weight);
          joints.push_back(weight > 0 ? carrier.joints[vertex * n + k] : uint16_t(0));
        }
      const std::string number = std::to_string(set);
      attributes["JOINTS_" + number] =
          addAccessor(bytesOf(joints), kShortType, "VEC4", part.carriers.size(), 8, kVertexData);
      attributes["WEIGHTS_" + number] =
          addAccessor(bytesOf(weights), kFloatType, "VEC4", part.carriers.size(), 16, kVertexData);
    }
  }

  // All primitives of a mesh have as many.
  void addTargets(const PaintPart& part, Json& primitive) {
    size_t targets = 0;
    for (const Json& other : mesh_["primitives"])
      if (other.contains("targets")) targets = std::max(targets, other["targets"].size());
    const std::vector<MorphTarget>& morphs = own_.primitives[part.primitive].morphTargets;
    for (size_t t = 0; t < targets; ++t) {
      std::vector<glm::vec3> moved(part.carriers.size(), glm::vec3(0));
      if (t < morphs.size() && !morphs[t].positions.empty())
        for (size_t v = 0; v < moved.size(); ++v) moved[v] = morphs[t].positions[part.carriers[v]];
      primitive["targets"].push_back({{"POSITION", addPoints(moved, true)}});
    }
  }

  Rewrite& file_;
  Json& mesh_;
  const Mesh& own_;
};

}  // namespace

std::vector<uint8_t> withPaint(const std::string& path, const SceneOptions& options, const SceneData& scene,
                               const std::vector<PaintedMesh>& meshes, ImportWarnings& warnings) {
  Rewrite file(path, options, warnings);
  file.dropStrokes();
  for (size_t m = 0; m < file.meshes().size(); ++m) {
    const int own = file.meshes()[m];
    if (own < 0 || size_t(own) >= meshes.size() || meshes[size_t(own)].parts.empty()) continue;
    PaintWriter(file, file.root()["meshes"][m], scene.meshes[size_t(own)]).add(meshes[size_t(own)]);
  }
  return file.glb("ask for a smaller texture");
}

std::vector<uint8_t> paintAlone(const Mesh& mesh, const PaintedMesh& painted, const glm::dvec3& origin) {
  const Json root = {{"asset", {{"version", "2.0"}}},
                     {"scene", 0},
                     {"scenes", {{{"nodes", {0}}}}},
                     {"nodes", {nodeAt(origin, mesh.name, 0)}},
                     {"meshes", {{{"name", mesh.name}, {"primitives", Json::array()}}}}};
  Rewrite file(root);
  PaintWriter(file, file.root()["meshes"][0], mesh).add(painted);
  return file.glb("ask for a smaller texture");
}

}  // namespace scumble::gltf
