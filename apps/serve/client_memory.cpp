#include "client_memory.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace scumble::serve {

ClientMemory::~ClientMemory() {
  for (const auto& [name, shared] : shared_) ::close(shared.file);
}

void ClientMemory::share(const std::string& name, const std::string& path, uint64_t bytes) {
  // A pipe or a terminal would make the open wait.
  const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (file < 0)
    throw Refusal{{ErrorKind::unusableFile, path, 0, "file",
                   std::string("it cannot be opened: ") + std::strerror(errno),
                   "make a file that can be read and written"}};
  struct stat state = {};
  if (::fstat(file, &state) != 0 || !S_ISREG(state.st_mode) || uint64_t(state.st_size) < bytes) {
    ::close(file);
    throw Refusal{{ErrorKind::unusableFile, path, 0, "file",
                   "it is no file of " + std::to_string(bytes) + " bytes", "make it as large as you say"}};
  }
  forget(name);
  shared_[name] = {file, bytes};
}

void ClientMemory::forget(const std::string& name) {
  const auto found = shared_.find(name);
  if (found == shared_.end()) return;
  ::close(found->second.file);
  shared_.erase(found);
}

ClientMemory::Range ClientMemory::rangeOf(const nlohmann::json& reference, const std::string& where,
                                          uint64_t unit, uint64_t count) const {
  Members members(reference, where);
  const std::string name = members.requireText("memory");
  const uint64_t offset = members.whole("offset", kMostBytes).value_or(0);
  const uint64_t counted = count > 0 ? count : members.requireWhole("count", kMostBytes / unit);
  members.end();
  const auto found = shared_.find(name);
  if (found == shared_.end()) refuse(where, "there is no memory '" + name + "'", "share it first");
  const uint64_t bytes = counted * unit, size = found->second.bytes;
  if (offset > size || bytes > size - offset)
    refuse(where,
           std::to_string(bytes) + " bytes at " + std::to_string(offset) + " do not lie within the " +
               std::to_string(size) + " of '" + name + "'",
           "share more");
  return {found->second.file, offset, bytes, where};
}

void ClientMemory::readBytes(const Range& range, void* bytes) const {
  auto* to = static_cast<char*>(bytes);
  for (uint64_t done = 0; done < range.bytes;) {
    const ssize_t got = ::pread(range.file, to + done, range.bytes - done, off_t(range.offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) refuse(range.where, "the memory ends before that", "do not cut its file off");
    done += uint64_t(got);
  }
}

void ClientMemory::write(const Range& range, uint64_t at, const void* bytes, uint64_t size) const {
  if (at > range.bytes || size > range.bytes - at)
    refuse(range.where, "more is written than there is room for", "please report this");
  const auto* from = static_cast<const char*>(bytes);
  for (uint64_t done = 0; done < size;) {
    const ssize_t put = ::pwrite(range.file, from + done, size - done, off_t(range.offset + at + done));
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0)
      throw Refusal{{ErrorKind::outputNotWritten, "", 0, range.where,
                     std::string("it cannot be written: ") + std::strerror(errno), "is the disk full?"}};
    done += uint64_t(put);
  }
}

}  // namespace scumble::serve
