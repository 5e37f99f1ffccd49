// The bytes of a file: mapped into memory without a copy, or read.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace scumble {

using Bytes = std::span<const uint8_t>;

// Of a file that is mapped, bytes that another program cuts off meanwhile end this one (SIGBUS).
enum class FileAccess { mapped, read };

class FileBytes {
 public:
  FileBytes() = default;
  FileBytes(FileBytes&& other) noexcept;
  FileBytes& operator=(FileBytes&& other) noexcept;
  ~FileBytes();

  // False when the file cannot be read; `problem` then says why. Only regular files: a pipe could block for
  // ever.
  bool open(const std::string& path, std::string& problem, FileAccess access = FileAccess::mapped);

  Bytes bytes() const { return mapped_ ? Bytes(mapped_, size_) : Bytes(copy_); }
  // Lets go of the memory that what is mapped takes; it is read from the file again where it is needed again.
  void forget() const;

 private:
  bool read(int file, size_t size, std::string& problem);
  bool map(int file, size_t size, std::string& problem);

  const uint8_t* mapped_ = nullptr;
  size_t size_ = 0;  // of what is mapped
  std::vector<uint8_t> copy_;
};

}  // namespace scumble
