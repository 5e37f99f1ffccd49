#include "gltf/document.h"

#include <algorithm>
#include <cstring>
#include <set>
#include <string_view>

namespace scumble::gltf {

namespace {

constexpr uint32_t kGlbMagic = 0x46546c67;  // "glTF"
constexpr uint32_t kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;

// FB_ngon_encoding only says how triangles once were polygons: there is nothing to do for it.
constexpr std::string_view kSupported[] = {"EXT_mesh_gpu_instancing",
                                           "EXT_meshopt_compression",
                                           "EXT_texture_webp",
                                           "FB_ngon_encoding",
                                           "KHR_animation_pointer",
                                           "KHR_draco_mesh_compression",
                                           "KHR_gaussian_splatting",
                                           "KHR_lights_punctual",
                                           "KHR_materials_emissive_strength",
                                           "KHR_materials_pbrSpecularGlossiness",
                                           "KHR_materials_unlit",
                                           "KHR_mesh_quantization",
                                           "KHR_node_visibility",
                                           "KHR_texture_transform",
                                           "VRM",
                                           "VRMC_materials_mtoon"};

// Extensions without which the scene is still itself, only plainer: required or not, they end in a warning.
constexpr std::string_view kOnlyLooks[] = {"KHR_materials_", "EXT_materials_", "MSFT_texture_",
                                           "KHR_texture_",   "EXT_texture_",   "ADOBE_materials_",
                                           "EXT_lights_",    "KHR_xmp"};

bool isSupported(std::string_view name) {
  return std::find(std::begin(kSupported), std::end(kSupported), name) != std::end(kSupported);
}

bool changesOnlyLooks(std::string_view name) {
  return std::any_of(std::begin(kOnlyLooks), std::end(kOnlyLooks),
                     [&](std::string_view prefix) { return name.starts_with(prefix); });
}

uint32_t littleEndian32(const uint8_t* p) {
  return p[0] | uint32_t(p[1]) << 8 | uint32_t(p[2]) << 16 | uint32_t(p[3]) << 24;
}

std::vector<std::string> namesIn(const JsonView& root, const char* key) {
  std::vector<std::string> names;
  const JsonView list = root.list(key);
  for (size_t i = 0; i < list.size(); ++i) {
    const Json& name = list.json()[i];
    if (!name.is_string()) fail(list.path() + "[" + std::to_string(i) + "]", "is not a string");
    names.push_back(name.get<std::string>());
  }
  return names;
}

}  // namespace

Document::Document(Bytes bytes, ImportWarnings& warnings) {
  if (bytes.empty()) fail({}, "is empty", "export the scene again");
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (bytes.size() >= 4 && littleEndian32(bytes.data()) == kGlbMagic) {
    text = splitGlb(bytes, warnings);
  } else {
    // One look at the first letter saves the user of an .fbx or .obj a message about JSON syntax.
    const size_t first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    if (first == std::string_view::npos || text[first] != '{')
      fail({}, "is neither a .gltf nor a .glb", "convert it to glTF 2.0");
  }
  root_ = parseJson(text);
  if (!root_.is_object()) fail({}, "is not a glTF: the JSON is not an object", "convert it to glTF 2.0");
  checkVersion();
  checkExtensions(warnings);
}

// Returns the text of the JSON chunk.
std::string_view Document::splitGlb(Bytes bytes, ImportWarnings& warnings) {
  if (bytes.size() < 12) fail({}, "is a .glb that ends within its header", "copy or export it again");
  const uint32_t version = littleEndian32(bytes.data() + 4);
  if (version == 1) fail({}, "is a .glb of glTF 1.0", "convert it to glTF 2.0");
  if (version != 2)
    fail({}, "is a .glb of unknown version " + std::to_string(version), "convert it to glTF 2.0");
  const uint32_t length = littleEndian32(bytes.data() + 8);
  if (length > bytes.size())
    fail({},
         "is a .glb of " + std::to_string(length) + " bytes of which only " + std::to_string(bytes.size()) +
             " are there",
         "copy or export it again");
  if (length < 12) fail({}, "is a .glb with an impossible length in its header", "export it again");
  if (length < bytes.size()) warnings.add({}, "bytes after the end of the .glb are ignored");
  bytes = bytes.first(length);

  std::string_view text;
  bool hasJson = false;
  size_t at = 12;
  for (int chunk = 0; at + 8 <= bytes.size(); ++chunk) {
    const uint32_t size = littleEndian32(bytes.data() + at), type = littleEndian32(bytes.data() + at + 4);
    at += 8;
    if (size > bytes.size() - at)
      fail({}, "is a .glb whose chunk " + std::to_string(chunk) + " is longer than the file",
           "copy or export it again");
    const Bytes content = bytes.subspan(at, size);
    if (chunk == 0) {
      if (type != kJsonChunk) fail({}, "is a .glb whose first chunk is not JSON", "export it again");
      text = {reinterpret_cast<const char*>(content.data()), content.size()};
      hasJson = true;
    } else if (type == kBinaryChunk && !hasBinaryChunk_) {
      binaryChunk_ = content;
      hasBinaryChunk_ = true;
    } else {
      warnings.add({}, "a further chunk of the .glb is ignored");
    }
    at = std::min<size_t>(bytes.size(), at + (size_t(size) + 3) / 4 * 4);
  }
  if (!hasJson) fail({}, "is a .glb without a JSON chunk", "export it again");
  return text;
}

void Document::checkVersion() const {
  const JsonView asset = root().object("asset");
  const std::string advice = "convert it to glTF 2.0";
  if (!asset) {
    // glTF 1.0 could leave the asset out, and kept its meshes in an object.
    const auto meshes = root_.find("meshes");
    if (meshes != root_.end() && meshes->is_object()) fail({}, "is glTF 1.0", advice);
    fail("asset", "is missing, so this is no glTF 2.0", advice);
  }
  // Some writers of 1.0 gave a number.
  const Json* version = asset.has("version") ? &asset.json()["version"] : nullptr;
  if (!version) fail("asset.version", "is missing", advice);
  const std::string text = version->is_string() ? version->get<std::string>() : version->dump();
  if (text.starts_with("1")) fail("asset.version", "is glTF " + text.substr(0, 10), advice);
  if (!version->is_string() || !text.starts_with("2.") || text.size() < 3)
    fail("asset.version", "is not a 2.x version: \"" + text.substr(0, 20) + "\"", advice);
  const std::string minVersion = asset.text("minVersion", "2.0");
  if (minVersion != "2.0")
    fail("asset.minVersion", "asks for glTF " + minVersion.substr(0, 20) + ", and scumble reads 2.0",
         "export as glTF 2.0");
}

void Document::checkExtensions(ImportWarnings& warnings) {
  const std::vector<std::string> used = namesIn(root(), "extensionsUsed");
  const std::vector<std::string> required = namesIn(root(), "extensionsRequired");
  extensionsRequired_.insert(required.begin(), required.end());
  for (size_t i = 0; i < required.size(); ++i)
    if (!isSupported(required[i]) && !changesOnlyLooks(required[i]))
      fail("extensionsRequired[" + std::to_string(i) + "]",
           "the extension \"" + required[i].substr(0, 80) + "\" is not supported",
           "export the scene without it");

  std::set<std::string> seen;
  const auto note = [&](const std::string& name, const std::string& path) {
    if (!seen.insert(name).second) return;
    extensionsUsed_.push_back(name);
    if (isSupported(name)) return;
    extensionsNotSupported_.push_back(name);
    // Every image that needs it gets a warning of its own.
    if (name == "KHR_texture_basisu") return;
    warnings.add(path, "the extension \"" + name.substr(0, 80) + "\" is ignored");
  };
  for (size_t i = 0; i < used.size(); ++i) note(used[i], "extensionsUsed[" + std::to_string(i) + "]");
  for (size_t i = 0; i < required.size(); ++i)
    note(required[i], "extensionsRequired[" + std::to_string(i) + "]");
}

}  // namespace scumble::gltf
