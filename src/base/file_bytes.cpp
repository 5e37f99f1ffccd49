#include "base/file_bytes.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <exception>
#include <utility>

namespace scumble {

FileBytes::FileBytes(FileBytes&& other) noexcept
    : mapped_(std::exchange(other.mapped_, nullptr)),
      size_(std::exchange(other.size_, 0)),
      copy_(std::move(other.copy_)) {}

FileBytes& FileBytes::operator=(FileBytes&& other) noexcept {
  std::swap(mapped_, other.mapped_);
  std::swap(size_, other.size_);
  std::swap(copy_, other.copy_);
  return *this;
}

FileBytes::~FileBytes() {
  if (mapped_) munmap(const_cast<uint8_t*>(mapped_), size_);
}

void FileBytes::forget() const {
  if (mapped_) madvise(const_cast<uint8_t*>(mapped_), size_, MADV_DONTNEED);
}

bool FileBytes::open(const std::string& path, std::string& problem, FileAccess access) {
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
  *this = FileBytes();
  struct stat info {};
  bool isOpen = false;
  if (fstat(file, &info) != 0 || !S_ISREG(info.st_mode)) {
    problem = S_ISDIR(info.st_mode) ? "is a folder, not a file" : "is not a regular file";
  } else {
    const auto size = static_cast<size_t>(info.st_size);
    isOpen = size == 0 || (access == FileAccess::read ? read(file, size, problem) : map(file, size, problem));
  }
  ::close(file);
  return isOpen;
}

bool FileBytes::map(int file, size_t size, std::string& problem) {
  void* const mapped = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
  if (mapped == MAP_FAILED) {
    problem = std::string("cannot be mapped: ") + std::strerror(errno);
    return false;
  }
  mapped_ = static_cast<const uint8_t*>(mapped);
  size_ = size;
  madvise(mapped, size_, MADV_WILLNEED);
  return true;
}

bool FileBytes::read(int file, size_t size, std::string& problem) {
  try {
    copy_.resize(size);
  } catch (const std::exception&) {
    problem = "needs more memory than there is";
    return false;
  }
  for (size_t done = 0; done < size;) {
    const ssize_t got = ::read(file, copy_.data() + done, size - done);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) {
      problem =
          got < 0 ? std::string("cannot be read: ") + std::strerror(errno) : "was cut off while it was read";
      copy_.clear();
      return false;
    }
    done += size_t(got);
  }
  return true;
}

}  // namespace scumble
