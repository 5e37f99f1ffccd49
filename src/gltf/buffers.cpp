#include "gltf/buffers.h"

#include <meshoptimizer.h>

#include "gltf/uri.h"

namespace scumble::gltf {

Buffers::Buffers(const Document& document, const FileBytes* file, std::string folder, bool allowOutside,
                 FileAccess access, ImportBudget& budget)
    : document_(document),
      file_(file),
      folder_(std::move(folder)),
      allowOutside_(allowOutside),
      access_(access),
      budget_(budget),
      bufferList_(document.list("buffers")),
      viewList_(document.list("bufferViews")),
      buffers_(bufferList_.size()),
      views_(viewList_.size()) {}

Bytes Buffers::buffer(size_t i) {
  Buffer& buffer = buffers_[i];
  const std::lock_guard lock(buffer.mutex);
  if (!buffer.loaded) load(i, buffer);
  return buffer.bytes;
}

void Buffers::load(size_t i, Buffer& buffer) {
  const JsonView json = bufferList_.at(i);
  const uint64_t length = json.requiredCount("byteLength");
  Bytes bytes;
  if (json.has("uri")) {
    // A reference, because embedded data is megabytes long.
    const Json& uri = json.json()["uri"];
    if (!uri.is_string()) json.failAt("uri", "is not a string");
    const std::string& text = uri.get_ref<const std::string&>();
    const std::string path = json.pathOf("uri");
    if (isDataUri(text)) {
      buffer.holder.data = decodeDataUri(text, path);
      bytes = buffer.holder.data;
    } else {
      std::string problem;
      const std::string file = resolveFileUri(text, folder_, allowOutside_, path);
      if (!buffer.holder.file.open(file, problem, access_))
        fail(path, "the buffer \"" + file + "\" " + problem, "put it where the scene expects it");
      bytes = buffer.holder.file.bytes();
      const std::lock_guard lock(filesMutex_);
      if (files_.insert(file).second) budget_.addBacking(bytes.size());
    }
  } else if (i == 0 && document_.hasBinaryChunk()) {
    bytes = document_.binaryChunk();
  } else {
    fail(json.path(), "has neither a uri nor a binary chunk, so its bytes are missing",
         "export the scene again");
  }
  if (bytes.size() < length)
    fail(json.path(),
         "is said to be " + std::to_string(length) + " bytes long, but holds only " +
             std::to_string(bytes.size()),
         "copy or export the scene again");
  buffer.bytes = bytes.first(length);
  buffer.loaded = true;
}

void Buffers::forgetFiles() {
  if (file_) file_->forget();
  for (Buffer& buffer : buffers_) {
    const std::lock_guard lock(buffer.mutex);
    buffer.holder.file.forget();
  }
}

// The bytes that "buffer", "byteOffset" and "byteLength" describe: a view's own or its compressed ones.
Bytes Buffers::viewBytes(const JsonView& view) {
  const size_t index = static_cast<size_t>(view.requiredIndex("buffer", buffers_.size(), "buffer"));
  const uint64_t offset = view.count("byteOffset", 0), length = view.requiredCount("byteLength");
  const Bytes bytes = buffer(index);
  if (offset > bytes.size() || length > bytes.size() - offset)
    fail(view.path(),
         "reaches to byte " + std::to_string(offset + length) + " of a buffer of " +
             std::to_string(bytes.size()),
         "export the scene again");
  return bytes.subspan(offset, length);
}

Bytes Buffers::view(size_t i) {
  const JsonView json = viewList_.at(i);
  const JsonView compression = json.extension("EXT_meshopt_compression");
  if (!compression) return viewBytes(json);
  View& view = views_[i];
  const std::lock_guard lock(view.mutex);
  if (!view.decoded) {
    view.bytes = decodeMeshopt(json, compression);
    view.decoded = true;
  }
  return view.bytes;
}

size_t Buffers::viewStride(size_t i) const {
  const JsonView json = viewList_.at(i);
  const uint64_t stride = json.count("byteStride", 0);
  if (stride > 255) json.failAt("byteStride", "is larger than 252");
  return stride;
}

std::vector<uint8_t> Buffers::decodeMeshopt(const JsonView& view, const JsonView& compression) {
  const Bytes source = viewBytes(compression);
  const uint64_t stride = compression.requiredCount("byteStride"), count = compression.requiredCount("count");
  const std::string mode = compression.text("mode"), filter = compression.text("filter", "NONE");

  // What the codec can do at all, and the best ratio that each mode can reach: the size is known to be backed
  // by bytes before it is allocated.
  const bool attributes = mode == "ATTRIBUTES", triangles = mode == "TRIANGLES", indices = mode == "INDICES";
  if (!attributes && !triangles && !indices) compression.failAt("mode", "is not a known mode");
  if (attributes ? stride == 0 || stride > 256 || stride % 4 != 0 : stride != 2 && stride != 4)
    compression.failAt("byteStride", "does not fit the mode");
  if (triangles && count % 3 != 0) compression.failAt("count", "is not a multiple of three");
  if (count > (1ull << 32) || count * stride > 64 * (uint64_t(source.size()) + 1024))
    compression.failAt("count", "is more than the compressed bytes can hold", "export the scene again");
  if (view.has("byteLength") && view.count("byteLength", 0) != count * stride)
    view.failAt("byteLength", "does not fit the compressed count and stride");
  const bool octahedral = filter == "OCTAHEDRAL", quaternion = filter == "QUATERNION",
             exponential = filter == "EXPONENTIAL";
  if (filter != "NONE" && !octahedral && !quaternion && !exponential)
    compression.failAt("filter", "is not a known filter");
  if (filter != "NONE" && !attributes) compression.failAt("filter", "is allowed for ATTRIBUTES only");
  if ((octahedral && stride != 4 && stride != 8) || (quaternion && stride != 8))
    compression.failAt("filter", "does not fit the byteStride");

  budget_.takeBytes(count * stride, compression.path());
  std::vector<uint8_t> bytes(count * stride);
  int status = 0;
  if (attributes)
    status = meshopt_decodeVertexBuffer(bytes.data(), count, stride, source.data(), source.size());
  else if (triangles)
    status = meshopt_decodeIndexBuffer(bytes.data(), count, stride, source.data(), source.size());
  else
    status = meshopt_decodeIndexSequence(bytes.data(), count, stride, source.data(), source.size());
  if (status != 0)
    fail(compression.path(), "holds compressed data that is damaged", "export the scene again");

  if (octahedral) meshopt_decodeFilterOct(bytes.data(), count, stride);
  if (quaternion) meshopt_decodeFilterQuat(bytes.data(), count, stride);
  if (exponential) meshopt_decodeFilterExp(bytes.data(), count, stride);
  return bytes;
}

std::vector<std::string> Buffers::files() const {
  std::vector<std::string> files;
  for (const char* name : {"buffers", "images"}) {
    const JsonView list = document_.list(name);
    for (size_t i = 0; i < list.size(); ++i) {
      const JsonView json = list.at(i);
      if (!json.has("uri") || !json.json()["uri"].is_string()) continue;
      const std::string& uri = json.json()["uri"].get_ref<const std::string&>();
      if (uri.empty() || isDataUri(uri)) continue;
      // A picture on the network has a stand-in, where it is used at all; without its vertices a scene is
      // none.
      if (std::string_view(name) == "images" && isRemoteUri(uri)) continue;
      std::string file =
          resolveFileUri(uri, folder_.empty() ? "." : folder_, allowOutside_, json.pathOf("uri"));
      if (!folder_.empty()) files.push_back(std::move(file));
    }
  }
  return files;
}

bool Buffers::imageFile(const std::string& uri, const std::string& jsonPath, Holder& holder, Bytes& bytes,
                        std::string& problem) const {
  try {
    if (isDataUri(uri)) {
      holder.data = decodeDataUri(uri, jsonPath);
      bytes = holder.data;
      return true;
    }
    if (isRemoteUri(uri)) {
      problem = "it lies on the network, which scumble never uses; put it beside the scene";
      return false;
    }
    const std::string file = resolveFileUri(uri, folder_, allowOutside_, jsonPath);
    if (!holder.file.open(file, problem, access_)) {
      problem = "the image \"" + file + "\" " + problem;
      return false;
    }
    bytes = holder.file.bytes();
    return true;
  } catch (const ImportFailure& failure) {
    problem = failure.error.problem;
    return false;
  }
}

}  // namespace scumble::gltf
