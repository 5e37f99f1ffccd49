#include "base/file_bytes.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace scumble {

FileBytes::FileBytes(FileBytes&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}

FileBytes& FileBytes::operator=(FileBytes&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  return *this;
}

FileBytes::~FileBytes() {
  if (data_) munmap(const_cast<uint8_t*>(data_), size_);
}

void FileBytes::forget() const {
  if (data_) madvise(const_cast<uint8_t*>(data_), size_, MADV_DONTNEED);
}

bool FileBytes::open(const std::string& path, std::string& problem) {
  if (path.find('\0') != std::string::npos) {
    problem = "its name holds the character NUL";
    return false;
  }
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    problem =
        errno == ENOENT ? "there is no such file" : std::string("cannot be opened: ") + std::strerror(errno);
    return false;
  }
  struct stat info {};
  if (fstat(file, &info) != 0 || !S_ISREG(info.st_mode)) {
    problem = S_ISDIR(info.st_mode) ? "is a folder, not a file" : "is not a regular file";
    ::close(file);
    return false;
  }
  *this = FileBytes();
  if (info.st_size > 0) {
    void* mapped = mmap(nullptr, static_cast<size_t>(info.st_size), PROT_READ, MAP_PRIVATE, file, 0);
    if (mapped == MAP_FAILED) {
      problem = std::string("cannot be mapped: ") + std::strerror(errno);
      ::close(file);
      return false;
    }
    data_ = static_cast<const uint8_t*>(mapped);
    size_ = static_cast<size_t>(info.st_size);
    madvise(mapped, size_, MADV_WILLNEED);
  }
  ::close(file);
  return true;
}

}  // namespace scumble
