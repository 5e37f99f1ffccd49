// A .tilt is a zip behind a header of its own, or such a zip's content as a folder.
#include <fmt/format.h>
#include <zip.h>

#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "base/file_bytes.h"
#include "scene/import_failure.h"
#include "sketch/byte_reader.h"
#include "sketch/sketch.h"

namespace scumble::sketch {

using namespace scene;

namespace {

constexpr const char* kMetadata = "metadata.json";
constexpr const char* kSketch = "data.sketch";
constexpr std::string_view kHeader = "tilT", kZip = "PK\x03\x04";
// Sketches are not packed, and those of other zips by a tenth or so: more than that is no sketch.
constexpr uint64_t kFreeBytes = 64ull << 20, kBytesPerByte = 64;

struct CloseZip {
  void operator()(zip_t* zip) const { zip_discard(zip); }
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};

// Of a file of that name, or of the first one in a folder: who zips a folder again has that, too.
zip_int64_t placeOf(zip_t* zip, std::string_view name) {
  if (const zip_int64_t place = zip_name_locate(zip, std::string(name).c_str(), 0); place >= 0) return place;
  for (zip_int64_t i = 0; i < zip_get_num_entries(zip, 0); ++i) {
    const char* const found = zip_get_name(zip, zip_uint64_t(i), 0);
    const std::string_view entry = found ? found : "";
    if (entry.ends_with(name) && entry.substr(0, entry.size() - name.size()).ends_with('/')) return i;
  }
  return -1;
}

std::vector<uint8_t> unpacked(zip_t* zip, const char* name, size_t fileSize) {
  zip_stat_t stat;
  zip_stat_init(&stat);
  const zip_int64_t place = placeOf(zip, name);
  if (place < 0 || zip_stat_index(zip, zip_uint64_t(place), 0, &stat) != 0 || !(stat.valid & ZIP_STAT_SIZE) ||
      !(stat.valid & ZIP_STAT_INDEX))
    fail(name, "is not in the file", "a .tilt holds metadata.json and data.sketch");
  if (stat.size > kFreeBytes + kBytesPerByte * fileSize)
    fail(name, fmt::format("would unpack to {} bytes, far more than such a file can hold", stat.size),
         "check how it was made");
  const std::unique_ptr<zip_file_t, CloseZip> file(zip_fopen_index(zip, stat.index, 0));
  if (!file) fail(name, fmt::format("cannot be unpacked: {}", zip_strerror(zip)), "get the file again");
  std::vector<uint8_t> bytes(stat.size);
  // What the directory says of its size may be wrong.
  size_t done = 0;
  while (done < bytes.size()) {
    const zip_int64_t got = zip_fread(file.get(), bytes.data() + done, bytes.size() - done);
    if (got <= 0) fail(name, "cannot be unpacked: it is damaged", "get the file again");
    done += size_t(got);
  }
  return bytes;
}

FileBytes opened(const std::filesystem::path& path) {
  FileBytes file;
  std::string problem;
  if (!file.open(path.string(), problem, FileAccess::read))
    fail(path.filename().string(), problem, "an unzipped .tilt holds metadata.json and data.sketch");
  return file;
}

}  // namespace

bool isTiltFile(Bytes file) {
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  return text.starts_with(kHeader) || (text.starts_with(kZip) && text.find(kSketch) != text.npos);
}

Painting readTiltFile(Bytes file, ImportWarnings& warnings) {
  Bytes packed = file;
  if (std::string_view(reinterpret_cast<const char*>(file.data()), file.size()).starts_with(kHeader)) {
    ByteReader header(file, "header");
    header.take(kHeader.size());
    const auto headerSize = header.read<uint16_t>();
    if (headerSize < 8 || headerSize > file.size())
      header.failHere(fmt::format("says that it has {} bytes", headerSize));
    packed = file.subspan(headerSize);
  }
  zip_error_t error;
  zip_error_init(&error);
  const auto why = [&] {
    std::string text = zip_error_strerror(&error);
    zip_error_fini(&error);
    return text;
  };
  zip_source_t* const source = zip_source_buffer_create(packed.data(), packed.size(), 0, &error);
  if (!source) fail({}, "cannot be unpacked: " + why());
  const std::unique_ptr<zip_t, CloseZip> zip(zip_open_from_source(source, ZIP_RDONLY, &error));
  if (!zip) {
    zip_source_free(source);
    fail({}, "cannot be unpacked: " + why(), "the file is cut off or damaged; get it again");
  }
  zip_error_fini(&error);
  const std::vector<uint8_t> metadata = unpacked(zip.get(), kMetadata, file.size()),
                             sketch = unpacked(zip.get(), kSketch, file.size());
  return readTilt(metadata, sketch, warnings);
}

bool isSketchFolder(const std::string& path) {
  std::error_code failed;
  return std::filesystem::is_directory(path, failed) &&
         std::filesystem::exists(std::filesystem::path(path) / kSketch, failed);
}

Painting readSketchFolder(const std::string& path, ImportWarnings& warnings) {
  const FileBytes metadata = opened(std::filesystem::path(path) / kMetadata),
                  sketch = opened(std::filesystem::path(path) / kSketch);
  return readTilt(metadata.bytes(), sketch.bytes(), warnings);
}

}  // namespace scumble::sketch
