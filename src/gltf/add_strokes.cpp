#include "gltf/add_strokes.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <limits>

#include "gltf/import.h"
#include "gltf/uri.h"
#include "scene/nearest_place.h"

namespace scumble::gltf {

namespace {

// The binary chunk, as it grows.
class Chunk {
 public:
  std::vector<uint8_t> bytes;

  size_t align() {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    return bytes.size();
  }
  size_t add(Bytes added) {
    const size_t offset = align();
    bytes.insert(bytes.end(), added.begin(), added.end());
    return offset;
  }
};

// What all strokes have of one attribute, in one view; each stroke has an accessor of its own.
class Attribute {
 public:
  Attribute(const char* name, int componentType, const char* type, size_t bytesEach, bool normalized = false)
      : name_(name), type_(type), componentType_(componentType), each_(bytesEach), normalized_(normalized) {}

  template <class T>
  void put(const T& value) {
    const auto* from = reinterpret_cast<const uint8_t*>(&value);
    bytes_.insert(bytes_.end(), from, from + sizeof(T));
  }
  // The last `count` elements become an accessor, which the primitive names.
  Json& addTo(Json& root, Json& primitive, size_t count) {
    Json accessor = {{"bufferView", 0},
                     {"componentType", componentType_},
                     {"type", type_},
                     {"count", count},
                     {"byteOffset", bytes_.size() - count * each_}};
    if (normalized_) accessor["normalized"] = true;
    primitive["attributes"][name_] = root["accessors"].size();
    accessors_.push_back(root["accessors"].size());
    root["accessors"].push_back(std::move(accessor));
    return root["accessors"].back();
  }
  void finish(Json& root, Chunk& chunk) const {
    if (bytes_.empty()) return;
    const size_t view = root["bufferViews"].size();
    root["bufferViews"].push_back({{"buffer", 0},
                                   {"byteOffset", chunk.add(bytes_)},
                                   {"byteLength", bytes_.size()},
                                   {"byteStride", each_},
                                   {"target", 34962}});
    for (const size_t accessor : accessors_) root["accessors"][accessor]["bufferView"] = view;
  }

 private:
  const char *name_, *type_;
  int componentType_;
  size_t each_;
  bool normalized_;
  std::vector<uint8_t> bytes_;
  std::vector<size_t> accessors_;
};

const char* mimeTypeOf(Bytes bytes) {
  const auto begins = [&](std::string_view with, size_t at = 0) {
    return bytes.size() >= at + with.size() && std::memcmp(bytes.data() + at, with.data(), with.size()) == 0;
  };
  if (begins("\x89PNG")) return "image/png";
  if (begins("\xFF\xD8")) return "image/jpeg";
  if (begins("RIFF") && begins("WEBP", 8)) return "image/webp";
  return nullptr;
}

class Writer {
 public:
  Writer(const std::string& path, const SceneOptions& options, ImportWarnings& warnings)
      : warnings_(warnings), options_(options) {
    std::string problem;
    if (!file_.open(path, problem)) fail({}, problem, "give the path of a .gltf or .glb");
    folder_ = std::filesystem::path(path).parent_path().string();
    if (folder_.empty()) folder_ = ".";
    budget_.addBacking(file_.bytes().size());
    document_ = std::make_unique<Document>(file_.bytes(), warnings_);
    buffers_ = std::make_unique<Buffers>(*document_, &file_, folder_, options.allowOutside, budget_);
    root_ = document_->root().json();
  }

  std::vector<uint8_t> write(const SceneData& scene,
                             const std::vector<std::shared_ptr<const Painting>>& paintings) {
    takeBuffers();
    takeImages();
    for (const char* list : {"accessors", "bufferViews"})
      if (!root_.contains(list)) root_[list] = Json::array();
    // The file's meshes, as the scene counts them.
    Accessors accessors(*document_, *buffers_, budget_);
    const Progress none;
    ImportProgress progress(none);
    const Import import{*document_, *buffers_, accessors, budget_, warnings_, progress};
    SceneData nodes;
    Maps maps;
    readNodes(import, options_.scene, nodes, maps);
    for (size_t m = 0; m < maps.meshes.size(); ++m) {
      const int own = maps.meshes[m];
      if (own < 0 || size_t(own) >= paintings.size() || !paintings[size_t(own)]) continue;
      addStrokes(root_["meshes"][m], scene.meshes[size_t(own)], *paintings[size_t(own)]);
    }
    for (const Attribute* attribute : {&positions_, &colors_, &radii_, &turns_, &times_, &joints_, &weights_})
      attribute->finish(root_, chunk_);
    chunk_.align();
    root_["buffers"][0] = {{"byteLength", chunk_.bytes.size()}};
    return glb();
  }

 private:
  // Everything in one buffer, the first; what has no bytes of its own (fallbacks of compressed views) stays.
  void takeBuffers() {
    Json buffers = Json::array();
    buffers.push_back(Json::object());
    struct Moved {
      size_t buffer, offset;
    };
    std::vector<Moved> moved;
    const size_t count = document_->list("buffers").size();
    for (size_t i = 0; i < count; ++i) {
      const Json& buffer = root_["buffers"][i];
      const bool hasBytes = buffer.contains("uri") || (i == 0 && document_->hasBinaryChunk());
      if (hasBytes) {
        moved.push_back({0, chunk_.add(buffers_->buffer(i))});
      } else {
        moved.push_back({buffers.size(), 0});
        buffers.push_back(buffer);
      }
    }
    const auto move = [&](Json& view) {
      const Moved& to = moved[view["buffer"].get<size_t>()];
      view["buffer"] = to.buffer;
      view["byteOffset"] = to.offset + view.value("byteOffset", size_t(0));
    };
    const JsonView views = document_->list("bufferViews");
    for (size_t v = 0; v < views.size(); ++v) {
      Json& view = root_["bufferViews"][v];
      views.at(v).requiredIndex("buffer", count, "buffer");
      views.at(v).count("byteOffset", 0);
      move(view);
      const JsonView compression = views.at(v).extension("EXT_meshopt_compression");
      if (!compression) continue;
      compression.requiredIndex("buffer", count, "buffer");
      compression.count("byteOffset", 0);
      move(view["extensions"]["EXT_meshopt_compression"]);
    }
    root_["buffers"] = std::move(buffers);
  }

  void takeImages() {
    const JsonView images = document_->list("images");
    for (size_t i = 0; i < images.size(); ++i) {
      const JsonView json = images.at(i);
      if (!json.has("uri") || !json.json()["uri"].is_string()) continue;
      const std::string uri = json.text("uri");
      if (isDataUri(uri)) continue;
      Buffers::Holder holder;
      Bytes bytes;
      std::string problem;
      const char* type = nullptr;
      if (buffers_->imageFile(uri, json.pathOf("uri"), holder, bytes, problem)) type = mimeTypeOf(bytes);
      if (!type) {
        warnings_.add(json.pathOf("uri"), "a picture that cannot be read stays outside of the file");
        continue;
      }
      Json& image = root_["images"][i];
      image.erase("uri");
      image["mimeType"] = type;
      image["bufferView"] = root_["bufferViews"].size();
      root_["bufferViews"].push_back(
          {{"buffer", 0}, {"byteOffset", chunk_.add(bytes)}, {"byteLength", bytes.size()}});
    }
  }

  void addStrokes(Json& mesh, const Mesh& own, const Painting& painting) {
    // A skinned mesh has joints for all that it is made of: those of the nearest vertex.
    std::vector<const Primitive*> skinned;
    for (const Primitive& p : own.primitives)
      if (p.influences > 0) skinned.push_back(&p);
    const NearestPlaces places(skinned);
    size_t targets = 0;
    for (const Json& other : mesh["primitives"])
      if (other.contains("targets")) targets = std::max(targets, other["targets"].size());
    for (const Stroke& stroke : painting.strokes) {
      Json primitive = {{"mode", 3}, {"extras", {{"scumble_brush", nameOf(stroke.brush)}}}};
      glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
      for (uint32_t i = stroke.firstPoint; i < stroke.firstPoint + stroke.pointCount; ++i) {
        const StrokePoint& point = painting.points[i];
        low = glm::min(low, point.position), high = glm::max(high, point.position);
        positions_.put(point.position);
        for (int c = 0; c < 4; ++c) colors_.put(uint16_t(std::lround(65535 * double(point.color[c]))));
        radii_.put(point.radius);
        const glm::quat& q = point.orientation;
        turns_.put(glm::vec4(q.x, q.y, q.z, q.w));
        times_.put(point.time);
        if (!places.isEmpty()) addSkin(skinned, places.to(point.position));
      }
      const size_t count = stroke.pointCount;
      Json& position = positions_.addTo(root_, primitive, count);
      position["min"] = {low.x, low.y, low.z}, position["max"] = {high.x, high.y, high.z};
      colors_.addTo(root_, primitive, count);
      radii_.addTo(root_, primitive, count);
      turns_.addTo(root_, primitive, count);
      times_.addTo(root_, primitive, count);
      if (!places.isEmpty()) {
        joints_.addTo(root_, primitive, count);
        weights_.addTo(root_, primitive, count);
      }
      // All primitives of a mesh have its morph targets; what they would do to strokes the mesh does.
      if (targets > 0) {
        const size_t zeros = root_["accessors"].size();
        root_["accessors"].push_back({{"componentType", 5126},
                                      {"type", "VEC3"},
                                      {"count", count},
                                      {"min", {0, 0, 0}},
                                      {"max", {0, 0, 0}}});
        for (size_t t = 0; t < targets; ++t) primitive["targets"].push_back({{"POSITION", zeros}});
      }
      mesh["primitives"].push_back(std::move(primitive));
    }
  }

  void addSkin(const std::vector<const Primitive*>& skinned, const NearestPlaces::Place& place) {
    const Primitive& p = *skinned[place.primitive];
    const float parts[] = {1 - place.at.x - place.at.y, place.at.x, place.at.y};
    const uint32_t vertex = place.vertices[int(std::max_element(parts, parts + 3) - parts)];
    const size_t n = size_t(p.influences);
    std::vector<std::pair<float, uint16_t>> most;
    for (size_t k = 0; k < n; ++k) most.emplace_back(p.weights[vertex * n + k], p.joints[vertex * n + k]);
    std::stable_sort(most.begin(), most.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    most.resize(4);
    float sum = 0;
    for (const auto& [weight, joint] : most) sum += weight;
    for (const auto& [weight, joint] : most) {
      joints_.put(uint16_t(weight > 0 ? joint : 0));
      weights_.put(sum > 0 ? weight / sum : 0.0f);
    }
  }

  std::vector<uint8_t> glb() const {
    std::string json = root_.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::vector<uint8_t> file;
    const auto put = [&](size_t value) {
      if (value > std::numeric_limits<uint32_t>::max())
        fail({}, "with its strokes it would be more than a .glb can hold", "ask for fewer splats");
      for (int i = 0; i < 4; ++i) file.push_back(uint8_t(value >> 8 * i));
    };
    const auto text = [&](std::string_view word) { file.insert(file.end(), word.begin(), word.end()); };
    file.reserve(28 + json.size() + chunk_.bytes.size());
    text("glTF");
    put(2);
    put(28 + json.size() + chunk_.bytes.size());
    put(json.size());
    text("JSON");
    text(json);
    put(chunk_.bytes.size());
    text(std::string_view("BIN\0", 4));
    file.insert(file.end(), chunk_.bytes.begin(), chunk_.bytes.end());
    return file;
  }

  ImportWarnings& warnings_;
  const SceneOptions& options_;
  FileBytes file_;
  std::string folder_;
  ImportBudget budget_;
  std::unique_ptr<Document> document_;
  std::unique_ptr<Buffers> buffers_;
  Json root_;
  Chunk chunk_;
  Attribute positions_{"POSITION", 5126, "VEC3", 12}, colors_{"COLOR_0", 5123, "VEC4", 8, true},
      radii_{"_RADIUS", 5126, "SCALAR", 4}, turns_{"_ORIENTATION", 5126, "VEC4", 16},
      times_{"_TIME", 5126, "SCALAR", 4}, joints_{"JOINTS_0", 5123, "VEC4", 8},
      weights_{"WEIGHTS_0", 5126, "VEC4", 16};
};

}  // namespace

std::vector<uint8_t> withStrokes(const std::string& path, const SceneOptions& options, const SceneData& scene,
                                 const std::vector<std::shared_ptr<const Painting>>& paintings,
                                 ImportWarnings& warnings) {
  return Writer(path, options, warnings).write(scene, paintings);
}

}  // namespace scumble::gltf
