#include "gpu/cache_file.h"

#include <cstdio>
#include <cstring>
#include <filesystem>

#include "base/file_bytes.h"
#include "base/whole_file.h"

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

}  // namespace

std::string cacheFile(const std::string& folder, const std::string& kind,
                      const VkPhysicalDeviceProperties& properties) {
  std::string file = folder + "/" + kind + "-";
  for (const uint8_t byte : properties.pipelineCacheUUID) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", byte);
    file += digits;
  }
  return file + ".bin";
}

std::vector<char> readCache(const std::string& file) {
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

bool writeCache(const std::string& file, const std::vector<char>& data) {
  namespace fs = std::filesystem;
  if (data.size() > kMaxBytes) return false;
  std::error_code ignored;
  fs::create_directories(fs::path(file).parent_path(), ignored);
  const fs::file_type there = fs::symlink_status(file, ignored).type();
  if (there != fs::file_type::regular && there != fs::file_type::not_found) return false;
  const Header header = headerFor(data.data(), data.size());
  WholeFile whole(file);
  whole.write(&header, sizeof header);
  whole.write(data.data(), data.size());
  return whole.commit().ok();
}

}  // namespace scumble::gpu
