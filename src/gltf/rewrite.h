// A glTF that is written anew as one .glb: buffers and pictures of other files become part of it, and more is
// added to it or left out.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gltf/import.h"
#include "scumble/scene.h"

namespace scumble::gltf {

class Rewrite {
 public:
  // Reads the file. What it says stays, but that all bytes lie in its first buffer. Fails with
  // scene::ImportFailure.
  Rewrite(const std::string& path, const SceneOptions& options, ImportWarnings& warnings);

  // One that nobody has written yet.
  explicit Rewrite(Json root);

  Json& root() { return root_; }
  // By mesh of the file, which one of the scene that Scene::load makes of it; -1: none.
  const std::vector<int>& meshes() const { return meshes_; }

  // Takes all strokes out, and what only they have used.
  void dropStrokes();

  // Names an extension among those that are used.
  void useExtension(const char* name);
  // Adds to a list, which may not be there yet; gives the number.
  size_t add(const char* list, Json object);
  // Bytes as a view. `stride`, `target`: as glTF has them; 0: none.
  size_t addView(Bytes bytes, size_t stride = 0, int target = 0);

  // The whole file. `remedy`: what to do where it is too large.
  std::vector<uint8_t> glb(const char* remedy);

 private:
  void takeBuffers();
  void takeImages(ImportWarnings& warnings);
  size_t append(Bytes bytes);
  void dropUnused(const std::vector<Json>& dropped);
  void dropEmptyMeshes();

  FileBytes file_;
  std::string folder_;
  ImportBudget budget_;
  std::unique_ptr<Document> document_;
  std::unique_ptr<Buffers> buffers_;
  Json root_;
  std::vector<uint8_t> bytes_;  // the binary chunk
  std::vector<int> meshes_;
};

// A node that shows a mesh, moved by `place` where that is not 0.
Json nodeAt(const glm::dvec3& place, const std::string& name, size_t mesh);

constexpr int kVertexData = 34962, kIndexData = 34963;                // targets of views
constexpr int kShortType = 5123, kIntType = 5125, kFloatType = 5126;  // component types

// What many primitives have of one attribute, in one view; each has an accessor of its own.
class AttributeWriter {
 public:
  AttributeWriter(const char* name, int componentType, const char* type, size_t bytesEach,
                  bool normalized = false)
      : name_(name), type_(type), componentType_(componentType), each_(bytesEach), normalized_(normalized) {}

  template <class T>
  void put(const T& value) {
    const auto* from = reinterpret_cast<const uint8_t*>(&value);
    bytes_.insert(bytes_.end(), from, from + sizeof(T));
  }
  // The last `count` elements become an accessor, which the primitive names.
  Json& addTo(Rewrite& file, Json& primitive, size_t count) {
    Json accessor = {{"bufferView", 0},
                     {"componentType", componentType_},
                     {"type", type_},
                     {"count", count},
                     {"byteOffset", bytes_.size() - count * each_}};
    if (normalized_) accessor["normalized"] = true;
    accessors_.push_back(file.add("accessors", std::move(accessor)));
    primitive["attributes"][name_] = accessors_.back();
    return file.root()["accessors"].back();
  }
  // Once all are there.
  void finish(Rewrite& file) const {
    if (bytes_.empty()) return;
    const size_t view = file.addView(bytes_, each_, kVertexData);
    for (const size_t accessor : accessors_) file.root()["accessors"][accessor]["bufferView"] = view;
  }

 private:
  const char *name_, *type_;
  int componentType_;
  size_t each_;
  bool normalized_;
  std::vector<uint8_t> bytes_;
  std::vector<size_t> accessors_;
};

}  // namespace scumble::gltf
