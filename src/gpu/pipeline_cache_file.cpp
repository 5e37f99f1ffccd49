#include "gpu/pipeline_cache_file.h"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "base/file_bytes.h"
#include "base/file_size_signal.h"

namespace scumble::gpu {

namespace {

// All pipelines of all passes take some megabytes.
constexpr size_t kMaxBytes = 256 << 20;

// Before the driver's data.
struct Header {
  char magic[8] = {'s', 'c', 'u', 'm', 'b', 'l', 'e', '1'};
  uint64_t size = 0, sum = 0;
};

// FNV-1a.
uint64_t sumOf(const char* bytes, size_t size) {
  uint64_t sum = 0xcbf29ce484222325;
  for (size_t i = 0; i < size; ++i) sum = (sum ^ uint8_t(bytes[i])) * 0x100000001b3;
  return sum;
}

Header headerFor(const char* bytes, size_t size) {
  Header header;
  header.size = size, header.sum = sumOf(bytes, size);
  return header;
}

bool writeAll(int descriptor, const void* bytes, size_t size) {
  for (const char* next = static_cast<const char*>(bytes); size > 0;) {
    const ssize_t written = write(descriptor, next, size);
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) next += written, size -= size_t(written);
  }
  return true;
}

}  // namespace

std::string pipelineCacheFile(const std::string& folder, const VkPhysicalDeviceProperties& properties) {
  std::string file = folder + "/pipelines-";
  for (const uint8_t byte : properties.pipelineCacheUUID) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", byte);
    file += digits;
  }
  return file + ".bin";
}

std::vector<char> readPipelineCache(const std::string& file) {
  FileBytes opened;
  std::string ignored;
  if (!opened.open(file, ignored) || opened.bytes().size() > kMaxBytes) return {};
  const char* bytes = reinterpret_cast<const char*>(opened.bytes().data());
  const size_t size = opened.bytes().size();
  if (size < sizeof(Header)) return {};
  const std::vector<char> data(bytes + sizeof(Header), bytes + size);
  const Header wanted = headerFor(data.data(), data.size());
  return std::memcmp(bytes, &wanted, sizeof wanted) == 0 ? data : std::vector<char>();
}

void writePipelineCache(const std::string& file, const std::vector<char>& data) {
  namespace fs = std::filesystem;
  if (data.size() <= sizeof(VkPipelineCacheHeaderVersionOne) || data.size() > kMaxBytes) return;
  std::error_code ignored;
  fs::create_directories(fs::path(file).parent_path(), ignored);
  const fs::file_type there = fs::symlink_status(file, ignored).type();
  if (there != fs::file_type::regular && there != fs::file_type::not_found) return;
  const FileSizeSignalHeld held;
  std::string passing = file + ".XXXXXX";
  const int descriptor = mkostemp(passing.data(), O_CLOEXEC);
  if (descriptor < 0) return;
  const Header header = headerFor(data.data(), data.size());
  const bool written =
      writeAll(descriptor, &header, sizeof header) && writeAll(descriptor, data.data(), data.size());
  if (close(descriptor) != 0 || !written || std::rename(passing.c_str(), file.c_str()) != 0)
    unlink(passing.c_str());
}

}  // namespace scumble::gpu
