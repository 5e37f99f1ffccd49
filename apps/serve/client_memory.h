// Memory that a client shares by a file, such as those below /dev/shm: meshes lie there, and pictures go
// there. Each access is checked and copies, so that nothing that the client does to it meanwhile can hurt.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "members.h"

namespace scumble::serve {

class ClientMemory {
 public:
  static constexpr uint64_t kMostBytes = uint64_t(1) << 50;

  ClientMemory() = default;
  ~ClientMemory();
  ClientMemory(const ClientMemory&) = delete;
  ClientMemory& operator=(const ClientMemory&) = delete;

  // Opens a file of at least so many bytes, in place of another one of that name.
  void share(const std::string& name, const std::string& path, uint64_t bytes);
  void forget(const std::string& name);

  // What {"memory": NAME, "offset": BYTES, "count": NUMBER} says, as so many of T; without a count, `count`.
  template <class T>
  std::vector<T> read(const nlohmann::json& reference, const std::string& where, uint64_t count = 0) const {
    const Range range = rangeOf(reference, where, sizeof(T), count);
    std::vector<T> values(range.bytes / sizeof(T));
    readBytes(range, values.data());
    return values;
  }

  struct Range {
    int file = -1;
    uint64_t offset = 0, bytes = 0;
    std::string where;
  };
  // The same, of so many bytes each.
  Range rangeOf(const nlohmann::json& reference, const std::string& where, uint64_t unit,
                uint64_t count = 0) const;
  void write(const Range& range, uint64_t at, const void* bytes, uint64_t size) const;

 private:
  struct Shared {
    int file = -1;
    uint64_t bytes = 0;
  };
  void readBytes(const Range& range, void* bytes) const;
  std::map<std::string, Shared> shared_;
};

}  // namespace scumble::serve
