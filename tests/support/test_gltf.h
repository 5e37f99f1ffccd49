// Makes small glTFs for tests and for the fuzzer's first corpus: numbers go into one buffer, and a builder
// writes the buffer views and accessors for them.
#pragma once

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace scumble::scene {

struct TestGltf {
  using Json = nlohmann::json;

  Json json = {{"asset", {{"version", "2.0"}}}};
  std::vector<uint8_t> bytes;

  template <class T>
  int addView(const std::vector<T>& values, int stride = 0) {
    while (bytes.size() % 8 != 0) bytes.push_back(0);
    const size_t offset = bytes.size(), size = values.size() * sizeof(T);
    bytes.resize(offset + size);
    if (size > 0) std::memcpy(bytes.data() + offset, values.data(), size);
    Json view = {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}};
    if (stride > 0) view["byteStride"] = stride;
    json["bufferViews"].push_back(view);
    return static_cast<int>(json["bufferViews"].size()) - 1;
  }

  int addAccessor(int view, int componentType, const char* type, size_t count, bool normalized = false,
                  size_t byteOffset = 0) {
    Json accessor = {{"componentType", componentType}, {"type", type}, {"count", count}};
    if (view >= 0) accessor["bufferView"] = view;
    if (normalized) accessor["normalized"] = true;
    if (byteOffset > 0) accessor["byteOffset"] = byteOffset;
    json["accessors"].push_back(accessor);
    return static_cast<int>(json["accessors"].size()) - 1;
  }

  template <class T>
  int add(const std::vector<T>& values, int componentType, const char* type, int components,
          bool normalized = false) {
    return addAccessor(addView(values), componentType, type, values.size() / static_cast<size_t>(components),
                       normalized);
  }
  int addFloats(const std::vector<float>& values, int components) {
    static constexpr const char* kTypes[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    return add(values, 5126, kTypes[components], components);
  }
  int addIndices(const std::vector<uint16_t>& values) { return add(values, 5123, "SCALAR", 1); }

  // A node in scene 0 with a mesh of one primitive.
  Json& addMesh(const Json& attributes, int indices = -1) {
    Json primitive = {{"attributes", attributes}};
    if (indices >= 0) primitive["indices"] = indices;
    json["meshes"].push_back({{"primitives", Json::array({primitive})}});
    json["nodes"].push_back({{"mesh", json["meshes"].size() - 1}});
    json["scenes"][0]["nodes"].push_back(json["nodes"].size() - 1);
    return json["meshes"].back()["primitives"][0];
  }

  // The unit square in the xy plane: u goes along x, v along -y; uv spans [0, 1].
  Json& addQuad() {
    const int position = addFloats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, 3);
    const int uv = addFloats({0, 1, 1, 1, 1, 0, 0, 0}, 2);
    const int normal = addFloats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
    return addMesh({{"POSITION", position}, {"TEXCOORD_0", uv}, {"NORMAL", normal}},
                   addIndices({0, 1, 2, 0, 2, 3}));
  }

  // A material for the first primitive whose base colour is this image.
  void addImage(const std::vector<uint8_t>& file) {
    const int view = addView(file);
    json["images"] = Json::array({{{"bufferView", view}, {"mimeType", "image/png"}}});
    json["textures"] = Json::array({{{"source", 0}}});
    json["materials"] = Json::array({{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}});
    json["meshes"][0]["primitives"][0]["material"] = 0;
  }

  static std::string base64(const std::vector<uint8_t>& data) {
    static const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < data.size(); i += 3) {
      const uint32_t b1 = i + 1 < data.size() ? data[i + 1] : 0, b2 = i + 2 < data.size() ? data[i + 2] : 0;
      const uint32_t bits = uint32_t(data[i]) << 16 | b1 << 8 | b2;
      text += kDigits[bits >> 18];
      text += kDigits[bits >> 12 & 63];
      text += i + 1 < data.size() ? kDigits[bits >> 6 & 63] : '=';
      text += i + 2 < data.size() ? kDigits[bits & 63] : '=';
    }
    return text;
  }

  std::string gltf() const {
    Json whole = json;
    if (!bytes.empty())
      whole["buffers"] = Json::array(
          {{{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}}});
    return whole.dump();
  }

  static void append32(std::string& text, size_t value) {
    for (int i = 0; i < 4; ++i) text += static_cast<char>(value >> (8 * i) & 255);
  }

  std::string glb() const {
    Json whole = json;
    if (!bytes.empty()) whole["buffers"] = Json::array({{{"byteLength", bytes.size()}}});
    std::string text = whole.dump();
    while (text.size() % 4 != 0) text += ' ';
    std::string binary(bytes.begin(), bytes.end());
    while (binary.size() % 4 != 0) binary += '\0';
    std::string file = "glTF";
    append32(file, 2);
    append32(file, 12 + 8 + text.size() + (binary.empty() ? 0 : 8 + binary.size()));
    append32(file, text.size());
    file += "JSON" + text;
    if (!binary.empty()) {
      append32(file, binary.size());
      file += std::string("BIN\0", 4) + binary;
    }
    return file;
  }
};

}  // namespace scumble::scene
