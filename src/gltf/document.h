// A glTF as parsed JSON, with the binary chunk of a .glb; version and extensions checked.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "base/file_bytes.h"
#include "scene/import_warnings.h"
#include "scene/json.h"

namespace scumble::gltf {

using namespace scene;

class Document {
 public:
  // `bytes` must outlive the document. Fails when it is no glTF 2.x, or one that requires what we cannot do.
  Document(Bytes bytes, ImportWarnings& warnings);

  JsonView root() const { return JsonView(&root_, ""); }
  JsonView list(const char* name) const { return root().list(name); }

  bool hasBinaryChunk() const { return hasBinaryChunk_; }
  Bytes binaryChunk() const { return binaryChunk_; }

  const std::vector<std::string>& extensionsUsed() const { return extensionsUsed_; }
  const std::vector<std::string>& extensionsNotSupported() const { return extensionsNotSupported_; }
  bool isRequired(const std::string& extension) const { return extensionsRequired_.contains(extension); }

 private:
  std::string_view splitGlb(Bytes bytes, ImportWarnings& warnings);
  void checkVersion() const;
  void checkExtensions(ImportWarnings& warnings);

  Json root_;
  bool hasBinaryChunk_ = false;
  Bytes binaryChunk_;
  std::vector<std::string> extensionsUsed_, extensionsNotSupported_;
  std::set<std::string> extensionsRequired_;
};

}  // namespace scumble::gltf
