#include "gltf/rewrite.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <limits>
#include <set>

#include "gltf/gaussians.h"
#include "gltf/strokes.h"
#include "gltf/uri.h"

namespace scumble::gltf {

namespace {

const char* mimeTypeOf(Bytes bytes) {
  const auto begins = [&](std::string_view with, size_t at = 0) {
    return bytes.size() >= at + with.size() && std::memcmp(bytes.data() + at, with.data(), with.size()) == 0;
  };
  if (begins("\x89PNG")) return "image/png";
  if (begins("\xFF\xD8")) return "image/jpeg";
  if (begins("RIFF") && begins("WEBP", 8)) return "image/webp";
  return nullptr;
}

// A number that names something; -1: none. Files write 3 as 3.0 as well.
int64_t numberOf(const Json& json) {
  return json.is_number() && json.get<double>() >= 0 ? int64_t(json.get<double>()) : -1;
}

// Numbers of accessors under these keys, or under any, wherever in it they are.
void addNumbers(const Json& json, std::string_view key, std::set<int64_t>& to) {
  for (const auto& [name, value] : json.items()) {
    if (value.is_structured()) addNumbers(value, key, to);
    if (json.is_object() && name == key) to.insert(numberOf(value));
  }
}

// Accessors that attributes name: those of primitives, of their targets, and of instances.
void addAttributes(const Json& json, std::set<int64_t>& to) {
  for (const auto& [name, value] : json.items()) {
    if (json.is_object() && (name == "attributes" || name == "targets") && value.is_structured()) {
      const auto addAll = [&](const Json& attributes) {
        for (const Json& number : attributes)
          if (number.is_number()) to.insert(numberOf(number));
      };
      if (value.is_object()) addAll(value);
      for (const Json& target : value)
        if (target.is_object()) addAll(target);
    }
    if (value.is_structured()) addAttributes(value, to);
  }
}

std::set<int64_t> accessorsOf(const Json& json) {
  std::set<int64_t> all;
  addAttributes(json, all);
  for (const char* key : {"indices", "input", "output", "inverseBindMatrices"}) addNumbers(json, key, all);
  return all;
}

// Takes the last entries of a list away as long as all of them are superfluous.
void cutEnd(Json& list, const std::set<int64_t>& superfluous) {
  while (!list.empty() && superfluous.contains(int64_t(list.size()) - 1)) list.erase(list.size() - 1);
}

}  // namespace

Rewrite::Rewrite(const std::string& path, const SceneOptions& options, ImportWarnings& warnings) {
  std::string problem;
  if (!file_.open(path, problem)) fail({}, problem, "give the path of a .gltf or .glb");
  folder_ = std::filesystem::path(path).parent_path().string();
  if (folder_.empty()) folder_ = ".";
  budget_.addBacking(file_.bytes().size());
  document_ = std::make_unique<Document>(file_.bytes(), warnings);
  buffers_ = std::make_unique<Buffers>(*document_, &file_, folder_, options.allowOutside, FileAccess::mapped,
                                       budget_);
  root_ = document_->root().json();
  takeBuffers();
  takeImages(warnings);
  // The file's meshes, as the scene counts them.
  Accessors accessors(*document_, *buffers_, budget_);
  const Progress none;
  ImportProgress progress(none);
  const Import import{*document_, *buffers_, accessors, budget_, warnings, progress};
  SceneData nodes;
  Maps maps;
  readNodes(import, options.scene, nodes, maps);
  meshes_ = maps.meshes;
}

Rewrite::Rewrite(Json root) : root_(std::move(root)) {
  root_["buffers"] = Json::array({Json::object()});
}

size_t Rewrite::append(Bytes bytes) {
  bytes_.resize((bytes_.size() + 3) / 4 * 4);
  const size_t offset = bytes_.size();
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  return offset;
}

void Rewrite::useExtension(const char* name) {
  Json& used = root_["extensionsUsed"];
  if (!used.is_array()) used = Json::array();
  if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

size_t Rewrite::add(const char* list, Json object) {
  if (!root_.contains(list)) root_[list] = Json::array();
  root_[list].push_back(std::move(object));
  return root_[list].size() - 1;
}

Json nodeAt(const glm::dvec3& place, const std::string& name, size_t mesh) {
  Json node = {{"name", name}, {"mesh", mesh}};
  if (place != glm::dvec3(0.0)) node["translation"] = {place.x, place.y, place.z};
  return node;
}

size_t Rewrite::addView(Bytes bytes, size_t stride, int target) {
  Json view = {{"buffer", 0}, {"byteOffset", append(bytes)}, {"byteLength", bytes.size()}};
  if (stride > 0) view["byteStride"] = stride;
  if (target > 0) view["target"] = target;
  return add("bufferViews", std::move(view));
}

// Everything in one buffer, the first; what has no bytes of its own (fallbacks of compressed views) stays.
void Rewrite::takeBuffers() {
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
      moved.push_back({0, append(buffers_->buffer(i))});
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

void Rewrite::takeImages(ImportWarnings& warnings) {
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
      warnings.add(json.pathOf("uri"), "a picture that cannot be read stays outside of the file");
      continue;
    }
    Json& image = root_["images"][i];
    image.erase("uri");
    image["mimeType"] = type;
    image["bufferView"] = addView(bytes);
  }
}

void Rewrite::dropStrokes() {
  std::vector<Json> dropped;
  if (!root_.contains("meshes")) return;
  const JsonView meshes = document_->list("meshes");
  for (size_t m = 0; m < root_["meshes"].size(); ++m) {
    Json& mesh = root_["meshes"][m];
    if (!mesh.contains("primitives")) continue;
    const JsonView primitives = meshes.at(m).list("primitives");
    Json kept = Json::array();
    for (size_t p = 0; p < mesh["primitives"].size(); ++p)
      if (isStroke(primitives.at(p)) || areGaussians(primitives.at(p)))
        dropped.push_back(mesh["primitives"][p]);
      else
        kept.push_back(mesh["primitives"][p]);
    mesh["primitives"] = std::move(kept);
  }
  if (!dropped.empty()) dropUnused(dropped);
}

// Numbers of what stays must stay, since anything may name them: only ends of lists are cut, which is where
// strokes lie that were added.
void Rewrite::dropUnused(const std::vector<Json>& dropped) {
  std::set<int64_t> accessors = accessorsOf(Json(dropped)), views;
  for (const int64_t number : accessorsOf(root_)) accessors.erase(number);
  if (!root_.contains("accessors") || !root_.contains("bufferViews")) return;
  for (const int64_t number : accessors)
    if (number >= 0 && size_t(number) < root_["accessors"].size())
      addNumbers(root_["accessors"][size_t(number)], "bufferView", views);
  cutEnd(root_["accessors"], accessors);
  std::set<int64_t> named;
  addNumbers(root_, "bufferView", named);
  for (const int64_t number : named) views.erase(number);
  const size_t before = root_["bufferViews"].size();
  cutEnd(root_["bufferViews"], views);
  if (root_["bufferViews"].size() == before) return;
  size_t end = 0;
  for (const Json& view : root_["bufferViews"]) {
    const auto reach = [&](const Json& of) {
      if (numberOf(of.value("buffer", Json(-1))) == 0)
        end = std::max(end, size_t(std::max<int64_t>(numberOf(of.value("byteOffset", Json(0))), 0) +
                                   std::max<int64_t>(numberOf(of.value("byteLength", Json(0))), 0)));
    };
    reach(view);
    if (view.contains("extensions") && view["extensions"].contains("EXT_meshopt_compression"))
      reach(view["extensions"]["EXT_meshopt_compression"]);
  }
  bytes_.resize(std::min(bytes_.size(), end));
}

// A mesh of strokes alone is none any more.
void Rewrite::dropEmptyMeshes() {
  if (!root_.contains("meshes")) return;
  Json kept = Json::array();
  std::vector<int64_t> numbers;
  for (Json& mesh : root_["meshes"]) {
    const bool isEmpty = !mesh.contains("primitives") || mesh["primitives"].empty();
    numbers.push_back(isEmpty ? -1 : int64_t(kept.size()));
    if (!isEmpty) kept.push_back(std::move(mesh));
  }
  if (kept.size() == numbers.size()) {
    root_["meshes"] = std::move(kept);
    return;
  }
  if (root_.contains("nodes"))
    for (Json& node : root_["nodes"]) {
      if (!node.is_object() || !node.contains("mesh")) continue;
      const int64_t mesh = numberOf(node["mesh"]);
      if (mesh >= 0 && size_t(mesh) < numbers.size() && numbers[size_t(mesh)] >= 0) {
        node["mesh"] = numbers[size_t(mesh)];
      } else {
        for (const char* key : {"mesh", "skin", "weights"}) node.erase(key);
      }
    }
  if (kept.empty())
    root_.erase("meshes");
  else
    root_["meshes"] = std::move(kept);
}

std::vector<uint8_t> Rewrite::glb(const char* remedy) {
  dropEmptyMeshes();
  bytes_.resize((bytes_.size() + 3) / 4 * 4);
  root_["buffers"][0] = {{"byteLength", bytes_.size()}};
  std::string json = root_.dump();
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::vector<uint8_t> file;
  const auto put = [&](size_t value) {
    if (value > std::numeric_limits<uint32_t>::max())
      fail({}, "it would be more than a .glb can hold", remedy);
    for (int i = 0; i < 4; ++i) file.push_back(uint8_t(value >> 8 * i));
  };
  const auto text = [&](std::string_view word) { file.insert(file.end(), word.begin(), word.end()); };
  file.reserve(28 + json.size() + bytes_.size());
  text("glTF");
  put(2);
  put(28 + json.size() + bytes_.size());
  put(json.size());
  text("JSON");
  text(json);
  put(bytes_.size());
  text(std::string_view("BIN\0", 4));
  file.insert(file.end(), bytes_.begin(), bytes_.end());
  return file;
}

}  // namespace scumble::gltf
