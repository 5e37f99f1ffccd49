// The bytes of a file, mapped into memory without a copy.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace scumble {

using Bytes = std::span<const uint8_t>;

class FileBytes {
 public:
  FileBytes() = default;
  FileBytes(FileBytes&& other) noexcept;
  FileBytes& operator=(FileBytes&& other) noexcept;
  ~FileBytes();

  // False when the file cannot be read; `problem` then says why. Only regular files: a pipe could block for
  // ever.
  bool open(const std::string& path, std::string& problem);

  Bytes bytes() const { return {data_, size_}; }
  // Lets go of the memory that what was read takes; it is read from the file again where it is needed again.
  void forget() const;

 private:
  const uint8_t* data_ = nullptr;
  size_t size_ = 0;
};

}  // namespace scumble
