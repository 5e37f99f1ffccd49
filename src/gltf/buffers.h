// The bytes behind a glTF: buffers and buffer views as spans, loaded when first asked for. May be asked from
// several threads.
#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/file_bytes.h"
#include "gltf/document.h"
#include "gltf/import_budget.h"

namespace scumble::gltf {

using namespace scene;

class Buffers {
 public:
  // `file`: where the document lies; null: in memory that is somebody else's. `access`: to other files.
  Buffers(const Document& document, const FileBytes* file, std::string folder, bool allowOutside,
          FileAccess access, ImportBudget& budget);

  // Bytes of buffers[i], exactly its byteLength. Fails when they cannot be had.
  Bytes buffer(size_t i);

  // Bytes of bufferViews[i], decompressed where EXT_meshopt_compression says so.
  Bytes view(size_t i);
  size_t viewStride(size_t i) const;  // 0: not given
  // Lets go of the memory of files that have been read; whoever has spans of them keeps these.
  void forgetFiles();
  size_t viewCount() const { return views_.size(); }

  // The files that URIs name, used or not; none where the folder is empty. Fails when any is remote or leads
  // out of the folder.
  std::vector<std::string> files() const;

  // The bytes of an image's URI. `holder` keeps what is not part of the file itself. False when they cannot
  // be had, and `problem` says why.
  struct Holder {
    std::vector<uint8_t> data;
    FileBytes file;
  };
  bool imageFile(const std::string& uri, const std::string& jsonPath, Holder& holder, Bytes& bytes,
                 std::string& problem) const;

 private:
  struct Buffer {
    std::mutex mutex;
    bool loaded = false;
    Bytes bytes;
    Holder holder;
  };
  struct View {
    std::mutex mutex;
    bool decoded = false;
    std::vector<uint8_t> bytes;
  };
  void load(size_t i, Buffer& buffer);
  Bytes viewBytes(const JsonView& view);
  std::vector<uint8_t> decodeMeshopt(const JsonView& view, const JsonView& compression);

  const Document& document_;
  const FileBytes* file_;
  std::string folder_;
  bool allowOutside_;
  FileAccess access_;
  ImportBudget& budget_;
  JsonView bufferList_, viewList_;
  std::deque<Buffer> buffers_;  // deques, because a mutex does not move
  std::deque<View> views_;
  std::mutex filesMutex_;
  std::set<std::string> files_;  // that are part of the budget already
};

}  // namespace scumble::gltf
